//! The equations of a cycle with two parameters among the unknowns and one additional condition. Their solutions are
//! curves in a plane of parameters.

use super::cycle_equations::slopes;
use crate::continuation::trace::equations::Equations;
use crate::math::sin_cos;
use crate::orbit::{Block, Floquet, Ring, blocks, closest};
use crate::system::{Oscillator, ParameterPlane, Side};

/// The condition that holds along a curve: the zero of a function of the cycle and the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Condition {
    /// A multiplier is +1.
    PlusOne,
    /// The test function of a multiplier +1 has this value instead of zero.
    NearPlusOne(f64),
    /// A multiplier is -1.
    MinusOne,
    /// The speed of the first impact exceeds that of the second by this value.
    Unlike(usize, usize, f64),
    /// An impact has speed zero.
    Speed(usize),
    /// The flight after an impact grazes a stop.
    Clear(usize, Side),
    /// The force on the mass at the position of the stop vanishes at an impact.
    Pull(usize),
    /// The trace of the derivative over one cycle is zero, apart from the factor that is zero at a grazing impact.
    Trace,
    /// A straight line in the plane: `a p + b q = c`.
    Line(f64, f64, f64),
    /// The frequency ratio exceeds this value, on the side of the sign, by more than the second number.
    Frequency { side: f64, beta: f64, by: f64 },
}

/// The equations of the cycles of one signature over a plane of two parameters, with one condition.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    osc: Oscillator,
    pub(crate) over: ParameterPlane,
    pub(crate) sides: Vec<Side>,
    periods: u32,
    scales: (f64, f64),
    weights: Vec<f64>,
    /// Whether changes of speed are divided by the speed of the fastest impact, if that exceeds 1. Near resonance
    /// speeds are as large as the restitution permits.
    pub(crate) relative: bool,
    pub(crate) condition: Condition,
}

impl Plane {
    /// The equations for the signature of `ring`. Changes of the parameters by `scales` have the same length as a
    /// change of all phases by one radian.
    pub(crate) fn new(
        osc: &Oscillator,
        over: ParameterPlane,
        scales: (f64, f64),
        ring: &Ring,
        condition: Condition,
    ) -> Self {
        let m = ring.len();
        // a mean over the impacts: lengths do not depend on their number
        let mut weights = vec![1.0 / m as f64; 2 * m];
        weights.extend([1.0 / (scales.0 * scales.0), 1.0 / (scales.1 * scales.1)]);
        let (sides, periods) = (ring.sides.clone(), ring.periods);
        Self { osc: *osc, over, sides, periods, scales, weights, relative: false, condition }
    }

    /// If [`relative`](Self::relative) is set, adapts the weights of the speeds to the solution `w`.
    pub(crate) fn weigh(&mut self, w: &[f64]) {
        if !self.relative {
            return;
        }
        let m = self.sides.len();
        let fastest = (0..m).map(|k| w[2 * k + 1].abs()).fold(1.0, f64::max);
        for speed in self.weights[..2 * m].iter_mut().skip(1).step_by(2) {
            *speed = 1.0 / (m as f64 * fastest * fastest);
        }
    }

    /// The vector of unknowns of a ring and values of the parameters.
    pub(crate) fn join(ring: &Ring, (p, q): (f64, f64)) -> Vec<f64> {
        let mut w = ring.unknowns.clone();
        w.extend([p, q]);
        w
    }

    /// The values of the parameters.
    pub(crate) fn values(w: &[f64]) -> (f64, f64) {
        (w[w.len() - 2], w[w.len() - 1])
    }

    /// The values of the parameters divided by the scales.
    pub(crate) fn scaled(&self, w: &[f64]) -> (f64, f64) {
        let (p, q) = Self::values(w);
        (p / self.scales.0, q / self.scales.1)
    }

    /// The values of the parameters from values divided by the scales.
    pub(crate) const fn unscaled(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x * self.scales.0, y * self.scales.1)
    }

    /// The oscillator at a point of the plane; `None` for invalid values.
    pub(crate) fn oscillator(&self, at: (f64, f64)) -> Option<Oscillator> {
        self.over.set(&self.osc, at).ok()
    }

    /// The oscillator and the ring that belong to these unknowns; `None` for invalid values of the parameters.
    pub(crate) fn split(&self, w: &[f64]) -> Option<(Oscillator, Ring)> {
        let osc = self.oscillator(Self::values(w))?;
        let unknowns = w[..w.len() - 2].to_vec();
        Some((osc, Ring { sides: self.sides.clone(), unknowns, periods: self.periods }))
    }

    /// The oscillator, the ring and the linearised flights that belong to these unknowns; `None` for invalid values.
    pub(crate) fn flights(&self, w: &[f64]) -> Option<(Oscillator, Ring, Vec<Block>)> {
        let (osc, ring) = self.split(w)?;
        let flights = blocks(&osc, &ring)?;
        Some((osc, ring, flights))
    }

    /// The value of the function that is zero under a condition; `None` where it is not defined.
    pub(crate) fn value(&self, condition: Condition, w: &[f64]) -> Option<f64> {
        let (p, q) = Self::values(w);
        Some(match condition {
            Condition::Line(a, b, c) => a * p + b * q - c,
            Condition::Frequency { side, beta, by } => side * (self.oscillator((p, q))?.beta() - beta) - by,
            Condition::Speed(k) => w[2 * k + 1],
            Condition::Unlike(k, l, by) => w[2 * k + 1] - w[2 * l + 1] - by,
            Condition::Clear(k, side) => {
                let (osc, ring) = self.split(w)?;
                // an iteration can go to a flight that ends before it begins
                if ring.turn(k) <= 0.0 {
                    return None;
                }
                closest(&osc, &ring, k, side).map_or(f64::INFINITY, |closest| closest.distance)
            }
            Condition::Pull(k) => {
                let (osc, ring) = self.split(w)?;
                // the force of the spring at the stop less that of the excitation
                osc.stop(ring.side(k))?.gap - ring.side(k).sign() * sin_cos(ring.theta(k)).0
            }
            Condition::PlusOne | Condition::NearPlusOne(_) | Condition::MinusOne | Condition::Trace => {
                let (osc, ring, flights) = self.flights(w)?;
                let floquet = Floquet::new(&osc, &ring, &flights);
                match condition {
                    Condition::PlusOne => floquet.plus_one(),
                    Condition::NearPlusOne(value) => floquet.plus_one() - value,
                    Condition::MinusOne => floquet.minus_one(),
                    _ => floquet.turn.trace(),
                }
            }
        })
    }

    /// The gradient of that function. It is computed by differences where the formula is long; Newton's method
    /// converges with it too.
    pub(crate) fn gradient(&self, condition: Condition, w: &[f64]) -> Option<Vec<f64>> {
        let mut row = vec![0.0; w.len()];
        match condition {
            Condition::Line(a, b, _) => {
                row[w.len() - 2] = a;
                row[w.len() - 1] = b;
            }
            Condition::Speed(k) => row[2 * k + 1] = 1.0,
            Condition::Unlike(k, l, _) => {
                row[2 * k + 1] = 1.0;
                row[2 * l + 1] = -1.0;
            }
            _ => {
                let here = self.value(condition, w)?;
                let mut moved = w.to_vec();
                for (i, slope) in row.iter_mut().enumerate() {
                    let h = DIFFERENCE * (1.0 + w[i].abs());
                    let mut at = |x: f64| {
                        moved[i] = x;
                        let value = self.value(condition, &moved);
                        moved[i] = w[i];
                        value.filter(|v| v.is_finite())
                    };
                    // one-sided at the end of the range of a parameter
                    let (up, down) = (at(w[i] + h), at(w[i] - h));
                    *slope = match (up, down) {
                        (Some(up), Some(down)) => (up - down) / (2.0 * h),
                        (Some(up), None) => (up - here) / h,
                        (None, Some(down)) => (here - down) / h,
                        (None, None) => return None,
                    };
                }
            }
        }
        Some(row)
    }
}

/// Half the width of a difference, relative to the unknown.
const DIFFERENCE: f64 = 1e-6;

impl Equations for Plane {
    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let (osc, ring, flights) = self.flights(w)?;
        let width = w.len();
        let rates = self.over.rates(Self::values(w)).ok()?;
        let mut rows = slopes(&osc, &ring, &flights, &rates)?;
        let mut miss: Vec<f64> = flights.iter().flat_map(|b| b.miss).collect();
        // the row that the equations of the cycle leave to the condition
        let last = (width - 2) * width;
        rows[last..last + width].copy_from_slice(&self.gradient(self.condition, w)?);
        miss.push(self.value(self.condition, w)?);
        Some((miss, rows))
    }
}
