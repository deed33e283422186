//! The fast flight of the long run: doubles, marched from node to node by the exact propagator of a short time.
//!
//! Over a time $h$ state and force turn linearly into the next: $x' = x + (C-1)x + Sv + K_c\sin\theta + K_s\cos\theta$ and
//! so on. The coefficients come from the textbook flight with 256 places, rounded once to doubles, for $h$ and its
//! halves down to $2^{-47}h$: no formula is ever evaluated near resonance, and a displacement right after the start keeps
//! its digits. Each step adds its roundings to running bounds of the error, and what lies within four times those is
//! not decided here but handed to the exact flight.

use super::case::Case;
use super::cell::View;
use super::fixed::Fixed;
use super::search::{Cell, Curve, Found, examine};
use super::textbook::{Data, Solution};
use vibroimpact::{Oscillator, Side};

/// Halvings of the longest step.
const LEVELS: usize = 48;

/// One step's coefficients, for displacement and velocity.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    h: f64,
    /// $C - 1$, $S$, $K_c$, $K_s$.
    x: [f64; 4],
    /// Their derivatives; for $S$ its derivative minus 1.
    v: [f64; 4],
    turn: (f64, f64),
}

/// A propagator table for one oscillator.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    beta: f64,
    zeta: f64,
    steps: [Step; LEVELS],
    /// Distance of the stops from the rest position.
    gaps: [Option<f64>; 2],
}

impl Table {
    pub(crate) fn new(osc: &Oscillator) -> Self {
        let (beta, zeta) = (osc.beta(), osc.damping());
        let (zero, one) = (Fixed::ZERO, Fixed::ONE);
        let flight =
            |x, v, force| Solution::new(Data { beta: Fixed::from_f64(beta), zeta: Fixed::from_f64(zeta), x, v, force });
        let basis = [
            flight(one, zero, (zero, zero)),
            flight(zero, one, (zero, zero)),
            flight(zero, zero, (one, zero)),
            flight(zero, zero, (zero, one)),
        ];
        // a power of two, so that halves stay exact
        let longest = 0.7 / (1.0 + 2.0 * zeta).max(beta.sqrt());
        let longest = 2_f64.powf(longest.log2().floor());
        let mut steps = [Step::default(); LEVELS];
        let mut h = longest;
        for step in &mut steps {
            let s = Fixed::from_f64(h);
            let nodes = basis.map(|flight| flight.at(s));
            let (sine, cosine) = super::elementary::sin_cos(Fixed::from_f64(beta) * s);
            let mut v = nodes.map(|node| node.v);
            v[1] = v[1] - one;
            *step = Step {
                h,
                // sin(phase) drives K_c: from rest, the force cos(beta s) has phase pi/2, that is sin = 1
                x: nodes.map(|node| node.d.to_f64()),
                v: v.map(Fixed::to_f64),
                turn: (cosine.to_f64(), sine.to_f64()),
            };
            h *= 0.5;
        }
        let gaps = [Side::Upper, Side::Lower].map(|side| osc.stop(side).map(|stop| stop.gap));
        Self { beta, zeta, steps, gaps }
    }
}

/// A point of the march.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    s: f64,
    d: f64,
    v: f64,
    sine: f64,
    cosine: f64,
    /// Bounds, to first order, of the error of `d` and of `v`.
    noise: f64,
    noise_v: f64,
    /// The same of their root sum of squares, which no free motion enlarges.
    norm: f64,
    /// The same of sine and cosine.
    noise_turn: f64,
}

/// What the march found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Seen {
    /// A contact at this time, to about 1e-10, relative for short flights.
    Strike(Side, f64),
    Nothing,
    /// Too close to a tangency, or to the end of the digits, to be decided in doubles.
    Unclear,
}

/// One flight through a table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct March<'a> {
    table: &'a Table,
    x: f64,
    /// Position past each stop at the start.
    past: [Option<f64>; 2],
}

impl<'a> March<'a> {
    /// What a flight from `case`, of the table's oscillator, meets up to `horizon`.
    pub(crate) fn look(table: &'a Table, case: &Case, horizon: f64) -> Seen {
        let past = [table.gaps[0].map(|gap| case.x - gap), table.gaps[1].map(|gap| -case.x - gap)];
        let march = Self { table, x: case.x, past };
        let (sine, cosine) = case.phase.sin_cos();
        let noise_turn = f64::EPSILON;
        let mut a = Mark { s: 0.0, d: 0.0, v: case.v, sine, cosine, noise: 0.0, noise_v: 0.0, norm: 0.0, noise_turn };
        let h = table.steps[0].h;
        let mut found = Vec::new();
        while a.s < horizon {
            let b = march.step(&a, 0);
            let mut first: Option<(Side, f64)> = None;
            for (side, past) in [(Side::Upper, past[0]), (Side::Lower, past[1])] {
                let Some(past) = past else { continue };
                let on_stop = a.s == 0.0 && past == 0.0;
                examine(&march, side, Cell { a, b, h, on_stop }, &mut found);
                for one in found.drain(..) {
                    match one {
                        Found::Rise { a, b, h } => match march.root(side, a, b, h) {
                            Some(s) if first.is_none_or(|(_, other)| s < other) => first = Some((side, s)),
                            Some(_) => {}
                            None => return Seen::Unclear,
                        },
                        Found::Touch { .. } | Found::Unresolved => return Seen::Unclear,
                    }
                }
            }
            if let Some((side, s)) = first {
                return Seen::Strike(side, s);
            }
            a = b;
        }
        Seen::Nothing
    }

    fn step(&self, a: &Mark, level: usize) -> Mark {
        let step = &self.table.steps[level];
        let state = [self.x + a.d, a.v, a.sine, a.cosine];
        let product = |row: &[f64; 4]| row[0] * state[0] + row[1] * state[1] + row[2] * state[2] + row[3] * state[3];
        let size = |row: &[f64; 4]| {
            (row[0] * state[0]).abs()
                + (row[1] * state[1]).abs()
                + (row[2] * state[2]).abs()
                + (row[3] * state[3]).abs()
        };
        let (c, s) = step.turn;
        let (h, d) = (step.h, a.d + product(&step.x));
        let v = a.v + product(&step.v);
        let turning = a.noise_turn * h;
        let local = f64::EPSILON * (size(&step.x) + d.abs()) + turning * h;
        let local_v = f64::EPSILON * (size(&step.v) + v.abs()) + turning;
        let norm = a.norm + local + local_v;
        Mark {
            s: a.s + h,
            d,
            v,
            sine: a.sine * c + a.cosine * s,
            cosine: a.cosine * c - a.sine * s,
            noise: (a.noise + h * a.noise_v + local).min(norm),
            noise_v: (a.noise_v + h * (1.0 + 2.0 * self.table.zeta) * (a.noise + a.noise_v) + local_v).min(norm),
            norm,
            noise_turn: a.noise_turn + 2.0 * f64::EPSILON,
        }
    }

    /// The level of a step of length `h`.
    fn level(&self, h: f64) -> Option<usize> {
        // powers of two: the exponents tell
        let exponent = |h: f64| h.to_bits() >> 52;
        let level = usize::try_from(exponent(self.table.steps[0].h) - exponent(h)).ok()?;
        (level < LEVELS).then_some(level)
    }

    /// The contact in a cell of rise, by cutting it until the cubic through its ends is good enough.
    fn root(&self, side: Side, mut a: Mark, mut b: Mark, mut h: f64) -> Option<f64> {
        loop {
            let (va, vb) = (self.view(&a, side), self.view(&b, side));
            let bounds = super::cell::Bounds::new(self.table.beta, self.table.zeta, self.size(&a), h);
            let slowest = va.p.min(vb.p);
            let wanted = 1e-11 * b.s.min(1.0);
            if bounds.cubic_error(h) <= slowest * wanted {
                if va.noise.max(vb.noise) > 50.0 * slowest * wanted {
                    return None;
                }
                return Some(a.s + h * cubic_root(va.y, h * va.p, vb.y, h * vb.p));
            }
            h *= 0.5;
            let middle = self.after(&a, h)?;
            let y = self.view(&middle, side);
            if y.y.abs() <= y.noise {
                return Some(middle.s);
            }
            if y.y < 0.0 { a = middle } else { b = middle }
        }
    }
}

/// The root in [0, 1] of the rising cubic with these values and slopes at 0 and 1.
fn cubic_root(ya: f64, pa: f64, yb: f64, pb: f64) -> f64 {
    let (mut low, mut high, mut t) = (0.0, 1.0, ya / (ya - yb));
    for _ in 0..12 {
        // by Newton, or by halving where that leaves the bracket
        let (c2, c3) = (3.0 * (yb - ya) - 2.0 * pa - pb, pa + pb - 2.0 * (yb - ya));
        let y = ya + t * (pa + t * (c2 + t * c3));
        let slope = pa + t * (2.0 * c2 + 3.0 * t * c3);
        if y < 0.0 {
            low = t;
        } else {
            high = t;
        }
        let next = t - y / slope;
        let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
        if (next - t).abs() < 1e-15 {
            return next;
        }
        t = next;
    }
    t
}

impl Curve for March<'_> {
    type Node = Mark;

    fn view(&self, node: &Mark, side: Side) -> View {
        let sign = side.sign();
        let past = self.past[usize::from(side == Side::Lower)].unwrap_or(f64::NEG_INFINITY);
        let q = node.sine - self.x - node.d - 2.0 * self.table.zeta * node.v;
        let noise_q = 1e-14 * (1.0 + self.x.abs() + node.d.abs() + (1.0 + 2.0 * self.table.zeta) * node.v.abs())
            + node.noise
            + 2.0 * self.table.zeta * node.noise_v
            + node.noise_turn;
        View { y: past + sign * node.d, p: sign * node.v, q: sign * q, noise: 4.0 * node.noise, noise_q }
    }

    fn size(&self, node: &Mark) -> f64 {
        (self.x + node.d).abs().max(node.v.abs())
    }

    fn rates(&self) -> (f64, f64) {
        (self.table.beta, self.table.zeta)
    }

    fn after(&self, a: &Mark, h: f64) -> Option<Mark> {
        self.level(h).map(|level| self.step(a, level))
    }

    fn apex(&self, _side: Side, _a: &Mark, _b: &Mark) -> Option<(Mark, f64)> {
        None
    }
}
