//! Two events that come so close that no further step converges.

use super::at_rest::at_rest;
use super::change::Difference;
use super::joined::SHORT;
use super::problem::{MachineProblem, MachineSolution};
use crate::continuation::trace::tracer::Tracer;

/// Events with phases that differ by less happen at the same time.
const TOGETHER: f64 = 1e-6;

/// The solution at which two events happen at the same time, close to the last one, and what changes beyond: a rest begins or
/// ends, if both are of one contact, else the events change their order.
pub(super) fn meeting(tracer: &Tracer<MachineProblem>) -> Option<(MachineSolution, Difference)> {
    let here = &tracer.here;
    let (machine, ring) = tracer.problem.equations.split(&here.w)?;
    let (stops, m) = (machine.stops().len(), ring.len());
    let of = |k: usize| ring.events[k % m].guard.place(stops);
    let rests = |k: usize| ring.events[k % m].after[of(k)].constrains();
    let angle = |k: usize| ring.theta(k + 1) - ring.theta(k);
    let short = |k: &usize| angle(*k) < SHORT && of(*k) == of(k + 1) && rests(*k) != rests(k + 1);
    let rest = (0..m).filter(short).find_map(|k| {
        let found = Difference::Rest { place: of(k), joint: of(k) >= stops, begins: rests(k + 1) };
        at_rest(tracer, here, &found).or_else(|| (angle(k) < TOGETHER).then(|| (here.clone(), found)))
    });
    rest.or_else(|| {
        let at = (0..m).find(|k| angle(*k) < TOGETHER && of(*k) != of(k + 1))?;
        Some((here.clone(), Difference::Corner { first: of(at), second: of(at + 1) }))
    })
}
