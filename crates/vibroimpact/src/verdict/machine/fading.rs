//! Impacts that fade away where nothing drives a machine.
//!
//! Where impacts or dampers take energy and none comes back, the speeds of impacts tend to zero. Beside a body that swings on this can
//! take for ever, as at the top of its swing: the energy above that of the swing that only touches the stop falls with each
//! impact, until it is a rounding error. From there on rounding errors decide whether a swing reaches the stop: the impacts
//! end, or go on at the speed to which a rounding error of the gap leads. Both motions are the same, and so is the verdict.
//!
//! Where bodies touch stops without any load, all speeds fall together and nothing says when they are zero: a motion that is a
//! rounding error of what it was has faded away.

use crate::events::{Event, EventKind, Place};
use crate::machine::{Machine, StopLaw};
use crate::math::dot;
use crate::orbit::MachineFrame;
use core::f64::consts::TAU;

/// Motions are compared over so many periods of the slowest mode, and at least so many steps.
const PERIODS: f64 = 8.0;
const STEPS: u32 = 16;
/// Motions that differ by less, relative to the velocity, differ by some rounding errors in the energy.
const CLOSE: f64 = 3e-7;

/// A motion this much slower than it was is one of rounding errors of some hundred events, which are taken away one coordinate after
/// another.
const GONE: f64 = 1e3 * f64::EPSILON;

/// A state of the motion, after which it is compared with the one without events.
#[derive(Clone, Debug)]
struct Begin {
    place: Place,
    time: f64,
    steps: u32,
    /// The rate of the slowest mode with all stops open.
    rate: f64,
}

/// Whether the motion differs from one without events, and from rest.
#[derive(Clone, Debug, Default)]
pub(super) struct Fading {
    begin: Option<Begin>,
    /// The largest speed of the motion.
    largest: f64,
}

impl Fading {
    /// Includes a step to this state; returns whether the impacts before it have faded away.
    pub(super) fn includes(&mut self, frame: &MachineFrame<'_>, place: &Place, time: f64) -> bool {
        if !frame.gains_no_energy() || !takes_energy(frame.machine) {
            return false;
        }
        if let Some(begin) = &mut self.begin {
            begin.steps += 1;
            if begin.steps < STEPS || (time - begin.time) * begin.rate < PERIODS * TAU {
                return false;
            }
        }
        let mut fades = self.begin.as_ref().is_some_and(|begin| begin.goes_on(frame, place, time));
        let rate = frame.open().and_then(|open| open.slowest());
        if let Some(rate) = rate {
            let speed = speed(place, rate);
            fades |= speed < GONE * self.largest;
            self.largest = self.largest.max(speed);
        }
        self.begin = rate.map(|rate| Begin { place: place.clone(), time, steps: 0, rate });
        fades
    }

    /// Whether the impacts before a flight without an end have faded away: it touches a stop again and again.
    pub(super) fn touches(frame: &MachineFrame<'_>, seen: &[Event]) -> bool {
        frame.gains_no_energy()
            && takes_energy(frame.machine)
            && seen.len() >= STEPS as usize
            && seen.iter().all(|event| event.kind == EventKind::Graze)
    }
}

impl Begin {
    /// Whether the motion from here without events leads to the same state.
    fn goes_on(&self, frame: &MachineFrame<'_>, place: &Place, time: f64) -> bool {
        let Some(structure) = frame.structure(&self.place.states) else { return false };
        let moved = frame.moved(&self.place, &structure, time - self.time);
        let speed = speed(place, self.rate);
        frame.distance(&moved, place, (speed / self.rate, speed)) < CLOSE
    }
}

/// The speed of a motion at this rate: of a swing through rest the largest one.
fn speed(place: &Place, rate: f64) -> f64 {
    let way = rate * rate * dot(&place.x, &place.x);
    (dot(&place.v, &place.v) + way).sqrt()
}

/// Whether anything in a machine takes energy.
fn takes_energy(machine: &Machine) -> bool {
    let parts = machine.parts();
    let takes = |law: &StopLaw| match *law {
        StopLaw::Rigid { restitution } => restitution < 1.0,
        StopLaw::Compliant { damping, .. } => damping > 0.0,
    };
    parts.damping.largest() > 0.0
        || parts.stops.iter().any(|stop| takes(&stop.law))
        || parts.joints.iter().any(|joint| joint.sliding > 0.0)
}
