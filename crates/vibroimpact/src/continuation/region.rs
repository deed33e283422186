//! Where in a plane of two parameters a motion exists, and where it is stable: closed polygons along the curves that bound
//! it.
//!
//! The solutions of the equations of m/n over the plane are a surface. It folds where a multiplier is +1, and on either side
//! of a fold it lies over the plane like a sheet. A sheet is a motion where every impact has speed, no flight touches a stop,
//! and, for stability, no multiplier has passed -1. Each of these bounds is a smooth function on the surface, so the region
//! is bounded by curves along which one of them is zero, with corners where two are. A walk goes along one curve until
//! another bound would be passed and goes on along that, the way on which the former holds, until it is back.

use super::frame::Frame;
use super::polygon::Region;
use super::search::Search;
use crate::system::Oscillator;
use crate::verdict::Label;

/// What a region is the region of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegionKind {
    /// Where the motion exists, stable or not.
    Existence,
    /// Where it exists and is stable.
    Stability,
}

/// How a region is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionOptions {
    /// The grid of points at which orbits are looked for: smaller parts of the region may be missed.
    pub grid: (u32, u32),
    /// Seeds of that search.
    pub seeds: (u32, u32),
    /// The longest edge: phases in radians, speeds over the fastest where that exceeds 1, and parameters in quarters of the frame.
    pub longest: f64,
    /// How far an edge may lie off its curve, in quarters of the frame (an estimate, from how the curve turns).
    pub accuracy: f64,
    /// The most vertices of a polygon.
    pub vertices: u32,
}

impl Default for RegionOptions {
    /// A grid of 24 times 24, 24 times 12 seeds at each point; edges up to 0.02, right to
    /// 2e-5; polygons of at most 6000 vertices.
    fn default() -> Self {
        Self { grid: (24, 24), seeds: (24, 12), longest: 0.02, accuracy: 2e-5, vertices: 6_000 }
    }
}

/// The region of the orbits of `osc` that are called `label` in a frame of two parameters.
///
/// Orbits are looked for on a grid, and from each on a sheet that is not known yet a walk goes round the part of the region
/// it lies in; from the folds of that one on to the sheet on their other side; and from grid points inside a polygon without
/// an orbit, which none can be followed to from the edge, round the hole. Where a walk is lost, the points of the grid that
/// it would have gone round are [unresolved](Region::unresolved). Not looked for are the regions of orbits that
/// rest on a stop (`inf/n`), and that of the motion without impacts: it is where $`|f|`$ exceeds no gap.
#[must_use]
pub fn region(osc: &Oscillator, label: Label, kind: RegionKind, frame: &Frame, options: RegionOptions) -> Region {
    let mut search = Search::new(osc, frame, kind, options, &|| true);
    search.run(label);
    search.region
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
    go_on: &dyn Fn() -> bool,
) -> Option<Region> {
    let mut search = Search::new(osc, frame, kind, options, go_on);
    search.run(label);
    go_on().then_some(search.region)
}
