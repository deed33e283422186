//! Where in a plane of two parameters a motion exists, and where it is stable: closed polygons along the curves that bound
//! it.
//!
//! The solutions of the equations of m/n over the plane are a surface. It folds where a multiplier is +1, and on either side
//! of a fold it lies over the plane like a sheet. A sheet is a motion where every impact has speed, no flight touches a stop,
//! and, for stability, no multiplier has passed -1. Each of these bounds is a smooth function on the surface, so the region
//! is bounded by curves along which one of them is zero, with corners where two are. A walk goes along one curve until
//! another bound would be passed and goes on along that, the way on which the former holds, until it is back.

use super::frame::Frame;
use super::polygon::{Polygon, Region};
use super::round::Round;
use crate::orbit::{Cycle, FindOptions, Orbit, Ring, find};
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
    /// The longest edge: phases in radians, speeds, and parameters in quarters of the frame.
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
/// Orbits are looked for on a grid, and from each that lies in no polygon yet a walk goes round the part of the region
/// it lies in; from grid points inside a polygon without an orbit, round the hole. Where a walk is lost, the points of the
/// grid that it would have gone round are [unresolved](Region::unresolved). Not looked for are the regions of orbits that
/// rest on a stop (`inf/n`), and that of the motion without impacts: it is where $`|f|`$ exceeds no gap.
#[must_use]
pub fn region(osc: &Oscillator, label: Label, kind: RegionKind, frame: &Frame, options: RegionOptions) -> Region {
    let mut search =
        Search { osc, frame, kind, options, region: Region { polygons: Vec::new(), unresolved: Vec::new() } };
    if frame.sensible() {
        search.run(label);
    }
    search.region
}

/// An orbit at a point of the grid.
pub(super) struct Seed {
    pub(super) ring: Ring,
    pub(super) osc: Oscillator,
    pub(super) below: bool,
}

struct Search<'a> {
    osc: &'a Oscillator,
    frame: &'a Frame,
    kind: RegionKind,
    options: RegionOptions,
    region: Region,
}

impl Search<'_> {
    /// The point `(i, j)` of the grid, not on the frame itself.
    fn node(&self, i: u32, j: u32) -> (f64, f64) {
        let at = |range: &core::ops::RangeInclusive<f64>, k: u32, count: u32| {
            range.start() + (range.end() - range.start()) * (f64::from(k) + 0.5) / f64::from(count)
        };
        let (p, q) = &self.frame.ranges;
        (at(p, i, self.options.grid.0), at(q, j, self.options.grid.1))
    }

    fn oscillator(&self, (p, q): (f64, f64)) -> Option<Oscillator> {
        let (first, second) = self.frame.parameters;
        second.set(&first.set(self.osc, p).ok()?, q).ok()
    }

    fn run(&mut self, label: Label) {
        let (columns, rows) = self.options.grid;
        let mut seeds: Vec<Vec<Seed>> = Vec::new();
        for j in 0..rows {
            for i in 0..columns {
                seeds.push(self.seeds(label, self.node(i, j)));
            }
        }
        let index = |i: u32, j: u32| (j * columns + i) as usize;
        for j in 0..rows {
            for i in 0..columns {
                let at = self.node(i, j);
                for seed in &seeds[index(i, j)] {
                    if !self.region.on_sheet(at, seed.below) {
                        self.around(seed, at);
                    }
                }
            }
        }
        for j in 0..rows {
            for i in 0..columns {
                for below in [true, false] {
                    let at = self.node(i, j);
                    let has = seeds[index(i, j)].iter().any(|seed| seed.below == below);
                    if has || !self.region.on_sheet(at, below) {
                        continue;
                    }
                    // a hole: towards it from beside it
                    let beside = [(i.wrapping_sub(1), j), (i + 1, j), (i, j.wrapping_sub(1)), (i, j + 1)];
                    for (k, l) in beside.into_iter().filter(|&(k, l)| k < columns && l < rows) {
                        if let Some(seed) = seeds[index(k, l)].iter().find(|seed| seed.below == below) {
                            let from = self.node(k, l);
                            self.add(seed, from, (at.0 - from.0, at.1 - from.1));
                            if !self.region.on_sheet(at, below) {
                                break;
                            }
                        }
                    }
                }
            }
        }
        for j in 0..rows {
            for i in 0..columns {
                let at = self.node(i, j);
                if self.region.contains(at) == seeds[index(i, j)].is_empty() {
                    self.region.unresolved.push(at);
                }
            }
        }
    }

    /// The orbits at a point that belong to the region.
    fn seeds(&self, label: Label, at: (f64, f64)) -> Vec<Seed> {
        let Some(osc) = self.oscillator(at) else { return Vec::new() };
        let orbits = find(&osc, label, FindOptions { seeds: self.options.seeds, ..FindOptions::default() });
        let wanted = |o: &Orbit| o.physical && (self.kind == RegionKind::Existence || o.cycle.stable());
        let seed = |cycle: &Cycle| {
            let ring = Ring::of(&osc, cycle).filter(|ring| ring.len() > 0)?;
            let [one, two] = cycle.multipliers;
            // (1 - one)(1 - two): positive below +1
            let product = (1.0 - one.re) * (1.0 - two.re) - one.im * two.im;
            Some(Seed { ring, osc, below: product > 0.0 })
        };
        orbits.iter().filter(|o| wanted(o)).filter_map(|o| seed(&o.cycle)).collect()
    }

    /// Walks round the part of the region that a seed lies in, and round holes that are met on the way out.
    fn around(&mut self, seed: &Seed, at: (f64, f64)) {
        let (p, q) = self.frame.scales();
        for towards in [(p, 0.0), (-p, 0.0), (0.0, q), (0.0, -q)] {
            self.add(seed, at, towards);
            if self.region.on_sheet(at, seed.below) {
                return;
            }
        }
    }

    /// Adds the polygon that is met from a seed in a direction, unless it is known.
    fn add(&mut self, seed: &Seed, at: (f64, f64), towards: (f64, f64)) {
        let known = &self.region.polygons;
        let scales = self.frame.scales();
        let is_known = |point: (f64, f64)| -> bool {
            known.iter().any(|p| p.below == seed.below && p.distance(point, scales) < 0.1 * self.options.longest)
        };
        // an edge of the frame where the equations are singular (whole natural periods without damping) is kept off
        let found = [0.0, INWARDS].into_iter().find_map(|inwards| {
            let frame = self.frame.shrunk(inwards);
            Round::new(&frame, self.kind, self.options, seed, at)?.go(towards, is_known)
        });
        if let Some(vertices) = found {
            let mut polygon = Polygon { vertices, hole: false, below: seed.below };
            polygon.hole = polygon.area() < 0.0;
            self.region.polygons.push(polygon);
        }
    }
}

/// Share of its ranges by which a frame is shrunk where a walk along its edge is lost, and by which singular frequencies are
/// kept off.
pub(super) const INWARDS: f64 = 1e-5;
