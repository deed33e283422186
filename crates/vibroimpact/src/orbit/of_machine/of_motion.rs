//! The events of a motion as a ring.

use super::chatters::Chatter;
use super::frame::MachineFrame;
use super::lap::MachineLap;
use super::ring::{MachineRing, RingEvent};
use crate::events::Place;
use core::f64::consts::TAU;

impl MachineRing {
    /// The events of the motion from `begin`, a state between two events, over `periods` forcing periods, or without
    /// forcing over the time `period`; `None` if there is none.
    pub(crate) fn of(frame: &MachineFrame<'_>, begin: &Place, (periods, period): (u32, f64)) -> Option<Self> {
        let time = frame.time(periods, period);
        let pace = TAU / time;
        let frequency = frame.machine.parts().frequency.unwrap_or(pace);
        let lap = MachineLap::fly(frame, begin, time)?;
        let free = &frame.normal.translations;
        let (mut events, mut places): (Vec<RingEvent>, Vec<Place>) = Default::default();
        for (k, (time, _, passage)) in lap.steps.iter().enumerate() {
            // the last step is the flight to the end
            if k + 1 == lap.steps.len() {
                break;
            }
            let Some(event) = RingEvent::of(passage) else { continue };
            let mut place = passage.after.clone()?;
            place.phase = begin.phase + frequency * (time + passage.duration);
            events.push(event);
            places.push(place);
        }
        let first = places.first()?.phase;
        let mut ring = Self { events, places, periods, pace, together: None };
        ring.end_at(first + TAU);
        Chatter::shorten(frame, &mut ring)?;
        Some(ring.centred(free))
    }
}
