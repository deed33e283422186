//! Motions compared with plain time stepping: positions at equal times, until the two step sizes separate.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod stepper;

use stepper::Stepper;
use vibroimpact::events::{Limits, Motion, Samples};
use vibroimpact::machine::ImpactLaw;
use vibroimpact_cases::{Case, FAMILIES};

/// How far motions are compared, and at how many times.
const UNTIL: f64 = 6.0;
const TIMES: u32 = 30;
/// The larger of the two steps, and that for motions that differ with it, to tell whether the difference falls with the step.
const STEP: f64 = 1.0 / 2048.0;
const SMALL_STEP: f64 = STEP / 16.0;
/// A motion is compared up to so many events: light bodies on stiff springs have some millions of them.
const EVENTS: usize = 20_000;
/// Two step sizes whose coordinates differ by more than this part of the largest ones are not compared further.
const APART: f64 = 0.02;
/// The difference from the simulator may be this many times the difference between the two step sizes, plus this part of
/// the largest coordinates.
const TIMES_APART: f64 = 4.0;
const ALWAYS: f64 = 2e-3;

/// Motions that equal steps do not resolve: impacts over gaps of 1e-9, impacts of one bead with two others within 1e-4 of time, two
/// joints on one coordinate whose static limits can be shared in any way, a light body with restitution 1 on a stiff damper.
const UNRESOLVED: [(&str, u64); 4] = [("cradles", 7), ("columns", 7), ("duplicates", 11), ("light", 3)];

/// Coordinates at so many equal times, by steps of this size.
fn stepped(case: &Case, h: f64, times: u32) -> Vec<Vec<f64>> {
    let mut stepper = Stepper::new(&case.machine, &case.start, h);
    let mut rows = vec![stepper.q.clone()];
    for k in 1..=times {
        let time = UNTIL * f64::from(k) / f64::from(TIMES);
        while stepper.time() < time - 0.5 * h {
            stepper.step();
        }
        rows.push(stepper.q.clone());
    }
    rows
}

/// The number of times that could be compared, or the first difference.
fn compare(case: &Case, h: f64) -> Result<usize, String> {
    let step = UNTIL / f64::from(TIMES);
    let motion = Motion::new(&case.machine, &case.start, Limits::default()).unwrap();
    let last = motion.take_while(|event| event.time < UNTIL).nth(EVENTS).map_or(UNTIL, |event| event.time);
    let times = (0..=TIMES).rev().find(|k| step * f64::from(*k) <= last).unwrap_or(0);
    let until = step * f64::from(times);
    let samples = Samples::new(&case.machine, &case.start, Limits::default(), (until, step)).unwrap();
    let exact: Vec<Vec<f64>> = samples.filter(|sample| sample.even).map(|sample| sample.q).collect();
    let (coarse, fine) = (stepped(case, h, times), stepped(case, 0.5 * h, times));
    let largest = |row: &[f64]| row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (mut size, mut error) = (1e-3_f64, 0.0_f64);
    for (k, ((exact, coarse), fine)) in exact.iter().zip(&coarse).zip(&fine).enumerate() {
        size = size.max(largest(fine));
        error = error.max(apart(coarse, fine));
        if error > APART * size {
            return Ok(k);
        }
        let difference = apart(exact, fine);
        if difference > TIMES_APART * error + ALWAYS * size {
            let time = step * k as f64;
            return Err(format!(
                "at {time:.2} {difference:.2e} from stepping, whose sizes differ by {error:.2e} of {size:.2e}"
            ));
        }
    }
    if exact.len() < coarse.len() {
        Err(format!("the motion ends after {} times", exact.len()))
    } else {
        Ok(exact.len())
    }
}

/// Everyday one machine of each family; with `VIBROIMPACT_LONG=1` fourteen, more than 200 together.
#[test]
fn motions_are_those_of_time_stepping() {
    let count = if std::env::var("VIBROIMPACT_LONG").is_ok() { 14 } else { 1 };
    let (mut times, mut all, mut wrong) = (0, 0, Vec::new());
    for family in FAMILIES {
        for case in (0..count).map(|seed| family.case(seed)) {
            // time stepping is of impacts together
            if case.machine.parts().impacts != ImpactLaw::Together || UNRESOLVED.contains(&(family.name, case.seed)) {
                continue;
            }
            all += 1;
            match compare(&case, STEP).or_else(|_| compare(&case, SMALL_STEP)) {
                Ok(count) => times += count,
                Err(what) => wrong.push(format!("{} {}: {what}", family.name, case.seed)),
            }
        }
    }
    println!("{all} machines, {times} states compared");
    assert!(wrong.is_empty(), "{} of {all}:\n{}", wrong.len(), wrong.join("\n"));
}
