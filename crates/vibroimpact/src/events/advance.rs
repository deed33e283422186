//! One step of a motion: from one event, or from the change of a guard, to the next.

use super::event::{End, EventKind};
use super::motion::Motion;
use super::passage::Passage;
use crate::arc::{Found, MachineFlight, first_event};
use crate::regime::{ContactState, GuardKind, compliant};

/// What a stop does whose gap is zero.
pub(super) enum Approach {
    /// It is struck.
    Strikes,
    /// It is touched with a velocity that is a rounding error.
    Touches(f64),
    /// It is left: the gap was zero by a rounding error.
    Leaves,
}

/// An impact is none if its speed is below this part of the velocities of late.
pub(super) const FAINT: f64 = 64.0 * f64::EPSILON;
/// More events than this at one time are those of contacts that take no time.
const SEVERAL: u32 = 2;
/// After more events at one time than impacts that are summed can have, rounding errors decide them.
const STALLED: u32 = 300;
/// More events than this at one time are a collapse.
const CROWD: u32 = 10_000;
/// The number of windows of a flight after which it is asked whether there is an event at all.
const PATIENCE: u32 = 512;

impl Motion<'_> {
    /// Follows the motion to its next event.
    pub(super) fn advance(&mut self) {
        if self.instants.are_close() {
            self.note_stops_just_left();
        }
        let Some(flight) = self.fly() else { return self.end = Some(End::Inconsistent) };
        let recovered = self.recovery();
        let until = recovered.min(self.limits.time);
        (self.buffers.square, self.buffers.longest) = (self.instants.square(), self.instants.longest());
        self.buffers.stalled = self.crowd > STALLED;
        // few windows first: most flights end within them, and of the others it is asked whether they end at all
        let mut found = self.first_event(&flight, until, self.limits.steps.min(PATIENCE));
        let never = match found {
            Found::NoneBefore(s) => self.search_on(&flight, (s, until), recovered.is_finite(), &mut found),
            Found::Zero { .. } => false,
        };
        self.announce_touches(&flight);
        self.passage = None;
        if self.recording {
            let duration = match &found {
                Found::NoneBefore(s) if *s >= until && recovered <= self.limits.time => recovered,
                Found::NoneBefore(s) | Found::Zero { s, .. } => *s,
            };
            self.passage = Some(Passage::new(flight.structure.clone(), duration));
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
            Found::Zero { s, guards } => self.arrive(&flight, *s, guards),
        }
        // its memory is used again two flights later
        self.spare[0] = Some(flight);
    }

    /// The time after which the first surface that stands back reaches its holder: it changes its guard without an event.
    fn recovery(&self) -> f64 {
        // without an offset a surface comes back in the limit only
        let standing = self.place.surfaces.iter().flatten().filter(|surface| surface.offset > 0.0);
        let times = standing.map(|surface| crate::math::ln(surface.size / surface.offset) / surface.rate);
        times.fold(f64::INFINITY, f64::min)
    }

    /// The first event of a flight in so many windows.
    #[inline(always)] // a copy of the result costs as much as all else here
    fn first_event(&mut self, flight: &MachineFlight, until: f64, steps: u32) -> Found {
        self.touches.clear();
        first_event(flight, until, steps, &mut self.buffers, &mut self.touches)
    }

    /// Goes on with a flight that has no event before a time `s`: in all windows if it is not shown that there is none ever. Returns
    /// whether this is shown; then the closed form holds as long as it is wanted.
    #[inline(never)]
    fn search_on(&mut self, flight: &MachineFlight, (s, until): (f64, f64), recovers: bool, found: &mut Found) -> bool {
        let never =
            |motion: &mut Self, s: f64| !recovers && flight.never_after(s, &motion.normal, &mut motion.buffers.modes);
        let mut is_free = never(self, s);
        if !is_free && s < until && self.limits.steps > PATIENCE {
            *found = self.first_event(flight, until, self.limits.steps);
            if let Found::NoneBefore(s) = *found {
                is_free = never(self, s);
            }
        }
        if is_free {
            *found = Found::NoneBefore(until);
        }
        is_free
    }

    /// Announces where gaps touch zero on the way; the flight of the motion goes on.
    fn announce_touches(&mut self, flight: &MachineFlight) {
        for k in 0..self.touches.len() {
            let touch = self.touches[k];
            if let GuardKind::Gap(j) = flight.structure.guards[touch.guard].kind {
                let (place, time) = (self.place.clone(), self.time);
                self.move_to(flight, touch.s);
                // a flight that begins here begins on the stop without speed
                self.place.note(GuardKind::Gap(j), 2);
                self.announce(EventKind::Graze, j, 0.0, Vec::new());
                (self.place, self.time) = (place, time);
            }
        }
    }

    /// Goes to the zero of guards, and does what happens there.
    fn arrive(&mut self, flight: &MachineFlight, s: f64, guards: &[usize]) {
        self.move_to(flight, s);
        self.crowd += 1;
        self.instants.pass(s);
        let exact = guards.iter().all(|g| flight.begins_exactly(*g));
        self.instants.land(&self.place.x, &self.place.v, exact);
        if self.crowd > CROWD {
            self.end = Some(End::Collapse);
            return;
        }
        let kept = |g: usize| {
            matches!(flight.structure.guards[g].kind, GuardKind::Gap(_))
                && flight.begins_exactly(g)
                && !guards.contains(&g)
        };
        if self.instants.are_close() && (0..flight.structure.guards.len()).any(kept) {
            let modes = self.buffers.modes_with_errors(flight, s);
            self.place.keep_gaps(&self.normal, flight, (modes, guards));
        }
        let timing = self.passage.is_some().then(|| self.timing(flight, guards));
        if let (Some(passage), Some(timing)) = (&mut self.passage, timing) {
            passage.guards = timing;
            passage.before = Some(self.place.clone());
        }
        let structure = &flight.structure;
        let kind = |g: &usize| structure.guards[*g].kind;
        let fastest = structure.fastest();
        match guards {
            [g] => self.happen(&[kind(g)], fastest),
            all => self.happen(&all.iter().map(kind).collect::<Vec<_>>(), fastest),
        }
        if self.recording {
            self.time_by_others(flight, fastest);
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
                || self.place.sharp_gap(j).is_some()
            {
                continue;
            }
            let (gap, rate, size, rate_size) = self.place.gap(&self.normal, &turns, j);
            if gap.abs() <= 4.0 * f64::EPSILON * size && rate > 4.0 * f64::EPSILON * rate_size {
                self.place.note(kind, 1);
            }
        }
    }

    /// The flight from here, in the memory of an earlier one; `None` if its constraints depend on each other.
    fn fly(&mut self) -> Option<Box<MachineFlight>> {
        // the memory of the last flight in this regime, if it is one of the last two
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
        // most events: one impact, with nothing that rests, holds or slides
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
        self.normal.move_beside(&before, &gaps, &mut self.place.x);
        self.normal.move_beside(&before, &rates, &mut self.place.v);
        self.change(&before, &closing, candidates, &ended);
    }
}
