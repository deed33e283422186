//! The solution near a guess.

use super::cycle::Cycle;
use super::newton::{cycle, solve};
use super::physical::Orbit;
use super::ring::Ring;
use crate::system::Oscillator;

/// The cycle with the impacts of `guess`, on the same stops and in the same order, that solves the equations of `osc`;
/// `None` if Newton's method does not converge from there, or if `guess` sticks.
///
/// Only phases, speeds and intervals of the guess are used. Newton's method has all impacts as unknowns and searches
/// for no first contact, so it also converges near grazing impacts, and to inadmissible solutions, which are marked.
/// The speed of an impact of such a solution may be zero or negative.
///
/// ```
/// use vibroimpact::{Oscillator, orbit::{one_impact, refine}};
/// // followed by hand: from a damping of 0.05 to one of 0.06
/// let osc = Oscillator::new(1.0, 2.0, 0.8)?.with_damping(0.05)?;
/// let orbit = one_impact(&osc, 1).pop().expect("it exists");
/// let other = osc.with_damping(0.06)?;
/// let refined = refine(&other, &orbit.cycle).expect("it is near");
/// assert!(refined.physical && refined.cycle.residual < 1e-14);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn refine(osc: &Oscillator, guess: &Cycle) -> Option<Orbit> {
    let (ring, flights) = solve(osc, Ring::of(osc, guess)?)?;
    Some(Orbit::judged(osc, cycle(osc, &ring, &flights)))
}
