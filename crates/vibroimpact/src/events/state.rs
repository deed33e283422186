//! A whole state of a machine as a start, and back: what its future depends on, to the last bit.
//!
//! Coordinates, velocities, phase and contacts are the state. What they leave out are digits: coordinates are mass-normalised
//! ones that have been transformed and rounded, a stiff stop that is closed has a gap with more digits than the
//! coordinates, a flight that begins on a guard begins exactly there, and a chatter is summed by the impacts before it.

use super::event::{ContactStart, Start};
use super::instants::Instants;
use super::place::{Place, SharpGap, standing_back};
use crate::arc::Recovery;
use crate::machine::{Fault, Machine, MachineError, Opening, StopLaw};
use crate::regime::{ContactState, GuardKind, Normal};
use crate::system::phase;

/// What a motion knows of the impacts before a state.
#[derive(Clone, Debug, Default)]
pub(super) struct ImpactHistory {
    /// The largest speed of an impact since the structure last came to rest by a chatter.
    pub(super) largest: f64,
    /// The latest changes.
    pub(super) instants: Instants,
    /// The rigid stops that were struck to come to the state and have opened, and the speeds.
    pub(super) last: Vec<(usize, f64)>,
}

const ZEROS: [&str; 8] = ["gap", "depth", "force", "reaction", "preload", "sliding", "forward", "backward"];

const fn name_of(kind: GuardKind) -> &'static str {
    match kind {
        GuardKind::Gap(_) => ZEROS[0],
        GuardKind::Depth(_) => ZEROS[1],
        GuardKind::Force(_) => ZEROS[2],
        GuardKind::Reaction(_) => ZEROS[3],
        GuardKind::Preload(_) => ZEROS[4],
        GuardKind::Sliding(_) => ZEROS[5],
        GuardKind::LimitForward(_) => ZEROS[6],
        GuardKind::LimitBackward(_) => ZEROS[7],
    }
}

fn guard_of(name: &str, place: usize, stops: usize) -> Option<GuardKind> {
    let kind: fn(usize) -> GuardKind = match ZEROS.iter().position(|known| *known == name)? {
        0 => GuardKind::Gap,
        1 => GuardKind::Depth,
        2 => GuardKind::Force,
        3 => GuardKind::Reaction,
        4 => GuardKind::Preload,
        5 => GuardKind::Sliding,
        6 => GuardKind::LimitForward,
        _ => GuardKind::LimitBackward,
    };
    let of_joint = matches!(kind(0), GuardKind::Sliding(_) | GuardKind::LimitForward(_) | GuardKind::LimitBackward(_));
    (of_joint == (place >= stops)).then(|| kind(if of_joint { place - stops } else { place }))
}

fn equal_bits(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(a, b)| a.to_bits() == b.to_bits())
}

impl Place {
    /// The state without the digits that its numbers leave out.
    pub(super) fn numbers(&self, normal: &Normal) -> Start {
        let contact = |(place, state): (usize, &ContactState)| {
            let surface = self.surfaces.get(place).copied().flatten();
            ContactStart { place, state: *state, surface: surface.map_or(0.0, |surface| surface.size - surface.offset) }
        };
        Start {
            q: normal.to_machine(&self.x),
            qdot: normal.to_machine(&self.v),
            phase: self.phase,
            contacts: self.states.iter().enumerate().map(contact).collect(),
            exact: Vec::new(),
        }
    }

    /// The whole state.
    pub(crate) fn start(&self, machine: &Machine, normal: &Normal) -> Start {
        self.start_after(machine, normal, (fingerprint(machine), &ImpactHistory::default()))
    }

    /// The whole state after some impacts.
    pub(super) fn start_after(
        &self,
        machine: &Machine,
        normal: &Normal,
        (fingerprint, history): (f64, &ImpactHistory),
    ) -> Start {
        let mut start = self.numbers(normal);
        let stops = machine.stops().len();
        let mut add = |name: String, values: Vec<f64>| start.exact.push((name, values));
        add("machine".to_owned(), vec![fingerprint]);
        for (name, exact, rounded) in [("x", &self.x, &start.q), ("v", &self.v, &start.qdot)] {
            // only where the rounded numbers do not give back the exact ones
            if !equal_bits(&normal.to_normal(rounded), exact) {
                add(name.to_owned(), exact.clone());
            }
        }
        for (j, surface) in self.surfaces.iter().enumerate() {
            if let Some(Recovery { size, offset, .. }) = surface
                // what is told of it is the size less the offset, which has fewer digits
                && *offset > 0.0
            {
                add(format!("spring.{}", machine.name_of(j)), vec![*size]);
            }
        }
        for SharpGap { stop, gap, size } in &self.gaps {
            add(format!("gap.{}", machine.name_of(*stop)), vec![*gap, *size]);
        }
        for (kind, count) in &self.known {
            let name = machine.name_of(kind.place(stops));
            // at most a few derivatives
            add(format!("zero.{}.{name}", name_of(*kind)), vec![f64::from(u32::try_from(*count).unwrap_or(u32::MAX))]);
        }
        for (stop, speed) in &history.last {
            add(format!("impact.{}", machine.name_of(*stop)), vec![*speed]);
        }
        if history.largest > 0.0 {
            add("largest_impact".to_owned(), vec![history.largest]);
        }
        let instants = history.instants.numbers();
        if !instants.is_empty() {
            add("instants".to_owned(), instants);
        }
        start
    }

    /// The state with these coordinates, velocities and phase, with all stops open.
    pub(super) fn at(machine: &Machine, normal: &Normal, start: &Start) -> Result<Self, MachineError> {
        let n = machine.n();
        let vector = |path: &str, values: &[f64]| -> Result<Vec<f64>, MachineError> {
            if values.is_empty() {
                return Ok(vec![0.0; n]);
            }
            if values.len() != n {
                let given = format!("{} numbers", values.len());
                return Err(MachineError::new(path, Fault::Size { given, n }));
            }
            match values.iter().find(|value| !value.is_finite()) {
                Some(value) => Err(MachineError::new(path, Fault::NotFinite(*value))),
                None => Ok(normal.to_normal(values)),
            }
        };
        let (x, v) = (vector("q", &start.q)?, vector("qdot", &start.qdot)?);
        if !(start.phase.is_finite() && start.phase.abs() <= phase::LARGEST) {
            return Err(MachineError::new("phase", Fault::NotFinite(start.phase)));
        }
        let (stops, joints) = (machine.stops().len(), machine.joints().len());
        Ok(Self {
            x,
            v,
            phase: phase::wrap(start.phase),
            states: vec![ContactState::Open; stops + joints],
            surfaces: vec![None; stops],
            known: Vec::new(),
            gaps: Vec::new(),
        })
    }

    /// The state of a start with all its digits; `None` if it has none, or if they are not those of its other numbers or of
    /// this machine.
    pub(super) fn with_all_digits(
        &self,
        machine: &Machine,
        normal: &Normal,
        start: &Start,
    ) -> Result<Option<(Self, ImpactHistory)>, MachineError> {
        // digits of another machine would be wrong ones
        let own = start.exact.iter().any(|(name, values)| name == "machine" && values[..] == [fingerprint(machine)]);
        if !own || start.contacts.len() != self.states.len() {
            return Ok(None);
        }
        let (mut place, mut history) = (self.clone(), ImpactHistory::default());
        let stops = machine.stops().len();
        for contact in &start.contacts {
            place.states[contact.place] = contact.state;
            if contact.surface > 0.0 {
                place.surfaces[contact.place] = standing_back(&machine.stops()[contact.place].law, contact.surface);
            }
        }
        for (name, values) in &start.exact {
            let wrong = |what: &str| Err(MachineError::new(format!("exact.{name}"), Fault::Contact(what.to_owned())));
            if values.iter().any(|value| !value.is_finite()) {
                return wrong("a number is not finite");
            }
            let of = |name: &str| (0..place.states.len()).find(|at| machine.name_of(*at) == name);
            let (kind, rest) = name.split_once('.').unwrap_or((name, ""));
            match (kind, &values[..]) {
                ("machine", _) => {}
                ("x", x) if x.len() == normal.n => place.x.copy_from_slice(x),
                ("v", v) if v.len() == normal.n => place.v.copy_from_slice(v),
                ("largest_impact", [speed]) => history.largest = *speed,
                ("instants", numbers) => match Instants::of_numbers(numbers, (normal.n, place.states.len())) {
                    Some(instants) => history.instants = instants,
                    None => return wrong("this is no list of impacts"),
                },
                ("zero", [count]) => {
                    let guard = rest.split_once('.').and_then(|(kind, name)| guard_of(kind, of(name)?, stops));
                    match guard {
                        // a count is small
                        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
                        Some(guard) if (1.0..=32.0).contains(count) => place.known.push((guard, *count as usize)),
                        _ => return wrong("this is no zero of a contact"),
                    }
                }
                ("gap", [gap, size]) if *size >= 0.0 => {
                    let Some(stop) = of(rest).filter(|at| *at < stops) else { return wrong("there is no such stop") };
                    place.gaps.push(SharpGap { stop, gap: *gap, size: *size });
                }
                ("spring" | "impact", [value]) => {
                    let Some(stop) = of(rest).filter(|at| *at < stops) else { return wrong("there is no such stop") };
                    match (kind, &mut place.surfaces[stop]) {
                        ("spring", Some(surface)) => surface.size = *value,
                        // the numbers of the start have been changed since: without its digits it is a start all the
                        // same
                        ("spring", None) => return Ok(None),
                        _ => history.last.push((stop, *value)),
                    }
                }
                _ => return wrong("this is no part of a state"),
            }
        }
        Ok(place.has_digits_of(normal, start).then_some((place, history)))
    }

    /// Whether the digits of the state are those of the numbers of a start.
    fn has_digits_of(&self, normal: &Normal, start: &Start) -> bool {
        let own = self.numbers(normal);
        let same =
            // no numbers are zeros
            |one: &[f64], other: &[f64]| one == other || other.is_empty() && one.iter().all(|value| *value == 0.0);
        let has = |contact: &ContactStart| start.contacts.contains(contact);
        same(&own.q, &start.q) && same(&own.qdot, &start.qdot) && own.contacts.iter().all(has)
    }
}

/// A number that two machines have in common if all their numbers and names are equal.
pub(super) fn fingerprint(machine: &Machine) -> f64 {
    struct Hash(u64);
    impl core::fmt::Write for Hash {
        fn write_str(&mut self, text: &str) -> core::fmt::Result {
            for byte in text.bytes() {
                // the hash of Fowler, Noll and Vo, FNV-1a
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
            Ok(())
        }
    }
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    // cannot fail
    let _ = core::fmt::write(&mut hash, format_args!("{:?}", machine.parts()));
    // 53 bits are a number exactly
    #[allow(clippy::cast_precision_loss)]
    let number = (hash.0 >> 11) as f64;
    number
}

/// Whether contacts of a start are those of a machine.
pub(super) fn check_contacts(machine: &Machine, contacts: &[ContactStart]) -> Result<(), MachineError> {
    let stops = machine.stops();
    for (k, contact) in contacts.iter().enumerate() {
        let ContactStart { place, state, surface } = *contact;
        if place >= stops.len() + machine.joints().len() {
            let what = "the machine has no such stop or joint".to_owned();
            return Err(MachineError::new(format!("contact.{place}"), Fault::Contact(what)));
        }
        let wrong = |what: &str| Err(contact_error(machine, place, what.to_owned()));
        if contacts[..k].iter().any(|other| other.place == place) {
            return wrong("the contact is there twice");
        }
        let joint = matches!(state, ContactState::Forward | ContactState::Backward | ContactState::Holding);
        if joint != (place >= stops.len()) {
            return wrong(if joint {
                "a stop is open, closed or resting"
            } else {
                "a friction joint slides forward or backward, or holds"
            });
        }
        let law = stops.get(place).map(|stop| stop.law);
        match (state, law) {
            (ContactState::Closed, Some(StopLaw::Rigid { .. })) => return wrong("a rigid stop is open or resting"),
            (ContactState::Resting, Some(StopLaw::Compliant { preload, .. })) if preload <= 0.0 => {
                return wrong("a compliant stop without preload is open or closed");
            }
            _ => {}
        }
        if !(surface.is_finite() && surface >= 0.0) {
            return wrong("a surface stands back by a finite number that is not negative");
        }
        let recovers =
            matches!(law, Some(StopLaw::Compliant { damping, opening: Opening::Force, .. }) if damping > 0.0);
        if surface > 0.0 && !(recovers && state == ContactState::Open) {
            return wrong("only the surface of a damped stop that opens by force, and is open, stands back");
        }
    }
    Ok(())
}

pub(super) fn contact_error(machine: &Machine, place: usize, what: String) -> MachineError {
    MachineError::new(format!("contact.{}", machine.name_of(place)), Fault::Contact(what))
}
