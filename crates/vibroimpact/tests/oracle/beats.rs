//! Long flights: free and forced motion that reach a stop only when nearly all of both is in step, so that most of the way is
//! crossed in strides over which neither is evaluated.

use super::case::Case;
use super::long::is_long;
use super::random::Random;
use super::referee::verdict;
use super::tally::on_all_cores;
use core::f64::consts::TAU;
use vibroimpact::flight::SearchLimits;

const FLIGHTS: u64 = 1000;
/// With `VIBROIMPACT_LONG=1`, the same ones among them.
const FLIGHTS_LONG: u64 = 4000;
/// How long a flight the referee follows.
const LONGEST: f64 = 3000.0;

/// A start short of, or on, a stop so far away that the sum of both amplitudes passes it by little.
fn case(random: &mut Random) -> Option<Case> {
    let beta = match random.next() % 4 {
        0 => 1.0 + random.sign() * random.decade(-4.0, -0.3),
        1 => random.uniform(0.02, 0.5),
        2 => random.uniform(1.0, 8.0),
        _ => random.uniform(0.4, 1.6),
    };
    let steady = 1.0 / (1.0 - beta * beta);
    let phase = random.phase();
    let rho = steady.abs() * random.decade(-1.0, 1.0);
    let gap = (rho + steady.abs()) * (1.0 - random.decade(-6.0, -0.5));
    // the free part at this angle
    let angle = random.uniform(0.0, TAU);
    let (x, v) = (steady * phase.sin() + rho * angle.sin(), steady * beta * phase.cos() + rho * angle.cos());
    let zeta = if random.chance(0.1) { random.decade(-6.0, -3.0) } else { 0.0 };
    let (x, v) = if random.chance(0.5) { (x, v) } else { on_stop(random, gap, steady, beta, rho, phase)? };
    let second = random.chance(0.2).then(|| gap * random.uniform(1.0, 1.1));
    let case = Case { zeta, second, x, v, phase, ..Case::from_stop(beta, gap, 0.0, 0.0) };
    (x <= gap && second.is_none_or(|second| x > -second) && !case.stays()).then_some(case)
}

/// The speed at which it leaves the stop with a free part of this size.
fn on_stop(random: &mut Random, gap: f64, steady: f64, beta: f64, rho: f64, phase: f64) -> Option<(f64, f64)> {
    let rest = gap - steady * phase.sin();
    let speed = (rest.abs() < rho).then(|| (rho * rho - rest * rest).sqrt())?;
    let v = steady * beta * phase.cos() + random.sign() * speed;
    (v < 0.0).then_some((gap, v))
}

#[test]
fn flights_over_many_beats() {
    let flights = if is_long() { FLIGHTS_LONG } else { FLIGHTS };
    let tally = on_all_cores(flights, 20, |index, tally| {
        let case = Random::new(11, index).until(case);
        let mut limits = SearchLimits::default();
        limits.periods = limits.periods.min(1.1 * LONGEST / TAU * case.beta.min(1.0));
        tally.add(case, verdict(&case, limits, LONGEST));
    });
    println!("{tally}");
    assert_eq!(tally.total(), flights);
    assert!(tally.impacts > flights / 3 && tally.until > flights / 20, "{tally}");
    tally.expect_no_fault();
}
