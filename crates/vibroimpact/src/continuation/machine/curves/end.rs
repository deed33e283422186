//! The reason why a curve of a machine ends where no further step converges.
//!
//! Steps become ever shorter towards a point at which the equations are singular. The last solution shows its kind: a flight
//! takes no time any more, or both halves of the cycle have become equal.

use super::moment::Moment;
use super::problem::{CurveProblem, CurveSolution};

use crate::continuation::curves::{CurveEvent, CurveKind};
use crate::orbit::{Chatter, MachineFrame};

/// A flight that is shorter than this, in forcing periods or without forcing in periods of the cycle, takes no time.
const SHORT: f64 = 1e-3;

/// The event at the end of a curve; `None` if no reason is known.
pub(super) fn reason(problem: &CurveProblem, here: &CurveSolution) -> Option<CurveEvent> {
    let (machine, ring) = problem.equations.split(&here.w)?;
    let (m, stops) = (ring.len(), machine.stops().len());
    let period = machine.period().unwrap_or_else(|| ring.period(&MachineFrame::new(&machine)));
    let own = problem.equations.condition.moments(&MachineFrame::new(&machine), &ring);
    // flights between impacts of a chatter are short, and those of a moment
    let bounces: Vec<usize> = Chatter::all(&ring).iter().flat_map(|chatter| chatter.impacts(&ring)).collect();
    let within = |k: usize| {
        let of = |moment: &Moment| moment.has(k, m) && matches!(moment, Moment::Events(_, last) if k != *last);
        bounces.contains(&k) || own.iter().any(of)
    };
    let shortest =
        (0..m).filter(|k| !within(*k)).min_by(|a, b| ring.time(*a, &machine).total_cmp(&ring.time(*b, &machine)))?;
    if m > 1 && ring.time(shortest, &machine) < SHORT * period {
        let (first, second) =
            (ring.events[shortest].guard.place(stops), ring.events[(shortest + 1) % m].guard.place(stops));
        return Some(match problem.kind {
            _ if first != second || first >= stops => CurveEvent::Corner { first, second },
            CurveKind::Grazing { .. } => CurveEvent::DoubleGrazing { stop: first },
            _ => CurveEvent::Touch { stop: first },
        });
    }
    let twice = ring.is_twice(&MachineFrame::new(&machine), here.known.cycle.as_ref()?.sizes);
    twice.then_some(CurveEvent::DegenerateFlip)
}
