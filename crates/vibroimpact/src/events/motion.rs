//! The motion of a machine as an iterator over its events.

use super::event::{ContactStart, End, Event, EventKind, Limits, Start};
use super::instants::Instants;
use super::passage::Passage;
use super::place::{Place, Scratch, Structures, standing_back};
use super::resolve::{Resolution, Resolved};
use super::state::{ImpactHistory, check_contacts, fingerprint};
use super::stretch::{Stretch, follow};
use crate::arc::{Buffers, Found, MachineFlight, Touch, first_event};
use crate::machine::{Fault, Machine, MachineError, Opening, StopLaw};
use crate::math::Wide;
use crate::regime::{ContactState, GuardKind, Normal, compliant};
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
    time: Wide,
    pub(super) limits: Limits,
    pending: VecDeque<Event>,
    end: Option<End>,
    pub(super) buffers: Buffers,
    touches: Vec<Touch>,
    /// The last flights in two regimes, between which most motions alternate: their memory is used again.
    spare: [Option<Box<MachineFlight>>; 2],
    pub(super) scratch: Scratch,
    /// Whether the outcome of the last impacts depends on an order that is below rounding.
    pub(super) tie: bool,
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
    recording: bool,
    /// What it did since the last event, if someone looks.
    trail: Option<Vec<Stretch>>,
}

/// What a stop does whose gap is zero.
pub(super) enum Approach {
    /// It is struck.
    Strikes,
    /// It is touched with a velocity that is a rounding error.
    Touches(f64),
    /// It is left: the gap was zero by a rounding error.
    Leaves,
}

/// A gap or a rate below this part of its terms is zero within rounding.
const ROUNDED: f64 = 64.0 * f64::EPSILON;
/// An impact is none if its speed is below this part of the velocities of late.
const FAINT: f64 = 64.0 * f64::EPSILON;
/// More events than this at one time are those of contacts that take no time.
const SEVERAL: u32 = 2;
/// After more events at one time than impacts that are summed can have, rounding errors decide them.
const STALLED: u32 = 300;
/// More events than this at one time are a collapse.
const CROWD: u32 = 10_000;
/// The number of windows of a flight after which it is asked whether there is an event at all.
const PATIENCE: u32 = 512;

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
        if !self.struck.is_empty() {
            let turns = self.place.turns(&self.normal);
            self.after_impacts(&turns);
        }
    }

    /// Sums the impacts to which those belong that have just happened, if they accumulate.
    fn after_impacts(&mut self, turns: &[(f64, f64)]) {
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
            let on = gap.abs() <= 4.0 * f64::EPSILON * size;
            let approaching = rate < -4.0 * f64::EPSILON * rate_size;
            let still = rate.abs() <= 4.0 * f64::EPSILON * rate_size;
            match stop.law {
                StopLaw::Rigid { .. } if gap < 0.0 && !on => {
                    return Err(MachineError::new(format!("stop.{}", stop.name), Fault::Beyond(-gap)));
                }
                StopLaw::Compliant { stiffness, damping, preload, opening } if gap < 0.0 && !on => {
                    let force = preload - stiffness * gap - damping * rate;
                    if opening == Opening::Position || force > 0.0 {
                        self.place.states[j] = ContactState::Closed;
                    } else {
                        self.place.surfaces[j] = standing_back(&stop.law, -gap);
                    }
                }
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
            let (speed, size) = self.place.sliding(self.machine, &self.normal, joint);
            if speed.abs() <= 4.0 * f64::EPSILON * size {
                candidates.push(at);
                self.place.states[at] = ContactState::Holding;
            } else {
                self.place.states[at] = if speed > 0.0 { ContactState::Forward } else { ContactState::Backward };
            }
        }
        // a joint that holds from the start is announced, unless the start says so
        let before = |(at, state): (usize, &ContactState)| match state {
            ContactState::Holding if absent(at) => ContactState::Open,
            _ => *state,
        };
        let before: Vec<ContactState> = self.place.states.iter().enumerate().map(before).collect();
        self.instants.land(&self.place.x, &self.place.v);
        self.change(&before, &closing, candidates, &[]);
        let checked = !given.is_empty() && closing.is_empty() && self.end.is_none();
        if checked { self.check_guards() } else { Ok(()) }
    }

    /// Changes the contacts at this time, all at once: impacts on the stops `closing`, then the states of the candidates,
    /// which are closed without velocity; the forces of those in `ended` have reached their limits. The motion ends if no
    /// state of the contacts is consistent.
    fn change(&mut self, before: &[ContactState], closing: &[usize], candidates: Vec<usize>, ended: &[usize]) {
        if self.changed(before, closing, candidates, ended).is_none() {
            self.end = Some(End::Inconsistent);
        }
    }

    fn changed(
        &mut self,
        before: &[ContactState],
        closing: &[usize],
        mut candidates: Vec<usize>,
        ended: &[usize],
    ) -> Option<()> {
        let turns = self.place.turns(&self.normal);
        let speed = |place: &Place, stop: usize| (-place.gap(&self.normal, &turns, stop).1).max(0.0);
        let speeds: Vec<f64> = (0..self.machine.stops().len()).map(|j| speed(&self.place, j)).collect();
        let (rigid, soft): (Vec<usize>, Vec<usize>) =
            closing.iter().partition(|j| compliant(&self.machine.stops()[**j].law).is_none());
        let mut events: Vec<(EventKind, usize, f64, Vec<usize>)> = Vec::new();
        let sizes = (!rigid.is_empty()).then(|| self.rate_sizes());
        if let Some(sizes) = &sizes {
            self.largest_impact = rigid.iter().fold(self.largest_impact, |most, j| most.max(speeds[*j]));
            let pushed = self.strike(&rigid, (&speeds, sizes), &mut candidates)?;
            for j in self.distinct(&rigid, &pushed) {
                let others = rigid.iter().chain(pushed.iter().filter(|other| !rigid.contains(other)));
                let with = others.copied().filter(|other| *other != j).collect();
                events.push((EventKind::Impact, j, speeds[j], with));
            }
        }
        self.meet(&soft, before, sizes.as_deref(), &turns, &mut candidates);
        self.instants.silence(&mut self.place.x, &mut self.place.v, 1);
        self.touch_faintly(&soft, &turns, &mut candidates);
        // a force that jumps can end any rest
        for (at, state) in self.place.states.iter().enumerate() {
            if state.constrains() && !candidates.contains(&at) {
                candidates.push(at);
            }
        }
        // a preload that presses at depth zero is no constraint, and ends like one
        for (j, stop) in self.machine.stops().iter().enumerate() {
            if self.place.states[j] == ContactState::Closed
                && compliant(&stop.law).is_some_and(|(_, _, preload)| preload > 0.0)
                && !candidates.contains(&j)
            {
                let (gap, rate, size, rate_size) = self.place.gap(&self.normal, &turns, j);
                if gap.abs() <= ROUNDED * size && rate.abs() <= ROUNDED * rate_size && before[j] == ContactState::Closed
                {
                    candidates.push(j);
                }
            }
        }
        // a joint that others hold although its force is that of sliding can hold as well
        for joint in 0..self.machine.joints().len() {
            let at = self.machine.stops().len() + joint;
            if !self.place.states[at].constrains() && !candidates.contains(&at) {
                let (speed, size) = self.place.sliding(self.machine, &self.normal, joint);
                if speed.abs() <= ROUNDED * size {
                    candidates.push(at);
                }
            }
        }
        candidates.sort_unstable();
        if !candidates.is_empty() {
            let (machine, normal, place) = (self.machine, &self.normal, &self.place);
            let all =
                Resolution { machine, normal, structures: &mut self.structures, place, candidates: &candidates, ended };
            let Resolved { states, known } = all.resolve()?;
            self.place.states = states;
            for (kind, count) in known {
                self.place.note(kind, count);
            }
        }
        for (at, was) in before.iter().enumerate() {
            let now = self.place.states[at];
            if now == *was || rigid.contains(&at) && now == ContactState::Open {
                continue;
            }
            let kind = match (was, now) {
                // a contact without force at the start has nothing to announce
                (ContactState::Open, ContactState::Touching) if !closing.contains(&at) => continue,
                (ContactState::Open | ContactState::Touching, ContactState::Resting)
                | (ContactState::Closed, ContactState::Resting | ContactState::Touching)
                | (ContactState::Open, ContactState::Touching) => EventKind::Stick,
                (ContactState::Resting | ContactState::Touching, ContactState::Open)
                | (ContactState::Resting, ContactState::Touching) => EventKind::Release,
                (_, ContactState::Closed) => EventKind::Close,
                (ContactState::Closed, ContactState::Open) => EventKind::Open,
                (_, ContactState::Holding) => EventKind::Hold,
                // joints that slide at the start are not announced
                (ContactState::Open, _) => continue,
                _ => EventKind::Slip,
            };
            let speed = match now {
                ContactState::Closed if closing.contains(&at) => speeds[at],
                // a stop that was not about to close is pushed shut by an impact elsewhere
                ContactState::Closed => (-self.place.gap(&self.normal, &turns, at).1).max(0.0),
                ContactState::Open if kind == EventKind::Open => self.place.gap(&self.normal, &turns, at).1.max(0.0),
                ContactState::Forward => 1.0,
                ContactState::Backward => -1.0,
                _ => 0.0,
            };
            events.push((kind, at, speed, Vec::new()));
        }
        let open = |j: &usize| self.place.states[*j] == ContactState::Open;
        self.struck = rigid.into_iter().filter(open).map(|j| (j, speeds[j])).collect();
        for (kind, at, speed, _) in &events {
            self.instants.keep(*kind, *at, *speed);
        }
        for (kind, at, speed, with) in events {
            self.announce(kind, at, speed, with);
        }
        self.tie = false;
        if let Some(passage) = &mut self.passage {
            passage.after = Some(self.place.clone());
        }
        if !self.struck.is_empty() {
            self.after_impacts(&turns);
        }
        Some(())
    }

    /// Makes touches of the closures of compliant stops that are rounding errors: of a motion that has ended, or of one in which both
    /// sides of a stop without a preload go on together.
    fn touch_faintly(&mut self, soft: &[usize], turns: &[(f64, f64)], candidates: &mut Vec<usize>) {
        let mut rates = Vec::new();
        for j in soft.iter().copied().filter(|j| !candidates.contains(j)) {
            let (_, rate, _, size) = self.place.gap(&self.normal, turns, j);
            let along = (&self.normal.directions[j][..], self.normal.squares[j]);
            let loaded = compliant(&self.machine.stops()[j].law).is_some_and(|(_, _, preload)| preload > 0.0);
            let faint = size == 0.0 || !loaded && self.instants.is_faint(rate, along, FAINT);
            if faint && self.place.known.contains(&(GuardKind::Depth(j), 1)) {
                rates.push((j, rate));
            }
        }
        self.normal.move_by(&rates, &mut self.place.v);
        for (j, _) in rates {
            self.place.known.retain(|(kind, _)| *kind != GuardKind::Depth(j));
            self.place.states[j] = ContactState::Open;
            candidates.push(j);
        }
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

    /// The flight from here, in the memory of an earlier one; `None` if its constraints depend on each other.
    fn fly(&mut self) -> Option<Box<MachineFlight>> {
        if !matches!(&self.spare[0], Some(last) if last.structure.is_in(&self.place.states)) {
            self.spare.swap(0, 1);
        }
        let spare = self.spare[0].take();
        let structure = match &spare {
            Some(flight) if flight.structure.is_in(&self.place.states) => None,
            _ => Some(self.structures.get(self.machine, &self.normal, &self.place.states)?),
        };
        match (spare, structure) {
            (Some(mut flight), structure) => {
                self.place.fly(&self.normal, structure, &mut flight, &mut self.scratch);
                Some(flight)
            }
            (None, structure) => Some(Box::new(self.place.flight(&self.normal, structure?))),
        }
    }

    /// Notes that the gaps of stops are zero which are left faster than by rounding and are within it: after a short flight a gap
    /// can be smaller than the coordinates tell.
    fn note_stops_just_left(&mut self) {
        let turns = self.place.turns(&self.normal);
        for j in 0..self.machine.stops().len() {
            let kind = GuardKind::Gap(j);
            if self.place.states[j] != ContactState::Open
                || self.place.surfaces[j].is_some()
                || self.place.known.iter().any(|(known, _)| *known == kind)
            {
                continue;
            }
            let (gap, rate, size, rate_size) = self.place.gap(&self.normal, &turns, j);
            if gap.abs() <= 4.0 * f64::EPSILON * size && rate > 4.0 * f64::EPSILON * rate_size {
                self.place.note(kind, 1);
            }
        }
    }

    /// Follows the motion to its next event.
    fn advance(&mut self) {
        if self.instants.are_close() {
            self.note_stops_just_left();
        }
        let Some(flight) = self.fly() else { return self.end = Some(End::Inconsistent) };
        let structure = &flight.structure;
        // the first surface that reaches its holder changes its guard without an event
        let recovered = self
            .place
            .surfaces
            .iter()
            .flatten()
            .filter(|surface| surface.offset > 0.0)
            .map(|surface| crate::math::ln(surface.size / surface.offset) / surface.rate);
        let recovered = recovered.fold(f64::INFINITY, f64::min);
        let until = recovered.min(self.limits.time);
        self.touches.clear();
        let steps = self.limits.steps.min(PATIENCE);
        (self.buffers.square, self.buffers.longest) = (self.instants.square(), self.instants.longest());
        self.buffers.stalled = self.crowd > STALLED;
        let mut found = first_event(&flight, until, steps, &mut self.buffers, &mut self.touches);
        let mut never = false;
        if let Found::NoneBefore(s) = found {
            // a long flight: is there an event at all?
            never = !recovered.is_finite() && flight.never_after(s, &self.normal, &mut self.buffers.modes);
            if !never && s < until && self.limits.steps > PATIENCE {
                self.touches.clear();
                found = first_event(&flight, until, self.limits.steps, &mut self.buffers, &mut self.touches);
                if let Found::NoneBefore(s) = found {
                    never = !recovered.is_finite() && flight.never_after(s, &self.normal, &mut self.buffers.modes);
                }
            }
        }
        if never {
            // the closed form holds as long as it is wanted
            found = Found::NoneBefore(until);
        }
        for k in 0..self.touches.len() {
            let touch = self.touches[k];
            if let GuardKind::Gap(j) = structure.guards[touch.guard].kind {
                let (place, time) = (self.place.clone(), self.time);
                self.move_to(&flight, touch.s);
                // the flight of the motion goes on; one that begins here begins on the stop without speed
                self.place.note(GuardKind::Gap(j), 2);
                self.announce(EventKind::Graze, j, 0.0, Vec::new());
                (self.place, self.time) = (place, time);
            }
        }
        self.passage = None;
        if self.recording {
            let duration = match &found {
                Found::NoneBefore(s) if *s >= until && recovered <= self.limits.time => recovered,
                Found::NoneBefore(s) | Found::Zero { s, .. } => *s,
            };
            self.passage = Some(Passage::new(structure.clone(), duration));
        }
        match &found {
            Found::NoneBefore(s) if *s >= until && recovered <= self.limits.time => {
                self.move_to(&flight, recovered);
                self.instants.pass(recovered);
            }
            Found::NoneBefore(s) => {
                self.move_to(&flight, *s);
                self.end = Some(match never {
                    true if self.place.states.contains(&ContactState::Resting) => End::Stuck,
                    true => End::Never,
                    false if *s >= until => End::NoEventWithin,
                    false => End::SearchLimit,
                });
            }
            Found::Zero { s, guards } => {
                self.move_to(&flight, *s);
                self.crowd += 1;
                self.instants.pass(*s);
                self.instants.land(&self.place.x, &self.place.v);
                if self.crowd > CROWD {
                    return self.end = Some(End::Collapse);
                }
                if let Some(passage) = &mut self.passage {
                    passage.guards = guards.to_vec();
                    passage.before = Some(self.place.clone());
                }
                let kind = |g: &usize| structure.guards[*g].kind;
                let fastest = structure.fastest();
                match &guards[..] {
                    [g] => self.happen(&[kind(g)], fastest),
                    all => self.happen(&all.iter().map(kind).collect::<Vec<_>>(), fastest),
                }
            }
        }
        self.spare[0] = Some(flight);
    }

    /// How a gap that is zero closes with this rate.
    #[inline(always)]
    pub(super) fn approach(&self, j: usize, rate: f64) -> Approach {
        // a preloaded stop is touched only where its contacts take no time
        let touched = match compliant(&self.machine.stops()[j].law) {
            None => true,
            Some((_, _, preload)) => preload > 0.0 && self.crowd > SEVERAL,
        };
        if self.place.surfaces[j].is_some() || rate < 0.0 && !touched {
            return Approach::Strikes;
        }
        match self.instants.is_faint(rate, (&self.normal.directions[j], self.normal.squares[j]), FAINT) {
            true if touched => Approach::Touches(rate),
            false if rate > 0.0 => Approach::Leaves,
            _ => Approach::Strikes,
        }
    }

    /// What follows when these guards of a structure of this rate are zero.
    fn happen(&mut self, kinds: &[GuardKind], fastest: f64) {
        if let [kind] = *kinds
            && self.machine.joints().is_empty()
            && !self.place.states.iter().any(|state| state.constrains())
            && self.happen_alone(kind, fastest)
        {
            return;
        }
        let stops = self.machine.stops().len();
        let before = self.place.states.clone();
        let turns = self.place.turns(&self.normal);
        let (mut closing, mut candidates, mut ended) = (Vec::new(), Vec::new(), Vec::new());
        let (mut gaps, mut rates) = (Vec::new(), Vec::new());
        for kind in kinds {
            match *kind {
                GuardKind::Gap(j) => {
                    let (gap, rate, ..) = self.place.gap(&self.normal, &turns, j);
                    if self.place.surfaces[j].is_none() {
                        gaps.push((j, gap));
                    }
                    match self.approach(j, rate) {
                        Approach::Strikes => closing.push(j),
                        Approach::Touches(rate) => {
                            rates.push((j, rate));
                            candidates.push(j);
                        }
                        Approach::Leaves => self.place.note(*kind, 1),
                    }
                }
                GuardKind::Depth(j) | GuardKind::Force(j) => {
                    if self.place.states[j] == ContactState::Closed {
                        let here = self.place.gap_and_rate(&self.normal, &turns, j);
                        self.place.open(&self.machine.stops()[j].law, *kind, j, here);
                    }
                }
                GuardKind::Sliding(joint) => {
                    let (speed, _) = self.place.sliding(self.machine, &self.normal, joint);
                    rates.push((stops + joint, -speed));
                    candidates.push(stops + joint);
                }
                // the force of a constraint has reached its limit: what follows is decided with all others
                GuardKind::Reaction(_)
                | GuardKind::Preload(_)
                | GuardKind::LimitForward(_)
                | GuardKind::LimitBackward(_) => ended.push(kind.place(stops)),
            }
        }
        // on the stops exactly, without the rounding error of the time
        self.normal.move_by(&gaps, &mut self.place.x);
        self.normal.move_by(&rates, &mut self.place.v);
        self.change(&before, &closing, candidates, &ended);
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
