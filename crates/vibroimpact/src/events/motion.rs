//! The motion of a machine as an iterator over its events.

use super::event::{ContactStart, End, Event, EventKind, Limits, Start};
use super::instants::Instants;
use super::passage::Passage;
use super::place::{Place, Scratch, Structures, standing_back};
use super::state::{ImpactHistory, check_contacts, fingerprint};
use super::stretch::{Stretch, follow};
use crate::arc::{Buffers, MachineFlight, Touch};
use crate::machine::{Fault, Machine, MachineError, Opening, StopLaw};
use crate::math::Wide;
use crate::regime::{ContactState, GuardKind, Normal, compliant_force};
use std::collections::VecDeque;

/// The events of a machine from a start, in order.
///
/// ```
/// use vibroimpact::events::{EventKind, Limits, Motion, Start};
/// use vibroimpact::machine::{Machine, MachineParts};
/// // a ball of mass 1 under gravity 1, dropped from height 1/2 on a floor: impacts at 1, 2, 2.5, ...
/// let parts = MachineParts::new(["height"]).with_mass(0, 1.0).with_constant(0, -1.0);
/// let ball = Machine::new(parts.with_rigid_stop("floor", &[-1.0], 0.0, 0.5))?;
/// let start = Start { q: vec![0.5], ..Start::default() };
/// let times: Vec<f64> = Motion::new(&ball, &start, Limits::default())?.take(3).map(|event| event.time).collect();
/// assert!(times.iter().zip([1.0, 2.0, 2.5]).all(|(time, want)| (time - want).abs() < 1e-14));
/// let rest = Motion::new(&ball, &start, Limits::default())?.last().unwrap();
/// assert_eq!(rest.kind, EventKind::Stick);
/// assert!((rest.time - 3.0).abs() < 1e-14); // infinitely many impacts are summed
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Motion<'a> {
    pub(super) machine: &'a Machine,
    pub(super) normal: Normal,
    pub(super) structures: Structures,
    pub(super) place: Place,
    pub(super) time: Wide,
    pub(super) limits: Limits,
    pending: VecDeque<Event>,
    pub(super) end: Option<End>,
    pub(super) buffers: Buffers,
    pub(super) touches: Vec<Touch>,
    /// The last flights in two regimes, between which most motions alternate: their memory is used again.
    pub(super) spare: [Option<Box<MachineFlight>>; 2],
    pub(super) scratch: Scratch,
    /// Whether the outcome of the last impacts depends on an order that is below rounding.
    pub(super) tie: bool,
    /// Whether rounding errors of the state were taken away at this event.
    pub(super) silenced: bool,
    /// Events since the time last advanced.
    pub(super) crowd: u32,
    pub(super) instants: Instants,
    /// The largest speed of an impact since the structure last came to rest by a chatter.
    pub(super) largest_impact: f64,
    /// The number of the machine, if events have whole states.
    fingerprint: Option<f64>,
    /// The rigid stops whose impacts are announced, if they may be those of a chatter, and the speeds.
    pub(super) struck: Vec<(usize, f64)>,
    /// The last step, if steps are recorded.
    pub(super) passage: Option<Passage>,
    pub(super) recording: bool,
    /// What it did since the last event, if someone looks.
    trail: Option<Vec<Stretch>>,
}

impl<'a> Motion<'a> {
    /// The motion from a start.
    ///
    /// # Errors
    /// [`MachineError`] if the start has another number of coordinates, a number that is not finite, or lies beyond a
    /// rigid stop.
    pub fn new(machine: &'a Machine, start: &Start, limits: Limits) -> Result<Self, MachineError> {
        Self::starting(machine, start, limits, None)
    }

    /// The same, with the [state](Event::state) in each event from which the motion goes on after it.
    ///
    /// ```
    /// use vibroimpact::events::{Limits, Motion, Start};
    /// use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
    /// // a damped stop that has opened by force recovers: where it is, is a part of the state
    /// let law = StopLaw::Compliant { stiffness: 3.0, damping: 2.0, preload: 0.0, opening: Opening::Force };
    /// let parts = MachineParts::new(["x"]).with_mass(0, 2.0).with_link(&[1.0], 1.0, 0.0).with_frequency(0.7);
    /// let machine = Machine::new(parts.with_force(0, 1, 0.0, 1.0).with_stop("soft", &[1.0], 0.1, law))?;
    /// let limits = Limits::default();
    /// let events: Vec<_> = Motion::with_states(&machine, &Start::default(), limits)?.take(9).collect();
    /// let state = events[1].state.as_deref().unwrap();
    /// assert!(state.contacts[0].surface > 0.0);
    /// for (again, event) in Motion::new(&machine, state, limits)?.zip(&events[2..]) {
    ///     assert_eq!((again.q, again.qdot, again.phase), (event.q.clone(), event.qdot.clone(), event.phase));
    /// }
    /// # Ok::<(), vibroimpact::machine::MachineError>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_states(machine: &'a Machine, start: &Start, limits: Limits) -> Result<Self, MachineError> {
        Self::starting(machine, start, limits, Some(fingerprint(machine)))
    }

    fn starting(
        machine: &'a Machine,
        start: &Start,
        limits: Limits,
        fingerprint: Option<f64>,
    ) -> Result<Self, MachineError> {
        let normal = Normal::new(machine);
        check_contacts(machine, &start.contacts)?;
        let place = Place::at(machine, &normal, start)?;
        let exact = place.with_all_digits(machine, &normal, start)?;
        let mut motion = Self { limits, fingerprint, ..Self::within(machine, normal, place) };
        match exact {
            Some((place, history)) => motion.go_on(place, history),
            None => motion.begin(&start.contacts)?,
        }
        Ok(motion)
    }

    /// The whole state here, if the motion keeps states.
    fn state(&self) -> Option<Box<Start>> {
        let fingerprint = self.fingerprint?;
        let (instants, last) = (self.instants.clone(), self.struck.clone());
        let history = ImpactHistory { largest: self.largest_impact, instants, last };
        Some(Box::new(self.place.start_after(self.machine, &self.normal, (fingerprint, &history))))
    }

    /// Goes on from a state with all its digits.
    fn go_on(&mut self, place: Place, history: ImpactHistory) {
        self.place = place;
        (self.largest_impact, self.instants, self.struck) = (history.largest, history.instants, history.last);
        // the state is that right after these impacts, whose chatter has not been summed yet
        if !self.struck.is_empty() {
            let turns = self.place.turns(&self.normal);
            self.after_impacts(&turns);
        }
    }

    /// Sums the impacts to which those belong that have just happened, if they accumulate.
    pub(super) fn after_impacts(&mut self, turns: &[(f64, f64)]) {
        let struck = core::mem::take(&mut self.struck);
        self.end_chatter(&struck, turns);
    }

    /// Why there is no further event; `None` while there may be one.
    #[must_use]
    pub fn end(&self) -> Option<End> {
        if self.pending.is_empty() { self.end } else { None }
    }

    /// The time up to which the motion is known.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time.value()
    }

    /// The state up to which the motion is known, after the events that belong to it, without the digits that go on to the last
    /// bit: for a motion of another machine that goes on from there.
    #[must_use]
    pub fn reached(&self) -> Start {
        self.place.numbers(&self.normal)
    }

    /// The same, with its stretches kept.
    pub(super) fn trailed(self) -> Self {
        Self { trail: Some(Vec::new()), ..self }
    }

    /// The stretches since they were last taken.
    pub(super) fn trail(&mut self) -> Vec<Stretch> {
        self.trail.as_mut().map(core::mem::take).unwrap_or_default()
    }

    /// The machine in mass-normalised coordinates.
    pub(crate) const fn normal(&self) -> &Normal {
        &self.normal
    }

    /// Finds out what the stops and joints do at the start.
    fn begin(&mut self, contacts: &[ContactStart]) -> Result<(), MachineError> {
        let turns = self.place.turns(&self.normal);
        let (given, mut closing) = self.give_states(contacts, &turns)?;
        let mut candidates = Vec::new();
        let absent = |at: usize| !given.contains(&at);
        for (j, stop) in self.machine.stops().iter().enumerate().filter(|(j, _)| absent(*j)) {
            let (gap, rate, size, rate_size) = self.place.gap(&self.normal, &turns, j);
            // a gap or a rate that is smaller than its rounding error is zero
            let on = gap.abs() <= 4.0 * f64::EPSILON * size;
            let approaching = rate < -4.0 * f64::EPSILON * rate_size;
            let still = rate.abs() <= 4.0 * f64::EPSILON * rate_size;
            match stop.law {
                StopLaw::Rigid { .. } if gap < 0.0 && !on => {
                    return Err(MachineError::new(format!("stop.{}", stop.name), Fault::Beyond(-gap)));
                }
                // the stop is compressed: it pushes, or it has opened by force and its surface stands back at this
                // depth
                StopLaw::Compliant { opening, .. } if gap < 0.0 && !on => {
                    let pushes = compliant_force(&stop.law, gap, rate).is_some_and(|force| force > 0.0);
                    if opening == Opening::Position || pushes {
                        self.place.states[j] = ContactState::Closed;
                    } else {
                        self.place.surfaces[j] = standing_back(&stop.law, -gap);
                    }
                }
                // on the stop: an impact now, a candidate for rest, or a gap that opens and whose zero here is no event
                _ if on && approaching => closing.push(j),
                _ if on && still => candidates.push(j),
                _ if on => self.place.note(GuardKind::Gap(j), 1),
                _ => {}
            }
        }
        for joint in 0..self.machine.joints().len() {
            let at = self.machine.stops().len() + joint;
            if !absent(at) {
                continue;
            }
            // whether it can hold is decided with the other candidates
            let slides = self.place.slides(self.machine, &self.normal, joint, (4.0 * f64::EPSILON, 0.0));
            if slides.is_none() {
                candidates.push(at);
            }
            self.place.states[at] = slides.unwrap_or(ContactState::Holding);
        }
        // a joint that holds from the start is announced, unless the start says so
        let before = |(at, state): (usize, &ContactState)| match state {
            ContactState::Holding if absent(at) => ContactState::Open,
            _ => *state,
        };
        let before: Vec<ContactState> = self.place.states.iter().enumerate().map(before).collect();
        self.instants.land(&self.place.x, &self.place.v, false);
        self.change(&before, &closing, candidates, &[]);
        // the given states may not be those that the forces allow
        let checked = !given.is_empty() && closing.is_empty() && self.end.is_none();
        if checked { self.check_guards() } else { Ok(()) }
    }

    /// Records the state after an event and the rigid stops that push, with their restitution.
    pub(super) fn record(&mut self, pushed: &[(usize, f64)]) {
        if let Some(passage) = &mut self.passage {
            passage.pushed = pushed.to_vec();
            passage.rounds.clear();
            passage.after = Some(self.place.clone());
        }
    }

    pub(super) fn announce(&mut self, kind: EventKind, place: usize, speed: f64, with: Vec<usize>) {
        let state = self.state();
        self.pending.push_back(Event {
            kind,
            place,
            time: self.time.value(),
            phase: self.place.phase,
            speed,
            q: self.normal.to_machine(&self.place.x),
            qdot: self.normal.to_machine(&self.place.v),
            with,
            tie: self.tie && kind == EventKind::Impact,
            state,
        });
    }

    /// Moves the state to a time after the beginning of a flight.
    pub(super) fn move_to(&mut self, flight: &MachineFlight, s: f64) {
        if let Some(trail) = self.trail.as_mut().filter(|_| s > 0.0) {
            let (begin, place, flight) = (self.time, self.place.clone(), flight.clone());
            follow(trail, Stretch { begin, duration: s, place, flight });
        }
        let modes = self.buffers.modes_at(flight, s);
        self.place.move_along(flight, (modes, s), self.machine.parts().frequency);
        let before = self.time.value();
        // a flight can be so short that the time, as a number, stays: only then does the crowd of events grow
        self.time += s;
        if self.time.value() > before {
            self.crowd = 0;
        }
    }

    /// Follows the motion by one step: to its next event, or to the time at which a surface has come back to its holder.
    /// The events of the step follow from the iterator. `None` at the end of the motion.
    pub(crate) fn step(&mut self) -> Option<Passage> {
        self.recording = true;
        if self.end.is_some() {
            return None;
        }
        self.advance();
        self.passage.take()
    }

    /// The motion from a state in which all stops and joints have their states already.
    pub(crate) fn resumed(machine: &'a Machine, normal: Normal, structures: Structures, place: Place) -> Self {
        Self { structures, ..Self::within(machine, normal, place) }
    }

    /// The same motion without a search for events later than this after the beginning of a flight.
    pub(crate) fn limited(self, time: f64) -> Self {
        Self { limits: Limits { time, ..self.limits }, ..self }
    }

    fn within(machine: &'a Machine, normal: Normal, place: Place) -> Self {
        Self {
            machine,
            normal,
            structures: Structures::default(),
            place,
            time: Wide::default(),
            limits: Limits::default(),
            pending: VecDeque::new(),
            end: None,
            buffers: Buffers::default(),
            touches: Vec::new(),
            spare: [None, None],
            scratch: Scratch::default(),
            tie: false,
            silenced: false,
            crowd: 0,
            instants: Instants::default(),
            largest_impact: 0.0,
            fingerprint: None,
            struck: Vec::new(),
            passage: None,
            recording: false,
            trail: None,
        }
    }

    /// The events of the steps so far that have not been taken.
    pub(crate) fn take_events(&mut self) -> Vec<Event> {
        self.pending.drain(..).collect()
    }

    /// The structures of all regimes visited so far.
    pub(crate) const fn structures(&self) -> &Structures {
        &self.structures
    }

    /// The present state.
    pub(crate) const fn place(&self) -> &Place {
        &self.place
    }
}

impl Iterator for Motion<'_> {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        loop {
            if let Some(event) = self.pending.pop_front() {
                return Some(event);
            }
            if self.end.is_some() {
                return None;
            }
            self.advance();
        }
    }
}
