//! The branch beyond a change of the events of its cycle.
//!
//! Where a rigid stop is grazed, the cycle with an impact of speed zero and the cycle without it are the same motion and
//! solve both systems of equations; the branch goes on along the curve of the other one, in the direction in which the
//! impact gains speed or the gap opens. At any other change the motion is continuous, and the cycle beyond is found by
//! Newton's method from the last one at a number a little beyond, or before if the branch turns back.

use super::beginning::{begun, last, traced};
use super::change::Difference;
use super::closest::closest;
use super::equations::MachineEquations;
use super::problem::{MachineProblem, MachineSolution};
use super::summed::same_in_turn;
use super::touch::speed_before;
use crate::continuation::branches::BranchOptions;
use crate::continuation::trace::equations::{Equations, correct, tangent};
use crate::continuation::trace::tracer::Tracer;
use crate::events::Place;
use crate::machine::{Machine, StopLaw};
use crate::orbit::{MachineCycle, MachineFrame, MachineRing, RingEvent};
use crate::regime::GuardKind;

/// The tracer on the other side of a change at `at`; `None` if no cycle is found there.
pub(super) fn beyond(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    found: &Difference,
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let (machine, ring) = tracer.problem.equations.split(&at.w)?;
    let rigid = |stop: usize| match machine.stops()[stop].law {
        StopLaw::Rigid { restitution } => restitution > 0.0,
        StopLaw::Compliant { .. } => false,
    };
    let through_grazing = match *found {
        Difference::Appears { at: before, stop } if rigid(stop) => {
            appearing(tracer, at, (&machine, &ring), (before, stop), options)
        }
        Difference::Disappears { at: gone, stop } if rigid(stop) && ring.len() > 1 => {
            disappearing(tracer, at, (&machine, &ring), gone, options)
        }
        _ => None,
    };
    through_grazing.or_else(|| replayed(tracer, at, (options, false)))
}

/// The problem with another ring at the same machine.
pub(super) fn with_ring(
    tracer: &Tracer<MachineProblem>,
    machine: &Machine,
    ring: MachineRing,
    sizes: (f64, f64),
) -> MachineProblem {
    let old = &tracer.problem;
    let ring = ring.centred(&MachineFrame::new(machine).normal.translations);
    let equations = MachineEquations::new((machine, old.equations.family.clone()), ring, sizes, old.equations.scale);
    MachineProblem { equations, range: old.range }
}

/// Lengths of the first step beyond a grazing contact, at which the derivative does not exist. The shortest that works is
/// taken, because a multiplier that is without limit at the contact can pass -1 and 1 close to it, and the curve can turn.
const STEPS: [f64; 5] = [1e-6, 1e-5, 1e-4, 5e-4, 2e-3];
/// The smallest cosine of the angle by which the curve turns on this step.
const BEND: f64 = 0.9;

/// The first admissible solution in one of these directions.
fn first_step(
    problem: &MachineProblem,
    w: &[f64],
    directions: &[Vec<f64>],
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    for h in STEPS {
        for along in directions {
            let guess: Vec<f64> = w.iter().zip(along).map(|(w, t)| w + h * t).collect();
            let row = problem.row(along);
            let level = problem.dot(along, w) + h;
            let Some((next, _)) = correct(problem, &guess, &row, level) else { continue };
            let Some(next_along) = tangent(problem, &next, &row) else { continue };
            if problem.dot(&next_along, along) < BEND {
                continue;
            }
            if let Some(tracer) = traced(problem.clone(), next, next_along, *options)
                && tracer.here.known.physical()
            {
                return Some(tracer);
            }
        }
    }
    None
}

/// With a new impact of speed zero before event `before`.
fn appearing(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (machine, ring): (&Machine, &MachineRing),
    (before, stop): (usize, usize),
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let frame = MachineFrame::new(machine);
    let m = ring.len();
    let leg = (before + m - 1) % m;
    let (_, place) = closest(&frame, ring, (leg, GuardKind::Gap(stop)))?;
    let event = RingEvent {
        with: Vec::new(),
        rounds: Vec::new(),
        guard: GuardKind::Gap(stop),
        after: place.states.clone(),
        pushed: vec![(stop, false)],
        back: place.surfaces.iter().map(Option::is_some).collect(),
    };
    let mut next = ring.clone();
    let index = leg + 1;
    next.insert(index, event, place);
    let sizes = at.known.cycle.as_ref()?.sizes;
    let problem = with_ring(tracer, machine, next, sizes);
    let w = MachineEquations::join(machine, &problem.equations.ring, last(&at.w));
    // towards a larger velocity away from the stop
    let width = frame.shape.size() + 1;
    let mut row = vec![0.0; w.len()];
    for (i, direction) in frame.normal.directions[stop].iter().enumerate() {
        row[index * width + 1 + machine.n() + i] = -direction;
    }
    let along = tangent(&problem, &w, &row)?;
    first_step(&problem, &w, &[along], options)
}

/// Impacts of lower speeds, relative to the largest velocity, have speed zero where another one has.
const AT_ONCE: f64 = 1e-9;

/// Without the impact `gone`, whose speed is zero. What is left can be several times a shorter cycle.
fn disappearing(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (machine, ring): (&Machine, &MachineRing),
    gone: usize,
    options: &BranchOptions,
) -> Option<Tracer<MachineProblem>> {
    let sizes = at.known.cycle.as_ref()?.sizes;
    let frame = MachineFrame::new(machine);
    // all that graze at once, as in the equal parts of a cycle
    let grazes = |k: usize| match ring.events[k].guard {
        GuardKind::Gap(stop) => speed_before(&frame, ring, k, stop).abs() <= AT_ONCE * sizes.1,
        _ => false,
    };
    let mut next = ring.clone();
    for k in (0..ring.len()).rev().filter(|k| *k == gone || grazes(*k)) {
        next.remove(k);
    }
    if next.len() == 0 {
        return None;
    }
    let next = next.shortest(&frame, sizes);
    let problem = with_ring(tracer, machine, next, sizes);
    let w = MachineEquations::join(machine, &problem.equations.ring, last(&at.w));
    let mut row = vec![0.0; w.len()];
    *row.last_mut()? = if last(&at.tangent) < 0.0 { -1.0 } else { 1.0 };
    let along = tangent(&problem, &w, &row)?;
    let back: Vec<f64> = along.iter().map(|t| -t).collect();
    first_step(&problem, &w, &[along, back], options)
}

/// How far beyond a change the motion is followed, in the scale of the number.
const BESIDE: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-2];

/// The cycle a little beyond, from the last one. Beyond a `corner` its events may be the same in cyclic order.
pub(super) fn replayed(
    tracer: &Tracer<MachineProblem>,
    at: &MachineSolution,
    (options, corner): (&BranchOptions, bool),
) -> Option<Tracer<MachineProblem>> {
    let (ring, forward) = (&tracer.problem.equations.ring, forward(at));
    let motion = LastMotion::of(tracer, at)?;
    let steps = [forward, -forward].into_iter().flat_map(|up| BESIDE.map(|by| up * by));
    steps.into_iter().find_map(|by| {
        let other = |next: &MachineRing| !same_in_turn(&next.events, &ring.events) || corner && by * forward > 0.0;
        motion.beside(tracer, (by, options), other)
    })
}

/// The direction of the number along the branch.
fn forward(at: &MachineSolution) -> f64 {
    if last(&at.tangent) < 0.0 { -1.0 } else { 1.0 }
}

/// The motion at the last solution.
struct LastMotion {
    number: f64,
    /// A state between two events.
    begin: Place,
    periods: u32,
    period: f64,
}

impl LastMotion {
    fn of(tracer: &Tracer<MachineProblem>, at: &MachineSolution) -> Option<Self> {
        let (machine, ring) = tracer.problem.equations.split(&at.w)?;
        let frame = MachineFrame::new(&machine);
        let begin = ring.middle(&frame)?.1;
        Some(Self { number: last(&at.w), begin, periods: ring.periods, period: ring.period(&frame) })
    }

    /// The cycle close to it at a number that differs by `by` in its scale; `None` if it is not `wanted`.
    fn beside(
        &self,
        tracer: &Tracer<MachineProblem>,
        (by, options): (f64, &BranchOptions),
        wanted: impl Fn(&MachineRing) -> bool,
    ) -> Option<Tracer<MachineProblem>> {
        let equations = &tracer.problem.equations;
        let (low, high) = tracer.problem.range;
        let there = self.number + by * equations.scale;
        (low..=high).contains(&there).then_some(())?;
        let moved = equations.family.at(there)?;
        let frame = MachineFrame::new(&moved);
        let cycle = MachineCycle::lasting(&frame, &self.begin, (self.periods, self.period))?;
        let next = MachineRing::of(&frame, cycle.strobes.first()?, (self.periods, cycle.period))?;
        wanted(&next).then_some(())?;
        let w = MachineEquations::join(&moved, &next, there);
        let problem = with_ring(tracer, &moved, next, cycle.sizes);
        begun(problem, &w, there, by.signum(), *options).filter(|tracer| tracer.here.known.physical())
    }
}
