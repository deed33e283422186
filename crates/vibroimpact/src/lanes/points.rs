//! Points of one flight, side by side, panel by panel.
//!
//! The responses at the points of a panel of the longest length depend on the oscillator alone. So they are computed
//! once for many flights, and a point of such a panel takes a few multiplications instead of four sines and cosines.

use crate::flight::{Flight, PANEL};
use crate::math::{Lane, POINTS, RULE};
use crate::system::{Nearby, Response};
use core::cell::OnceCell;

/// The shortest flight, in units of the time in which it changes: over shorter ones the closed form loses digits of the
/// displacement, and the few points by the series cost little.
const SHORTEST: f64 = 0.25;
/// The longest flight, so that the rounding errors of its panels, which add up, stay small.
const LONGEST: f64 = 1e5;

/// Whether the points of the first `duration` of a flight can be computed side by side.
pub(super) fn suited(flight: &Flight, duration: f64) -> bool {
    let response = flight.response();
    response.is_light() && (SHORTEST..LONGEST).contains(&(duration * response.beta().max(1.0)))
}

/// Positions, velocities, and sine and cosine of the phase of the force.
#[derive(Clone, Copy)]
pub(super) struct Points<L> {
    pub(super) x: L,
    pub(super) v: L,
    pub(super) sin: L,
    pub(super) cos: L,
}

impl Points<f64> {
    /// The beginning of a flight.
    pub(super) const fn begin(flight: &Flight) -> Self {
        Self { x: flight.x, v: flight.v, sin: flight.sin, cos: flight.cos }
    }

    /// The points for which `after` has the responses, counted from this point.
    #[inline(always)]
    pub(super) fn then<L: Lane>(&self, beta: f64, after: &Nearby<L>) -> Points<L> {
        let (x, v, beta) = (L::splat(self.x), L::splat(self.v), L::splat(beta));
        let (sin, cos) = (L::splat(self.sin), L::splat(self.cos));
        Points {
            x: x * after.c + v * after.s + (sin * after.kc + cos * after.ks),
            // K' = S + i beta K
            v: v * after.s_rate - x * after.s + (sin * (after.s - beta * after.ks) + cos * (beta * after.kc)),
            sin: sin * after.cos_turn + cos * after.sin_turn,
            cos: cos * after.cos_turn - sin * after.sin_turn,
        }
    }
}

/// The responses at the points of a panel.
#[derive(Clone, Debug)]
pub(super) struct Rows(Nearby<[f64; POINTS]>);

impl Rows {
    /// At these places on [-1, 1].
    fn new(response: &Response, half: f64, places: &[f64; POINTS]) -> Self {
        let points = places.map(|place| response.nearby(half, half * place));
        Self(Nearby {
            c: points.map(|point| point.c),
            s: points.map(|point| point.s),
            s_rate: points.map(|point| point.s_rate),
            kc: points.map(|point| point.kc),
            ks: points.map(|point| point.ks),
            sin_turn: points.map(|point| point.sin_turn),
            cos_turn: points.map(|point| point.cos_turn),
        })
    }

    /// From point number `k` on.
    #[inline(always)]
    pub(super) fn load<L: Lane>(&self, k: usize) -> Nearby<L> {
        // without a closure, which would not be compiled for the processor's instructions
        Nearby {
            c: L::load(&self.0.c[k..]),
            s: L::load(&self.0.s[k..]),
            s_rate: L::load(&self.0.s_rate[k..]),
            kc: L::load(&self.0.kc[k..]),
            ks: L::load(&self.0.ks[k..]),
            sin_turn: L::load(&self.0.sin_turn[k..]),
            cos_turn: L::load(&self.0.cos_turn[k..]),
        }
    }
}

/// Half the length of an interval on [-1, 1]; a panel has an interval for each point.
pub(super) const RHO: f64 = 1.0 / 16.0;
/// The middles of the intervals.
pub(super) const MIDDLES: [f64; POINTS] = {
    let mut middles = [RHO - 1.0; POINTS];
    let mut k = 1;
    while k < POINTS {
        middles[k] = middles[k - 1] + 2.0 * RHO;
        k += 1;
    }
    middles
};
/// The places of the points of the quadrature on [-1, 1], and their weights.
pub(super) const PLACES: ([f64; POINTS], [f64; POINTS]) = {
    let (mut places, mut weights) = ([0.0; POINTS], [0.0; POINTS]);
    let mut k = 0;
    while k < RULE.len() {
        let (place, weight) = RULE[k];
        // the rule is symmetric: each place of its table stands for two
        (places[2 * k], places[2 * k + 1]) = (-place, place);
        (weights[2 * k], weights[2 * k + 1]) = (weight, weight);
        k += 1;
    }
    (places, weights)
};

/// The longest panel of an oscillator.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    /// Half its length.
    pub(super) half: f64,
    /// The responses at its end,
    pub(super) end: Nearby<f64>,
    /// at the points of the quadrature,
    pub(super) places: Rows,
    /// and in the middles of the intervals.
    pub(super) middles: Rows,
}

/// The longest panel of one oscillator, computed when a flight needs it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Panels(OnceCell<Box<Panel>>);

impl Panels {
    /// The panel; `flight` must be of the same oscillator each time, and suited.
    pub(super) fn longest(&self, flight: &Flight) -> &Panel {
        self.0.get_or_init(|| {
            let (response, half) = (flight.response(), 0.5 * PANEL / flight.fastest());
            Box::new(Panel {
                half,
                end: response.nearby(half, half),
                places: Rows::new(response, half, &PLACES.0),
                middles: Rows::new(response, half, &MIDDLES),
            })
        })
    }
}
