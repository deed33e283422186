//! The kind of a region, and the options of its search.

/// The property that holds in a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegionKind {
    /// The orbit exists, stable or not.
    Existence,
    /// The orbit exists and is stable.
    Stability,
}

/// The grid, step lengths and limits of the search for a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegionOptions {
    /// The number of points of the grid at which orbits are searched for. Parts of the region smaller than its step can
    /// be missed.
    pub grid: (u32, u32),
    /// The number of starting guesses at each point of the grid: phases and speeds.
    pub seeds: (u32, u32),
    /// The longest edge of a polygon: phases in radians, speeds relative to the fastest if that exceeds 1, parameters
    /// in quarters of the frame.
    pub longest: f64,
    /// The largest distance of an edge from its curve, in quarters of the frame; estimated from the change of
    /// direction.
    pub accuracy: f64,
    /// The largest number of vertices of a polygon.
    pub vertices: u32,
}

impl Default for RegionOptions {
    /// A grid of 24 times 24, with 24 times 12 starting guesses at each point; edges up to 0.02 that are accurate to
    /// 2e-5; polygons of at most 6000 vertices.
    fn default() -> Self {
        Self { grid: (24, 24), seeds: (24, 12), longest: 0.02, accuracy: 2e-5, vertices: 6_000 }
    }
}
