//! Where a cycle becomes another one repeated twice: the flip of that one.

use super::equations::MachineEquations;
use super::problem::{Judged, MINUS_ONE, MachineProblem, MachineSolution};
use crate::continuation::trace::secant;
use crate::continuation::trace::tracer::Problem;
use crate::orbit::{MachineCycle, MachineFrame, MachineLap, MachineRing};

/// The solution at which the cycle of a branch repeats itself after half its period, near the unknowns `w` of the whole
/// cycle; `here` is a solution near by. `None` if the halves of `w` differ.
///
/// The equations of the whole cycle are singular there, so its half is solved for: the value of the number is that of its
/// flip.
pub(super) fn halved(problem: &MachineProblem, here: &MachineSolution, w: &[f64]) -> Option<MachineSolution> {
    let MachineProblem { equations, range } = problem;
    let (machine, ring) = equations.split(w)?;
    let cycle = here.known.cycle.as_ref()?;
    ring.is_twice(&MachineFrame::new(&machine), cycle.sizes).then_some(())?;
    let as_it_is = || {
        let known = Judged { cycle: Some(cycle.clone()), ..here.known.clone() };
        MachineSolution { w: w.to_vec(), tangent: here.tangent.clone(), values: here.values.clone(), known }
    };
    let half = ring.half();
    let guess = MachineEquations::join(&machine, &half, *w.last()?);
    let family = equations.family.clone();
    let equations = MachineEquations::new((&machine, family), half, cycle.sizes, equations.scale);
    let once = MachineProblem { equations, range: *range };
    let minus_one = |w: &[f64]| once.test(MINUS_ONE, w, || None);
    let Some(solved) = secant::zero(&once, &guess, minus_one) else { return Some(as_it_is()) };
    let (machine, half) = once.equations.split(&solved)?;
    let twice = repeated(&MachineFrame::new(&machine), &half);
    let Some((ring, cycle)) = twice else { return Some(as_it_is()) };
    let known = Judged { multipliers: cycle.multipliers.clone(), cycle: Some(cycle), ..here.known.clone() };
    let w = MachineEquations::join(&machine, &ring, *solved.last()?);
    Some(MachineSolution { w, tangent: here.tangent.clone(), values: here.values.clone(), known })
}

/// The motion of a cycle over twice its period, as a ring and as a cycle.
fn repeated(frame: &MachineFrame<'_>, half: &MachineRing) -> Option<(MachineRing, MachineCycle)> {
    let (_, begin) = half.middle(frame)?;
    let (periods, period) = (2 * half.periods, 2.0 * half.period(frame));
    let lap = MachineLap::fly(frame, &begin, period)?;
    let residual = frame.distance(&begin, &lap.end, lap.sizes);
    let cycle = MachineCycle::of(frame, (&begin, periods), &lap, residual, vec![begin.clone()]);
    Some((MachineRing::of(frame, &begin, (periods, period))?, cycle))
}
