//! The events and the condition of a curve, from an event of a branch.

use super::condition::{Condition, multipliers, pair};
use super::equations::CurveEquations;
use super::origin_at_rest;
use super::plane::Plane;
use super::problem::CurveProblem;
use crate::continuation::branches::BranchError;
use crate::continuation::curves::{CurveKind, check};
use crate::continuation::machine::branches::{BranchEvent, CompleteChatter, MachineEquations, SolutionPoint, closest};
use crate::events::{Place, standing_back};
use crate::machine::Machine;
use crate::orbit::{MachineFrame, MachineRing, RingEvent};
use crate::regime::{ContactState, GuardKind};

/// The equations and test functions of the curve through an event of a branch, and its unknowns there.
pub(super) fn origin(
    plane: &Plane,
    values: (f64, f64),
    point: &SolutionPoint,
) -> Result<(CurveProblem, Vec<f64>), BranchError> {
    check(&plane.ranges, values)?;
    let machine = plane.family.machine(values.into()).ok_or(BranchError::NoCycle)?;
    let event = point.event.ok_or(BranchError::NotThere)?;
    begin(plane, (&machine, values), point, event).unwrap_or(Err(BranchError::NoCycle))
}

type Origin = Result<(CurveProblem, Vec<f64>), BranchError>;

fn begin(
    plane: &Plane,
    (machine, values): (&Machine, (f64, f64)),
    point: &SolutionPoint,
    event: BranchEvent,
) -> Option<Origin> {
    let frame = MachineFrame::new(machine);
    let sizes = point.cycle.sizes;
    let begin = point.cycle.strobes.first()?;
    let ring_at = |machine: &Machine| {
        MachineRing::of(&MachineFrame::new(machine), begin, (point.cycle.label.periods, point.cycle.period))
    };
    // a point of an oscillator has no solution of the machine's equations: its motion is followed, and rounding can let that end at
    // a limit, or miss a stop that it grazes
    let beside = |by: f64| ring_at(&plane.family.machine([values.0 + by * plane.scales()[0], values.1])?);
    let both_sides = || BESIDE.into_iter().flat_map(|by| [by, -by]);
    let farther = || FARTHER.into_iter().flat_map(|by| [by, -by]);
    // where a rest begins, the solution can be that without it
    let rests = matches!(event, BranchEvent::Sticking { .. } | BranchEvent::Holding { .. });
    let solved = || point.ring.clone().filter(|_| !rests).or_else(|| ring_at(machine));
    let mut ring = solved().or_else(|| both_sides().chain(farther()).find_map(beside))?;
    let touch = |at: usize| Condition::Touch { at, size: sizes.1, contact: None, speed: sizes.1 };
    let (kind, condition) = match event {
        BranchEvent::Fold => (CurveKind::Fold, None),
        BranchEvent::Flip => (CurveKind::Flip, None),
        BranchEvent::Torus => {
            let all = multipliers(&frame, &ring)?.1;
            // of the pairs of complex multipliers the one nearest to the circle
            let complex: Vec<_> = all.iter().copied().filter(|m| m.im != 0.0).collect();
            let nearest =
                complex.iter().min_by(|a, b| (a.modulus() - 1.0).abs().total_cmp(&(b.modulus() - 1.0).abs()))?;
            (CurveKind::Torus, Some(Condition::Pair { cosine: pair(&all, nearest.re)?.2 }))
        }
        BranchEvent::Grazing { stop, appears: true, .. } => {
            // by rounding the motion can have the impact that appears here
            let without = |ring: &MachineRing| touched(&frame, ring, stop).is_some();
            if !without(&ring) {
                ring = both_sides().filter_map(beside).find(without)?;
            }
            let (leg, (gap, place)) = touched(&frame, &ring, stop)?;
            if gap.abs() > NEAR * sizes.0 {
                return Some(Err(BranchError::NotThere));
            }
            let back = place.surfaces.iter().map(Option::is_some).collect();
            ring.insert(leg + 1, RingEvent::touch(GuardKind::Gap(stop), &place.states, back), place);
            (CurveKind::Grazing { stop }, Some(touch(leg + 1)))
        }
        BranchEvent::Grazing { stop, .. } | BranchEvent::LossOfContact { stop } => {
            // by rounding the motion can miss the stop
            let rings = core::iter::once(ring.clone()).chain(both_sides().filter_map(beside));
            // an only closing is the one that disappears, whatever its speed beside the event
            let lost = matches!(event, BranchEvent::LossOfContact { .. });
            let slow = if lost { f64::INFINITY } else { NEAR * sizes.1 };
            let without = |mut ring: MachineRing| Some((without_contact(&frame, &mut ring, (stop, slow))?, ring));
            let Some((at, other)) = rings.into_iter().find_map(without) else {
                return Some(Err(BranchError::NotThere));
            };
            ring = other;
            (CurveKind::Grazing { stop }, Some(touch(at)))
        }
        BranchEvent::Corner { first, second } => {
            let stops = machine.stops().len();
            let of = |k: usize| ring.events[k % ring.len()].guard.place(stops);
            let both = |k: &usize| {
                let (a, b) = (of(*k), of(k + 1));
                (a, b) == (first, second) || (b, a) == (first, second)
            };
            let at = (0..ring.len())
                .filter(both)
                .min_by(|a, b| (ring.theta(a + 1) - ring.theta(*a)).total_cmp(&(ring.theta(b + 1) - ring.theta(*b))))?;
            let kind = CurveKind::Corner { first: of(at), second: of(at + 1) };
            ring.together = Some(at);
            (kind, Some(Condition::Together { at }))
        }
        BranchEvent::Sticking { stop: contact, .. } | BranchEvent::Holding { joint: contact, .. } => {
            // a chatter that is complete at its release is so before it on one side
            let chatter = |by: f64| {
                let mut ring = beside(by)?;
                Some((CompleteChatter::shortened(&frame, &mut ring, contact)?, ring))
            };
            let bounces = machine.stops().get(contact).is_some_and(|stop| CurveProblem::rigid(&stop.law));
            let complete = bounces.then(|| both_sides().chain(farther()).find_map(chatter)).flatten();
            let condition = if let Some((chatter, complete)) = complete {
                ring = complete;
                Condition::Chatter(chatter)
            } else if let Some(condition) = origin_at_rest::condition(&frame, &mut ring, (contact, sizes.1)) {
                condition
            } else {
                return Some(Err(BranchError::NotThere));
            };
            let kind = if contact < machine.stops().len() {
                CurveKind::Sticking { stop: contact }
            } else {
                CurveKind::Holding { joint: contact }
            };
            (kind, Some(condition))
        }
        _ => return Some(Err(BranchError::NotThere)),
    };
    let w = MachineEquations::join(machine, &ring, values.into());
    let rigid =
        if let CurveKind::Grazing { stop } = kind { CurveProblem::rigid(&machine.stops()[stop].law) } else { false };
    let together = Condition::Together { at: 0 };
    let events = MachineEquations::new((machine, plane.family.clone()), ring, sizes, plane.scales());
    let (ranges, condition) = (plane.ranges.clone(), condition.unwrap_or(together));
    let equations = CurveEquations { events, ranges, condition };
    let equations = match kind {
        CurveKind::Fold => equations.singular(machine, 1.0)?,
        CurveKind::Flip => equations.singular(machine, -1.0)?,
        _ => equations,
    };
    Some(Ok((CurveProblem::new(equations, kind, (sizes.1, rigid)), w)))
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
