//! Which stops rest and which joints hold: the contacts that are closed without closing velocity, decided by reactions
//! and accelerations.
//!
//! Each state of a contact holds as long as a function is not negative: the reaction of a stop at rest, what is missing to
//! the limit of a joint that holds, the gap of a stop that opens, the velocity of a joint that slides. At the beginning of a
//! flight the first derivative of it that is not zero within rounding decides, from the value on. All conditions hold
//! together. The search begins with all contacts at rest and changes the state that is violated most, until none is; should
//! it come back to where it was, all combinations are tried, those with most constraints first.
//!
//! Then a contact whose force is zero for the whole flight *touches*: equal bodies under equal forces move on together, and
//! a third support of a bar has nothing to bear. It has no condition, so that rounding errors of zero decide nothing.

use super::place::{Place, Structures};
use crate::arc::{FIRST_ORDERS, IDLE, MachineFlight, ORDERS};
use crate::machine::Machine;
use crate::math::sort_by_key;
use crate::regime::{ContactState, GuardKind, Normal, Observable, bearing, compliant};

/// Rounding errors of reactions, accelerations and their rates, relative to their terms.
const SMALL: f64 = 1e-11;
/// Combinations that are tried at most when the search has no end.
const COMBINATIONS: usize = 20_000;

/// The states of all contacts, and how many derivatives of the guards of those that were decided are zero.
pub(super) struct Resolved {
    pub(super) states: Vec<ContactState>,
    pub(super) known: Vec<(GuardKind, usize)>,
}

/// A condition that does not hold: the derivative that violates it, by how much relative to its terms, and the state to try
/// instead.
#[derive(Clone, Copy)]
struct Violation {
    order: usize,
    amount: f64,
    instead: ContactState,
}

impl Violation {
    /// Whether it weighs more than another one: a lower derivative first.
    fn exceeds(&self, other: &Self) -> bool {
        self.order < other.order || self.order == other.order && self.amount > other.amount
    }
}

/// The contacts to decide: stops, and joints counted after them, that are closed without velocity.
pub(super) struct Resolution<'a> {
    pub(super) machine: &'a Machine,
    pub(super) normal: &'a Normal,
    pub(super) structures: &'a mut Structures,
    pub(super) place: &'a Place,
    pub(super) candidates: &'a [usize],
    /// Those of them whose force has just reached its limit.
    pub(super) ended: &'a [usize],
}

/// What a combination of states of the candidates amounts to.
struct Trial {
    flight: MachineFlight,
    /// The worst violation, with its candidate.
    worst: Option<(Violation, usize)>,
    /// For each candidate the order of the first derivative that is not zero.
    orders: Vec<usize>,
    /// The forces of constraints that begin at a limit, with this order.
    limits: Vec<(GuardKind, usize)>,
}

impl Resolution<'_> {
    /// The states of the candidates; `None` if no combination is consistent.
    pub(super) fn resolve(mut self) -> Option<Resolved> {
        let mut states: Vec<ContactState> = self.candidates.iter().map(|at| self.first_state(*at)).collect();
        let mut tried: Vec<Vec<ContactState>> = Vec::new();
        let (trial, states) = loop {
            let trial = self.attempt(&states);
            let Some((violation, k)) = trial.as_ref().and_then(|trial| trial.worst) else {
                break match trial {
                    Some(trial) => (trial, states),
                    None => self.enumerated()?,
                };
            };
            tried.push(states.clone());
            states[k] = violation.instead;
            // it goes round in a circle
            if tried.contains(&states) {
                break self.enumerated()?;
            }
        };
        Some(self.with_touches(trial, states))
    }

    /// The state with most constraints that a contact can have.
    fn first_state(&self, at: usize) -> ContactState {
        if at >= self.machine.stops().len() {
            return ContactState::Holding;
        }
        // without preload it yields to any force and cannot rest
        let soft = compliant(&self.machine.stops()[at].law).is_some_and(|(_, _, preload)| preload == 0.0);
        if soft { ContactState::Open } else { ContactState::Resting }
    }

    /// All contacts with these states of the candidates. Stops at rest that others hold already touch.
    fn states(&self, of: &[ContactState]) -> Vec<ContactState> {
        let mut states = self.place.states.clone();
        self.candidates.iter().zip(of).for_each(|(at, state)| states[*at] = *state);
        let (closed, bearing) = bearing(self.machine, self.normal, &states, |_| false);
        for at in closed.iter().filter(|at| !bearing.contains(at)) {
            if states[*at] == ContactState::Resting {
                states[*at] = ContactState::Touching;
            }
        }
        states
    }

    fn attempt(&mut self, of: &[ContactState]) -> Option<Trial> {
        let states = self.states(of);
        let structure = self.structures.get(self.machine, self.normal, &states)?;
        let there = Place { states, known: Vec::new(), ..self.place.clone() };
        let flight = there.flight(self.normal, structure);
        let (mut worst, mut orders, mut limits) = (None, Vec::with_capacity(of.len()), Vec::new());
        for (k, at) in self.candidates.iter().enumerate() {
            let (order, violation) = self.check(&flight, *at, there.states[*at], &mut limits);
            orders.push(order);
            if let Some(violation) = violation
                && worst.as_ref().is_none_or(|(other, _)| violation.exceeds(other))
            {
                worst = Some((violation, k));
            }
        }
        Some(Trial { flight, worst, orders, limits })
    }

    /// The order of the first derivative that is not zero of the condition of a contact, and its violation.
    /// `limits` receives the forces that begin at a limit.
    fn check(
        &self,
        flight: &MachineFlight,
        at: usize,
        state: ContactState,
        limits: &mut Vec<(GuardKind, usize)>,
    ) -> (usize, Option<Violation>) {
        let structure = &flight.structure;
        // of a stop it is not used
        let joint = at.wrapping_sub(self.machine.stops().len());
        // at least zero: a multiple of a function and a constant
        let condition = |of: &Observable, (sign, constant): (f64, f64), from: usize, instead: ContactState| {
            let (order, value) = first_derivative(flight, of, (sign, constant), from);
            // a hold that begins at its limit ends with an event of its own, but where others end it does not begin
            let begins = from == 0 && order > 0 && self.ended.is_empty() && state == ContactState::Holding;
            let value = if begins { value.max(0.0) } else { value };
            (order, (value < 0.0).then_some(Violation { order, amount: -value, instead }))
        };
        let mut limit = |kind: GuardKind, of: (usize, Option<Violation>)| {
            // the force is at its limit now and leaves it later, a guard that begins at zero, or stays there
            if of.0 > 0 && of.0 < ORDERS {
                limits.push((kind, of.0));
            } else if of.0 == ORDERS {
                let held = structure.held.iter().position(|held| *held == at);
                if held.is_some_and(|held| flight.presses_evenly(self.normal, held)) {
                    limits.push((kind, IDLE));
                }
            }
            of
        };
        let two = |one: (usize, Option<Violation>), other: (usize, Option<Violation>)| {
            if one.1.is_some() { one } else { (one.0.min(other.0), other.1) }
        };
        match state {
            ContactState::Resting => {
                let Some(held) = structure.held.iter().position(|held| *held == at) else { return (ORDERS, None) };
                if flight.presses_never(self.normal, held) {
                    return (ORDERS, None);
                }
                let (reaction, shared) = (&structure.reactions[held], structure.shared[held]);
                let pushes = limit(GuardKind::Reaction(at), condition(reaction, (1.0, shared), 0, ContactState::Open));
                match compliant(&self.machine.stops()[at].law) {
                    Some((_, _, preload)) => {
                        let yields = condition(reaction, (-1.0, preload + shared), 0, ContactState::Closed);
                        two(pushes, limit(GuardKind::Preload(at), yields))
                    }
                    None => pushes,
                }
            }
            ContactState::Holding => {
                let Some((reaction, shared)) = structure.reaction(at) else {
                    // other constraints move it, and it holds only if they do not
                    let sliding = structure.sliding(self.machine, self.normal, joint);
                    if flight.slides_never(self.normal, (at, &sliding)) {
                        return (ORDERS, None);
                    }
                    let forward = condition(&sliding, (-1.0, 0.0), 1, ContactState::Forward);
                    return two(forward, condition(&sliding, (1.0, 0.0), 1, ContactState::Backward));
                };
                let most = self.machine.joints()[joint].limit + shared;
                let forward = condition(reaction, (-1.0, most), 0, ContactState::Forward);
                let backward = condition(reaction, (1.0, most), 0, ContactState::Backward);
                two(limit(GuardKind::LimitForward(joint), forward), limit(GuardKind::LimitBackward(joint), backward))
            }
            ContactState::Open | ContactState::Closed | ContactState::Touching
                if flight.opens_never(self.normal, at) =>
            {
                (ORDERS, None)
            }
            // other constraints move it, and it stays closed only if they do not
            ContactState::Touching => {
                let (gap, _) = structure.gap(self.normal, at);
                let opens = condition(&gap, (-1.0, 0.0), 2, ContactState::Open);
                two(opens, condition(&gap, (1.0, 0.0), 2, ContactState::Open))
            }
            ContactState::Open => {
                let preloaded = compliant(&self.machine.stops()[at].law).is_none_or(|(_, _, preload)| preload > 0.0);
                let instead = if preloaded { ContactState::Resting } else { ContactState::Closed };
                condition(&structure.gap(self.normal, at).0, (1.0, 0.0), 2, instead)
            }
            ContactState::Closed => {
                let preloaded = compliant(&self.machine.stops()[at].law).is_some_and(|(_, _, preload)| preload > 0.0);
                let instead = if preloaded { ContactState::Resting } else { ContactState::Open };
                condition(&structure.gap(self.normal, at).0, (-1.0, 0.0), 2, instead)
            }
            ContactState::Forward | ContactState::Backward => {
                let sign = if state == ContactState::Forward { 1.0 } else { -1.0 };
                let sliding = structure.sliding(self.machine, self.normal, joint);
                condition(&sliding, (sign, 0.0), 1, ContactState::Holding)
            }
        }
    }

    /// All combinations in turn, those with most constraints first; the least violation is taken if it is small, because
    /// rounding can leave a corner case without an exact answer.
    #[inline(never)]
    fn enumerated(&mut self) -> Option<(Trial, Vec<ContactState>)> {
        let mut combinations: Vec<Vec<ContactState>> = vec![Vec::new()];
        for at in self.candidates {
            let options = self.options(*at);
            let with = |states: &Vec<ContactState>, state: &ContactState| {
                states.iter().chain(core::iter::once(state)).copied().collect()
            };
            combinations =
                combinations.iter().flat_map(|states| options.iter().map(move |state| with(states, state))).collect();
            combinations.truncate(COMBINATIONS);
        }
        // most constraints first, as in the search
        sort_by_key(&mut combinations, |states| states.iter().filter(|state| !state.constrains()).count());
        let mut best: Option<(Violation, Trial, Vec<ContactState>)> = None;
        for states in combinations {
            let Some(trial) = self.attempt(&states) else { continue };
            match trial.worst {
                None => return Some((trial, states)),
                Some((violation, _)) if best.as_ref().is_none_or(|(least, ..)| least.exceeds(&violation)) => {
                    best = Some((violation, trial, states));
                }
                Some(_) => {}
            }
        }
        best.filter(|(violation, ..)| violation.order > 0 || violation.amount < 1e-6)
            .map(|(_, trial, states)| (trial, states))
    }

    /// The states that a contact can have.
    fn options(&self, at: usize) -> &'static [ContactState] {
        if at >= self.machine.stops().len() {
            return &[ContactState::Holding, ContactState::Forward, ContactState::Backward];
        }
        match compliant(&self.machine.stops()[at].law) {
            None => &[ContactState::Resting, ContactState::Open],
            Some((_, _, preload)) if preload > 0.0 => {
                &[ContactState::Resting, ContactState::Open, ContactState::Closed]
            }
            Some(_) => &[ContactState::Open, ContactState::Closed],
        }
    }

    /// The states of a consistent trial, in which contacts whose force is zero for the whole flight touch.
    fn with_touches(&mut self, mut trial: Trial, mut states: Vec<ContactState>) -> Resolved {
        let stops = self.machine.stops().len();
        // a stop that opens with no derivative may as well stay closed without force
        let idle = |k: usize, trial: &Trial, states: &[ContactState]| {
            states[k] == ContactState::Open && trial.orders[k] == ORDERS
        };
        for k in 0..states.len() {
            if !idle(k, &trial, &states) {
                continue;
            }
            let mut closed = states.clone();
            closed[k] = ContactState::Resting;
            // the contact stays closed if all conditions hold with it too
            if let Some(other) = self.attempt(&closed)
                && other.worst.is_none()
            {
                (trial, states) = (other, closed);
            }
        }
        let mut all = trial.flight.structure.states().to_vec();
        let mut known = trial.limits.clone();
        for (k, at) in self.candidates.iter().enumerate() {
            let order = trial.orders[k];
            match all[*at] {
                ContactState::Resting => {
                    let held = trial.flight.structure.held.iter().position(|place| place == at);
                    if order == ORDERS && held.is_some_and(|held| trial.flight.presses_never(self.normal, held)) {
                        all[*at] = ContactState::Touching;
                    }
                }
                ContactState::Open if order == ORDERS && trial.flight.opens_never(self.normal, *at) => {
                    all[*at] = ContactState::Touching;
                }
                ContactState::Open => known.push((GuardKind::Gap(*at), order)),
                ContactState::Closed => {
                    known.push((GuardKind::Depth(*at), order));
                    // the force of a damper begins with the velocity; a preload presses at once
                    if compliant(&self.machine.stops()[*at].law).is_some_and(|(_, _, preload)| preload == 0.0) {
                        known.push((GuardKind::Force(*at), order.saturating_sub(1)));
                    }
                }
                ContactState::Forward | ContactState::Backward => {
                    let joint = *at - stops;
                    let sliding = trial.flight.structure.sliding(self.machine, self.normal, joint);
                    // one that others keep where it is pushes with its limit
                    let stays = order == ORDERS && trial.flight.slides_never(self.normal, (*at, &sliding));
                    known.push((GuardKind::Sliding(joint), if stays { IDLE } else { order }));
                }
                ContactState::Touching | ContactState::Holding => {}
            }
        }
        Resolved { states: all, known }
    }
}

/// The first derivative of `sign * of + constant` from an order on that is not zero within rounding, relative to its terms;
/// the number of derivatives that are known if all are zero.
fn first_derivative(
    flight: &MachineFlight,
    of: &Observable,
    (sign, constant): (f64, f64),
    from: usize,
) -> (usize, f64) {
    if from == 0 {
        let (value, size) = (sign * flight.first(of).0 + constant, flight.size_in_motion(of) + constant);
        if value.abs() > SMALL * size {
            return (0, value / size);
        }
    }
    let first = |terms: &[(f64, f64)]| {
        let mut all = terms.iter().enumerate().skip(from.max(1));
        all.find(|(_, (value, size))| value.abs() > SMALL * size).map(|(k, (value, size))| (k, sign * value / size))
    };
    first(&flight.taylor::<FIRST_ORDERS>(of)).or_else(|| first(&flight.taylor::<ORDERS>(of))).unwrap_or((ORDERS, 0.0))
}
