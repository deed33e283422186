//! The test functions of a branch: they are smooth along the branch and change sign at an event.

use super::cycle_equations::CycleEquations;
use crate::math::sin_cos;
use crate::orbit::{Block, Floquet, Ring, closest, room};
use crate::system::{Oscillator, Side};

/// A test function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TestFunction {
    /// The component of the tangent along the parameter: zero where the parameter turns back.
    Pace,
    /// Zero where a multiplier is +1.
    PlusOne,
    /// Zero where a multiplier is -1.
    MinusOne,
    /// The speed of an impact.
    Speed(usize),
    /// The smallest distance of the flight after an impact from a stop.
    Clear(usize, Side),
    /// The distance of the motion without impacts from a stop.
    Room(Side),
    /// With restitution 0: the force that pulls the mass away from the stop after an impact. With another one, as along a branch over the
    /// restitution that begins at 0, the impact itself does.
    Pull(usize),
}

impl TestFunction {
    /// The test functions for the cycles with the signature of `ring`.
    pub(crate) fn all(osc: &Oscillator, ring: &Ring) -> Vec<Self> {
        if ring.len() == 0 {
            return osc.stops().map(|(side, _)| Self::Room(side)).collect();
        }
        let mut list = vec![Self::Pace, Self::PlusOne, Self::MinusOne];
        for k in 0..ring.len() {
            list.push(Self::Speed(k));
            list.extend(osc.stops().map(|(side, _)| Self::Clear(k, side)));
            if osc.stop(ring.side(k)).is_some_and(|stop| stop.restitution == 0.0) {
                list.push(Self::Pull(k));
            }
        }
        list
    }

    /// Whether the cycle is admissible only while this function is positive.
    pub(crate) const fn needed(&self) -> bool {
        matches!(self, Self::Speed(_) | Self::Clear(..) | Self::Room(_) | Self::Pull(_))
    }

    /// Whether it is zero at folds or branch points.
    pub(crate) const fn critical(&self) -> bool {
        matches!(self, Self::Pace | Self::PlusOne)
    }

    /// Its value at the solution `at`, with the tangent there.
    pub(crate) fn value(self, equations: &CycleEquations, tangent: &[f64], at: &Place<'_>) -> f64 {
        let Place { osc, ring, flights } = *at;
        match self {
            Self::Pace => equations.pace(tangent),
            Self::PlusOne => Floquet::new(osc, ring, flights).plus_one(),
            Self::MinusOne => Floquet::new(osc, ring, flights).minus_one(),
            Self::Speed(k) => ring.speed(k),
            Self::Clear(k, side) => closest(osc, ring, k, side).map_or(f64::INFINITY, |closest| closest.distance),
            Self::Room(side) => room(osc, side),
            Self::Pull(k) => osc
                .stop(ring.side(k))
                .filter(|stop| stop.restitution == 0.0)
                .map_or(f64::INFINITY, |stop| stop.gap - ring.side(k).sign() * sin_cos(ring.theta(k)).0),
        }
    }
}

/// A solution at which test functions are evaluated.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) osc: &'a Oscillator,
    pub(crate) ring: &'a Ring,
    pub(crate) flights: &'a [Block],
}
