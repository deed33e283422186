//! A walk round a sheet: along one bound until another would be passed, then along that, until it is back.

use super::arc::Equations;
use super::frame::Frame;
use super::plane::{Condition, Plane};
use super::polygon::{Bound, Vertex};
use super::region::{INWARDS, RegionKind, RegionOptions, Seed};
use super::walk::{Spot, Stride, Walk};
use crate::orbit::{Floquet, blocks};
use crate::system::Side;

/// A walk round the edge of a sheet.
pub(super) struct Round {
    plane: Plane,
    /// What must stay positive, up to the sign given.
    bounds: Vec<(Condition, f64, Bound)>,
    w: Vec<f64>,
    options: RegionOptions,
}

impl Round {
    pub(super) fn new(
        frame: &Frame,
        kind: RegionKind,
        options: RegionOptions,
        seed: &Seed,
        at: (f64, f64),
    ) -> Option<Self> {
        let plane =
            Plane::new(&seed.osc, frame.parameters, frame.scales(), &seed.ring, Condition::Line(0.0, 1.0, at.1));
        let w = Plane::join(&seed.ring, at);
        let flights = blocks(&seed.osc, &seed.ring)?;
        let floquet = Floquet::new(&seed.osc, &seed.ring, &flights);
        let mut bounds: Vec<(Condition, f64, Bound)> =
            frame.edges().into_iter().map(|edge| (edge, 1.0, Bound::Frame)).collect();
        let sheet = floquet.plus_one().signum();
        match partner(frame, seed) {
            // a branch point where symmetry is lost is singular; a little before it the equations are not
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
    pub(super) fn go(&self, (dp, dq): (f64, f64), known: impl Fn((f64, f64)) -> bool) -> Option<Vec<Vertex>> {
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

/// What a cycle becomes when half of it is shifted onto the other half, on the same stops or mirrored.
enum Partner {
    /// The same: it is symmetric.
    Itself,
    /// Another, which it may merge with; the impacts that differ most in speed, the faster one first.
    Other(usize, usize),
}

/// The partner of a seed, if it can have one.
fn partner(frame: &Frame, seed: &Seed) -> Option<Partner> {
    use crate::system::Parameter::{Gap, Restitution, SecondGap, SecondRestitution};
    let (ring, m) = (&seed.ring, seed.ring.len());
    if !m.is_multiple_of(2) {
        return None;
    }
    let half = m / 2;
    let shifted = ring.periods.is_multiple_of(2) && (0..m).all(|k| ring.side(k) == ring.side(k + half));
    let unequal = |p| matches!(p, Gap | Restitution | SecondGap | SecondRestitution);
    let alike = seed.osc.stop(Side::Lower).is_some_and(|lower| Some(lower) == seed.osc.stop(Side::Upper))
        && !unequal(frame.parameters.0)
        && !unequal(frame.parameters.1);
    let mirrored = alike && !ring.periods.is_multiple_of(2) && (0..m).all(|k| ring.side(k) != ring.side(k + half));
    if !(shifted || mirrored) {
        return None;
    }
    let more = |k: usize| ring.speed(k) - ring.speed(k + half);
    let k = (0..m).max_by(|&a, &b| more(a).total_cmp(&more(b)))?;
    if more(k) < 1e-6 {
        return Some(Partner::Itself);
    }
    // one that is nearer to merging than the bound lies on no side of it
    (more(k) > ASIDE).then_some(Partner::Other(k, (k + half) % m))
}

/// How far from merging, in speed, a walk stays; the parameters are off by about its square.
const ASIDE: f64 = 1e-3;

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

/// Bounds closer to zero than this at a corner meet there.
const MEET: f64 = 1e-6;
/// How far beyond a corner the way on is tried.
const TRIAL: f64 = 1e-3;
/// A bound that is this little violated there is held, by rounding.
const SLACK: f64 = 1e-9;
