//! Legal and absurd: no panic, an answer in bounded time, and one that makes sense.

use super::case::Case;
use vibroimpact::Side;
use vibroimpact::flight::{Contact, Flight, SearchLimits};
use vibroimpact::{Oscillator, Start};

/// What any answer must be, wherever it comes from.
fn sensible(case: &Case, osc: &Oscillator, answer: Contact) -> Result<(), String> {
    let gap = |side| osc.stop(side).map(|stop| stop.gap).ok_or("a stop that is not there");
    match answer {
        Contact::Impact { time, side, velocity } => {
            if !(time >= 0.0 && time.is_finite() && velocity >= 0.0 && velocity.is_finite()) {
                return Err("a time or velocity that cannot be".into());
            }
            let flight = Flight::new(osc, Start::new(osc, case.x, case.v, case.phase).map_err(|e| e.to_string())?);
            let (x, v) = flight.state(time);
            let (stop, past) = (gap(side)?, side.sign() * x - gap(side)?);
            // rounding of the state, of the time, of the angle of the force
            let size = 1.0 + case.x.abs() + case.v.abs() + stop.abs() + time;
            let slack = 1e-13 * size * (1.0 + time) + 4.0 * f64::EPSILON * time * v.abs();
            if past.abs() > slack { Err(format!("{past:e} away from the stop, {slack:e} allowed")) } else { Ok(()) }
        }
        Contact::Grazing { time, side, depth } => {
            gap(side)?;
            if time >= 0.0 && depth.is_finite() { Ok(()) } else { Err("a grazing that cannot be".into()) }
        }
        Contact::NoneUntil(s) => {
            if s >= 0.0 && s.is_finite() {
                Ok(())
            } else {
                Err("none until a time that cannot be".into())
            }
        }
        Contact::Never(_) => Ok(()),
        Contact::Contact { side } => {
            let on = side.sign() * case.x == gap(side)?;
            if on && side.sign() * case.v >= 0.0 { Ok(()) } else { Err("does not stay on the stop".into()) }
        }
    }
}

#[test]
fn legal_and_absurd() {
    let limits = SearchLimits { periods: 1000.0, steps: 4_000 };
    let (mut asked, mut wrong) = (0_u32, Vec::new());
    let speeds = [0.0, -5e-324, -1e-300, -1e-12, 1e-12, -1.0, 1.0, -1e9, 1e9];
    for beta in [1e-6, 1e-3, 1.0 - f64::EPSILON, 1.0, 1.0 + f64::EPSILON, 1e3, 1e6] {
        for zeta in [0.0, 1e-100, 1e-12, 0.5, 1.0, 1e3, 1e9] {
            for gap in [0.0, 5e-324, -5e-324, 1e-300, 1.0, -1.0, 1e6, 1e12, -1e12] {
                for second in [None, Some(1e-9), Some(1e12)] {
                    for depth in [0.0, 5e-324, 1e-9, 1.0, 1e9] {
                        for v in speeds {
                            let phase = 2.0;
                            let case = Case { beta, zeta, gap, second, x: gap - depth, v, phase, release: None };
                            let (low, high) = (second.map_or(f64::NEG_INFINITY, |gap: f64| -gap), gap);
                            if low >= high || case.x < low || (asked + 1) % 7 == 0 && depth > 1.0 {
                                continue;
                            }
                            asked += 1;
                            let answer = case.answer(limits);
                            if let Err(why) = sensible(&case, &case.oscillator(), answer) {
                                wrong.push(format!("{case}\n    {answer:?}: {why}"));
                            }
                        }
                    }
                }
            }
        }
    }
    println!("{asked} questions");
    let shown: Vec<_> = wrong.iter().take(30).cloned().collect();
    assert!(wrong.is_empty(), "{} of {asked} make no sense:\n{}", wrong.len(), shown.join("\n"));
    let upper = Case::from_stop(1e6, 1e12, 1.0, 0.0).answer(limits);
    assert_eq!(upper, Contact::Contact { side: Side::Upper });
}
