//! The distance of the flights of a cycle from the stops between its impacts.
//!
//! On a flight the distance from a stop has interior minima, where the velocity changes sign. The smallest of them is
//! the *clearance*. It is a smooth function of the cycle and becomes zero where the flight grazes, so continuation uses
//! it as a test function. It does not decide whether a cycle is admissible; the certified first contact does.

use super::cyclic::leaving;
use super::ring::Ring;
use crate::flight::{Flight, FlightPoint};
use crate::system::{Oscillator, Side};

/// The smallest distance of a flight from a stop between two impacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Closest {
    /// Time since the impact that the flight leaves.
    pub(crate) time: f64,
    /// Distance from the stop; negative beyond it.
    pub(crate) distance: f64,
}

/// The step of the scan for sign changes of the velocity, as a phase of the faster of the force and the free
/// oscillation.
const STEP: f64 = 0.35;
/// The largest number of steps of a scan; longer flights are scanned with longer steps.
const MAX_STEPS: f64 = 20_000.0;
/// The largest number of iterations for one extremum.
const MAX_REFINEMENTS: u32 = 80;

/// The smallest interior minimum of the distance of the flight after impact `k` from the stop on `side`; `None` if it
/// has no interior minimum.
///
/// An impact of negative speed is inadmissible, and the extremum next to it lies beyond the stop in any case. It is
/// left out.
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

/// Of the times within `time` at which a flight turns back from the stop on `side`, on either side of the stop, the one
/// nearest to `near`.
pub(crate) fn turning_near(osc: &Oscillator, flight: &Flight, side: Side, time: f64, near: f64) -> Option<Closest> {
    let sign = side.sign();
    let room = osc.stop(side)?.gap - sign * flight.x;
    let all = maxima(osc, flight, time, sign).into_iter();
    let nearest = all.min_by(|a, b| (a.0 - near).abs().total_cmp(&(b.0 - near).abs()))?;
    Some(Closest { time: nearest.0, distance: room - sign * nearest.1.displacement })
}

/// The extremum next to an impact of negative speed lies beyond the stop, up to this rounding error.
const BEYOND: f64 = 1e-12;

/// The larger of the angular rates of the force and of the free oscillation.
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
    // an extremum at either end belongs to an impact
    found.retain(|(s, _)| *s > 1e-12 * time && *s < (1.0 - 1e-12) * time);
    found
}

/// Adds the maxima of `sign * x` within one step to `found`, from velocity and acceleration at both ends.
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
        // the velocity may become positive and negative again within the step: examine it where it is largest
        let s = peak(flight, sign, s0, s1);
        if sign * flight.at(s).v > 0.0 {
            found.push(turning(flight, sign, s, s1));
        }
    } else if v0 > 0.0 && v1 > 0.0 && a0 < 0.0 && a1 > 0.0 {
        // the velocity may become negative and positive again
        let s = peak(flight, -sign, s0, s1);
        if sign * flight.at(s).v <= 0.0 {
            found.push(turning(flight, sign, s0, s));
        }
    }
}

/// The time between `low` and `high` at which `sign * v` changes from positive to negative, with the point of the
/// flight there.
fn turning(flight: &Flight, sign: f64, mut low: f64, mut high: f64) -> (f64, FlightPoint) {
    let mut s = 0.5 * (low + high);
    for _ in 0..MAX_REFINEMENTS {
        let point = flight.at(s);
        if sign * point.v > 0.0 {
            low = s;
        } else {
            high = s;
        }
        // Newton's method for a zero of the velocity
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

/// The time between `low` and `high` at which `sign * v` is largest; its derivative changes from positive to negative
/// there.
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
