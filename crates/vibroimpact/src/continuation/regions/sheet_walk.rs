//! The trace of the edge of a sheet: along one bound to a corner with another bound, then along that one, until it is
//! closed.

use super::options::{RegionKind, RegionOptions};
use super::polygon::{Bound, Vertex};
use super::seed::Seed;
use super::singular::{ASIDE, Partner, partner, walls};
use crate::continuation::curves::Frame;
use crate::continuation::equations::plane_equations::{Condition, Plane};
use crate::continuation::equations::plane_tracer::{PlaneSolution, PlaneTracer};
use crate::continuation::trace::equations::{Equations, unit};
use crate::continuation::trace::tracer::Step;
use crate::orbit::{Floquet, blocks};

/// The trace of the edge of a sheet.
pub(crate) struct SheetWalk<'a> {
    pub(crate) plane: Plane,
    /// The functions that bound the sheet, with the sign that each has inside.
    pub(crate) bounds: Vec<(Condition, f64, Bound)>,
    /// The number of these functions that `walled` has added.
    pub(crate) added: usize,
    w: Vec<f64>,
    /// The sign of the test function of a multiplier +1 on the sheet.
    pub(crate) sheet: f64,
    pub(crate) options: RegionOptions,
    /// Called at every step; false stops the trace.
    pub(crate) go_on: &'a dyn Fn() -> bool,
}

/// The edge of a sheet, or a part of it.
#[derive(Default)]
pub(crate) struct Edge {
    pub(crate) vertices: Vec<Vertex>,
    /// The cycle and the parameters at each vertex.
    pub(crate) trail: Vec<Vec<f64>>,
    pub(crate) closed: bool,
}

impl Edge {
    fn push(&mut self, w: &[f64], bound: Bound) {
        self.vertices.push(Vertex { values: Plane::values(w), bound });
        self.trail.push(w.to_vec());
    }
}

impl<'a> SheetWalk<'a> {
    /// From a seed; with `walled`, the trace keeps a distance from frequencies at which the forcing periods are a whole
    /// number of natural periods.
    pub(crate) fn new(
        (frame, kind, options): (&Frame, RegionKind, RegionOptions),
        seed: &Seed,
        at: (f64, f64),
        walled: bool,
        go_on: &'a dyn Fn() -> bool,
    ) -> Option<Self> {
        let line = Condition::Line(0.0, 1.0, at.1);
        let mut plane = Plane::new(&seed.osc, frame.plane.clone(), frame.scales(), &seed.ring, line);
        plane.relative = true;
        let w = Plane::join(&seed.ring, at);
        let flights = blocks(&seed.osc, &seed.ring)?;
        let floquet = Floquet::new(&seed.osc, &seed.ring, &flights);
        let mut bounds: Vec<(Condition, f64, Bound)> =
            frame.edges().into_iter().map(|edge| (edge, 1.0, Bound::Frame)).collect();
        let sheet = floquet.plus_one().signum();
        match partner(frame, seed) {
            // a branch point where symmetry is lost is singular; a little before it the equations are regular
            Some(Partner::Itself) => {
                bounds.push((Condition::NearPlusOne(sheet * ASIDE * ASIDE), sheet, Bound::Fold));
            }
            Some(Partner::Other(faster, slower)) => {
                bounds.push((Condition::PlusOne, sheet, Bound::Fold));
                bounds.push((Condition::Unlike(faster, slower, ASIDE), 1.0, Bound::Merging));
            }
            None => bounds.push((Condition::PlusOne, sheet, Bound::Fold)),
        }
        if kind == RegionKind::Stability {
            bounds.push((Condition::MinusOne, floquet.minus_one().signum(), Bound::Flip));
        }
        for k in 0..seed.ring.len() {
            bounds.push((Condition::Speed(k), 1.0, Bound::NoSpeed));
            bounds.extend(seed.osc.stops().map(|(side, _)| (Condition::Clear(k, side), 1.0, Bound::Touch)));
            if seed.osc.stop(seed.ring.side(k)).is_some_and(|stop| stop.restitution <= INELASTIC) {
                bounds.push((Condition::Pull(k), 1.0, Bound::Touch));
            }
        }
        // an orbit with one impact never crosses these frequencies
        let alone = seed.ring.len() == 1;
        let walls = if walled || alone { walls(frame, seed, at) } else { Vec::new() };
        let added = if alone { 0 } else { walls.len() };
        bounds.extend(walls.into_iter().map(|wall| (wall, 1.0, Bound::NoSpeed)));
        Some(Self { plane, bounds, added, w, sheet, options, go_on })
    }

    fn watched(&self) -> Vec<Condition> {
        self.bounds.iter().map(|(condition, ..)| *condition).collect()
    }

    /// The tracer along the zero of a condition from `w`, in the direction of the tangent whose product with `row` is
    /// positive.
    pub(crate) fn along(&self, condition: Condition, w: &[f64], row: &[f64]) -> Option<PlaneTracer> {
        let mut plane = self.plane.clone();
        plane.condition = condition;
        let mut walk = PlaneTracer::along(plane, self.watched(), w.to_vec(), row, self.options.longest)?;
        // the function that is followed is zero, and the others have their sign inside
        for (known, (other, sign, _)) in walk.signs.iter_mut().zip(&self.bounds) {
            *known = (*other != condition).then_some(*sign > 0.0);
        }
        Some(walk)
    }

    /// Traces in a direction to the first bound: its index, the point, and the tracer; `None` if the trace fails or
    /// takes more steps than a polygon may have vertices.
    pub(crate) fn out(&self, (dp, dq): (f64, f64)) -> Option<(usize, Vec<f64>, PlaneTracer)> {
        let (p, q) = Plane::values(&self.w);
        // the line through the orbit in this direction
        let line = Condition::Line(dq, -dp, dq * p - dp * q);
        let mut row = vec![0.0; self.w.len()];
        let width = row.len();
        (row[width - 2], row[width - 1]) = (dp, dq);
        let mut out = self.along(line, &self.w, &row)?;
        for _ in 0..self.options.vertices {
            if !(self.go_on)() {
                break;
            }
            let step = out.step()?;
            if let Some(&(s, Some(j))) = step.crossed.first() {
                return Some((j, out.between(&step, s)?, out));
            }
            out.take(step.there);
        }
        None
    }

    /// The edge through `start` on the bound `bound`, to which `out` led. If the trace fails, the edge is also traced
    /// in the other direction; it is closed if both traces end at the same place.
    pub(crate) fn edge(&self, bound: usize, start: &[f64], out: &PlaneTracer) -> Edge {
        // the inside, from which `out` came, must be on the left
        let inside = {
            let (x, y) = out.problem.plane.scaled(start);
            let (u, v) = out.problem.plane.scaled(&out.here.w);
            (u - x, v - y)
        };
        let left = |walk: &PlaneTracer| {
            let (x, y) = walk.problem.plane.scaled(&walk.here.tangent);
            x * inside.1 - y * inside.0 > 0.0
        };
        let Some([one, two]) = self.ways(self.bounds[bound].0, start) else { return Edge::default() };
        let (forth, back) = if left(&one) { (one, two) } else { (two, one) };
        let forth = self.circle(bound, forth);
        if forth.closed { forth } else { self.joined(forth, self.circle(bound, back)) }
    }

    /// Joins two traces from one point, up to the places where they failed. The edge is closed if that is the same
    /// place: a point at which more than two functions are zero.
    fn joined(&self, mut edge: Edge, mut back: Edge) -> Edge {
        let place = |edge: &Edge| {
            let (p, q) = edge.vertices.last().map_or((f64::NAN, f64::NAN), |vertex| vertex.values);
            self.plane.scaled(&[p, q])
        };
        let ((x, y), (u, v)) = (place(&edge), place(&back));
        // the bound of an edge is stored with its first vertex, which in reverse order is the other one
        for k in (1..back.vertices.len()).rev() {
            back.vertices[k].bound = back.vertices[k - 1].bound;
        }
        edge.vertices.extend(back.vertices.into_iter().skip(1).rev());
        edge.trail.extend(back.trail.into_iter().skip(1).rev());
        edge.closed = crate::math::hypot(x - u, y - v) < JOIN && edge.vertices.len() > 4;
        edge
    }

    /// The tracers in both directions along a bound from a point on it.
    pub(crate) fn ways(&self, condition: Condition, w: &[f64]) -> Option<[PlaneTracer; 2]> {
        let mut plane = self.plane.clone();
        plane.condition = condition;
        let width = w.len();
        // at least one of these unknowns changes along the curve
        for unknown in [width - 2, width - 1, 0, 1] {
            let Some(forth) = self.along(condition, w, &unit(width, unknown, 1.0)) else { continue };
            let pace = plane.row(&forth.here.tangent)[unknown].abs();
            if pace < 1e-6 {
                continue;
            }
            let back = self.along(condition, w, &unit(width, unknown, -1.0))?;
            return Some([forth, back]);
        }
        None
    }

    /// Traces the edge from where `walk` begins, on the bound `first`, until it is closed or the trace fails.
    fn circle(&self, first: usize, mut walk: PlaneTracer) -> Edge {
        let begin = walk.here.clone();
        let mut active = first;
        let mut edge = Edge::default();
        // corners at the same place, each with the bound on which it was reached
        let mut corners: Vec<(usize, PlaneSolution)> = Vec::new();
        let mut small = 0;
        edge.push(&begin.w, self.bounds[active].2);
        while edge.vertices.len() < self.options.vertices as usize && (self.go_on)() {
            let Some(step) = walk.step() else { break };
            // towards an orbit that is repeated several times
            small = if step.length < CREEP { small + 1 } else { 0 };
            if small > MOST_SMALL || self.repeats(&step.there.w) {
                break;
            }
            let bound = self.bounds[active].2;
            if let Some(&(s, Some(j))) = step.crossed.first() {
                // the first point of the edge may lie before the corner
                let Some(corner) = walk.at(&step, s) else { break };
                if active == first && walk.passes(&begin, &corner) {
                    edge.closed = true;
                    break;
                }
                corners.retain(|(_, other)| apart(&walk.problem.plane, other, &corner) < MEET);
                corners.push((active, corner.clone()));
                if corners.len() > MOST_CORNERS {
                    break;
                }
                let Some(next) = self.turn(&corners, j) else { break };
                (active, walk) = next;
                edge.push(&corner.w, self.bounds[active].2);
                continue;
            }
            if active == first && walk.passes(&begin, &step.there) {
                edge.closed = true;
                break;
            }
            edge.push(&step.there.w, bound);
            let off = sagitta(&walk.problem.plane, &walk.here, &step.there);
            if off > self.options.accuracy {
                // the distance from the chord grows as the square of the step
                walk.step.now *= (0.5 * self.options.accuracy / off).sqrt();
            } else if off > 0.25 * self.options.accuracy {
                walk.step.now = walk.step.now.min(step.length);
            }
            walk.take(step.there);
        }
        edge
    }

    /// Whether a cycle is a shorter one repeated several times.
    fn repeats(&self, w: &[f64]) -> bool {
        let ring = self.plane.split(w).map(|(_, ring)| ring).filter(|ring| ring.len() > 1);
        ring.is_some_and(|ring| ring.len() > ring.smallest(REPEATED).len())
    }

    /// At a corner, which is the last of `corners` at one place: the bound to follow next, with a tracer in the
    /// direction in which all other functions keep their sign, but not back along a bound on which the place was
    /// reached.
    fn turn(&self, corners: &[(usize, PlaneSolution)], crossed: usize) -> Option<(usize, PlaneTracer)> {
        let (active, corner) = corners.last()?;
        let zero = |j: usize| j != *active && corner.values[j].abs() < MEET;
        let mut candidates = vec![crossed];
        candidates.extend((0..self.bounds.len()).filter(|&j| j != crossed && zero(j)));
        for (trial, j) in TRIALS.into_iter().flat_map(|trial| candidates.iter().map(move |&j| (trial, j))) {
            let Some(ways) = self.ways(self.bounds[j].0, &corner.w) else { continue };
            for mut walk in ways {
                let along = walk.here.tangent.clone();
                let back = |(on, spot): &(usize, PlaneSolution)| {
                    *on == j && walk.problem.plane.dot(&along, &spot.tangent) < BACK
                };
                if corners.iter().any(back) {
                    continue;
                }
                walk.step.now = trial;
                // without a sign no crossing is detected
                walk.signs.iter_mut().for_each(|sign| *sign = None);
                let Some(Step { there, .. }) = walk.step() else { continue };
                let holds = |k: usize| k == j || there.values[k] * self.bounds[k].1 > -SLACK;
                if (0..self.bounds.len()).all(holds) {
                    let row = walk.problem.plane.row(&walk.here.tangent);
                    return Some((j, self.along(self.bounds[j].0, &corner.w, &row)?));
                }
            }
        }
        None
    }
}

/// The distance between two solutions.
fn apart(plane: &Plane, one: &PlaneSolution, other: &PlaneSolution) -> f64 {
    let off: Vec<f64> = one.w.iter().zip(&other.w).map(|(a, b)| a - b).collect();
    plane.length(&off)
}

/// An estimate of the distance between the curve and the chord of two of its points, with parameters divided by their
/// scales.
fn sagitta(plane: &Plane, here: &PlaneSolution, there: &PlaneSolution) -> f64 {
    let ((x, y), (u, v)) = (plane.scaled(&here.w), plane.scaled(&there.w));
    let ((p, q), (r, s)) = (plane.scaled(&here.tangent), plane.scaled(&there.tangent));
    let turn = crate::math::atan2(p * s - q * r, p * r + q * s).abs();
    crate::math::hypot(u - x, v - y) * turn / 8.0
}

/// At a restitution up to this the mass leaves a stop where the force pulls it off. The flight of the rebound itself is
/// too low for grazing contacts on it to be a bound.
const INELASTIC: f64 = 1e-9;
/// Functions closer to zero than this at a corner are zero there.
const MEET: f64 = 1e-6;
/// The trace has failed if it meets this number of corners at one place.
const MOST_CORNERS: usize = 8;
/// A direction with a smaller cosine to the direction of arrival leads back.
const BACK: f64 = -0.9;
/// The distances beyond a corner at which the directions are tried; the shorter one where two corners are close.
const TRIALS: [f64; 2] = [1e-3, 1e-6];
/// A function may be negative by this much there, by rounding.
const SLACK: f64 = 1e-9;
/// The largest distance between the ends of two traces that are the same place, with parameters in quarters of the
/// frame.
const JOIN: f64 = 5e-3;
/// The trace has failed after more than this number of successive steps shorter than [`CREEP`].
const MOST_SMALL: u32 = 40;
/// See [`MOST_SMALL`].
const CREEP: f64 = 1e-5;
/// Parts of a cycle that differ by less than this are equal.
pub(crate) const REPEATED: f64 = 1e-7;
