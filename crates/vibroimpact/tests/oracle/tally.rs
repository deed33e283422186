//! Many questions on all cores, and the table of what came out.

use super::case::Case;
use super::referee::{Fault, Passed};
use core::fmt;
use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicU64, Ordering};
use vibroimpact::flight::Contact;

/// Counts by kind, the worst errors, and every wrong answer.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    pub(crate) impacts: u64,
    pub(crate) beyond: u64,
    pub(crate) grazing: u64,
    pub(crate) never: u64,
    pub(crate) until: u64,
    pub(crate) stays: u64,
    worst: f64,
    worst_case: Option<Case>,
    pub(crate) faults: Vec<(Case, Fault)>,
}

impl Tally {
    pub(crate) fn add(&mut self, case: Case, verdict: Result<Passed, Fault>) {
        let mut measured = |units: f64| {
            if units > self.worst {
                (self.worst, self.worst_case) = (units, Some(case));
            }
        };
        match verdict {
            Ok(Passed::Impact { units, .. }) => {
                self.impacts += 1;
                measured(units);
            }
            Ok(Passed::Beyond { units }) => {
                self.beyond += 1;
                measured(units);
            }
            Ok(Passed::Grazing { .. }) => self.grazing += 1,
            Ok(Passed::Never) => self.never += 1,
            Ok(Passed::NoneUntil) => self.until += 1,
            Ok(Passed::Stays) => self.stays += 1,
            Err(fault) => self.faults.push((case, fault)),
        }
    }

    /// An answer that another search gave as well.
    pub(crate) fn count(&mut self, answer: &Contact) {
        match answer {
            Contact::Impact { .. } => self.impacts += 1,
            Contact::Grazing { .. } => self.grazing += 1,
            Contact::Never(_) => self.never += 1,
            Contact::NoneUntil(_) => self.until += 1,
            Contact::Contact { .. } => self.stays += 1,
        }
    }

    pub(crate) fn join(&mut self, other: Self) {
        self.impacts += other.impacts;
        self.beyond += other.beyond;
        self.grazing += other.grazing;
        self.never += other.never;
        self.until += other.until;
        self.stays += other.stays;
        if other.worst > self.worst {
            (self.worst, self.worst_case) = (other.worst, other.worst_case);
        }
        self.faults.extend(other.faults);
    }

    pub(crate) fn total(&self) -> u64 {
        let wrong = self.faults.len() as u64;
        self.impacts + self.beyond + self.grazing + self.never + self.until + self.stays + wrong
    }

    /// Fails with the list of the wrong answers.
    pub(crate) fn expect_no_fault(&self) {
        let mut kinds = BTreeMap::new();
        for (_, fault) in &self.faults {
            *kinds.entry(fault.kind()).or_insert(0) += 1;
        }
        let few = self.faults.iter().take(25);
        let shown: Vec<String> = few.map(|(case, fault)| format!("{case}\n    {fault:?}")).collect();
        assert!(kinds.is_empty(), "{} wrong answers: {kinds:?}\n{}", self.faults.len(), shown.join("\n"));
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "questions            {:>9}", self.total())?;
        writeln!(f, "impacts              {:>9}", self.impacts)?;
        writeln!(f, "impacts past horizon {:>9}", self.beyond)?;
        writeln!(f, "grazing contacts     {:>9}", self.grazing)?;
        writeln!(f, "never                {:>9}", self.never)?;
        writeln!(f, "none until           {:>9}", self.until)?;
        writeln!(f, "stays on the stop    {:>9}", self.stays)?;
        writeln!(f, "wrong                {:>9}", self.faults.len())?;
        writeln!(f, "worst time error     {:>9.3} (unit in the last place x condition; 8 allowed)", self.worst)?;
        self.worst_case.map_or(Ok(()), |case| writeln!(f, "  at {case}"))
    }
}

/// Runs `ask` on every index below `count`, in chunks, on all cores, and joins the tallies.
pub(crate) fn on_all_cores(count: u64, chunk: u64, ask: impl Fn(u64, &mut Tally) + Sync) -> Tally {
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
    let next = AtomicU64::new(0);
    let work = || {
        let mut tally = Tally::default();
        loop {
            let first = next.fetch_add(chunk, Ordering::Relaxed);
            if first >= count {
                return tally;
            }
            for index in first..(first + chunk).min(count) {
                ask(index, &mut tally);
            }
        }
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let mut all = Tally::default();
        for worker in workers {
            match worker.join() {
                Ok(tally) => all.join(tally),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        all
    })
}
