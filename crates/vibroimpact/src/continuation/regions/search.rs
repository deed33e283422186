//! The search for the sheets of a region: finds orbits on a grid, traces the edge of each sheet, and compares orbits
//! and polygons.

use super::options::{RegionKind, RegionOptions};
use super::polygon::{Bound, Polygon, Region};
use super::seed::Seed;
use super::sheet_walk::{Edge, SheetWalk};
use super::singular::INWARDS;
use crate::continuation::curves::Frame;
use crate::continuation::equations::plane_equations::Plane;
use crate::math::{sin_cos, sort_by};
use crate::orbit::{Cycle, DEFAULT_EVENTS, FindOptions, Orbit, Ring, from_release, struck};
use crate::system::Oscillator;
use crate::verdict::{Count, Label};

/// A closed edge with the solutions on it.
struct Sheet<'a> {
    walk: SheetWalk<'a>,
    trail: Vec<Vec<f64>>,
}

pub(crate) struct Search<'a> {
    osc: &'a Oscillator,
    frame: &'a Frame,
    kind: RegionKind,
    options: RegionOptions,
    pub(crate) region: Region,
    /// One for each polygon.
    sheets: Vec<Sheet<'a>>,
    /// Edges whose trace failed, with the index in [`WAYS`] of the attempt, so that it is not repeated.
    lost: Vec<(usize, Polygon, Vec<Vec<f64>>)>,
    go_on: &'a dyn Fn() -> bool,
}

/// The attempts to trace an edge: the fraction by which the frame is shortened, to avoid singular equations on its
/// edge, and whether the trace keeps a distance from frequencies with a whole number of natural periods.
const WAYS: [(f64, bool); 3] = [(0.0, false), (0.0, true), (INWARDS, true)];
/// The largest number of polygons.
const MOST_POLYGONS: usize = 200;
/// An edge that encloses less area than this, in quarters of the frame, is traced forth and back.
const LEAST: f64 = 1e-9;
/// Speeds below this are rounding errors: an edge on which all speeds are below it is not that of an orbit.
const STILL: f64 = 1e-9;
/// One of this number of vertices on folds is used to cross to the other sheet.
const FOLDS: usize = 8;
/// The number of vertices of an edge from which an orbit is followed to a point of the grid.
const PLACES: usize = 6;
/// The difference of orbits on the same edge is below this between two vertices.
const LIKE: f64 = 0.1;

impl<'a> Search<'a> {
    pub(crate) fn new(
        osc: &'a Oscillator,
        frame: &'a Frame,
        kind: RegionKind,
        options: RegionOptions,
        go_on: &'a dyn Fn() -> bool,
    ) -> Self {
        let region = Region { polygons: Vec::new(), unresolved: Vec::new() };
        Self { osc, frame, kind, options, region, sheets: Vec::new(), lost: Vec::new(), go_on }
    }

    /// The point `(i, j)` of the grid; no point lies on the edge of the frame.
    fn node(&self, i: u32, j: u32) -> (f64, f64) {
        self.frame.node((i, j), self.options.grid)
    }

    fn oscillator(&self, at: (f64, f64)) -> Option<Oscillator> {
        self.frame.plane.set(self.osc, at).ok()
    }

    /// Finds the polygons of the region of a label, and compares them with the orbits on the grid.
    pub(crate) fn run(&mut self, label: Label) {
        if !self.frame.sensible() {
            return;
        }
        let (columns, rows) = self.options.grid;
        let nodes: Vec<(u32, u32)> = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))).collect();
        let mut places: Vec<(f64, f64)> = nodes.iter().map(|&(i, j)| self.node(i, j)).collect();
        let mut seeds: Vec<Vec<Seed>> = places.iter().map(|&at| self.seeds(label, at)).collect();
        // where the numbers of orbits at neighbours differ, an edge lies between them, perhaps more than one, so search
        // there too
        for (k, &(i, j)) in nodes.iter().enumerate() {
            for (there, other) in [(i + 1 < columns, k + 1), (j + 1 < rows, k + columns as usize)] {
                if there && seeds[k].len() != seeds[other].len() {
                    let ((x, y), (u, v)) = (places[k], places[other]);
                    let at = (0.5 * (x + u), 0.5 * (y + v));
                    places.push(at);
                    seeds.push(self.seeds(label, at));
                }
            }
        }
        for (&at, seeds) in places.iter().zip(&seeds) {
            for seed in seeds {
                let sheets = seeds.iter().filter(|other| other.below == seed.below).count();
                if self.region.sheets(at, seed.below) < sheets {
                    self.around(seed, at, sheets);
                }
            }
        }
        for (index, &(i, j)) in nodes.iter().enumerate() {
            for below in [true, false] {
                let at = self.node(i, j);
                let has = seeds[index].iter().any(|seed| seed.below == below);
                if has || self.region.sheets(at, below) == 0 {
                    continue;
                }
                if let Some(seed) = self.reached(at, below) {
                    seeds[index].push(seed);
                    continue;
                }
                // the point is in a hole: trace towards it from its neighbours
                let beside = [(i.wrapping_sub(1), j), (i + 1, j), (i, j.wrapping_sub(1)), (i, j + 1)];
                for (k, l) in beside.into_iter().filter(|&(k, l)| k < columns && l < rows) {
                    let near = seeds[(l * columns + k) as usize].iter().find(|seed| seed.below == below);
                    if let Some(seed) = near.cloned() {
                        let from = self.node(k, l);
                        self.add(&seed, from, (at.0 - from.0, at.1 - from.1));
                        if self.region.sheets(at, below) == 0 {
                            break;
                        }
                    }
                }
            }
        }
        self.region.polygons.retain(|polygon| {
            let inside = places.iter().zip(&seeds).take(nodes.len()).filter(|(at, _)| polygon.winding(**at) > 0);
            // a polygon that contains points of the grid but no orbit at any of them is wrong
            let mut inside = inside.map(|(_, seeds)| seeds.iter().any(|seed| seed.below == polygon.below)).peekable();
            inside.peek().is_none() || inside.any(|has| has)
        });
        for (at, seeds) in places.into_iter().zip(&seeds).take(nodes.len()) {
            let none = seeds.is_empty() && !self.rests(label, at);
            if self.region.contains(at) == none {
                self.region.unresolved.push(at);
            }
        }
    }

    /// Whether an orbit with this label sticks at a point, as m/n can with restitution 0.
    fn rests(&self, label: Label, at: (f64, f64)) -> bool {
        let Some(osc) = self.oscillator(at).filter(|_| (self.go_on)()) else { return false };
        let sticky = osc.stops().filter(|(_, stop)| stop.restitution == 0.0);
        let mut cycles = sticky.filter_map(|(side, _)| from_release(&osc, side, DEFAULT_EVENTS));
        cycles.any(|cycle| cycle.label == label && (self.kind == RegionKind::Existence || cycle.stable()))
    }

    /// The orbits at a point that belong to the region.
    fn seeds(&self, label: Label, at: (f64, f64)) -> Vec<Seed> {
        let Some(osc) = self.oscillator(at).filter(|_| (self.go_on)()) else { return Vec::new() };
        let loses = osc.damping() > 0.0 || osc.stops().any(|(_, stop)| stop.restitution < 1.0);
        if self.kind == RegionKind::Stability && !loses {
            return Vec::new(); // without loss of energy nothing is asymptotically stable, and rounding would decide
        }
        let Count::Finite(impacts @ 1..) = label.impacts else { return Vec::new() };
        let (options, mut orbits) = (FindOptions { seeds: self.options.seeds, ..FindOptions::default() }, Vec::new());
        if struck(&osc, (impacts, label.periods), options, &mut orbits, self.go_on).is_none() {
            return Vec::new(); // stopped: the caller discards the region
        }
        let wanted = |o: &Orbit| o.physical && (self.kind == RegionKind::Existence || o.cycle.stable());
        let seed = |cycle: &Cycle| {
            let ring = Ring::of(&osc, cycle).filter(|ring| ring.len() > 0)?;
            let [one, two] = cycle.multipliers;
            // (1 - one)(1 - two): positive if both multipliers are below +1
            let product = (1.0 - one.re) * (1.0 - two.re) - one.im * two.im;
            Some(Seed { ring, osc, below: product > 0.0 })
        };
        let mut seeds: Vec<Seed> = Vec::new();
        for seed in orbits.iter().filter(|o| wanted(o)).filter_map(|o| seed(&o.cycle)) {
            // a mirrored orbit has the same region
            let same = |other: &Seed| unlike(&other.ring.unknowns, &seed.ring.unknowns) < 1e-6;
            if !seeds.iter().any(same) {
                seeds.push(seed);
            }
        }
        seeds
    }

    /// Traces the edge of the part of the region that contains a seed, and the holes that are met on the way to it,
    /// until the seed is enclosed by the known number of sheets of its kind.
    fn around(&mut self, seed: &Seed, at: (f64, f64), sheets: usize) {
        let (p, q) = self.frame.scales();
        for towards in [(p, 0.0), (-p, 0.0), (0.0, q), (0.0, -q)] {
            self.add(seed, at, towards);
            if self.region.sheets(at, seed.below) >= sheets {
                return;
            }
        }
    }

    /// Adds the polygon whose edge is met from a seed in a direction, unless it is known, and those on the other side
    /// of its folds.
    fn add(&mut self, seed: &Seed, at: (f64, f64), towards: (f64, f64)) {
        for (way, (inwards, walled)) in WAYS.into_iter().enumerate() {
            let frame = self.frame.shrunk(inwards);
            let what = (&frame, self.kind, self.options);
            let Some(walk) = SheetWalk::new(what, seed, at, walled, self.go_on) else { continue };
            if (way, walk.added) == (1, 0) {
                continue; // the same attempt as before
            }
            let Some((bound, start, out)) = walk.out(towards) else { continue };
            if start.len() > 4 && still(&start) {
                continue; // all speeds vanish: several bounds are zero here along a curve
            }
            let sheets = self.region.polygons.iter().zip(&self.sheets);
            if sheets.into_iter().any(|(polygon, sheet)| self.on(polygon, &sheet.trail, &start, seed.below)) {
                return;
            }
            let lost = self.lost.iter().filter(|(other, ..)| *other == way);
            if lost.into_iter().any(|(_, polygon, trail)| self.on(polygon, trail, &start, seed.below)) {
                continue;
            }
            let Edge { vertices, trail, closed } = walk.edge(bound, &start, &out);
            let mut polygon = Polygon { vertices, hole: false, below: seed.below };
            let (p, q) = self.frame.scales();
            let area = polygon.area() / (p * q);
            let moves = !trail.iter().all(|w| still(w));
            if closed && area.abs() > LEAST && moves && self.sheets.len() < MOST_POLYGONS {
                polygon.hole = area < 0.0;
                self.region.polygons.push(polygon);
                self.sheets.push(Sheet { walk, trail });
                self.cross(self.sheets.len() - 1);
                return;
            }
            self.lost.push((way, polygon, trail));
        }
    }

    /// Crosses the folds of a sheet and traces the sheets on their other side.
    fn cross(&mut self, index: usize) {
        if self.kind == RegionKind::Stability {
            return; // nothing is stable there
        }
        let (polygon, Sheet { walk, trail }) = (&self.region.polygons[index], &self.sheets[index]);
        let folds = polygon.vertices.iter().zip(trail).step_by(FOLDS).filter(|(v, _)| v.bound == Bound::Fold);
        let found: Vec<_> = folds.filter_map(|(_, w)| walk.across(w, polygon.below)).collect();
        for (seed, at) in found {
            if self.region.sheets(at, seed.below) == 0 {
                self.around(&seed, at, 1);
            }
        }
    }

    /// Whether an orbit on an edge lies on this edge, which was traced before.
    fn on(&self, polygon: &Polygon, trail: &[Vec<f64>], w: &[f64], below: bool) -> bool {
        let (distance, k) = polygon.nearest(Plane::values(w), self.frame.scales());
        let like = |k: usize| unlike(impacts(&trail[k % trail.len()]), impacts(w)) < LIKE;
        polygon.below == below && distance < 0.1 * self.options.longest && (like(k) || like(k + 1))
    }

    /// The orbit at a point inside a polygon, followed from the edge.
    fn reached(&self, at: (f64, f64), below: bool) -> Option<Seed> {
        let scales = self.frame.scales();
        let inside =
            self.region.polygons.iter().zip(&self.sheets).filter(|(p, _)| p.below == below && p.winding(at) != 0);
        inside.into_iter().find_map(|(polygon, Sheet { walk, trail })| {
            // at a fold the equations are singular in the direction into the region, so no orbit is followed from there
            let mut places: Vec<(f64, usize)> = polygon
                .vertices
                .iter()
                .enumerate()
                .filter(|(_, vertex)| vertex.bound != Bound::Fold)
                .map(|(k, vertex)| {
                    let ((x, y), (u, v)) = (vertex.values, at);
                    (crate::math::hypot((u - x) / scales.0, (v - y) / scales.1), k)
                })
                .collect();
            sort_by(&mut places, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            places.truncate(PLACES * PLACES);
            places.iter().step_by(PLACES).find_map(|&(_, k)| walk.reach(&trail[k], at, below))
        })
    }
}

fn impacts(w: &[f64]) -> &[f64] {
    &w[..w.len() - 2]
}

/// Whether all speeds vanish.
fn still(w: &[f64]) -> bool {
    impacts(w).iter().skip(1).step_by(2).all(|speed| *speed <= STILL)
}

/// How unlike two lists of impacts are, wherever they begin, and mirrored or not: the largest difference of some means.
fn unlike(one: &[f64], other: &[f64]) -> f64 {
    let means = |impacts: &[f64]| {
        let mut sums = [0.0; 4];
        for impact in impacts.chunks_exact(2) {
            // twice the phase: a mirrored impact comes half a turn later and counts as the same
            let (sin, cos) = sin_cos(2.0 * impact[0]);
            for (sum, part) in sums.iter_mut().zip([impact[1], impact[1] * impact[1], cos, sin]) {
                *sum += part / (impacts.len() / 2) as f64;
            }
        }
        sums
    };
    let (one, other) = (means(one), means(other));
    // speeds over what they are
    let size = 1.0 + one[1].max(other[1]);
    let off = |k: usize| (one[k] - other[k]).abs();
    (off(0) / size.sqrt()).max(off(1) / size).max(off(2)).max(off(3))
}
