//! Branches that lead from cycles with impacts to the steady motion without impacts, or back.
//!
//! With damping the steady motion is one cycle. Where it grazes a stop, a cycle with one impact of speed zero is the
//! same motion, so a branch continues from one to the other as at any grazing event. Without damping it is one of a
//! continuum of motions without impacts. Where it grazes, the orbits 1/n of all n end together, and the branch ends.

use super::graze::{Beyond, striking};
use crate::continuation::equations::cycle_equations::CycleEquations;
use crate::continuation::equations::test_functions::TestFunction;
use crate::continuation::trace::equations::tangent;
use crate::orbit::{Ring, crest, room};
use crate::system::{Oscillator, Side};
use core::f64::consts::PI;

/// The relative distance to either side at which clearances are compared.
const ASIDE: f64 = 1e-6;

/// The steady motion without impacts beyond grazing contact with the stop on `side`, in the direction in which it
/// clears the stop; `None` without damping, or if no direction is found.
pub(crate) fn leaving(equations: &CycleEquations, osc: &Oscillator, value: f64, side: Side) -> Option<Beyond> {
    if osc.damping() <= 0.0 {
        return None;
    }
    let equations = equations.with(&Ring::free());
    let w = vec![value];
    let mut along = tangent(&equations, &w, &equations.parameter_row())?;
    let at = |step: f64| {
        let (osc, _) = equations.split(&[value + step * along[0] * ASIDE])?;
        Some(room(&osc, side))
    };
    // one-sided at the end of the range of a parameter
    let (here, up, down) = (room(osc, side), at(1.0), at(-1.0));
    let slope = match (up, down) {
        (Some(up), Some(down)) => up - down,
        (Some(up), None) => up - here,
        (None, Some(down)) => here - down,
        (None, None) => return None,
    };
    if slope < 0.0 {
        along.iter_mut().for_each(|t| *t = -*t);
    }
    let positive = osc.stops().map(|(side, _)| TestFunction::Room(side)).collect();
    (slope != 0.0).then_some(Beyond { equations, w, tangent: along, positive })
}

/// The cycle with one impact on each stop of `touched`, the stops that the steady motion without impacts grazes.
pub(crate) fn arriving(equations: &CycleEquations, osc: &Oscillator, value: f64, touched: &[Side]) -> Option<Beyond> {
    let first = crest(osc, *touched.first()?);
    let unknowns = (0..touched.len()).flat_map(|k| [first + PI * k as f64, 0.0]).collect();
    let ring = Ring { sides: touched.to_vec(), unknowns, periods: 1 };
    let new: Vec<usize> = (0..touched.len()).collect();
    striking(equations.with(&ring), CycleEquations::join(&ring, value), &new)
}

/// Whether the motion without impacts reaches a stop at the resonance between two oscillators at which it clears the
/// stops. A step must not pass such a resonance.
pub(crate) fn hides(from: &Oscillator, to: &Oscillator) -> bool {
    let zeta = to.damping();
    // where the steady amplitude is largest, 1/(2 zeta sqrt(1 - zeta^2))
    let highest = (1.0 - 2.0 * zeta * zeta).max(0.0).sqrt();
    let (low, high) = (from.beta().min(to.beta()), from.beta().max(to.beta()));
    let amplitude = 1.0 / (2.0 * zeta * ((1.0 - zeta) * (1.0 + zeta)).max(0.0).sqrt());
    low < highest && highest < high && to.stops().any(|(_, stop)| amplitude > stop.gap)
}
