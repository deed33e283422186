//! The events of a motion as a ring.

use super::chatters::Chatter;
use super::frame::MachineFrame;
use super::lap::MachineLap;
use super::ring::{MachineRing, RingEvent};
use crate::arc::Recovery;
use crate::events::Place;
use crate::regime::GuardKind;
use core::f64::consts::TAU;

/// The events of a lap, each with its time and the state after it. A surface that comes back to its holder before its stop
/// closes again decides nothing, wherever this happens: it is left out.
pub(crate) fn events_of(lap: &MachineLap) -> Vec<(f64, RingEvent, Place)> {
    // the last step is the flight to the end
    let passages = lap.steps[..lap.steps.len() - 1].iter();
    let mut events: Vec<(f64, RingEvent, Place)> = Vec::new();
    let mut on_holder: Vec<(usize, usize)> = Vec::new();
    for (time, _, passage) in passages {
        let Some((event, place)) = RingEvent::of(passage).zip(passage.after.clone()) else { continue };
        let stood_back = |stop: usize| passage.before.as_ref().is_some_and(|before| before.surfaces[stop].is_some());
        let closed = event.guards().filter_map(|guard| match guard {
            GuardKind::Gap(stop) if !stood_back(stop) => Some((events.len(), stop)),
            _ => None,
        });
        on_holder.extend(closed);
        events.push((time + passage.duration, event, place));
    }
    let m = events.len();
    for (k, stop) in on_holder {
        // where the lap is not closed, what is at its end is not what was at its beginning
        let stands = |place: &Place| place.surfaces[stop].is_some();
        let closes = lap.steps.first().is_some_and(|(_, begin, _)| stands(begin) == stands(&lap.end));
        let before: Vec<usize> = (1..m).take_while(|i| *i <= k || closes).map(|i| (k + m - i) % m).collect();
        // without an offset a surface comes back in the limit only: it stands back by nothing where its size is below all numbers, so
        // that cycles do not differ on both sides of a number at which nothing happens
        let opened = before.iter().position(|i| events[*i].2.surfaces[stop].is_some());
        if let Some(last) = opened
            && let Some(surface) = events[before[last]].2.surfaces[stop].filter(|surface| surface.offset == 0.0)
        {
            for i in &before[..last] {
                events[*i].1.back[stop] = true;
                events[*i].2.surfaces[stop] = Some(Recovery { size: 0.0, ..surface });
            }
            continue;
        }
        for i in before {
            // between the opening and the closing there can be others, at which it is on its holder or still stands back
            events[i].1.back[stop] = false;
            events[i].2.surfaces[stop] = None;
            if events[i].1.has(GuardKind::Force(stop)) || events[i].1.has(GuardKind::Gap(stop)) {
                break;
            }
        }
    }
    events
}

impl MachineRing {
    /// The events of the motion from `begin`, a state between two events, over `periods` forcing periods, or without
    /// forcing over the time `period`; `None` if there is none.
    pub(crate) fn of(frame: &MachineFrame<'_>, begin: &Place, (periods, period): (u32, f64)) -> Option<Self> {
        let time = frame.time(periods, period);
        let pace = TAU / time;
        let frequency = frame.machine.parts().frequency.unwrap_or(pace);
        let lap = MachineLap::replay(frame, begin, time)?;
        let free = &frame.normal.translations;
        let (mut events, mut places): (Vec<RingEvent>, Vec<Place>) = Default::default();
        for (time, event, mut place) in events_of(&lap) {
            place.phase = begin.phase + frequency * time;
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
