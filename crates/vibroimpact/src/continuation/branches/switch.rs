//! Branches that begin at a flip or at a branch point, where a multiplier is -1 or +1.

use super::branch::Branch;
use super::impact_branch::ImpactBranch;
use super::options::{BranchError, BranchOptions, scale};
use super::point::SolutionPoint;
use crate::continuation::equations::cycle_equations::CycleEquations;
use crate::continuation::event::BranchEvent;
use crate::continuation::trace::equations::Equations;
use crate::continuation::trace::secant;
use crate::orbit::{Block, Floquet, Ring, blocks, solve};
use crate::system::{Oscillator, ParameterPath};
use core::ops::RangeInclusive;

impl Branch {
    /// The branch of twice the period that begins or ends at `flip`, a [flip](BranchEvent::Flip) of a branch of `osc`
    /// in the same parameters.
    ///
    /// It begins in the direction that is reversed by one period of the cycle. The opposite direction gives the same
    /// cycles shifted by one period, so there is only one branch.
    ///
    /// # Errors
    /// [`BranchError::NotThere`] if the point is not a flip, otherwise as [`Branch::new`].
    pub fn from_flip(
        osc: &Oscillator,
        flip: &SolutionPoint,
        varying: impl Into<ParameterPath>,
        range: RangeInclusive<f64>,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        if flip.event != Some(BranchEvent::Flip) {
            return Err(BranchError::NotThere);
        }
        let varying = varying.into();
        let (osc, ring, flights) = solved(osc, flip, &varying)?;
        let once = carried(&osc, &ring, &flights, -1.0).ok_or(BranchError::NoCycle)?;
        // after one period the direction is reversed
        let direction: Vec<f64> = once.iter().copied().chain(once.iter().map(|d| -d)).collect();
        leave(&osc, &ring.repeated(2), (varying, flip.value), range, direction, options)
    }

    /// The two branches that leave a branch of `osc` in the same parameters at a [branch
    /// point](BranchEvent::BranchPoint), one to either side.
    ///
    /// # Errors
    /// [`BranchError::NotThere`] if the point is not a branch point, otherwise as [`Branch::new`].
    pub fn from_branch_point(
        osc: &Oscillator,
        point: &SolutionPoint,
        varying: impl Into<ParameterPath>,
        range: RangeInclusive<f64>,
        options: BranchOptions,
    ) -> Result<[Self; 2], BranchError> {
        if point.event != Some(BranchEvent::BranchPoint) {
            return Err(BranchError::NotThere);
        }
        let varying = varying.into();
        let (osc, ring, flights) = solved(osc, point, &varying)?;
        let direction = carried(&osc, &ring, &flights, 1.0).ok_or(BranchError::NoCycle)?;
        let back: Vec<f64> = direction.iter().map(|d| -d).collect();
        let leaving = |direction| leave(&osc, &ring, (varying.clone(), point.value), range.clone(), direction, options);
        Ok([leaving(direction)?, leaving(back)?])
    }
}

/// The oscillator, the ring and the linearised flights at a point of a branch.
fn solved(
    osc: &Oscillator,
    point: &SolutionPoint,
    varying: &ParameterPath,
) -> Result<(Oscillator, Ring, Vec<Block>), BranchError> {
    let osc = varying.set(osc, point.value).map_err(|_| BranchError::NoCycle)?;
    let ring = Ring::of(&osc, &point.cycle).ok_or(BranchError::Rests)?;
    // at a branch point the equations are singular, so the interpolated point is used as it is
    let solved = solve(&osc, ring.clone());
    let (ring, flights) = match solved {
        Some(solved) => solved,
        None => {
            let flights = blocks(&osc, &ring).ok_or(BranchError::NoCycle)?;
            (ring, flights)
        }
    };
    Ok((osc, ring, flights))
}

/// The direction at every impact that one period of the cycle multiplies by `multiplier`; `None` if an impact grazes.
fn carried(osc: &Oscillator, ring: &Ring, flights: &[Block], multiplier: f64) -> Option<Vec<f64>> {
    let mut at = Floquet::new(osc, ring, flights).direction(multiplier);
    let mut all = Vec::with_capacity(2 * ring.len());
    for block in flights {
        all.extend(at);
        // the equations of a flight: `left` times the change before it and `right` times that after it add up to zero
        let driven = block.left.apply(at);
        at = block.right.solve([-driven[0], -driven[1]])?;
    }
    Some(all)
}

/// The flip near the parameter value `value` of the cycle that `ring` contains twice: that cycle repeated twice, and
/// the value.
pub(crate) fn halved(equations: &CycleEquations, ring: &Ring, value: f64) -> Option<(Ring, f64)> {
    let once = ring.half();
    let equations = equations.with(&once);
    let minus_one = |w: &[f64]| {
        let (osc, ring, flights) = equations.flights(w)?;
        Some(Floquet::new(&osc, &ring, &flights).minus_one())
    };
    let w = secant::zero(&equations, &CycleEquations::join(&once, value), minus_one)?;
    let (_, ring) = equations.split(&w)?;
    Some((ring.repeated(2), *w.last()?))
}

/// The branch that leaves `ring` in the given direction of its impacts; the parameter does not change to first order.
fn leave(
    osc: &Oscillator,
    ring: &Ring,
    (varying, value): (ParameterPath, f64),
    range: RangeInclusive<f64>,
    mut direction: Vec<f64>,
    options: BranchOptions,
) -> Result<Branch, BranchError> {
    let equations = CycleEquations::new(osc, varying.clone(), ring, scale(&range, value)?);
    // to first order the parameter does not change
    direction.push(0.0);
    let length = equations.length(&direction);
    direction.iter_mut().for_each(|d| *d /= length);
    let w = CycleEquations::join(ring, value);
    let branch = ImpactBranch::begin(equations, w, direction, &range, options)?;
    Ok(Branch::of_impacts(branch, osc, varying, range, options))
}
