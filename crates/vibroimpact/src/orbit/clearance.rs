//! How close the flights of a cycle come to the stops between their impacts.
//!
//! On a flight the distance to a stop has interior minima, where the velocity changes sign. The smallest of them, the
//! *clearance*, moves smoothly with the cycle and becomes zero where the flight grazes. It is what continuation
//! watches; whether a cycle is a motion is judged by the certified first contact, not by this.

use super::cyclic::leaving;
use super::ring::Ring;
use crate::flight::{Flight, FlightPoint};
use crate::system::{Oscillator, Side};

/// The closest a flight comes to a stop between two impacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Closest {
    /// Time since the impact it leaves.
    pub(crate) time: f64,
    /// Distance left; negative beyond the stop.
    pub(crate) distance: f64,
}

/// Step of the scan for changes of sign of the velocity, in the faster of the force's and the mass's own angle.
const STEP: f64 = 0.35;
/// The most steps a flight is scanned in; one longer than this many is scanned more coarsely.
const MAX_STEPS: f64 = 20_000.0;
/// Halvings that the refinement of an extremum may need.
const MAX_REFINEMENTS: u32 = 80;

/// The closest that the flight after impact `k` comes to the stop on `side` at an interior minimum of the distance;
/// `None` if it has none.
///
/// Where an impact has become virtual (its speed negative) the extremum that belongs to it is left out: it lies beyond
/// the stop by nature.
pub(crate) fn closest(osc: &Oscillator, ring: &Ring, k: usize, side: Side) -> Option<Closest> {
    let stop = osc.stop(side)?;
    let flight = leaving(osc, ring, k);
    let time = ring.turn(k) / osc.beta();
    let sign = side.sign();
    let room = stop.gap - sign * flight.x;
    let extrema = maxima(osc, &flight, time, sign);
    let mut extrema: Vec<Closest> =
        extrema.into_iter().map(|(time, point)| Closest { time, distance: room - sign * point.displacement }).collect();
    let own = |at: usize, extremum: Option<&Closest>| {
        ring.side(at) == side && ring.speed(at) < 0.0 && extremum.is_some_and(|e| e.distance < BEYOND)
    };
    if own(k, extrema.first()) {
        extrema.remove(0);
    }
    if own(k + 1, extrema.last()) {
        extrema.pop();
    }
    extrema.into_iter().min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// Of the places within `time` where a flight turns back from the stop on `side`, or beyond it, the one nearest in time to `near`.
pub(crate) fn turning_near(osc: &Oscillator, flight: &Flight, side: Side, time: f64, near: f64) -> Option<Closest> {
    let sign = side.sign();
    let room = osc.stop(side)?.gap - sign * flight.x;
    let all = maxima(osc, flight, time, sign).into_iter();
    let nearest = all.min_by(|a, b| (a.0 - near).abs().total_cmp(&(b.0 - near).abs()))?;
    Some(Closest { time: nearest.0, distance: room - sign * nearest.1.displacement })
}

/// The extremum that belongs to a virtual impact lies beyond the stop, up to rounding.
const BEYOND: f64 = 1e-12;

/// The faster of the force's and the mass's own rate.
fn fastest(osc: &Oscillator) -> f64 {
    osc.beta().max(1.0 + 2.0 * osc.damping())
}

/// The maxima of `sign * x` strictly within a flight of length `time`.
fn maxima(osc: &Oscillator, flight: &Flight, time: f64, sign: f64) -> Vec<(f64, FlightPoint)> {
    let steps = (time * fastest(osc) / STEP).ceil().clamp(4.0, MAX_STEPS);
    let step = time / steps;
    let mut found = Vec::new();
    // velocity and acceleration at the beginning of each step
    let mut before = (0.0, sign * flight.v, sign * flight.at(0.0).a);
    let mut k = 1.0;
    while k <= steps {
        let s = k * step;
        let point = flight.at(s);
        let here = (s, sign * point.v, sign * point.a);
        scan(flight, sign, before, here, &mut found);
        before = here;
        k += 1.0;
    }
    // an extremum at either end is an impact, not a touch
    found.retain(|(s, _)| *s > 1e-12 * time && *s < (1.0 - 1e-12) * time);
    found
}

fn scan(
    flight: &Flight,
    sign: f64,
    (s0, v0, a0): (f64, f64, f64),
    (s1, v1, a1): (f64, f64, f64),
    found: &mut Vec<(f64, FlightPoint)>,
) {
    if v0 > 0.0 && v1 <= 0.0 {
        found.push(turning(flight, sign, s0, s1));
    } else if v0 <= 0.0 && v1 <= 0.0 && a0 > 0.0 && a1 < 0.0 {
        // perhaps forward and back again within the step: look where the velocity is largest
        let s = peak(flight, sign, s0, s1);
        if sign * flight.at(s).v > 0.0 {
            found.push(turning(flight, sign, s, s1));
        }
    } else if v0 > 0.0 && v1 > 0.0 && a0 < 0.0 && a1 > 0.0 {
        // perhaps back and forward again
        let s = peak(flight, -sign, s0, s1);
        if sign * flight.at(s).v <= 0.0 {
            found.push(turning(flight, sign, s0, s));
        }
    }
}

/// Where `sign * v` passes through zero downwards between `low` and `high`.
fn turning(flight: &Flight, sign: f64, mut low: f64, mut high: f64) -> (f64, FlightPoint) {
    let mut s = 0.5 * (low + high);
    for _ in 0..MAX_REFINEMENTS {
        let point = flight.at(s);
        if sign * point.v > 0.0 {
            low = s;
        } else {
            high = s;
        }
        let mut next = s - point.v / point.a;
        if !(next > low && next < high) {
            next = 0.5 * (low + high);
        }
        let settled = (next - s).abs() <= 1e-15 * s || next <= low || next >= high;
        s = next;
        if settled {
            break;
        }
    }
    (s, flight.at(s))
}

/// Where `sign * v` is largest between `low` and `high`, its rate falling through zero there.
fn peak(flight: &Flight, sign: f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..MAX_REFINEMENTS {
        let s = 0.5 * (low + high);
        if s <= low || s >= high {
            break;
        }
        if sign * flight.at(s).a > 0.0 { low = s } else { high = s }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Start;

    #[test]
    fn every_maximum_of_a_long_flight() {
        let osc = Oscillator::new(2.7, 50.0, 0.5).unwrap().with_damping(0.01).unwrap();
        let start = Start::new(&osc, 0.2, -0.7, 1.0).unwrap();
        let flight = Flight::new(&osc, start);
        for sign in [1.0, -1.0] {
            let found = maxima(&osc, &flight, 60.0, sign);
            // by brute force
            let (mut count, mut last) = (0, sign * start.v);
            for k in 1..=600_000 {
                let v = sign * flight.at(f64::from(k) * 1e-4).v;
                if last > 0.0 && v <= 0.0 {
                    count += 1;
                }
                last = v;
            }
            assert_eq!(found.len(), count);
            assert!(found.iter().all(|(_, point)| point.v.abs() < 1e-12));
        }
    }
}
