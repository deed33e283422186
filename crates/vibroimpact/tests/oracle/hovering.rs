//! Flights under fast forcing that stay close to a stop, or between two, all the time: no step of theirs is far from a contact.

use super::case::Case;
use super::long::is_long;
use super::random::Random;
use super::referee::verdict;
use super::tally::on_all_cores;
use core::f64::consts::TAU;
use vibroimpact::flight::SearchLimits;

const FLIGHTS: u64 = 500;
/// With `VIBROIMPACT_LONG=1`, the same ones among them.
const FLIGHTS_LONG: u64 = 2000;
/// How long a flight the referee follows.
const LONGEST: f64 = 60.0;

/// A start near the motion without stops, whose amplitudes together are nearly the gap.
fn case(random: &mut Random) -> Option<Case> {
    let beta = random.decade(0.7, 1.9);
    let steady = 1.0 / (1.0 - beta * beta);
    let (phase, angle) = (random.phase(), random.uniform(0.0, TAU));
    let rho = steady.abs() * random.decade(-4.0, 0.5);
    let gap = (rho + steady.abs()) * (1.0 + random.sign() * random.decade(-6.0, -0.3));
    let x = steady * phase.sin() + rho * angle.sin();
    let v = steady * beta * phase.cos() + rho * angle.cos();
    let zeta = if random.chance(0.3) { random.decade(-5.0, -0.5) } else { 0.0 };
    let second = random.chance(0.4).then(|| gap * (1.0 + random.decade(-4.0, 0.0)));
    let case = Case { zeta, second, x, v, phase, ..Case::from_stop(beta, gap, 0.0, 0.0) };
    (x < gap && second.is_none_or(|second| x > -second)).then_some(case)
}

#[test]
fn flights_that_stay_close() {
    let flights = if is_long() { FLIGHTS_LONG } else { FLIGHTS };
    let tally = on_all_cores(flights, 20, |index, tally| {
        let case = Random::new(12, index).until(case);
        let limits = SearchLimits { periods: 1.1 * LONGEST / TAU, ..SearchLimits::default() };
        tally.add(case, verdict(&case, limits, LONGEST));
    });
    println!("{tally}");
    assert_eq!(tally.total(), flights);
    assert!(tally.impacts > flights / 5 && tally.never + tally.until > flights / 5, "{tally}");
    tally.expect_no_fault();
}
