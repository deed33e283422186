//! Where a cycle becomes another one repeated twice: the flip of that one.

use super::equations::MachineEquations;
use super::problem::{Judged, MINUS_ONE, MachineProblem, MachineSolution};
use crate::continuation::trace::secant;
use crate::continuation::trace::tracer::Problem;
use crate::machine::Machine;
use crate::orbit::{MachineFrame, MachineLap, MachineRing, machine::Cycle};

/// The solution at which the cycle of a branch repeats itself after half its period, near the unknowns `w` of the whole
/// cycle; `here` is a solution near by. `None` if the halves of `w` differ.
pub(super) fn halved(problem: &MachineProblem, here: &MachineSolution, w: &[f64]) -> Option<MachineSolution> {
    let (machine, ring) = problem.equations.split(w)?;
    let cycle = here.known.cycle.as_ref()?;
    ring.is_twice(&MachineFrame::new(&machine), cycle.sizes).then_some(())?;
    let exact = flip_of_half(problem, (&machine, ring), cycle.sizes, *w.last()?);
    let (w, cycle) = exact.unwrap_or_else(|| (w.to_vec(), cycle.clone()));
    let known = Judged { multipliers: cycle.multipliers.clone(), cycle: Some(cycle), ..here.known.clone() };
    Some(MachineSolution { w, tangent: here.tangent.clone(), values: here.values.clone(), known })
}

/// The unknowns and the cycle where the half of `ring` has its flip, near this value of the number. The equations of the
/// whole cycle are singular there, so its half is solved for.
fn flip_of_half(
    MachineProblem { equations, range, .. }: &MachineProblem,
    (machine, ring): (&Machine, MachineRing),
    sizes: (f64, f64),
    value: f64,
) -> Option<(Vec<f64>, Cycle)> {
    let half = ring.half();
    let guess = MachineEquations::join(machine, &half, [value]);
    let equations = MachineEquations::new((machine, equations.family.clone()), half, sizes, equations.scales);
    let once = MachineProblem::new(&MachineFrame::new(machine), equations, *range, sizes);
    let solved = secant::zero(&once.equations, &guess, |w| once.test(MINUS_ONE, w, || None))?;
    let (machine, half) = once.equations.split(&solved)?;
    let (ring, cycle) = repeated(&MachineFrame::new(&machine), &half)?;
    Some((MachineEquations::join(&machine, &ring, [*solved.last()?]), cycle))
}

/// The motion of a cycle over twice its period, as a ring and as a cycle.
fn repeated(frame: &MachineFrame<'_>, half: &MachineRing) -> Option<(MachineRing, Cycle)> {
    let (_, begin) = half.middle(frame)?;
    let (periods, period) = (2 * half.periods, 2.0 * half.period(frame));
    let lap = MachineLap::fly(frame, &begin, period)?;
    let residual = frame.distance(&begin, &lap.end, lap.sizes);
    let cycle = Cycle::of(frame, (&begin, periods), &lap, residual, vec![begin.clone()]);
    Some((MachineRing::of(frame, &begin, (periods, period))?, cycle))
}
