//! Many starts of machines: the distinct motions, and the motion of each start.
//!
//! A machine that is an oscillator settles its starts as one: side by side in lanes, those of several machines beside each other,
//! and with the trapping regions of cycles that are known. Only the distinct motions are converted to verdicts on the machine.
//! All other starts are settled one after another. The verdict on a start is that of [`settle_machine`](super::settle_machine)
//! either way, and a motion has the verdict on the first start that leads to it.

use super::super::attractors::{CountedMotion, SAME};
use super::super::each::{Counted, settle_each};
use super::super::many::{KnownAttractors, settle_many};
use super::super::options::SettleOptions;
use super::super::outcome::Verdict;
use super::super::settlement::Settlement as OscillatorSettlement;
use super::reduced::{Converted, Reduced};
use super::settle::settle_alone;
use crate::events;
use crate::lanes::Width;
use crate::machine::Machine;
use crate::system::Start;

/// The motions to which starts of one machine lead.
#[derive(Clone, Debug, Default)]
pub struct Settlement {
    /// The distinct motions, in the order of the first start that leads to each.
    pub motions: Vec<CountedMotion<Machine>>,
    /// The index of its motion for each start; `None` for a start that is not allowed.
    pub cells: Vec<Option<u32>>,
    /// For each start of a chaotic motion the number of events over which chaos was seen.
    pub seen: Vec<Option<u64>>,
}

/// What is known of a machine before many starts are settled: the cycles that have trapping regions. Empty unless the machine is an
/// oscillator.
#[derive(Clone, Debug, Default)]
pub struct KnownMotions {
    attractors: KnownAttractors,
    converted: Vec<(Verdict, Converted)>,
}

impl KnownMotions {
    /// Settles these starts one by one, if the machine is an oscillator, and keeps the cycles that have a trapping region.
    #[must_use]
    pub fn survey(machine: &Machine, starts: &[events::Start], options: &SettleOptions) -> Self {
        let Some(reduced) = Reduced::new(machine, options) else { return Self::default() };
        let plain = starts.iter().filter_map(|start| reduced.start(start));
        let attractors = KnownAttractors::survey(reduced.oscillator(), plain, options);
        let converted = attractors.verdicts().map(|of| (of.clone(), reduced.converted(of)));
        Self { converted: converted.collect(), attractors }
    }
}

/// Settles starts of one machine; `None` if stopped. `tick` is called for each start, and stops the computation if it returns true;
/// `go_on` at every step of a motion that the machine follows itself, and stops it if it returns false.
///
/// ```
/// use vibroimpact::events::Start;
/// use vibroimpact::lanes::Width;
/// use vibroimpact::machine::{Machine, MachineParts};
/// use vibroimpact::verdict::{KnownMotions, SettleOptions, settle_machine_many};
/// // S of the 1971 paper: two motions coexist
/// let parts = MachineParts::new(["mass"])
///     .with_mass(0, 1.0)
///     .with_link(&[1.0], 1.0, 0.0)
///     .with_frequency(1.0 / 1.3)
///     .with_force(0, 1, 0.0, 1.0)
///     .with_rigid_stop("stop", &[1.0], 0.75, 0.5);
/// let machine = Machine::new(parts)?;
/// let start = |k: u32| Start { qdot: vec![0.01 * f64::from(k) - 4.0], ..Start::default() };
/// let starts: Vec<Start> = (0..800).map(start).collect();
/// let options = SettleOptions::default();
/// let known = KnownMotions::survey(&machine, &starts[..8], &options);
/// let settled = settle_machine_many(&machine, &starts, &known, &options, Width::best(), &|| true, &|| false)
///     .unwrap();
/// assert_eq!((settled.motions.len(), settled.cells.len()), (2, 800)); // 1/1 and 2/1
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[must_use]
pub fn settle_machine_many(
    machine: &Machine,
    starts: &[events::Start],
    known: &KnownMotions,
    options: &SettleOptions,
    width: Width,
    go_on: &dyn Fn() -> bool,
    tick: &dyn Fn() -> bool,
) -> Option<Settlement> {
    let question = Question::new(machine, starts, (known, options));
    let settlement = question.reduced.as_ref().map(|reduced| {
        let range = 0..question.plain.len() as u64;
        let start = |k: u64| question.start(k);
        settle_many(reduced.oscillator(), range, &start, &known.attractors, options, width, tick)
    });
    question.settle(settlement, go_on, tick)
}

/// Settles the starts of each of several machines; `None` if stopped. `tick` is called for each machine, and stops the computation if
/// it returns true; `go_on` at every step of a motion that a machine follows itself, and stops it if it returns false.
#[must_use]
pub fn settle_each_machine(
    problems: &[(Machine, Vec<events::Start>)],
    options: &SettleOptions,
    width: Width,
    go_on: &dyn Fn() -> bool,
    tick: &dyn Fn() -> bool,
) -> Option<Vec<Settlement>> {
    let none = KnownMotions::default();
    let questions: Vec<Question<'_>> =
        problems.iter().map(|(machine, starts)| Question::new(machine, starts, (&none, options))).collect();
    let counted = |(k, question): (usize, &Question<'_>)| {
        Some((k, (*question.reduced.as_ref()?.oscillator(), question.plain.len() as u64)))
    };
    let (places, systems): (Vec<usize>, Vec<Counted>) = questions.iter().enumerate().filter_map(counted).unzip();
    let mut settlements: Vec<Option<OscillatorSettlement>> = vec![None; questions.len()];
    let start = |system: usize, k: u64| questions[places[system]].start(k);
    let ended = settle_each(&systems, &start, options, false, width, &mut |system, settlement| {
        settlements[places[system]] = Some(settlement);
        tick() || !go_on()
    });
    if !ended {
        return None;
    }
    let settle = |(question, settlement): (&Question<'_>, Option<OscillatorSettlement>)| {
        let found = question.settle(settlement, go_on, &|| false)?;
        // the others have been counted
        (question.reduced.is_some() || !tick()).then_some(found)
    };
    questions.iter().zip(settlements).map(settle).collect()
}

/// The starts of a machine.
struct Question<'a> {
    machine: &'a Machine,
    starts: &'a [events::Start],
    known: &'a KnownMotions,
    options: &'a SettleOptions,
    reduced: Option<Reduced<'a>>,
    /// The starts that the oscillator has, each with its place among all.
    plain: Vec<(usize, Start)>,
}

impl<'a> Question<'a> {
    fn new(
        machine: &'a Machine,
        starts: &'a [events::Start],
        (known, options): (&'a KnownMotions, &'a SettleOptions),
    ) -> Self {
        let reduced = Reduced::new(machine, options);
        let plain = |(place, start)| Some((place, reduced.as_ref()?.start(start)?));
        let plain = starts.iter().enumerate().filter_map(plain).collect();
        Self { machine, starts, known, options, reduced, plain }
    }

    /// A start of the oscillator.
    #[allow(clippy::cast_possible_truncation)] // an index
    fn start(&self, k: u64) -> Start {
        self.plain[k as usize].1
    }

    /// What a motion of the oscillator is of the machine.
    fn converted(&self, of: &Verdict) -> Converted {
        let known = self.known.converted.iter().find(|(known, _)| known.same_as(of, SAME));
        match (known, &self.reduced) {
            (Some((_, converted)), _) => converted.clone(),
            (None, Some(reduced)) => reduced.converted(of),
            (None, None) => Converted::Unknown,
        }
    }

    /// The motions of all starts, where those of the oscillator are settled; `None` if stopped.
    fn settle(
        &self,
        settlement: Option<OscillatorSettlement>,
        go_on: &dyn Fn() -> bool,
        tick: &dyn Fn() -> bool,
    ) -> Option<Settlement> {
        let settlement = settlement.unwrap_or_default();
        if settlement.cells.len() < self.plain.len() {
            return None;
        }
        let converted: Vec<Converted> = settlement.motions.iter().map(|found| self.converted(&found.verdict)).collect();
        let mut leads: Vec<Option<(usize, u64)>> = vec![None; self.starts.len()];
        for (((place, _), cell), ending) in self.plain.iter().zip(&settlement.cells).zip(&settlement.endings) {
            leads[*place] = Some((*cell as usize, u64::from(ending.impacts)));
        }
        let mut found = Settlement::default();
        // the number here of each motion of the oscillator, once it is known
        let mut numbers: Vec<Option<u32>> = vec![None; converted.len()];
        for (start, lead) in self.starts.iter().zip(leads) {
            if let Some((motion, impacts)) = lead
                && let Some(number) = numbers[motion].or_else(|| match &converted[motion] {
                    Converted::Verdict(verdict) => Some(found.number(verdict)),
                    _ => None,
                })
            {
                numbers[motion] = Some(number);
                found.lead(Some(number), Some(impacts));
                continue;
            }
            let own = match settle_alone(self.machine, start, self.options, go_on) {
                Ok(settled) => Some(settled?.verdict),
                Err(_) => None,
            };
            let number = own.as_ref().map(|verdict| found.number(verdict));
            found.lead(number, own.as_ref().and_then(Verdict::seen_events));
            if let (Some((motion, _)), Some(own)) = (lead, &own)
                && matches!(converted[motion], Converted::Kind)
                && own.label() == settlement.motions[motion].verdict.label()
            {
                numbers[motion] = number;
            }
            // those of the oscillator have been counted
            if lead.is_none() && tick() {
                return None;
            }
        }
        Some(found)
    }
}

impl Settlement {
    /// The number of a motion; a new motion is added.
    fn number(&mut self, verdict: &Verdict<Machine>) -> u32 {
        let known = self.motions.iter().position(|found| found.verdict.same_as(verdict, SAME));
        let number = known.unwrap_or_else(|| {
            self.motions.push(CountedMotion { verdict: verdict.clone(), count: 0 });
            self.motions.len() - 1
        });
        u32::try_from(number).unwrap_or(u32::MAX)
    }

    /// The next start leads to a motion, which was followed for so many events.
    fn lead(&mut self, number: Option<u32>, events: Option<u64>) {
        let motion = number.and_then(|number| self.motions.get_mut(number as usize));
        let chaotic = motion.is_some_and(|found| {
            found.count += 1;
            found.verdict.seen_events().is_some()
        });
        self.cells.push(number);
        self.seen.push(events.filter(|_| chaotic));
    }
}
