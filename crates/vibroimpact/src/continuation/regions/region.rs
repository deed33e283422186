//! Where in a plane of two parameters a motion exists, and where it is stable: closed polygons along the curves that bound
//! it.
//!
//! The solutions of the equations of m/n over the plane are a surface. It folds where a multiplier is +1, and on either side
//! of a fold it lies over the plane like a sheet. A sheet is a motion where every impact has speed, no flight touches a stop,
//! and, for stability, no multiplier has passed -1. Each of these bounds is a smooth function on the surface, so the region
//! is bounded by curves along which one of them is zero, with corners where two are. A walk goes along one curve until
//! another bound would be passed and goes on along that, the way on which the former holds, until it is back.

use super::free_region::free_region;
use super::options::{RegionKind, RegionOptions};
use super::polygon::Region;
use super::search::Search;
use crate::continuation::curves::Frame;
use crate::system::Oscillator;
use crate::verdict::{Count, Label};

/// The region of the orbits of `osc` that are called `label` in a frame of two parameters.
///
/// Orbits are looked for on a grid, and from each on a sheet that is not known yet a walk goes round the part of the region
/// it lies in; from the folds of that one on to the sheet on their other side; and from grid points inside a polygon without
/// an orbit, which none can be followed to from the edge, round the hole. Where a walk is lost, the points of the grid that
/// it would have gone round are [unresolved](Region::unresolved). Orbits that rest on a stop have no equations to
/// walk along: with restitution 0, where they may have the label m/n, the points of the grid at which there is one are unresolved.
///
/// The region of the motion without impacts, `0`, needs no search: it is where $`|f|`$ exceeds no gap, bounded by
/// [`Bound::Touch`](super::Bound::Touch). With damping the motion is stable wherever it exists; without, it is neutrally stable, and
/// the region of stability is empty.
///
/// ```
/// use vibroimpact::{Label, Oscillator, Parameter};
/// use vibroimpact::continuation::{Frame, RegionKind, RegionOptions, region};
/// let osc = Oscillator::new(2.0, 1.0, 0.5)?.with_damping(0.05)?;
/// let frame = Frame { parameters: (Parameter::Beta, Parameter::Gap), ranges: (1.5..=3.0, 0.5..=2.0) };
/// let found = region(&osc, Label::new(0, 1), RegionKind::Stability, &frame, RegionOptions::default());
/// // at beta = 1.5 the amplitude is 0.794
/// assert!(found.contains((1.501, 0.8)) && !found.contains((1.501, 0.78)));
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn region(osc: &Oscillator, label: Label, kind: RegionKind, frame: &Frame, options: RegionOptions) -> Region {
    // nothing stops it
    let nothing = Region { polygons: Vec::new(), unresolved: Vec::new() };
    region_while(osc, label, kind, frame, options, || true).unwrap_or(nothing)
}

/// The same as [`region`], as long as `go_on` says yes when asked, which it is at every point of the grid and every step;
/// `None` once it said no.
#[must_use]
pub fn region_while(
    osc: &Oscillator,
    label: Label,
    kind: RegionKind,
    frame: &Frame,
    options: RegionOptions,
    go_on: impl Fn() -> bool,
) -> Option<Region> {
    if label.impacts == Count::Finite(0) {
        return go_on().then(|| free_region(osc, kind, frame, options));
    }
    let mut search = Search::new(osc, frame, kind, options, &go_on);
    search.run(label);
    go_on().then_some(search.region)
}
