//! Regions of a plane of two parameters in which an orbit exists or is stable: closed polygons along the curves that
//! bound them.
//!
//! The solutions of the equations of m/n over the plane are a surface. It folds where a multiplier is +1, and the part
//! on one side of a fold is a sheet over the plane. A solution is admissible if every impact has positive speed and no
//! flight reaches a stop; for stability, no multiplier has passed -1. Each of these bounds is the zero of a smooth
//! function on the surface. So the region is bounded by curves along which one of the functions is zero, with corners
//! where two are zero. A curve is traced until another function changes sign. From this corner the curve of that
//! function is traced, in the direction in which the first one stays positive, and so on until the edge is closed.

use super::free_region::free_region;
use super::options::{RegionKind, RegionOptions};
use super::polygon::Region;
use super::search::Search;
use crate::continuation::curves::Frame;
use crate::system::Oscillator;
use crate::verdict::{Count, Label};

/// The region of the orbits of `osc` with the label `label` in a frame of two parameters.
///
/// Orbits are searched for on a grid. From each orbit on a sheet that is not known yet, the edge of that part of the
/// region is traced. If the edge has folds, the sheets on their other side are traced too. From points of the grid
/// inside a polygon at which the search found no orbit and to which none can be followed from the edge, the hole is
/// traced. If a trace fails, the points of the grid that it would have enclosed are [unresolved](Region::unresolved).
/// Orbits that stick have no equations that can be traced. With restitution 0 they can have the label m/n, and the
/// points of the grid with such an orbit are unresolved.
///
/// The region of the motion without impacts, `0`, is where $`|f|`$ exceeds no gap, bounded by
/// [`Bound::Touch`](super::Bound::Touch). With damping the motion is stable wherever it exists. Without damping it is
/// neutrally stable, and the region of stability is empty. Over numbers of a machine its edge is found on a grid, and parts
/// of it that are smaller than a cell can be missed.
///
/// ```
/// use vibroimpact::{Label, Oscillator, Parameter};
/// use vibroimpact::continuation::{Frame, RegionKind, RegionOptions, region};
/// let osc = Oscillator::new(2.0, 1.0, 0.5)?.with_damping(0.05)?;
/// let frame = Frame { plane: (Parameter::Beta, Parameter::Gap).into(), ranges: (1.5..=3.0, 0.5..=2.0) };
/// let found = region(&osc, Label::new(0, 1), RegionKind::Stability, &frame, RegionOptions::default());
/// // at beta = 1.5 the amplitude is 0.794
/// assert!(found.contains((1.501, 0.8)) && !found.contains((1.501, 0.78)));
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn region(osc: &Oscillator, label: Label, kind: RegionKind, frame: &Frame, options: RegionOptions) -> Region {
    // it is never stopped
    let nothing = Region { polygons: Vec::new(), unresolved: Vec::new() };
    region_while(osc, label, kind, frame, options, &|| true).unwrap_or(nothing)
}

/// The same as [`region`], but stopped when `go_on` returns false, and then `None`. `go_on` is called at every point of
/// the grid and at every step.
#[must_use]
pub fn region_while(
    osc: &Oscillator,
    label: Label,
    kind: RegionKind,
    frame: &Frame,
    options: RegionOptions,
    go_on: &dyn Fn() -> bool,
) -> Option<Region> {
    if label.impacts == Count::Finite(0) {
        return go_on().then(|| free_region(osc, kind, frame, options));
    }
    let mut search = Search::new(osc, frame, kind, options, go_on);
    search.run(label);
    go_on().then_some(search.region)
}
