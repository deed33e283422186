//! The verdict on the motion of a machine from a start.

use super::super::options::SettleOptions;
use super::super::outcome::{Settled, Undecided, UndecidedCause, Verdict};
use super::super::record::Record;
use super::super::recurring::Recurring;
use super::super::settle::{Followed, settle_while};
use super::fading::Fading;
use super::outcome::State;
use super::reduced::Reduced;
use super::returns::{Recorded, Step};
use crate::events;
use crate::events::{End, Motion};
use crate::machine::{Machine, MachineError};
use crate::orbit::MachineFrame;
use crate::system::Start;
use std::collections::VecDeque;
use std::sync::Arc;

/// The verdict on the motion of `machine` from `start`. In the options an impact stands for an event, and the limits of
/// the search of the oscillator are not used.
///
/// A machine that [is an oscillator](Machine::reduced) is followed as that: the options then mean what they mean for
/// [`settle`](crate::verdict::settle()), events are impacts, and chaos is decided as early as there. What the oscillator does not
/// decide for the machine, and the motion from a start that says what its contacts do, is followed as that of any machine.
///
/// ```
/// use vibroimpact::events::Start;
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
/// let settled = settle_machine(&machine, &Start::default(), &SettleOptions::default())?;
/// assert_eq!(settled.verdict.label(), "4/1");
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
///
/// # Errors
/// [`MachineError`] for an invalid start.
pub fn settle_machine(
    machine: &Machine,
    start: &events::Start,
    options: &SettleOptions,
) -> Result<Settled<Machine>, MachineError> {
    unstopped(settle_machine_while(machine, start, options, &|| true))
}

/// The longest flight of a machine that is searched for a verdict: 10 000 radians of the forcing, without forcing of the slowest
/// mode with all stops open. Of free bodies it is a time of 10 000.
#[must_use]
pub fn longest_flight(machine: &Machine) -> f64 {
    MachineFrame::new(machine).limits().time
}

/// The same, but stopped when `go_on` returns false, and then `None`. `go_on` is called at every step.
///
/// # Errors
/// [`MachineError`] for an invalid start.
pub fn settle_machine_while(
    machine: &Machine,
    start: &events::Start,
    options: &SettleOptions,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<Settled<Machine>>, MachineError> {
    let reduced = Reduced::of(machine, start, options);
    settle_as(reduced.as_ref(), machine, start, options, go_on)
}

/// The same with the oscillator that the machine is, if it is one, and its start.
pub(crate) fn settle_as(
    reduced: Option<&(Reduced<'_>, Start)>,
    machine: &Machine,
    start: &events::Start,
    options: &SettleOptions,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<Settled<Machine>>, MachineError> {
    if let Some((reduced, from)) = reduced {
        let Some(found) = settle_while(reduced.oscillator(), *from, options, go_on) else { return Ok(None) };
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
    start: &events::Start,
    options: &SettleOptions,
) -> Result<Settled<Machine>, MachineError> {
    unstopped(settle_alone(machine, start, options, &|| true))
}

/// The verdict on a motion that was not stopped.
fn unstopped(found: Result<Option<Settled<Machine>>, MachineError>) -> Result<Settled<Machine>, MachineError> {
    let nothing = Undecided { why: UndecidedCause::Budget, impacts: 0, spectrum: None };
    let nothing = || Settled { verdict: Verdict::Undecided(nothing), impacts: 0, time: 0.0, transient: None };
    Ok(found?.unwrap_or_else(nothing))
}

/// How many events of a machine stand for one impact of the longest period that is searched for.
const EVENTS_PER_IMPACT: u32 = 8;
/// Two releases at states that differ by less are the same.
const FORGOTTEN: f64 = 1e-9;
/// The number of latest steps whose size distances are relative to.
const RECENT: usize = 64;

/// The verdict on the motion that the machine follows itself.
pub(super) fn settle_alone(
    machine: &Machine,
    start: &events::Start,
    options: &SettleOptions,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<Settled<Machine>>, MachineError> {
    // chatters and contacts take many events in each period
    let options = &SettleOptions { longest: options.longest.saturating_mul(EVENTS_PER_IMPACT), ..*options };
    let mut follow = Follow::new(machine, start)?;
    let verdict = follow.verdict(options, &|_| !go_on());
    Ok(verdict.map(|verdict| follow.record.settled(&follow.system, verdict, follow.time)))
}

/// The record of a motion that a machine follows itself.
struct Follow<'a> {
    system: Recorded<'a>,
    motion: Motion<'a>,
    record: Record<Recorded<'a>>,
    /// The sizes of coordinates and velocities at the latest steps.
    sizes: VecDeque<(f64, f64)>,
    time: f64,
    /// The latest release from each stop, and its time.
    releases: Vec<(Arc<Step>, f64)>,
    fading: Fading,
}

impl<'a> Follow<'a> {
    fn new(machine: &'a Machine, start: &events::Start) -> Result<Self, MachineError> {
        let system = Recorded::new(MachineFrame::new(machine));
        let motion = Motion::new(machine, start, system.frame.limits())?;
        Ok(Self {
            system,
            motion,
            record: Record::default(),
            sizes: VecDeque::new(),
            time: 0.0,
            releases: Vec::new(),
            fading: Fading::default(),
        })
    }

    /// Includes a step in the size of the motion, to which distances are relative.
    fn measure_size(&mut self, step: &Step) {
        self.sizes.push_back(self.system.frame.sizes(&step.begin));
        if self.sizes.len() > RECENT {
            self.sizes.pop_front();
        }
        self.system.sizes.set(self.sizes.iter().fold((0.0, 0.0), |(a, b), (x, v)| (x.max(a), v.max(b))));
    }

    /// What a step to a release from rest decides. A rest can make a motion forget its past: it is the same from one release to
    /// another, however far apart.
    fn release(&mut self, step: &Arc<Step>) -> Option<Verdict<Machine>> {
        if !step.releases() {
            return None;
        }
        let earlier = self.releases.iter().position(|(earlier, _)| earlier.passage.guards == step.passage.guards);
        if let Some((earlier, then)) = earlier.map(|at| self.releases.swap_remove(at))
            && self.system.distance(step, &earlier) < FORGOTTEN
        {
            if let Some(cycle) = self.system.same(step, self.time - then) {
                return Some(Verdict::Periodic(cycle));
            }
            if self.system.rounding_decides(step, self.time - then) {
                // from this release the motion is always the same, and a longer run shows no more of it
                return Some(self.record.undecided(&self.system, UndecidedCause::Unconfirmed));
            }
            self.record.unconfirmed |= step.was_still();
        }
        if step.was_still() {
            self.record.end_chaos(&self.system);
            self.record.forget();
        }
        self.releases.push((step.clone(), self.time));
        None
    }
}

impl<'a> Followed for Follow<'a> {
    type Of = Recorded<'a>;

    fn record(&mut self) -> (&Recorded<'a>, &mut Record<Recorded<'a>>) {
        (&self.system, &mut self.record)
    }

    fn step(&mut self, options: &SettleOptions) -> Option<Verdict<Machine>> {
        let Some((step, seen)) = Step::next(&mut self.motion) else {
            return Some(self.record.last_look(&self.system, options));
        };
        self.record.events += seen.len() as u64;
        self.record.steps += 1;
        let before = core::mem::replace(&mut self.time, self.motion.time());
        if let Some(end) = self.motion.end() {
            let last = State::of(self.motion.place());
            let verdict = match end {
                End::Never => Verdict::NoImpact(last),
                End::NoEventWithin if Fading::touches(&self.system.frame, &seen) => {
                    Verdict::NoImpact(State { fades: true, ..last })
                }
                End::Stuck => Verdict::Stuck(last),
                end => return Some(self.record.undecided(&self.system, UndecidedCause::Ended(end))),
            };
            self.time = before;
            return Some(verdict);
        }
        if self.fading.includes(&self.system.frame, &step.end, self.time) {
            return Some(Verdict::NoImpact(State { fades: true, ..State::of(self.motion.place()) }));
        }
        self.measure_size(&step);
        let (interval, step) = (step.passage.time(), Arc::new(step));
        self.record.push(options, step.clone(), interval);
        let released = self.release(&step);
        if released.is_some() {
            return released;
        }
        if self.record.count().is_multiple_of(64) {
            self.system.frame.keep(&self.motion);
        }
        self.record.decide(&self.system, options, &step, interval)
    }

    fn returned(&self) -> bool {
        true
    }
}
