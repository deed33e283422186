//! Events and verdicts do not depend on how a machine is written.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]
#![allow(clippy::print_stdout, reason = "what is wrong is told as it is found: a long run takes minutes")]

use core::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{Stability, machine::Cycle};
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};
use vibroimpact_cases::{Budget, Case, FAMILIES, Rewriting, Standard, changed, rounded};

/// Many small vectors are allocated for each event.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn long() -> bool {
    std::env::var("VIBROIMPACT_LONG").is_ok()
}

/// The numbers of the machines of each family: the long form takes 60, or a part of them, as `VIBROIMPACT_LONG=20..40`.
fn seeds(everyday: Range<u64>) -> Range<u64> {
    let Ok(asked) = std::env::var("VIBROIMPACT_LONG") else { return everyday };
    asked.split_once("..").map_or(0..60, |(from, to)| from.parse().unwrap()..to.parse().unwrap())
}

/// What is wrong with these machines of each family, which the threads check one after another; told as it is found. The long form
/// tells which machines take long.
fn in_threads(seeds: Range<u64>, check: impl Fn(&Case) -> Vec<String> + Sync) -> Vec<String> {
    let cases: Vec<Case> = seeds.flat_map(|seed| FAMILIES.iter().map(move |family| family.case(seed))).collect();
    let next = AtomicUsize::new(0);
    let work = || -> Vec<String> {
        let cases = core::iter::from_fn(|| cases.get(next.fetch_add(1, Ordering::Relaxed)));
        let told = |case: &Case| {
            let begin = Instant::now();
            let wrong = check(case);
            wrong.iter().for_each(|wrong| println!("{wrong}"));
            let taken = begin.elapsed();
            if long() && taken.as_secs() >= 5 {
                println!("{} {} took {:.0} s", case.family, case.seed, taken.as_secs_f64());
            }
            wrong
        };
        cases.flat_map(told).collect()
    };
    let threads = std::thread::available_parallelism().map_or(1, Into::into);
    std::thread::scope(|scope| {
        let all: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        all.into_iter().flat_map(|one| one.join().unwrap()).collect()
    })
}

/// Everyday two machines of each family, written in all ways; with `VIBROIMPACT_LONG=1` 60, more than a thousand together.
#[test]
fn events_do_not_depend_on_names_order_units_and_signs() {
    let budget = Budget { stretches: 40, time: 25.0 };
    let instants = AtomicUsize::new(0);
    let wrong = in_threads(seeds(0..2), |case| {
        let standard = Standard::new(case, budget);
        let compared = Rewriting::ALL.map(|change| standard.same_written(case, change, budget));
        let what = |compared| match compared {
            Ok(count) => {
                instants.fetch_add(count, Ordering::Relaxed);
                None
            }
            Err(what) => Some(format!("{} {} {what}", case.family, case.seed)),
        };
        compared.into_iter().filter_map(what).collect()
    });
    println!("{} instants compared", instants.load(Ordering::Relaxed));
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// Machines whose events have depended on how they are written: the times of sums of impacts on several stops or with joints in
/// between, to 1e-11, and which of two bodies that hold and touch bears a load.
#[test]
fn mended_machines_move_alike_in_any_writing() {
    let budget = Budget { stretches: 40, time: 25.0 };
    for (name, seed) in [("columns", 53), ("friction", 25), ("friction", 44), ("duplicates", 46), ("friction", 35)] {
        let case = vibroimpact_cases::DrawnFamily::named(name).unwrap().case(seed);
        let standard = Standard::new(&case, budget);
        for change in Rewriting::ALL {
            assert_eq!(standard.same_written(&case, change, budget).err(), None, "{name} {seed}");
        }
    }
}

/// A machine with a stop or a joint twice moves as the one with it once.
#[test]
fn duplicates_move_as_originals() {
    let budget = Budget { stretches: 40, time: 25.0 };
    let family = vibroimpact_cases::DrawnFamily::named("duplicates").unwrap();
    let mut wrong = Vec::new();
    for seed in 0..if long() { 200 } else { 20 } {
        let case = family.case(seed);
        let plain = Case { machine: case.same_as.clone().unwrap(), same_as: None, ..case.clone() };
        if let Err(what) = Standard::new(&plain, budget).same_motion(&case.machine, &case.start, budget) {
            wrong.push(format!("{seed}: {what}"));
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// The label of a verdict, with half the closings of a machine beside itself.
fn label(verdict: &str, twice: bool) -> String {
    match verdict.split_once('/') {
        Some((closings, periods)) if twice => match closings.parse::<u32>() {
            Ok(closings) if closings % 2 == 0 => format!("{}/{periods}", closings / 2),
            _ => verdict.to_owned(),
        },
        _ => verdict.to_owned(),
    }
}

/// The verdict on a motion, and its label.
fn settled((machine, start): (&Machine, &Start), options: &SettleOptions) -> (Verdict<Machine>, String) {
    let verdict = settle_machine(machine, start, options).unwrap().verdict;
    let label = verdict.label().into_owned();
    (verdict, label)
}

/// Labels of verdicts on a case beside that of its own motion, computed when they are needed, and once for all writings.
struct Others<'a> {
    case: &'a Case,
    options: &'a SettleOptions,
    /// Those of motions whose numbers are changed by some roundings, each by itself.
    rounded: Vec<String>,
    /// That of the motion with a larger budget.
    later: Option<String>,
}

impl<'a> Others<'a> {
    const fn new(case: &'a Case, options: &'a SettleOptions) -> Self {
        Self { case, options, rounded: Vec::new(), later: None }
    }

    /// Whether rounding errors can give this verdict: one of so many of these motions has it.
    fn are_of_a_rounding(&mut self, verdict: &str, most: u64) -> bool {
        self.rounded.iter().any(|known| known == verdict)
            || (self.rounded.len() as u64..most).any(|seed| {
                let (machine, start) = rounded(self.case, seed);
                // with roundings a start can lie beyond a stop that it touches
                let settled = settle_machine(&machine, &start, self.options);
                let label = settled.map_or_else(|_| String::new(), |settled| settled.verdict.label().into_owned());
                let same = label == verdict;
                self.rounded.push(label);
                same
            })
    }

    /// Whether another verdict differs only in that one of them needs more than the budget: with [`LONGER`] times as much the motions
    /// have one verdict, which is not `undecided`.
    fn need_more(&mut self, other: (&Machine, &Start), twice: bool) -> bool {
        let more = SettleOptions::at_most(LONGER * self.options.max_impacts);
        let own = self.later.get_or_insert_with(|| settled((&self.case.machine, &self.case.start), &more).1);
        own != "undecided" && *own == label(&settled(other, &more).1, twice)
    }
}

/// The number of motions whose numbers are changed by some roundings, and of those that are tried first.
const ROUNDED: u64 = 60;
const FEW: u64 = 3;
/// By how much the budget is extended.
const LONGER: u32 = 4;

/// A verdict does not depend on how the machine is written, as far as the motion does not: after some tens of events of a chaotic motion,
/// rounding errors decide where it is, when a transient ends, and in which motion, and whether an exponent exceeds its
/// error bar at the end of the budget. So where one verdict is `undecided`, both must be the same with a larger budget; where they differ otherwise,
/// the other one must be that of a motion of the same machine whose numbers differ by roundings.
#[test]
fn verdicts_do_not_depend_on_names_order_units_and_signs() {
    let options = SettleOptions::at_most(if long() { 4000 } else { 1000 });
    // number 0 of `idle` takes longer than all other machines here
    let wrong = in_threads(seeds(1..3), |case| differences(case, &options));
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

fn told(case: &Case, change: Rewriting, what: &str) -> String {
    format!("{} {} {change:?}: {what}", case.family, case.seed)
}

/// How the moduli of the multipliers of two cycles differ if their events have the same phases: then they are one cycle.
fn other_multipliers((one, other): (&Verdict<Machine>, &Verdict<Machine>), twice: bool) -> Option<String> {
    let (Verdict::Periodic(one), Verdict::Periodic(other)) = (one, other) else { return None };
    let sorted = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values
    };
    let phases = |cycle: &Cycle| sorted(cycle.events.iter().map(|event| event.phase).collect());
    let moduli = |cycle: &Cycle| sorted(cycle.multipliers.iter().map(|multiplier| multiplier.modulus()).collect());
    let near = |one: &[f64], other: &[f64]| {
        let other: Vec<f64> = other.iter().copied().step_by(if twice { 2 } else { 1 }).collect();
        one.len() == other.len()
            && one.iter().zip(other).all(|(a, b)| *a == b || (a - b).abs() < NEAR * (1.0 + a.abs()))
    };
    let (own, theirs) = (moduli(one), moduli(other));
    // without forcing that along the motion is left out, of both parts together
    if theirs.len() != if twice { 2 } else { 1 } * own.len() {
        return None;
    }
    let same = near(&phases(one), &phases(other));
    // where a rounding error becomes as large within one period as what is compared here, multipliers are not known
    if own.iter().chain(&theirs).any(|modulus| modulus * f64::EPSILON > NEAR / 100.0) {
        let stable = |cycle: &Cycle| cycle.stability();
        return (stable(one) != stable(other)).then(|| format!("{:?} instead of {:?}", stable(other), stable(one)));
    }
    (same && !near(&own, &theirs)).then(|| format!("multipliers {theirs:?} instead of {own:?}"))
}

/// Multipliers and phases of one cycle differ by less.
const NEAR: f64 = 1e-5;

/// The writings of a case whose verdict differs from its own by more than rounding errors explain.
fn differences(case: &Case, options: &SettleOptions) -> Vec<String> {
    let (verdict, standard) = settled((&case.machine, &case.start), options);
    // a neutral motion does not settle: rounding errors decide whether it closes within the budget
    let neutral = verdict.stability(&case.machine) == Some(Stability::Neutral);
    let mut others = Others::new(case, options);
    let mut wrong = Vec::new();
    for change in Rewriting::ALL {
        let again = changed(case, change);
        let (again, twice) = ((&again.machine, &again.start), change == Rewriting::Twice);
        let (motion, verdict_again) = settled(again, options);
        let verdict_again = label(&verdict_again, twice);
        if verdict_again == standard {
            wrong.extend(other_multipliers((&verdict, &motion), twice).map(|what| told(case, change, &what)));
        }
        if verdict_again == standard || neutral && verdict_again == "undecided" {
            continue;
        }
        let verdict = verdict_again;
        let undecided = verdict == "undecided" || standard == "undecided";
        // a few roundings cost less than a longer motion
        let few = others.are_of_a_rounding(&verdict, FEW);
        if !(few || undecided && others.need_more(again, twice) || others.are_of_a_rounding(&verdict, ROUNDED)) {
            wrong.push(told(case, change, &format!("{verdict} instead of {standard}")));
        }
    }
    wrong
}

/// Machines of parts that do not act on each other, whose verdict has depended on the order of their coordinates: chaos was decided in
/// the last fifth of its measurement by the part of the first one.
#[test]
fn chaos_of_one_part_is_found_in_any_order() {
    let family = vibroimpact_cases::DrawnFamily::named("rotated").unwrap();
    let options = SettleOptions::at_most(4000);
    for seed in [2, 16, 25, 29, 31] {
        let case = family.case(seed);
        let again = changed(&case, Rewriting::Order);
        for (machine, start) in [(&case.machine, &case.start), (&again.machine, &again.start)] {
            assert_eq!(settle_machine(machine, start, &options).unwrap().verdict.label(), "chaotic", "{seed}");
        }
    }
}

/// A chain whose bodies collapse without a round that repeats itself, while forces open some of its contacts. The collapse was told to
/// go on until impacts were as slow as rounding errors, and left gaps as large: its cycle had multipliers of 1e111 in milliseconds,
/// and another period in pounds and inches.
#[test]
fn a_chain_that_collapses_while_contacts_open_has_one_cycle_in_any_writing() {
    let case = vibroimpact_cases::DrawnFamily::named("chains").unwrap().case(11);
    let writings = if long() { &Rewriting::ALL[..7] } else { &Rewriting::ALL[1..2] };
    for writing in writings {
        let again = changed(&case, *writing);
        let settled = settle_machine(&again.machine, &again.start, &SettleOptions::at_most(2000)).unwrap();
        let Verdict::Periodic(cycle) = &settled.verdict else { panic!("{writing:?}: {}", settled.verdict.label()) };
        assert_eq!((cycle.label.to_string().as_str(), cycle.stability()), ("inf/1", Stability::Stable), "{writing:?}");
        let largest = cycle.multipliers[0].modulus();
        assert!((largest - 0.866_407).abs() < 1e-5 && cycle.multipliers[3].modulus() < 1e-12, "{writing:?}: {largest}");
    }
}

/// A column of three bodies on a floor comes to rest, however it is written: the lower two collapse again and again, ever more
/// gently, at gaps below the rounding errors of their coordinates. Rounding errors made a cycle of it that did not end; twice beside
/// itself a column was summed too early, because changes were counted and not the times at which there are some.
#[test]
fn columns_collapse_to_rest_in_any_writing() {
    let family = vibroimpact_cases::DrawnFamily::named("columns").unwrap();
    let options = SettleOptions::at_most(1000);
    for seed in [8, 11, 43] {
        let case = family.case(seed);
        let rewritten = Rewriting::ALL.map(|change| changed(&case, change));
        let others = rewritten.iter().map(|again| (&again.machine, &again.start));
        for own in others.chain([(&case.machine, &case.start)]) {
            assert_eq!(settled(own, &options).1, "stuck", "{seed} {:?}", own.0);
        }
        for roundings in 0..10 {
            let (machine, start) = rounded(&case, roundings);
            assert_eq!(settled((&machine, &start), &options).1, "stuck", "{seed} with roundings {roundings}");
        }
    }
}

/// Bodies that nothing drives, one of which swings on and strikes another ever more gently at the top of its swing: rounding errors
/// decided whether the impacts end, level off at three roundings of the gap for ever, or become touches. Each was another verdict.
#[test]
fn impacts_that_fade_away_have_one_verdict_in_any_writing() {
    let family = vibroimpact_cases::DrawnFamily::named("idle").unwrap();
    let options = SettleOptions::at_most(4000);
    let fading = [3, 6, 19].map(|seed| family.case(seed));
    // nothing says when a body that touches its stops without a load is at rest: one writing ended with `search limit`
    let touching = vibroimpact_cases::DrawnFamily::named("chains").unwrap().case(53);
    for case in fading.into_iter().chain([touching]) {
        let rewritten = Rewriting::ALL.map(|change| changed(&case, change)).map(|again| (again.machine, again.start));
        let writings = rewritten.into_iter().chain((0..if long() { ROUNDED } else { 10 }).map(|k| rounded(&case, k)));
        for (k, (machine, start)) in writings.chain([(case.machine.clone(), case.start.clone())]).enumerate() {
            let verdict = settle_machine(&machine, &start, &options).unwrap().verdict;
            assert!(
                matches!(verdict, Verdict::NoImpact(last) if last.fades()),
                "{} {}, writing {k}: {machine:?}",
                case.family,
                case.seed
            );
        }
    }
}
