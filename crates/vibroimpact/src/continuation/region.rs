//! Where in a plane of two parameters a motion exists, and where it is stable: closed polygons along the curves that bound
//! it.
//!
//! The solutions of the equations of m/n over the plane are a surface. It folds where a multiplier is +1, and on either side
//! of a fold it lies over the plane like a sheet. A sheet is a motion where every impact has speed, no flight touches a stop,
//! and, for stability, no multiplier has passed -1. Each of these bounds is a smooth function on the surface, so the region
//! is bounded by curves along which one of them is zero, with corners where two are. A walk goes along one curve until
//! another bound would be passed and goes on along that, the way on which the former holds, until it is back.

use super::arc::Equations;
use super::curve::Frame;
use super::plane::{Condition, Plane};
use super::walk::{Spot, Stride, Walk};
use crate::orbit::{Cycle, FindOptions, Floquet, Orbit, Ring, find};
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

/// What bounds a region along an edge of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Two orbits meet: a multiplier is +1.
    Fold,
    /// A multiplier is -1.
    Flip,
    /// An impact has speed zero.
    NoSpeed,
    /// A flight touches a stop on its way.
    Touch,
    /// The edge of the frame.
    Frame,
}

impl Bound {
    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Flip => "flip",
            Self::NoSpeed => "no speed",
            Self::Touch => "touch",
            Self::Frame => "frame",
        }
    }
}

/// A corner or a point on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Values of the two parameters.
    pub values: (f64, f64),
    /// What bounds the region from here to the next vertex.
    pub bound: Bound,
}

/// A closed polygon; the last vertex is joined to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Its vertices, with the region to the left.
    pub vertices: Vec<Vertex>,
    /// Whether it is the edge of a hole.
    pub hole: bool,
    /// Which sheet of the surface it bounds: that of the orbits whose multipliers stay below +1, or the other.
    pub below: bool,
}

impl Polygon {
    /// Twice the area, negative for a hole.
    fn area(&self) -> f64 {
        self.edges().map(|((x, y), (u, v))| x * v - u * y).sum()
    }

    fn edges(&self) -> impl Iterator<Item = ((f64, f64), (f64, f64))> + '_ {
        let m = self.vertices.len();
        (0..m).map(move |k| (self.vertices[k].values, self.vertices[(k + 1) % m].values))
    }

    /// Whether a ray from the point to the right meets the polygon an odd number of times.
    fn encloses(&self, (x, y): (f64, f64)) -> bool {
        let meets = |((x0, y0), (x1, y1)): &((f64, f64), (f64, f64))| {
            (*y0 > y) != (*y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
        };
        self.edges().filter(meets).count() % 2 == 1
    }

    /// Distance of a point from it, lengths over `scales`.
    fn distance(&self, (x, y): (f64, f64), scales: (f64, f64)) -> f64 {
        let scaled = |(u, v): (f64, f64)| ((u - x) / scales.0, (v - y) / scales.1);
        let to_edge = |(a, b): ((f64, f64), (f64, f64))| {
            let ((ax, ay), (bx, by)) = (scaled(a), scaled(b));
            let (dx, dy) = (bx - ax, by - ay);
            let square = dx * dx + dy * dy;
            let t = if square > 0.0 { (-(ax * dx + ay * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
            crate::math::hypot(ax + t * dx, ay + t * dy)
        };
        self.edges().map(to_edge).fold(f64::INFINITY, f64::min)
    }
}

/// A region of a plane of two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its polygons.
    pub polygons: Vec<Polygon>,
    /// Points of the grid where the search for orbits and the polygons do not agree: a walk was lost there.
    pub unresolved: Vec<(f64, f64)>,
}

impl Region {
    /// Whether a point lies in it.
    #[must_use]
    pub fn contains(&self, point: (f64, f64)) -> bool {
        [true, false].into_iter().any(|below| self.on_sheet(point, below))
    }

    fn on_sheet(&self, point: (f64, f64), below: bool) -> bool {
        self.polygons.iter().filter(|p| p.below == below && p.encloses(point)).count() % 2 == 1
    }
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
    /// 2e-5; polygons of at most 20 000 vertices.
    fn default() -> Self {
        Self { grid: (24, 24), seeds: (24, 12), longest: 0.02, accuracy: 2e-5, vertices: 20_000 }
    }
}

/// The region of the orbits of `osc` that are called `label` in a frame of two parameters.
///
/// Orbits are looked for on a grid, and from each that lies in no polygon yet a walk goes round the part of the region
/// it lies in; from grid points inside a polygon without an orbit, round the hole. A region of orbits that rest on a stop
/// (`inf/n`) is not looked for.
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
struct Seed {
    ring: Ring,
    osc: Oscillator,
    below: bool,
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
            let ring = Ring::of(&osc, cycle)?;
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

/// A walk round the edge of a sheet.
struct Round {
    plane: Plane,
    /// What must stay positive, up to the sign given.
    bounds: Vec<(Condition, f64, Bound)>,
    w: Vec<f64>,
    options: RegionOptions,
}

impl Round {
    fn new(frame: &Frame, kind: RegionKind, options: RegionOptions, seed: &Seed, at: (f64, f64)) -> Option<Self> {
        let plane =
            Plane::new(&seed.osc, frame.parameters, frame.scales(), &seed.ring, Condition::Line(0.0, 1.0, at.1));
        let w = Plane::join(&seed.ring, at);
        let flights = crate::orbit::blocks(&seed.osc, &seed.ring)?;
        let floquet = Floquet::new(&seed.osc, &seed.ring, &flights);
        let mut bounds: Vec<(Condition, f64, Bound)> =
            frame.edges().into_iter().map(|edge| (edge, 1.0, Bound::Frame)).collect();
        bounds.push((Condition::PlusOne, floquet.plus_one().signum(), Bound::Fold));
        if kind == RegionKind::Stability {
            bounds.push((Condition::MinusOne, floquet.minus_one().signum(), Bound::Flip));
        }
        for k in 0..seed.ring.len() {
            bounds.push((Condition::Speed(k), 1.0, Bound::NoSpeed));
            bounds.extend(seed.osc.stops().map(|(side, _)| (Condition::Clear(k, side), 1.0, Bound::Touch)));
            if seed.osc.stop(seed.ring.side(k)).is_some_and(|stop| stop.restitution == 0.0) {
                bounds.push((Condition::Pull(k), 1.0, Bound::Touch));
            }
        }
        bounds.extend(walls(frame, seed, at).into_iter().map(|wall| (wall, 1.0, Bound::NoSpeed)));
        Some(Self { plane, bounds, w, options })
    }

    fn watched(&self) -> Vec<Condition> {
        self.bounds.iter().map(|(condition, ..)| *condition).collect()
    }

    /// A walk along the zero of a condition from `w`, on the side that `row` is positive on.
    fn along(&self, condition: Condition, w: &[f64], row: &[f64]) -> Option<Walk> {
        let mut plane = self.plane.clone();
        plane.condition = condition;
        let mut walk = Walk::new(plane, self.watched(), w.to_vec(), row, self.options.longest)?;
        // the bound that is followed is zero, and the others are what they have to be
        for (known, (other, sign, _)) in walk.signs.iter_mut().zip(&self.bounds) {
            *known = (*other != condition).then_some(*sign > 0.0);
        }
        Some(walk)
    }

    /// Out to the edge in a direction and round it. `None` if the edge is known or the walk is lost.
    fn go(&self, (dp, dq): (f64, f64), known: impl Fn((f64, f64)) -> bool) -> Option<Vec<Vertex>> {
        let (p, q) = Plane::values(&self.w);
        let line = Condition::Line(dq, -dp, dq * p - dp * q);
        let mut row = vec![0.0; self.w.len()];
        let width = row.len();
        (row[width - 2], row[width - 1]) = (dp, dq);
        let mut out = self.along(line, &self.w, &row)?;
        let (first, start) = loop {
            let Stride { there, length, crossed } = out.stride()?;
            if let Some(&(s, j)) = crossed.first() {
                break (j, out.between(&there, s, length)?);
            }
            out.settle(there);
        };
        if known(Plane::values(&start)) {
            return None;
        }
        // with the inside, where the walk came from, to the left
        let condition = self.bounds[first].0;
        let inside = {
            let (x, y) = out.plane.scaled(&start);
            let (u, v) = out.plane.scaled(&out.here.w);
            (u - x, v - y)
        };
        let walk = self.ways(condition, &start)?.into_iter().find(|walk| {
            let (x, y) = walk.plane.scaled(&walk.here.tangent);
            x * inside.1 - y * inside.0 > 0.0
        })?;
        self.circle(first, walk)
    }

    /// The two ways along a bound from a point on it.
    fn ways(&self, condition: Condition, w: &[f64]) -> Option<[Walk; 2]> {
        let mut plane = self.plane.clone();
        plane.condition = condition;
        let width = w.len();
        // across the gradients of the parameters at least one row is not along the curve
        for unknown in [width - 2, width - 1, 0, 1] {
            let mut row = vec![0.0; width];
            row[unknown] = 1.0;
            let Some(forth) = self.along(condition, w, &row) else { continue };
            let pace = plane.row(&forth.here.tangent)[unknown].abs();
            if pace < 1e-6 {
                continue;
            }
            row[unknown] = -1.0;
            let back = self.along(condition, w, &row)?;
            return Some([forth, back]);
        }
        None
    }

    /// Round the edge from where `walk` begins, on bound `first`.
    fn circle(&self, first: usize, mut walk: Walk) -> Option<Vec<Vertex>> {
        let begin = walk.here.clone();
        let mut active = first;
        let mut vertices = vec![Vertex { values: Plane::values(&begin.w), bound: self.bounds[active].2 }];
        while vertices.len() < self.options.vertices as usize {
            let Stride { there, length, crossed } = walk.stride()?;
            let bound = self.bounds[active].2;
            if let Some(&(s, j)) = crossed.first() {
                // the beginning may lie before the corner
                let corner = walk.spot(walk.between(&there, s, length)?)?;
                if active == first && self.passes(&begin, &walk.here, &corner, &walk.plane) {
                    return Some(vertices);
                }
                (active, walk) = self.turn(active, j, &corner)?;
                vertices.push(Vertex { values: Plane::values(&corner.w), bound: self.bounds[active].2 });
                continue;
            }
            if active == first && self.passes(&begin, &walk.here, &there, &walk.plane) {
                return Some(vertices);
            }
            vertices.push(Vertex { values: Plane::values(&there.w), bound });
            let off = sagitta(&walk.plane, &walk.here, &there);
            if off > self.options.accuracy {
                walk.step *= (0.5 * self.options.accuracy / off).sqrt();
            } else if off > 0.25 * self.options.accuracy {
                walk.step = walk.step.min(length);
            }
            walk.settle(there);
        }
        None
    }

    /// Whether the beginning lies between two points of a walk.
    fn passes(&self, begin: &Spot, here: &Spot, there: &Spot, plane: &Plane) -> bool {
        let ahead = |spot: &Spot| {
            let mut off: Vec<f64> = spot.w.iter().zip(&begin.w).map(|(a, b)| a - b).collect();
            let turns = core::f64::consts::TAU * (off[0] / core::f64::consts::TAU).round();
            let phases = off.len() - 2;
            off[..phases].iter_mut().step_by(2).for_each(|theta| *theta -= turns);
            (plane.dot(&off, &begin.tangent), plane.length(&off))
        };
        let ((before, _), (after, away)) = (ahead(here), ahead(there));
        before < 0.0 && after >= 0.0 && away < 2.0 * self.options.longest
    }

    /// At a corner: the bound to go on along and the way on which all others hold.
    fn turn(&self, active: usize, crossed: usize, corner: &Spot) -> Option<(usize, Walk)> {
        let zero = |j: usize| j != active && corner.values[j].abs() < MEET;
        let mut candidates = vec![crossed];
        candidates.extend((0..self.bounds.len()).filter(|&j| j != crossed && zero(j)));
        for j in candidates {
            let Some(ways) = self.ways(self.bounds[j].0, &corner.w) else { continue };
            for mut walk in ways {
                walk.step = TRIAL;
                // without a sign nothing is crossed
                walk.signs.iter_mut().for_each(|sign| *sign = None);
                let Some(Stride { there, .. }) = walk.stride() else { continue };
                let holds = |k: usize| k == j || there.values[k] * self.bounds[k].1 > -SLACK;
                if (0..self.bounds.len()).all(holds) {
                    let row = walk.plane.row(&walk.here.tangent);
                    return Some((j, self.along(self.bounds[j].0, &corner.w, &row)?));
                }
            }
        }
        None
    }
}

/// About how far the curve between two points of it lies off the straight line, parameters over their scales.
fn sagitta(plane: &Plane, here: &Spot, there: &Spot) -> f64 {
    let ((x, y), (u, v)) = (plane.scaled(&here.w), plane.scaled(&there.w));
    let ((p, q), (r, s)) = (plane.scaled(&here.tangent), plane.scaled(&there.tangent));
    let turn = crate::math::atan2(p * s - q * r, p * r + q * s).abs();
    crate::math::hypot(u - x, v - y) * turn / 8.0
}

/// Frequencies beyond which a cycle does not go, each positive on the side of a seed at `at`.
///
/// Where, without damping, one impact in n periods leaves exactly whole natural periods for its flight, the mass is back
/// on the stop whatever its speed was, and at resonance only has the force done work: as such a frequency is
/// approached every orbit loses its speed, at all gaps at once. There the equations are singular.
fn walls(frame: &Frame, seed: &Seed, at: (f64, f64)) -> Vec<Condition> {
    use crate::system::Parameter::{Beta, Damping, InverseBeta};
    let (first, second) = frame.parameters;
    if seed.ring.len() != 1 || seed.osc.damping() != 0.0 || first == Damping || second == Damping {
        return Vec::new();
    }
    let n = f64::from(seed.ring.periods);
    let turns = n / seed.osc.beta();
    let whole = |step: f64, from: f64| {
        let k = if from == n { from + step } else { from };
        (k >= 1.0).then_some(k)
    };
    let near = [whole(-1.0, turns.floor()), whole(1.0, turns.floor() + 1.0)];
    let mut walls = Vec::new();
    for (is_first, parameter, value, scale) in
        [(true, first, at.0, frame.scales().0), (false, second, at.1, frame.scales().1)]
    {
        for k in near.into_iter().flatten() {
            let wall = match parameter {
                InverseBeta => k / n,
                Beta => n / k,
                _ => continue,
            };
            let side = (value - wall).signum();
            let edge = side * wall + INWARDS * scale;
            walls.push(if is_first { Condition::Line(side, 0.0, edge) } else { Condition::Line(0.0, side, edge) });
        }
    }
    walls
}

/// Share of its ranges by which a frame is shrunk where a walk along its edge is lost.
const INWARDS: f64 = 1e-5;
/// Bounds closer to zero than this at a corner meet there.
const MEET: f64 = 1e-6;
/// How far beyond a corner the way on is tried.
const TRIAL: f64 = 1e-3;
/// A bound that is this little violated there is held, by rounding.
const SLACK: f64 = 1e-9;
