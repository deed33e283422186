//! The events and the condition of a curve, from an event of a branch.

use super::condition::{Condition, multipliers, pair};
use super::equations::CurveEquations;
use super::origin_at_rest;
use super::plane::Plane;
use super::problem::CurveProblem;
use crate::continuation::branches::BranchError;
use crate::continuation::curves::{CurveKind, check};
use crate::continuation::event::BranchEvent;
use crate::continuation::machine::branches::{CompleteChatter, MachineEquations, SolutionPoint, closest};
use crate::events::{Place, standing_back};
use crate::machine::Machine;
use crate::math::Multiplier;
use crate::orbit::{MachineFrame, MachineRing, RingEvent};
use crate::regime::{ContactState, GuardKind};

/// The equations and test functions of the curve through an event of a branch, and its unknowns there.
pub(super) fn origin(
    plane: &Plane,
    values: (f64, f64),
    point: &SolutionPoint,
) -> Result<(CurveProblem, Vec<f64>), BranchError> {
    check(&plane.ranges, values)?;
    let machine = &plane.family.machine(values.into()).ok_or(BranchError::NoCycle)?;
    let event = point.event.ok_or(BranchError::NotThere)?;
    let (kind, ring, condition) =
        Origin { plane, machine, values, point, frame: MachineFrame::new(machine) }.beginning(event)?;
    let w = MachineEquations::join(machine, &ring, values.into());
    let speed = point.cycle.sizes.1;
    let rigid = matches!(kind, CurveKind::Grazing { stop } if CurveProblem::rigid(&machine.stops()[stop].law));
    let events = MachineEquations::new((machine, plane.family.clone()), ring, point.cycle.sizes, plane.scales());
    let equations = CurveEquations { events, ranges: plane.ranges.clone(), condition };
    let equations = match kind {
        CurveKind::Fold => equations.singular(machine, 1.0).ok_or(BranchError::NoCycle)?,
        CurveKind::Flip => equations.singular(machine, -1.0).ok_or(BranchError::NoCycle)?,
        _ => equations,
    };
    Ok((CurveProblem::new(equations, kind, (speed, rigid)), w))
}

/// An event of a branch at which a curve begins.
struct Origin<'a> {
    plane: &'a Plane,
    machine: &'a Machine,
    values: (f64, f64),
    point: &'a SolutionPoint,
    frame: MachineFrame<'a>,
}

/// The kind of a curve, the events of its cycle, and its condition.
type Beginning = (CurveKind, MachineRing, Condition);

impl Origin<'_> {
    fn beginning(&self, event: BranchEvent) -> Result<Beginning, BranchError> {
        let ring = self.ring(event).ok_or(BranchError::NoCycle)?;
        // that of a fold or a flip replaces it: its matrix is singular
        let singular = Condition::Together { at: 0 };
        match event {
            BranchEvent::Fold => Ok((CurveKind::Fold, ring, singular)),
            BranchEvent::Flip => Ok((CurveKind::Flip, ring, singular)),
            BranchEvent::Torus => self.torus(ring).ok_or(BranchError::NoCycle),
            BranchEvent::Grazing { stop, appears: true, .. } => self.appearing(ring, stop),
            BranchEvent::Grazing { stop, .. } => self.disappearing(&ring, stop, NEAR * self.along(stop).1),
            // an only closing is the one that disappears, whatever its speed beside the event
            BranchEvent::LossOfContact { stop, .. } => self.disappearing(&ring, stop, f64::INFINITY),
            BranchEvent::Corner { first, second } => self.corner(ring, [first, second]).ok_or(BranchError::NoCycle),
            BranchEvent::Sticking { stop, .. } => self.resting(ring, stop, CurveKind::Sticking { stop }),
            BranchEvent::Holding { joint, .. } => self.resting(ring, joint, CurveKind::Holding { joint }),
            // where the joint slips no more, its hold begins to last for ever
            BranchEvent::RestForEver { stop: joint } if joint >= self.machine.stops().len() => {
                self.resting(ring, joint, CurveKind::Holding { joint })
            }
            _ => Err(BranchError::NotThere),
        }
    }

    /// The solution at the event. A point of an oscillator has no solution of the machine's equations: its motion is followed, and
    /// rounding can let that end at a limit, or miss a stop that it grazes; then it is that of a value beside it.
    fn ring(&self, event: BranchEvent) -> Option<MachineRing> {
        // where a rest begins, the solution can be that without it
        use BranchEvent::{Holding, RestForEver, Sticking};
        let rests = matches!(event, Sticking { .. } | Holding { .. } | RestForEver { .. });
        let solved = self.point.ring.clone().filter(|_| !rests).or_else(|| self.followed(self.machine));
        solved.or_else(|| self.beside().chain(self.farther()).next())
    }

    fn followed(&self, machine: &Machine) -> Option<MachineRing> {
        let cycle = &self.point.cycle;
        let begin = cycle.strobes.first()?;
        MachineRing::of(&MachineFrame::new(machine), begin, (cycle.label.periods, cycle.period))
    }

    /// The motions at values close to that of the event, the closest first.
    fn beside(&self) -> impl Iterator<Item = MachineRing> {
        self.followed_at(BESIDE)
    }

    fn farther(&self) -> impl Iterator<Item = MachineRing> {
        self.followed_at(FARTHER)
    }

    fn followed_at(&self, distances: [f64; 4]) -> impl Iterator<Item = MachineRing> {
        let both = distances.into_iter().flat_map(|by| [by, -by]);
        both.filter_map(|by| {
            let value = self.values.0 + by * self.plane.scales()[0];
            self.followed(&self.plane.family.machine([value, self.values.1])?)
        })
    }

    fn torus(&self, ring: MachineRing) -> Option<Beginning> {
        let all = multipliers(&self.frame, &ring)?.1;
        // of the pairs of complex multipliers the one nearest to the circle
        let complex = all.iter().copied().filter(|multiplier| multiplier.im != 0.0);
        let off = |multiplier: &Multiplier| (multiplier.modulus() - 1.0).abs();
        let nearest = complex.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let cosine = pair(&all, nearest.re)?.2;
        Some((CurveKind::Torus, ring, Condition::Pair { cosine }))
    }

    /// The largest way and velocity along a stop.
    fn along(&self, stop: usize) -> (f64, f64) {
        self.frame.normal.along(stop, self.point.cycle.sizes)
    }

    fn touch(&self, stop: usize, ring: MachineRing, at: usize) -> Beginning {
        let (size, speed) = (self.along(stop).1, self.point.cycle.sizes.1);
        (CurveKind::Grazing { stop }, ring, Condition::Touch { at, size, contact: None, speed })
    }

    /// That of a grazing contact which appears: a touch in the flight that comes closest to the stop.
    fn appearing(&self, ring: MachineRing, stop: usize) -> Result<Beginning, BranchError> {
        let touched = |ring: MachineRing| Some((touched(&self.frame, &ring, stop)?, ring));
        // by rounding the motion can have the impact that appears here
        let mut rings = core::iter::once(ring).chain(self.beside());
        let ((leg, (gap, place)), mut ring) = rings.find_map(touched).ok_or(BranchError::NoCycle)?;
        if gap.abs() > NEAR * self.along(stop).0 {
            return Err(BranchError::NotThere);
        }
        let back = place.surfaces.iter().map(Option::is_some).collect();
        ring.insert(leg + 1, RingEvent::touch(GuardKind::Gap(stop), &place.states, back), place);
        Ok(self.touch(stop, ring, leg + 1))
    }

    /// That of a closing which disappears: a touch in its place. `slow` is the largest speed of one that does.
    fn disappearing(&self, ring: &MachineRing, stop: usize, slow: f64) -> Result<Beginning, BranchError> {
        let without = |mut ring: MachineRing| Some((without_contact(&self.frame, &mut ring, (stop, slow))?, ring));
        // by rounding the motion can miss the stop
        let mut rings = core::iter::once(ring.clone()).chain(self.beside());
        let (at, ring) = rings.find_map(without).ok_or(BranchError::NotThere)?;
        Ok(self.touch(stop, ring, at))
    }

    /// That of two events of these contacts at one instant: of those that follow each other the closest in time.
    fn corner(&self, mut ring: MachineRing, contacts: [usize; 2]) -> Option<Beginning> {
        let stops = self.machine.stops().len();
        let of = |k: usize| ring.events[k % ring.len()].guard.place(stops);
        let both = |k: &usize| {
            let found = [of(*k), of(k + 1)];
            found == contacts || [found[1], found[0]] == contacts
        };
        let apart = |k: usize| ring.theta(k + 1) - ring.theta(k);
        let at = (0..ring.len()).filter(both).min_by(|a, b| apart(*a).total_cmp(&apart(*b)))?;
        let kind = CurveKind::Corner { first: of(at), second: of(at + 1) };
        ring.together = Some(at);
        Some((kind, ring, Condition::Together { at }))
    }

    /// That of a rest, or of the hold of a joint, that begins or ends.
    fn resting(&self, mut ring: MachineRing, contact: usize, kind: CurveKind) -> Result<Beginning, BranchError> {
        // a chatter that is complete at its release is so before it on one side
        let chatter = |mut ring| Some((CompleteChatter::shortened(&self.frame, &mut ring, contact)?, ring));
        let bounces = self.machine.stops().get(contact).is_some_and(|stop| CurveProblem::rigid(&stop.law));
        if bounces && let Some((chatter, complete)) = self.beside().chain(self.farther()).find_map(chatter) {
            return Ok((kind, complete, Condition::Chatter(chatter)));
        }
        let speed = self.point.cycle.sizes.1;
        let condition = origin_at_rest::condition(&self.frame, &mut ring, (contact, speed));
        Ok((kind, ring, condition.ok_or(BranchError::NotThere)?))
    }
}

/// The changes of the number at which the motion is followed instead, in its scale.
const BESIDE: [f64; 4] = [1e-9, 1e-8, 1e-7, 1e-6];
/// The same where the cycle of the point can be farther away: of a chatter that becomes complete with the last impact that appeared,
/// of an only impact that disappears with some speed.
const FARTHER: [f64; 4] = [1e-5, 1e-4, 1e-3, 1e-2];

/// A gap or a speed that is larger, relative to the motion, is not that of a grazing contact.
const NEAR: f64 = 1e-3;

/// The flight that comes closest to a stop, with the gap and the state there.
fn touched(frame: &MachineFrame<'_>, ring: &MachineRing, stop: usize) -> Option<(usize, (f64, Place))> {
    let open = (0..ring.len()).filter(|leg| ring.events[*leg].after[stop] == ContactState::Open);
    let lowest = open.filter_map(|leg| Some((leg, closest(frame, ring, (leg, GuardKind::Gap(stop)))?)));
    lowest.min_by(|a, b| a.1.0.abs().total_cmp(&b.1.0.abs()))
}

/// Replaces the slowest closing of a stop, with the opening that follows it, by a touch; returns the place of that. `None`
/// if its speed is not below `slow`.
fn without_contact(frame: &MachineFrame<'_>, ring: &mut MachineRing, (stop, slow): (usize, f64)) -> Option<usize> {
    let blocks = ring.blocks(frame)?;
    let m = ring.len();
    let rate = |k: usize| blocks[(k + m - 1) % m].late[0];
    let at = (0..m)
        .filter(|k| ring.events[*k].guard == GuardKind::Gap(stop))
        .max_by(|a, b| rate(*a).total_cmp(&rate(*b)))?;
    if rate(at).abs() * ring.frequency(frame.machine) > slow {
        return None;
    }
    let contact = ring.events[at].after[stop] != ContactState::Open;
    if contact && (m < 2 || ring.events[(at + 1) % m].after[stop] != ContactState::Open) {
        return None;
    }
    let before = ring.events[(at + m - 1) % m].clone();
    let surface = ring.places[(at + m - 1) % m].surfaces[stop];
    ring.events[at] = RingEvent::touch(GuardKind::Gap(stop), &before.after, before.back.clone());
    ring.places[at].states.clone_from(&before.after);
    let mut at = at;
    if contact {
        let opened = (at + 1) % m;
        ring.remove(opened);
        if opened < at {
            at -= 1;
        }
    }
    // until the next event of the stop its surface stands back as before the contact
    let m = ring.len();
    let law = &frame.machine.stops()[stop].law;
    let standing = before.back[stop].then(|| surface.or_else(|| standing_back(law, 0.0))).flatten();
    for i in 0..m {
        let k = (at + i) % m;
        let own =
            matches!(ring.events[k].guard, GuardKind::Gap(j) | GuardKind::Depth(j) | GuardKind::Force(j) if j == stop);
        if i > 0 && own {
            break;
        }
        ring.events[k].back[stop] = standing.is_some();
        ring.places[k].surfaces[stop] = standing;
    }
    Some(at)
}
