//! The motion of a machine over a time, with its derivative by the state at the beginning.

use super::frame::MachineFrame;
use crate::events::{End, Event, EventKind, Passage, Place, step_derivative};
use crate::machine::{Stop, StopLaw};
use crate::math::{Matrix, dot};
use crate::regime::ContactState;

/// The motion over a time.
#[derive(Clone, Debug)]
pub(crate) struct MachineLap {
    /// The time.
    pub(crate) time: f64,
    /// The state at the end.
    pub(crate) end: Place,
    /// The derivative of the state at the end by that at the beginning; `None` if a guard was only touched, or if nobody asked for it.
    pub(crate) derivative: Option<Matrix>,
    /// The steps, each with the state at its beginning and the time of that.
    pub(crate) steps: Vec<(f64, Place, Passage)>,
    /// The events, with times since the beginning.
    pub(crate) events: Vec<Event>,
    /// The largest sizes of coordinates and velocities.
    pub(crate) sizes: (f64, f64),
}

/// The largest number of steps of a lap.
const STEPS: usize = 100_000;

/// How far flights are followed, in units of the time of the lap.
const BEYOND: f64 = 1.25;
/// The rebound of the last impact that is followed in a chatter, in parts of the largest velocity along its stop.
const FAINT: f64 = 1e-6;

impl MachineLap {
    /// The joints that hold all the time, by their places. Each keeps where it is: beside the motion there are others in which it
    /// is elsewhere.
    pub(crate) fn holding(&self) -> Vec<usize> {
        let places = self.steps.first().map_or(0, |(_, first, _)| first.states.len());
        let holds = |k: &usize| self.steps.iter().all(|(_, place, _)| place.states[*k] == ContactState::Holding);
        (0..places).filter(holds).collect()
    }

    /// Whether infinitely many impacts are in it: some were summed, or a stop is at rest after an impact on it with so slow a rebound
    /// that further ones would be below rounding errors. After a faster one bodies can move on together too, as elastic ones in a
    /// row do after impacts in turn.
    pub(crate) fn completes_chatter(&self, frame: &MachineFrame<'_>) -> bool {
        let faint = |event: &Event, restitution: f64| {
            let along = &frame.normal.directions[event.place];
            event.kind == EventKind::Impact
                && restitution > 0.0
                && restitution * event.speed <= FAINT * dot(along, along).sqrt() * self.sizes.1
        };
        let fades = |(k, event): (usize, &Event)| {
            let last = || self.events[..k].iter().rev().find(|before| before.place == event.place);
            match frame.machine.stops().get(event.place).map(|stop| stop.law) {
                Some(StopLaw::Rigid { restitution }) if event.kind == EventKind::Stick => {
                    last().is_some_and(|last| faint(last, restitution))
                }
                _ => false,
            }
        };
        self.steps.iter().any(|(_, _, passage)| passage.rest.is_some()) || self.events.iter().enumerate().any(fades)
    }

    /// The rounding error of the derivative, in units of the sizes of coordinates and velocities.
    pub(crate) fn rounding(&self, frame: &MachineFrame<'_>) -> f64 {
        self.derivative.as_ref().map_or(0.0, |derivative| frame.rounding(derivative, self.steps.len(), self.sizes))
    }

    /// This motion and the one that follows it. The step at the end of this one is a part of a flight.
    pub(crate) fn then(mut self, next: Self) -> Self {
        self.derivative = self.derivative.zip(next.derivative).map(|(so_far, own)| own.times(&so_far));
        let time = self.time;
        self.steps.extend(next.steps.into_iter().map(|(begin, from, passage)| (time + begin, from, passage)));
        self.events.extend(next.events.into_iter().map(|event| Event { time: time + event.time, ..event }));
        self.sizes = (self.sizes.0.max(next.sizes.0), self.sizes.1.max(next.sizes.1));
        Self { time: time + next.time, end: next.end, ..self }
    }

    /// The motion from `begin` over a time. `None` if it ends before.
    pub(crate) fn fly(frame: &MachineFrame<'_>, begin: &Place, time: f64) -> Option<Self> {
        Self::along(frame, begin, (time, STEPS), Some(Matrix::identity(frame.shape.size())))
    }

    /// The same without the derivative.
    pub(crate) fn replay(frame: &MachineFrame<'_>, begin: &Place, time: f64) -> Option<Self> {
        Self::replay_in(frame, begin, time, STEPS)
    }

    /// The same; `None` if it has more than so many steps.
    pub(crate) fn replay_in(frame: &MachineFrame<'_>, begin: &Place, time: f64, most: usize) -> Option<Self> {
        Self::along(frame, begin, (time, most), None)
    }

    /// The motion, with the derivative of its end where it begins with that of its beginning.
    fn along(
        frame: &MachineFrame<'_>,
        begin: &Place,
        (time, most): (f64, usize),
        mut derivative: Option<Matrix>,
    ) -> Option<Self> {
        let mut motion = frame.resume(begin.clone()).limited(BEYOND * time);
        let mut steps: Vec<(f64, Place, Passage)> = Vec::new();
        let mut events = Vec::new();
        let mut sizes = frame.sizes(begin);
        // at the events of a joint, and after impacts with restitution 0, the velocity can be zero
        let plastic = |stop: &Stop| matches!(stop.law, StopLaw::Rigid { restitution } if restitution == 0.0);
        let can_be_still = !frame.machine.joints().is_empty() || frame.machine.stops().iter().any(plastic);
        let mut end = None;
        while end.is_none() {
            let (now, from) = (motion.time(), motion.place().clone());
            let (x, v) = frame.sizes(&from);
            sizes = (sizes.0.max(x), sizes.1.max(v));
            let left = time - now;
            let passage = motion.step()?;
            if can_be_still {
                let middle = frame.moved(&from, &passage.structure, 0.5 * passage.duration.min(left));
                let (x, v) = frame.sizes(&middle);
                sizes = (sizes.0.max(x), sizes.1.max(v));
            }
            let for_ever = matches!(motion.end(), Some(End::Never | End::Stuck));
            let through = if left <= passage.duration || for_ever {
                end = Some(frame.moved(&from, &passage.structure, left));
                None
            } else {
                if steps.len() >= most || motion.end().is_some() {
                    return None;
                }
                events.extend(motion.take_events());
                let mut shortened = passage.clone();
                if let (Some((rest, whole)), Some(after)) = (&passage.rest, &passage.after)
                    && left < passage.time()
                {
                    // the end lies in the chatter that was summed
                    let part = whole + left - passage.time();
                    end = Some(frame.moved(after, rest, part));
                    shortened.rest = Some((rest.clone(), part));
                }
                Some(shortened)
            };
            let shape = &frame.shape;
            derivative = derivative.and_then(|so_far| {
                let own = match &through {
                    None => Some(shape.transition(&passage.structure, &frame.normal, &from, left)),
                    Some(passage) => frame.with(|structures| {
                        step_derivative(shape, frame.machine, &frame.normal, structures, &from, passage)
                    }),
                };
                Some(own?.times(&so_far))
            });
            steps.push((now, from, passage));
        }
        frame.keep(&motion);
        let end = end?;
        // what happens after the end does not belong to it
        events.retain(|event: &Event| event.time <= time);
        Some(Self { time, end, derivative, steps, events, sizes })
    }
}
