//! The verdict on the motion of a machine from a start.

use super::super::attractors::SteadyMotion;
use super::super::options::SettleOptions;
use super::super::record::{Record, Shown};
use super::super::recurring::Recurring;
use super::super::settle::settle_while;
use super::reduced::Reduced;
use super::returns::{Recorded, Step};
use super::tail::MachineTail;
use crate::events::{MachineEnd, MachineLimits, MachineMotion, MachineStart};
use crate::lyapunov::MachineSpectrum;
use crate::machine::{Machine, MachineError};
use crate::orbit::{MachineCycle, MachineFrame, Stability};
use crate::regime::ContactState;
use std::sync::Arc;

/// What a machine settles into.
#[derive(Clone, Debug)]
pub enum MachineVerdict {
    /// A cycle, confirmed by Newton's method, that captures the motion: a stable one, or a neutral one on which it is to
    /// rounding, or an unstable one that it does not leave, as an exactly symmetric motion.
    Periodic(MachineCycle),
    /// No further event, for ever.
    NoImpact(MachineTail),
    /// At rest on a stop, for ever.
    Stuck(MachineTail),
    /// Chaotic by its largest Lyapunov exponent, to the end of the budget.
    Chaotic {
        /// The exponents of the last measurement.
        spectrum: MachineSpectrum,
        /// Events followed. Chaos can be a transient, which no finite observation excludes; this number is a lower bound of
        /// its length.
        events: u64,
        /// The last of them.
        tail: MachineTail,
    },
    /// None of these within the budget.
    Undecided {
        /// Why.
        why: MachineUndecided,
        /// Exponents of the last measurement.
        spectrum: Option<MachineSpectrum>,
        /// Events followed.
        events: u64,
    },
}

/// Why a motion of a machine is undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MachineUndecided {
    /// The number of events is used up.
    Events,
    /// The number of events is used up, and the motion has returned to a release from rest. So it is periodic, but the
    /// rounding errors between two releases grow so much that they decide its period.
    Unconfirmed,
    /// The motion ended for this reason.
    Ended(MachineEnd),
}

/// A verdict and how far the motion was followed.
#[derive(Clone, Debug)]
pub struct MachineSettled {
    /// The verdict.
    pub verdict: MachineVerdict,
    /// The number of events that were followed; of impacts, if the machine was followed as an oscillator.
    pub events: u64,
    /// The time that was followed.
    pub time: f64,
    /// Chaos that was measured and has ended.
    pub transient: Option<MachineSpectrum>,
}

impl MachineVerdict {
    /// The label of the motion as text: `4/1`, `inf/1`, `0`, `chaotic`, `stuck`, `undecided`.
    #[must_use]
    pub fn label(&self) -> String {
        match self {
            Self::Periodic(cycle) => cycle.label.to_string(),
            Self::NoImpact(_) => "0".to_owned(),
            Self::Stuck(_) => "stuck".to_owned(),
            Self::Chaotic { .. } => "chaotic".to_owned(),
            Self::Undecided { .. } => "undecided".to_owned(),
        }
    }

    /// Whether neighbours approach the motion; `None` if it is undecided. Of a motion that comes to no further event it is that
    /// of the structure in its last regime, in which a joint that holds keeps its place: there are rests on both sides of it.
    #[must_use]
    pub fn stability(&self, machine: &Machine) -> Option<Stability> {
        match self {
            Self::Periodic(cycle) => Some(cycle.stability()),
            Self::NoImpact(tail) | Self::Stuck(tail) => tail.stability(machine),
            Self::Chaotic { .. } => Some(Stability::Unstable),
            Self::Undecided { .. } => None,
        }
    }

    /// The stops that stay closed for ever, if no further event follows: those on which the structure rests, and compliant ones
    /// that push.
    #[must_use]
    pub fn closed(&self) -> Vec<usize> {
        let (Self::NoImpact(tail) | Self::Stuck(tail)) = self else { return Vec::new() };
        // stops come before joints, whose states are others
        let states = &tail.from.states;
        (0..states.len())
            .filter(|k| matches!(states[*k], ContactState::Closed | ContactState::Resting | ContactState::Touching))
            .collect()
    }

    /// The number of events over which chaos was seen; `None` unless the motion is chaotic.
    #[must_use]
    pub const fn seen_events(&self) -> Option<u64> {
        if let Self::Chaotic { events, .. } = self { Some(*events) } else { None }
    }

    /// A state of the motion that is reached: on the cycle, at the beginning of the last part of chaos that is measured, or
    /// after the last event; `None` for an undecided motion.
    #[must_use]
    pub fn reached(&self, machine: &Machine) -> Option<MachineStart> {
        match self {
            Self::Periodic(cycle) => Some(cycle.state.clone()),
            Self::NoImpact(tail) | Self::Stuck(tail) | Self::Chaotic { tail, .. } => Some(tail.start(machine)),
            Self::Undecided { .. } => None,
        }
    }
}

impl SteadyMotion for MachineVerdict {
    fn same_as(&self, other: &Self, tolerance: f64) -> bool {
        match (self, other) {
            (Self::Periodic(a), Self::Periodic(b)) => a.same_as(b, tolerance),
            // they differ if other stops stay closed or other joints hold; the places in which joints hold are a continuum
            (Self::NoImpact(a), Self::NoImpact(b)) | (Self::Stuck(a), Self::Stuck(b)) => a.from.states == b.from.states,
            _ => core::mem::discriminant(self) == core::mem::discriminant(other),
        }
    }
}

/// The verdict on the motion of `machine` from `start`. In the options an impact stands for an event, and the limits of
/// the search of the oscillator are not used.
///
/// A machine that [is an oscillator](Machine::reduced) is followed as that: the options then mean what they mean for
/// [`settle`](crate::verdict::settle()), events are impacts, and chaos is decided as early as there. What the oscillator does not
/// decide for the machine, and the motion from a start that says what its contacts do, is followed as that of any machine.
///
/// ```
/// use vibroimpact::events::MachineStart;
/// use vibroimpact::machine::{Machine, MachineParts};
/// use vibroimpact::verdict::{SettleOptions, settle_machine};
/// // N of the 1971 paper as a machine of one coordinate
/// let parts = MachineParts::new(["mass"])
///     .with_mass(0, 1.0)
///     .with_link(&[1.0], 1.0, 0.0)
///     .with_frequency(1.0 / 1.8)
///     .with_force(0, 1, 0.0, 1.0)
///     .with_rigid_stop("stop", &[1.0], 0.25, 0.5);
/// let machine = Machine::new(parts)?;
/// let settled = settle_machine(&machine, &MachineStart::default(), &SettleOptions::default())?;
/// assert_eq!(settled.verdict.label(), "4/1");
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
///
/// # Errors
/// [`MachineError`] for an invalid start.
pub fn settle_machine(
    machine: &Machine,
    start: &MachineStart,
    options: &SettleOptions,
) -> Result<MachineSettled, MachineError> {
    unstopped(settle_machine_while(machine, start, options, &|| true))
}

/// The same, but stopped when `go_on` returns false, and then `None`. `go_on` is called at every step.
///
/// # Errors
/// [`MachineError`] for an invalid start.
pub fn settle_machine_while(
    machine: &Machine,
    start: &MachineStart,
    options: &SettleOptions,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<MachineSettled>, MachineError> {
    if let Some(reduced) = Reduced::new(machine, options)
        && let Some(from) = reduced.start(start)
    {
        let Some(found) = settle_while(reduced.oscillator(), from, options, go_on) else { return Ok(None) };
        if let Some(found) = reduced.settled(&found) {
            return Ok(Some(found));
        }
    }
    settle_alone(machine, start, options, go_on)
}

/// The same as [`settle_machine`], but also a machine that is an oscillator is followed as any other: it takes a hundred times as
/// long, and checks it.
///
/// # Errors
/// [`MachineError`] for an invalid start.
pub fn settle_unreduced(
    machine: &Machine,
    start: &MachineStart,
    options: &SettleOptions,
) -> Result<MachineSettled, MachineError> {
    unstopped(settle_alone(machine, start, options, &|| true))
}

/// The verdict on a motion that was not stopped.
fn unstopped(found: Result<Option<MachineSettled>, MachineError>) -> Result<MachineSettled, MachineError> {
    Ok(found?.unwrap_or(MachineSettled {
        verdict: MachineVerdict::Undecided { why: MachineUndecided::Events, spectrum: None, events: 0 },
        events: 0,
        time: 0.0,
        transient: None,
    }))
}

/// How many events of a machine stand for one impact of the longest period that is searched for.
const EVENTS_PER_IMPACT: u32 = 8;
/// Two releases at states that differ by less are the same.
const FORGOTTEN: f64 = 1e-9;
/// The number of latest steps whose size distances are relative to.
const RECENT: usize = 64;

/// The verdict on the motion that the machine follows itself.
pub(super) fn settle_alone<'a>(
    machine: &'a Machine,
    start: &MachineStart,
    options: &SettleOptions,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<MachineSettled>, MachineError> {
    // chatters and contacts take many events in each period
    let options = &SettleOptions { longest: options.longest.saturating_mul(EVENTS_PER_IMPACT), ..*options };
    let mut motion = MachineMotion::new(machine, start, MachineLimits::default())?;
    let system = Recorded::new(MachineFrame::new(machine));
    let mut record: Record<Recorded<'a>> = Record::default();
    let mut sizes: std::collections::VecDeque<(f64, f64)> = std::collections::VecDeque::new();
    let mut events = 0_u64;
    // the latest release from each stop, and chaos that has ended by a rest
    let mut releases: Vec<(Arc<Step>, f64)> = Vec::new();
    let over = core::cell::RefCell::new(None);
    let mut unconfirmed = false;
    let settled = |verdict, events, time, record: &Record<Recorded<'a>>| {
        let transient = match &verdict {
            MachineVerdict::Chaotic { .. } | MachineVerdict::Undecided { .. } => None,
            _ => record.was_chaotic(&system).or_else(|| over.take()),
        };
        Ok(Some(MachineSettled { verdict, events, time, transient }))
    };
    let most = options.max_impacts as usize;
    while record.count() < most || options.extend && record.undecided_measurement() && record.count() < 3 * most {
        if !go_on() {
            return Ok(None);
        }
        let before = motion.time();
        let Some((step, seen)) = Step::next(&mut motion) else { break };
        let time = motion.time();
        let interval = step.passage.time();
        events += seen.len() as u64;
        if let Some(end) = motion.end() {
            let verdict = match end {
                MachineEnd::Never => MachineVerdict::NoImpact(MachineTail::end(motion.place())),
                MachineEnd::Stuck => MachineVerdict::Stuck(MachineTail::end(motion.place())),
                end => MachineVerdict::Undecided {
                    why: MachineUndecided::Ended(end),
                    spectrum: record.latest(&system),
                    events,
                },
            };
            let decided = matches!(verdict, MachineVerdict::NoImpact(_) | MachineVerdict::Stuck(_));
            return settled(verdict, events, if decided { before } else { time }, &record);
        }
        let (x, v) = system.frame.sizes(&step.begin);
        sizes.push_back((x, v));
        if sizes.len() > RECENT {
            sizes.pop_front();
        }
        system.sizes.set(sizes.iter().fold((0.0, 0.0), |(a, b), (x, v)| (x.max(a), v.max(b))));
        let step = Arc::new(step);
        record.push(options, step.clone(), interval);
        // a rest can make a motion forget its past: it is the same from one release to another, however far apart
        if step.releases() {
            let earlier = releases.iter().position(|(earlier, _)| earlier.passage.guards == step.passage.guards);
            if let Some((earlier, then)) = earlier.map(|at| releases.swap_remove(at))
                && system.distance(&step, &earlier) < FORGOTTEN
            {
                if let Some(cycle) = system.same(&step, time - then) {
                    return settled(MachineVerdict::Periodic(cycle), events, time, &record);
                }
                if system.rounding_decides(&step, time - then) {
                    // from this release the motion is always the same, and no longer run tells more of it
                    let why = MachineUndecided::Unconfirmed;
                    let verdict = MachineVerdict::Undecided { why, spectrum: record.latest(&system), events };
                    return settled(verdict, events, time, &record);
                }
                unconfirmed |= step.was_still();
            }
            if step.was_still() {
                if let Some(spectrum) = record.was_chaotic(&system) {
                    over.replace(Some(spectrum));
                }
                record.forget();
            }
            releases.push((step.clone(), time));
        }
        if record.count().is_multiple_of(64) {
            system.frame.keep(&motion);
        }
        match record.decide(&system, options, &step, interval) {
            Some(Shown::Cycle(cycle)) => {
                return settled(MachineVerdict::Periodic(cycle), events, time, &record);
            }
            // chaos of a machine is often a transient of thousands of events: the motion is followed to the end of the budget
            Some(Shown::Chaos(spectrum)) => {
                over.replace(Some(spectrum));
            }
            None => {}
        }
    }
    let last = record.returns.last().map(|(step, _)| step.clone());
    let verdict = match (last.and_then(|step| record.look(&system, options, &step)), record.chaos(&system)) {
        (Some(cycle), _) => MachineVerdict::Periodic(cycle),
        (None, Some(spectrum)) if !unconfirmed => {
            let tail = MachineTail::last(&record.returns, motion.place());
            MachineVerdict::Chaotic { spectrum, events, tail }
        }
        (None, _) => {
            let why = if unconfirmed { MachineUndecided::Unconfirmed } else { MachineUndecided::Events };
            MachineVerdict::Undecided { why, spectrum: record.latest(&system), events }
        }
    };
    settled(verdict, events, motion.time(), &record)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineParts;
    use crate::scenario;
    use crate::system::Start;
    use crate::verdict::{Verdict, settle};

    fn of(osc: &crate::Oscillator) -> Machine {
        let mut parts = MachineParts::new(["mass"])
            .with_mass(0, 1.0)
            .with_link(&[1.0], 1.0, 2.0 * osc.damping())
            .with_frequency(osc.beta())
            .with_force(0, 1, 0.0, 1.0);
        for (side, stop) in osc.stops() {
            parts = parts.with_rigid_stop(&format!("{side:?}"), &[side.sign()], stop.gap, stop.restitution);
        }
        Machine::new(parts).unwrap()
    }

    /// The paper's points as machines: the same labels, cycles and multipliers as the oscillator.
    #[test]
    fn the_papers_points() {
        for point in scenario::PAPER {
            let osc = point.oscillator();
            let machine = of(&osc);
            for (x, v) in [(0.0, 0.0), (-2.0, 0.0), (0.1, -1.0)] {
                let start = Start { x, v, phase: 0.0 };
                let expected = settle(&osc, start, &SettleOptions::default()).verdict;
                let own = MachineStart { q: vec![x], qdot: vec![v], phase: 0.0, ..MachineStart::default() };
                let found = settle_unreduced(&machine, &own, &SettleOptions::default()).unwrap().verdict;
                assert_eq!(found.label(), expected.label(), "{} from {x} {v}", point.name);
                if let (MachineVerdict::Periodic(cycle), Verdict::Periodic(of)) = (&found, &expected) {
                    assert!(cycle.residual < 1e-12);
                    assert!((cycle.fastest() - of.fastest()).abs() < 1e-11, "{} {}", cycle.fastest(), of.fastest());
                    for (a, b) in cycle.multipliers.iter().zip(of.multipliers) {
                        let apart = (a.re - b.re).abs() + (a.im - b.im).abs();
                        assert!(apart < 1e-9 || of.multipliers[0].modulus() == 0.0 && apart < 1e-3, "{a:?} {b:?}");
                    }
                }
                if let (MachineVerdict::Chaotic { spectrum, .. }, Verdict::Chaotic(chaos)) = (&found, &expected) {
                    let (a, b) = (spectrum.exponents[0], chaos.spectrum.exponents[0]);
                    assert!((a.value - b.value).abs() < a.error + b.error, "{a:?} {b:?}");
                }
            }
        }
    }
}
