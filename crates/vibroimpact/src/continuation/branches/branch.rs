//! The branch of a cycle in one parameter, or along a line through two parameters, as an iterator over its points.

use super::impact_branch::ImpactBranch;
use super::options::{BranchError, BranchOptions, Direction};
use super::point::SolutionPoint;
use super::resting::rest_branch::RestBranch;
use crate::orbit::Cycle;
use crate::system::{Oscillator, ParameterPath};
use core::ops::RangeInclusive;

/// A branch: an iterator over its points, including its events. The last point has an event that
/// [ends](crate::continuation::BranchEvent::ends) the branch.
///
/// ```
/// use vibroimpact::{Oscillator, Parameter, Label, orbit::{FindOptions, find}};
/// use vibroimpact::continuation::{Branch, BranchEvent, BranchOptions, Direction};
/// // 1/beta = 1.11, eps = 0.5: as the gap grows 1/1 loses its stability to a motion of twice the period
/// let osc = Oscillator::from_inverse_beta(1.11, 1.0, 0.5)?;
/// let orbit = find(&osc, Label::new(1, 1), FindOptions::default()).pop().expect("1/1 exists");
/// let (range, options) = (0.0..=4.0, BranchOptions::default());
/// let branch = Branch::new(&osc, &orbit.cycle, Parameter::Gap, range, Direction::Up, options).expect("it is a cycle");
/// let flip = branch.into_iter().find(|point| point.event == Some(BranchEvent::Flip)).expect("it flips");
/// assert!((flip.value - 1.829_006_189_683_6).abs() < 1e-12);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Branch(Method);

/// The method by which a branch is followed.
#[derive(Clone, Debug)]
enum Method {
    /// The equations of the impacts of the cycle.
    Impacts(Box<ImpactBranch>),
    /// The release that determines the cycle.
    Release(Box<RestBranch>),
}

impl Branch {
    /// The branch of `cycle`, a cycle of `osc`, in a [`Parameter`](crate::Parameter) over `range`, beginning in
    /// `direction`. On a line through two parameters, `range` is that of the first parameter.
    ///
    /// A cycle that sticks is followed by its release, any other cycle by the equations of its impacts.
    ///
    /// # Errors
    /// [`BranchError`] if the branch cannot begin.
    pub fn new(
        osc: &Oscillator,
        cycle: &Cycle,
        varying: impl Into<ParameterPath>,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let varying = varying.into();
        if cycle.rests.is_empty() {
            return ImpactBranch::of_cycle(osc, cycle, varying, range, direction, options).map(Self::from);
        }
        let resting = RestBranch::new(osc, cycle, varying, range, direction, options)?;
        Ok(Self(Method::Release(Box::new(resting))))
    }
}

impl From<ImpactBranch> for Branch {
    fn from(branch: ImpactBranch) -> Self {
        Self(Method::Impacts(Box::new(branch)))
    }
}

impl Iterator for Branch {
    type Item = SolutionPoint;

    fn next(&mut self) -> Option<SolutionPoint> {
        match &mut self.0 {
            Method::Impacts(branch) => branch.next(),
            Method::Release(branch) => branch.next(),
        }
    }
}
