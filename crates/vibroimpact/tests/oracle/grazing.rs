//! Flights aimed at grazing: a tangency is planted, then missed by a chosen depth. An ordinary run asks one thousand;
//! `VIBROIMPACT_LONG=1` asks ten thousand, the same ones among them.
//!
//! From the stop the speed of departure is solved for, so that the highest point of a later arch comes back to the stop
//! to within the depth; from free starts the stop is put there. Depths run from 1e-1 to 1e-13 on both sides; five
//! hundred more go on to 1e-18, where doubles decide no more and only `Grazing` can be right, or luck. The arch is
//! the first, or a later one that overtops all before it. Rounding the solution to doubles moves the depth by some
//! 1e-16; the referee works with what the doubles are.

use super::case::Case;
use super::exact::Exact;
use super::fixed::Fixed;
use super::long::is_long;
use super::random::Random;
use super::referee::{Fault, Passed, verdict};
use super::starts::{horizon, periods};
use super::tally::{Tally, on_all_cores};
use super::textbook::Solution;
use core::f64::consts::TAU;
use std::sync::atomic::{AtomicU64, Ordering};
use vibroimpact::Side;
use vibroimpact::flight::SearchLimits;

const AIMED: u64 = 500;
const AIMED_LONG: u64 = 10_000;
const FINEST: u64 = 300;
const FINEST_LONG: u64 = 1000;

/// The records of `x` along a flight without stops: highest points above everything before, up to `until`.
fn records(case: &Case, until: f64) -> Vec<Fixed> {
    let open = Case { gap: 1e6, second: None, ..*case };
    let exact = Exact::new(&open);
    let h = Fixed::from_f64(0.5 * exact.cell_length());
    let (mut highest, mut records) = (f64::NEG_INFINITY, Vec::new());
    let turn = exact.solution.factors(h);
    let mut factors = exact.solution.factors(Fixed::ZERO);
    let mut before = exact.solution.node(Fixed::ZERO, &factors);
    while before.s.to_f64() < until {
        factors = exact.solution.advance(&factors, &turn);
        let node = exact.solution.node(before.s + h, &factors);
        if before.v.to_f64() > 0.0
            && node.v.to_f64() <= 0.0
            && let Some(apex) = exact.extremum(Side::Upper, before.s)
            && apex.past > highest
        {
            highest = apex.past;
            records.push(apex.s);
        }
        before = node;
    }
    records
}

/// A flight with a planted tangency, missed by `depth` (negative: cut by that much), and about when it comes.
fn planted(random: &mut Random, depth: f64, on_stop: bool) -> Option<(Case, f64)> {
    let beta = random.beta();
    let zeta = if random.chance(0.7) { 0.0 } else { random.decade(-6.0, 0.0) };
    let gap = random.gap();
    let bare = Case { zeta, ..Case::from_stop(beta, gap, -random.decade(-3.0, 0.7), random.phase()) };
    let until = (25.0 * TAU / beta.min(1.0)).min(80.0);
    if on_stop { from_stop(random, bare, depth, until) } else { free(random, bare, depth, until) }
}

/// The stop where the arch is.
fn free(random: &mut Random, bare: Case, depth: f64, until: f64) -> Option<(Case, f64)> {
    let x = random.uniform(-3.0, 3.0);
    let v = random.sign() * random.decade(-3.0, 0.7);
    let case = Case { x, v, ..bare };
    let records = records(&case, until);
    if records.is_empty() {
        return None;
    }
    let s = random.one_of(&records);
    let exact = Exact::new(&Case { gap: 0.0, ..case });
    let gap = exact.past(&exact.solution.at(s), Side::Upper) + Fixed::from_f64(depth);
    let case = Case { gap: gap.to_f64(), ..case };
    (case.x < case.gap).then_some((case, s.to_f64()))
}

/// The speed of departure for which the arch returns to the stop, by Newton's iteration: the height of an arch changes
/// with the speed by the response $S$ at its top.
fn from_stop(random: &mut Random, bare: Case, depth: f64, until: f64) -> Option<(Case, f64)> {
    let records = records(&bare, until);
    let chosen = usize::try_from(random.next() % 4).expect("small");
    let mut s = *records.get(chosen).or(records.last())?;
    let mut case = bare;
    for _ in 0..40 {
        let exact = Exact::new(&case);
        let apex = exact.extremum(Side::Upper, s)?;
        s = apex.s;
        let mut unit = *exact.solution.data();
        (unit.x, unit.v, unit.force) = (Fixed::ZERO, Fixed::ONE, (Fixed::ZERO, Fixed::ZERO));
        let response = Solution::new(unit).at(s).d.to_f64();
        let step = -(apex.past + depth) / response;
        case.v += step.clamp(-0.5, 0.5);
        if !(case.v < 0.0 && case.v > -20.0) || s.to_f64() < 0.05 {
            return None;
        }
        if step.abs() <= 4.0 * f64::EPSILON * case.v.abs() {
            return Some((case, s.to_f64()));
        }
    }
    None
}

/// The planted tangency is what the flight comes to first: its contact lies on that arch, or after it.
fn reached(verdict: &Result<Passed, Fault>, apex: f64, depth: f64) -> bool {
    match verdict {
        Ok(Passed::Impact { s, .. }) if depth < 0.0 => (s - apex).abs() < 2.0 * depth.abs().sqrt() + 0.1,
        Ok(Passed::Impact { s, .. }) => *s > apex,
        Ok(_) => true,
        Err(_) => false,
    }
}

/// Asks `count` flights missed by depths between these powers of ten.
fn ask(family: u64, count: u64, finest: f64, coarsest: f64) -> Tally {
    let (blurred, aimed) = (AtomicU64::new(0), AtomicU64::new(0));
    let tally = on_all_cores(count, 20, |index, tally| {
        let mut random = Random::new(family, index);
        let depth = random.sign() * random.decade(finest, coarsest);
        let (case, apex) = random.until(|random| planted(random, depth, index % 2 == 0));
        let horizon = horizon(&case, false).min(160.0);
        let mut limits = SearchLimits::default();
        limits.periods = limits.periods.min(periods(&case, 1.1 * horizon));
        let verdict = verdict(&case, limits, horizon);
        aimed.fetch_add(u64::from(reached(&verdict, apex, depth)), Ordering::Relaxed);
        if let Ok(Passed::Grazing { depth, s }) = verdict
            && depth.abs() >= 1e-12
            && s < 50.0
            && case.beta < 3.0
        {
            blurred.fetch_add(1, Ordering::Relaxed);
        }
        tally.add(case, verdict);
    });
    let aimed = aimed.into_inner();
    println!("{tally}planted arch reached {aimed:>9}");
    assert_eq!(tally.total(), count);
    assert!(aimed > count / 2, "most flights come to what was planted first");
    assert_eq!(blurred.into_inner(), 0, "grazing answers at depths of 1e-12 and more, in moderate flights");
    tally
}

#[test]
fn aimed_at_grazing() {
    ask(2, if is_long() { AIMED_LONG } else { AIMED }, -13.0, -1.0).expect_no_fault();
}

#[test]
fn below_what_doubles_decide() {
    let count = if is_long() { FINEST_LONG } else { FINEST };
    let tally = ask(4, count, -18.0, -13.0);
    tally.expect_no_fault();
    assert!(tally.grazing > count / 10, "{} grazing answers", tally.grazing);
}
