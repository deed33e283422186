//! The solution at which a rest on a stop, or the hold of a joint, begins or ends, to rounding.
//!
//! There a limit of the contact is zero, or the smallest value of a guard, as a function along the curve of solutions. If a
//! flight takes no time there, its equations are singular, so the curve is that of the signature without it.

use super::change::Difference;
use super::closest::closest;
use super::equations::MachineEquations;
use super::joined::join;
use super::problem::{MachineProblem, MachineSolution};
use super::rest::{RestZero, rest_zero};
use crate::continuation::trace::equations::{Equations, correct, tangent, unit};
use crate::continuation::trace::tracer::{Tracer, last};
use crate::orbit::{MachineFrame, MachineRing};

/// The first step of the secant method along the curve, and the largest distance from the solution at which it begins.
const FIRST: f64 = 1e-7;
const MOST: f64 = 1e-2;
/// The largest number of its steps.
const STEPS: u32 = 12;

/// The solution, near `inside`, at which a rest begins or ends, and which of both, if the events differ beyond as `found`; its
/// states are those of `inside`. `None` if nothing of the contact is zero close by. An impact that disappears with the flight
/// after a release belongs to a rest that was interrupted.
pub(super) fn at_rest(
    tracer: &Tracer<MachineProblem>,
    inside: &MachineSolution,
    found: &Difference,
) -> Option<(MachineSolution, Difference)> {
    let (contact, interrupted) = match *found {
        Difference::Rest { place, .. } => (place, false),
        Difference::Disappears { stop, .. } => (stop, true),
        _ => return None,
    };
    let old = &tracer.problem.equations;
    let (machine, mut ring) = old.split(&inside.w)?;
    let frame = MachineFrame::new(&machine);
    let sizes = inside.known.cycle.as_ref()?.sizes;
    let joined = join(&frame, &mut ring, contact);
    let zero = rest_zero(&frame, &ring, (contact, sizes.1))?;
    (!interrupted || joined && zero.rests(&ring, contact)).then_some(())?;
    // without the flight that takes no time the events are those beyond
    let begins = zero.rests(&ring, contact) == joined;
    let number = last(&inside.w);
    let guess = MachineEquations::join(&machine, &ring, [number]);
    let equations = MachineEquations::new((&machine, old.family.clone()), ring, sizes, old.scales);
    let value = |frame: &MachineFrame<'_>, ring: &MachineRing| match &zero {
        RestZero::Limit(limit) => Some(limit.of(frame, ring)?.value),
        RestZero::Touch(touch) => Some(closest(frame, ring, (touch.leg, touch.guard))?.0),
    };
    let w = zero_near(&equations, &guess, MOST, value)?;
    let mut found = inside.clone();
    *found.w.last_mut()? = last(&w);
    let joint = contact >= machine.stops().len();
    Some((found, Difference::Rest { place: contact, joint, begins }))
}

/// The solution near `guess` at which a function of the machine and its cycle is zero, by the secant method along the curve of
/// solutions. `None` if it is none or farther away than `most`.
pub(super) fn zero_near(
    equations: &MachineEquations,
    guess: &[f64],
    most: f64,
    value: impl Fn(&MachineFrame<'_>, &MachineRing) -> Option<f64>,
) -> Option<Vec<f64>> {
    let row = unit(guess.len(), guess.len() - 1, 1.0);
    let (from, _) = correct(equations, guess, &row, last(guess))?;
    let along = tangent(equations, &from, &row)?;
    let (row, level) = (equations.row(&along), equations.dot(&along, &from));
    let at = |s: f64| {
        let guess: Vec<f64> = from.iter().zip(&along).map(|(w, t)| w + s * t).collect();
        Some(correct(equations, &guess, &row, level + s)?.0)
    };
    let value = |s: f64| {
        let (machine, ring) = equations.split(&at(s)?)?;
        value(&MachineFrame::new(&machine), &ring)
    };
    let (mut before, mut at_before, mut now) = (0.0, value(0.0)?, FIRST);
    for _ in 0..STEPS {
        let at_now = value(now)?;
        if at_now == 0.0 || at_now == at_before {
            break;
        }
        let next = now - at_now * (now - before) / (at_now - at_before);
        (next.abs() <= most).then_some(())?;
        (before, at_before, now) = (now, at_now, next);
    }
    at(now)
}
