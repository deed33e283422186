//! A case: drawn from its number, checked, and reduced if it has a fault.

use proptest::prelude::BoxedStrategy;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A family of cases, and the property that each case must have.
pub trait Property {
    /// The question.
    type Case: Clone + core::fmt::Debug;

    /// The strategy by which cases are drawn.
    fn strategy(&self) -> BoxedStrategy<Self::Case>;

    /// The case in a form in which a user can repeat it.
    fn describe(&self, case: &Self::Case) -> String;

    /// Asks the question and checks the answer.
    ///
    /// # Errors
    /// A message that names the property that does not hold.
    fn check(&mut self, case: &Self::Case) -> Result<(), String>;
}

/// A case with a fault.
#[derive(Clone, Debug)]
pub struct Fault {
    /// The property that does not hold.
    pub why: String,
    /// The smallest case with a fault that was found.
    pub case: String,
}

/// The kind of a fault. Messages that differ only in numbers are of the same kind.
pub(crate) fn kind(why: &str) -> String {
    why.chars().filter(|c| !c.is_ascii_digit()).take(60).collect()
}

/// Maximum number of trials to reduce one case, and their time limit.
const TRIALS: u32 = 60;
const PATIENCE: Duration = Duration::from_secs(8);

/// The source of random numbers of case number `k`.
#[must_use]
pub fn runner(seed: u64, family: &str, k: u64) -> TestRunner {
    let mut bytes = [0_u8; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    bytes[8..16].copy_from_slice(&k.to_le_bytes());
    for (to, from) in bytes[16..].iter_mut().zip(family.bytes()) {
        *to = from;
    }
    let config = Config { failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &bytes))
}

/// Draws a case from the strategy of the property and checks it. `begun` is called with the case before the check. A case with a `known` kind of fault is
/// not reduced.
///
/// # Errors
/// The [`Fault`] that was found.
pub fn run<P: Property>(
    property: &mut P,
    (strategy, mut runner): (&BoxedStrategy<P::Case>, TestRunner),
    known: &mut BTreeSet<String>,
    begun: impl FnOnce(&str),
) -> Result<(), Fault> {
    let drawn = strategy.new_tree(&mut runner);
    let mut tree = drawn.map_err(|why| Fault { why: format!("no case can be drawn: {why}"), case: String::new() })?;
    let case = tree.current();
    begun(&property.describe(&case));
    let Err(mut why) = guarded(property, &case) else { return Ok(()) };
    if !known.insert(kind(&why)) {
        return Err(Fault { why, case: property.describe(&case) });
    }
    let mut smallest = case;
    let limit = Instant::now() + PATIENCE;
    let mut smaller = tree.simplify();
    for _ in 0..TRIALS {
        if !smaller || Instant::now() > limit {
            break;
        }
        let case = tree.current();
        smaller = match guarded(property, &case) {
            Err(sentence) => {
                (why, smallest) = (sentence, case);
                tree.simplify()
            }
            Ok(()) => tree.complicate(),
        };
    }
    Err(Fault { why, case: property.describe(&smallest) })
}

/// The message of the first panic of a case; `None` outside of cases.
static PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Stores the messages of panics within cases, on any thread, for [`run`] instead of printing them.
pub(crate) fn keep_panics() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| match PANIC.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
        Some(kept) if kept.is_empty() => *kept = panic.to_string(),
        Some(_) => {}
        None => usual(panic),
    }));
}

fn keep(text: Option<String>) -> Option<String> {
    core::mem::replace(&mut *PANIC.lock().unwrap_or_else(PoisonError::into_inner), text)
}

fn guarded<P: Property>(property: &mut P, case: &P::Case) -> Result<(), String> {
    keep(Some(String::new()));
    let result = catch_unwind(AssertUnwindSafe(|| property.check(case)));
    let kept = keep(None).unwrap_or_default();
    result.unwrap_or_else(|_| Err(format!("panic: {kept}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Holds for numbers below a hundred, and panics from a thousand on.
    struct Small;

    impl Property for Small {
        type Case = u32;
        fn strategy(&self) -> BoxedStrategy<u32> {
            (0..1_000_000_u32).boxed()
        }
        fn describe(&self, case: &u32) -> String {
            case.to_string()
        }
        fn check(&mut self, case: &u32) -> Result<(), String> {
            assert!(*case < 1000, "a thousand");
            if *case < 100 { Ok(()) } else { Err(format!("{case} is a hundred or more")) }
        }
    }

    #[test]
    fn a_fault_is_found_and_made_smaller() {
        keep_panics();
        let found = (0..20)
            .filter_map(|k| {
                run(&mut Small, (&Small.strategy(), runner(1, "small", k)), &mut BTreeSet::new(), |_| {}).err()
            })
            .collect::<Vec<_>>();
        let _ = std::panic::take_hook();
        assert!(found.len() > 15, "{found:?}");
        assert!(found.iter().any(|fault| fault.case == "100"), "{found:?}");
    }

    #[test]
    fn a_case_follows_from_its_number() {
        let first = |seed, k| Small.strategy().new_tree(&mut runner(seed, "small", k)).unwrap().current();
        assert_eq!(first(1, 2), first(1, 2));
        assert!(first(1, 2) != first(1, 3) && first(1, 2) != first(2, 2));
    }
}
