//! A hundred million questions, against the fast march; where the two differ, the exact flight decides.
//!
//! Six kinds of motion, their impacts followed one after the other: chaotic, regular, chattering, damped, pressed
//! against the stop, between two stops; and random states of random systems, aimed ones among them. Everything the march
//! cannot decide, and one question in fifty thousand besides, goes to the exact referee.
//!
//! An ordinary run asks two hundred thousand. `VIBROIMPACT_LONG=1` asks 1e8, which takes a quarter of an hour on two cores;
//! `VIBROIMPACT_QUERIES` sets another number.

use super::case::Case;
use super::march::{March, Seen, Table};
use super::random::Random;
use super::referee::{Fault, Passed, judge};
use super::tally::{Tally, on_all_cores};
use core::f64::consts::TAU;
use std::sync::atomic::{AtomicU64, Ordering};
use vibroimpact::flight::{Contact, Flight, SearchLimits, first_contact};
use vibroimpact::{Oscillator, Side, Start, lanes};

const EVERYDAY: u64 = 100_000;
const LONG: u64 = 100_000_000;
/// Questions asked of one oscillator.
const RUN: u64 = 20_000;
/// Relative to the time of a short flight, or absolute.
const AGREE: f64 = 1e-9;

/// Whether long runs are asked for.
pub(crate) fn is_long() -> bool {
    std::env::var("VIBROIMPACT_LONG").is_ok_and(|on| on == "1")
}

fn questions() -> u64 {
    let asked = std::env::var("VIBROIMPACT_QUERIES").ok().and_then(|n| n.parse::<f64>().ok());
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 1e8 is a number of questions
    match asked {
        Some(n) => n as u64,
        None if is_long() => LONG,
        None => EVERYDAY,
    }
}

/// The oscillator of a run: parameters without a start.
fn system(random: &mut Random) -> (Case, f64) {
    let mut case = Case { x: 0.0, ..Case::from_stop(1.0, 0.0, 0.0, 0.0) };
    let eps;
    match random.next() % 8 {
        // the parameter plane of the 1971 paper: regular and chaotic
        0..3 => {
            (case.beta, case.gap, eps) = (1.0 / random.uniform(0.3, 2.5), random.uniform(0.0, 3.0), 0.5);
        }
        // hard, nearly elastic: long chaotic motions
        3 => {
            (case.beta, case.gap, eps) =
                (random.uniform(1.5, 6.0), random.uniform(-0.1, 0.6), random.uniform(0.8, 1.0));
        }
        // soft: chattering
        4 => {
            (case.beta, case.gap, eps) =
                (random.uniform(0.1, 1.0), random.uniform(-0.95, 0.5), random.uniform(0.3, 0.7));
        }
        5 => {
            (case.beta, case.gap, eps) =
                (random.decade(-0.7, 0.7), random.uniform(-0.5, 1.0), random.uniform(0.3, 1.0));
            case.zeta = random.decade(-3.0, 0.3);
        }
        6 => {
            (case.beta, case.gap, eps) =
                (random.decade(-0.7, 0.7), random.uniform(-0.5, 1.0), random.uniform(0.5, 1.0));
            case.second = Some(random.decade(-1.0, 0.5) - case.gap);
        }
        _ => {
            let drawn = random.case();
            (case.beta, case.zeta, case.gap, case.second) = (drawn.beta, drawn.zeta, drawn.gap, drawn.second);
            eps = random.unit();
        }
    }
    (case, eps)
}

/// A start of that oscillator: on the stop most often.
fn start(random: &mut Random, case: &Case) -> Case {
    let lowest = case.second.map_or(case.gap - 4.0, |second| -second);
    let x = if random.chance(0.5) { case.gap } else { random.uniform(lowest, case.gap).clamp(lowest, case.gap) };
    let mut v = random.sign() * random.decade(-3.0, 0.5);
    if x == case.gap {
        v = -v.abs();
    } else if case.second == Some(-x) {
        v = v.abs();
    }
    Case { x, v, phase: random.phase(), ..*case }
}

/// How many answers were re-judged.
struct Counters {
    asked: AtomicU64,
    unclear: AtomicU64,
    differing: AtomicU64,
}

/// One question: the library's answer, and whether it stands.
fn ask(table: &Table, osc: &Oscillator, case: &Case, limits: SearchLimits, counters: &Counters) -> (Contact, Verdict) {
    let flight = Flight::new(osc, Start { x: case.x, v: case.v, phase: case.phase });
    // the two ways in turn
    let way = if case.phase.to_bits().is_multiple_of(2) { lanes::first_contact } else { first_contact };
    let answer = way(osc, &flight, limits);
    let horizon = match answer {
        Contact::Impact { time, .. } | Contact::Grazing { time, .. } => 1.01 * time + 1e-3,
        Contact::NoneUntil(s) => s.min(limits.horizon(osc)),
        _ => limits.horizon(osc),
    };
    let seen = if case.stays() { Seen::Unclear } else { March::look(table, case, horizon) };
    let agree = match (answer, seen) {
        (Contact::Impact { time, side, .. }, Seen::Strike(other, s)) => {
            side == other && (time - s).abs() <= AGREE * s.min(1.0)
        }
        (Contact::Never(_) | Contact::NoneUntil(_), Seen::Nothing) => true,
        _ => false,
    };
    let asked = counters.asked.fetch_add(1, Ordering::Relaxed) + 1;
    if asked.is_multiple_of(1_000_000) {
        let (unclear, differing) =
            (counters.unclear.load(Ordering::Relaxed), counters.differing.load(Ordering::Relaxed));
        eprintln!("{asked} questions, {unclear} to the exact flight, {differing} of them differing");
    }
    if agree && !asked.is_multiple_of(50_000) {
        return (answer, Verdict::Agreed);
    }
    if !agree {
        counters.unclear.fetch_add(1, Ordering::Relaxed);
        if seen != Seen::Unclear {
            counters.differing.fetch_add(1, Ordering::Relaxed);
        }
    }
    (answer, Verdict::Judged(judge(case, answer, horizon.min(400.0))))
}

enum Verdict {
    Agreed,
    Judged(Result<Passed, Fault>),
}

/// A run of questions about one oscillator: motions followed from impact to impact.
fn run(index: u64, count: u64, counters: &Counters, tally: &mut Tally) {
    let mut random = Random::new(3, index);
    let (bare, eps) = system(&mut random);
    let osc = bare.oscillator();
    let table = Table::new(&osc);
    let horizon = 50.0 * TAU * (1.0 / bare.beta).clamp(1.0, 3.0);
    let limits = SearchLimits { periods: horizon / TAU * bare.beta.min(1.0), ..SearchLimits::default() };
    let mut case = start(&mut random, &bare);
    let mut impacts = 0;
    for _ in 0..count {
        let (answer, verdict) = ask(&table, &osc, &case, limits, counters);
        match verdict {
            Verdict::Agreed => tally.count(&answer),
            Verdict::Judged(verdict) => tally.add(case, verdict),
        }
        impacts += 1;
        case = match answer {
            Contact::Impact { time, side, velocity } if velocity * eps > 1e-11 && impacts % 2000 != 0 => {
                let flight = Flight::new(&osc, Start { x: case.x, v: case.v, phase: case.phase });
                let x = match side {
                    Side::Upper => case.gap,
                    Side::Lower => -case.second.unwrap_or(0.0),
                };
                Case { x, v: -side.sign() * eps * velocity, phase: flight.phase_at(time), ..case }
            }
            _ => start(&mut random, &bare),
        };
    }
}

#[test]
fn very_many() {
    let questions = questions();
    let counters = Counters { asked: AtomicU64::new(0), unclear: AtomicU64::new(0), differing: AtomicU64::new(0) };
    let run_length = RUN.min(questions / 100).max(1);
    let began = std::time::Instant::now();
    let tally =
        on_all_cores(questions.div_ceil(run_length), 1, |index, tally| run(index, run_length, &counters, tally));
    let (unclear, differing) = (counters.unclear.into_inner(), counters.differing.into_inner());
    println!("{tally}to the exact flight  {unclear:>9}\nof them differing    {differing:>9}");
    println!("{:.0} questions a second", tally.total().min(u64::from(u32::MAX)) as f64 / began.elapsed().as_secs_f64());
    assert!(tally.total() >= questions);
    tally.expect_no_fault();
}
