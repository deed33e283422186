//! Events and verdicts do not depend on how a machine is written.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::Stability;
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};
use vibroimpact_cases::{Budget, Case, DIFFERS, FAMILIES, Rewriting, Standard, changed, rounded};

fn long() -> bool {
    std::env::var("VIBROIMPACT_LONG").is_ok()
}

/// Everyday two machines of each family, written in all ways; with `VIBROIMPACT_LONG=1` 60, more than a thousand together.
#[test]
fn events_do_not_depend_on_names_order_units_and_signs() {
    let budget = Budget { stretches: 40, time: 25.0 };
    let (mut instants, mut wrong) = (0, Vec::new());
    for family in FAMILIES {
        for seed in 0..if long() { 60 } else { 2 } {
            let case = family.case(seed);
            let standard = Standard::new(&case, budget);
            for change in Rewriting::ALL {
                match standard.same_written(&case, change, budget) {
                    Ok(count) => instants += count,
                    Err(_) if DIFFERS.contains(&(family.name, seed)) => {}
                    Err(what) => wrong.push(format!("{} {seed} {what}", family.name)),
                }
            }
        }
    }
    println!("{instants} instants compared");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
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

/// Whether rounding errors can give this verdict on a case: one of the motions whose numbers are changed by some roundings, each by
/// itself, has it.
fn is_of_a_rounding(case: &Case, verdict: &str, options: &SettleOptions) -> bool {
    (0..ROUNDED).any(|seed| {
        let (machine, start) = rounded(case, seed);
        // with roundings a start can lie beyond a stop that it touches
        settle_machine(&machine, &start, options).is_ok_and(|settled| settled.verdict.label() == verdict)
    })
}

/// The number of these motions.
const ROUNDED: u64 = 60;

/// The verdict on a motion, and its label.
fn settled((machine, start): (&Machine, &Start), options: &SettleOptions) -> (Verdict<Machine>, String) {
    let verdict = settle_machine(machine, start, options).unwrap().verdict;
    let label = verdict.label().into_owned();
    (verdict, label)
}

/// Whether two verdicts differ only in that one of them needs more than the budget: with `LONGER` times as much the motions have one
/// verdict, which is not `undecided`.
fn need_more(one: (&Machine, &Start), other: (&Machine, &Start), twice: bool, options: &SettleOptions) -> bool {
    let more = SettleOptions::at_most(LONGER * options.max_impacts);
    let (of_one, of_other) = (settled(one, &more).1, label(&settled(other, &more).1, twice));
    of_one == of_other && of_one != "undecided"
}

/// By how much the budget is extended.
const LONGER: u32 = 4;

/// A verdict does not depend on how the machine is written, as far as the motion does not: after some tens of events of a chaotic motion,
/// rounding errors decide where it is, when a transient ends, and in which motion, and whether an exponent exceeds its
/// error bar at the end of the budget. So where one verdict is `undecided`, both must be the same with a larger budget; where they differ otherwise,
/// the other one must be that of a motion of the same machine whose numbers differ by roundings.
#[test]
fn verdicts_do_not_depend_on_names_order_units_and_signs() {
    let options = SettleOptions::at_most(if long() { 4000 } else { 1000 });
    let mut wrong = Vec::new();
    for family in FAMILIES {
        for seed in 0..if long() { 60 } else { 1 } {
            let case = family.case(seed);
            let plain = (&case.machine, &case.start);
            let (verdict, standard) = settled(plain, &options);
            // a neutral motion does not settle: rounding errors decide whether it closes within the budget
            let neutral = verdict.stability(&case.machine) == Some(Stability::Neutral);
            for change in Rewriting::ALL {
                let again = changed(&case, change);
                let (again, twice) = ((&again.machine, &again.start), change == Rewriting::Twice);
                let verdict = label(&settled(again, &options).1, twice);
                if verdict == standard || neutral && verdict == "undecided" {
                    continue;
                }
                let undecided = verdict == "undecided" || standard == "undecided";
                let explained = undecided && need_more(plain, again, twice, &options)
                    || is_of_a_rounding(&case, &verdict, &options);
                if !explained {
                    wrong.push(format!("{} {seed} {change:?}: {verdict} instead of {standard}", family.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
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

/// A column of three bodies on a floor comes to rest, however it is written: the lower two collapse again and again, ever more
/// gently, at gaps below the rounding errors of their coordinates. Rounding errors made a cycle of it that did not end.
#[test]
fn columns_collapse_to_rest_in_any_writing() {
    let family = vibroimpact_cases::DrawnFamily::named("columns").unwrap();
    let options = SettleOptions::at_most(1000);
    for seed in [8, 11] {
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
