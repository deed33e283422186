//! Of what a region is, and how it is looked for.

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
