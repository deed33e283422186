//! The verdict on the motion of a machine from a start.

use super::super::options::SettleOptions;
use super::super::record::{Record, Shown};
use super::super::recurring::Recurring;
use super::super::settle::settle_while;
use super::outcome::{MachineSettled, MachineUndecided, MachineVerdict};
use super::reduced::Reduced;
use super::returns::{Recorded, Step};
use super::tail::MachineTail;
use crate::events::{MachineEnd, MachineMotion, MachineStart};
use crate::machine::{Machine, MachineError};
use crate::orbit::MachineFrame;
use std::sync::Arc;

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
    let system = Recorded::new(MachineFrame::new(machine));
    let mut motion = MachineMotion::new(machine, start, system.frame.limits())?;
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
