//! Motions side by side and motions alone: the same bits.
//!
//! A [`Batch`] flies many motions in vectors of several widths, a [`Motion`] one alone. Every impact of a slot has to be
//! the impact of the motion to the last bit, for any width, whatever flies beside it and wherever in the batch it lies; and
//! where the batch says that what follows is no flight, the motion has to say so too.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use vibroimpact::flight::{Contact, SearchLimits};
use vibroimpact::lanes::{Batch, Width};
use vibroimpact::motion::{EventKind, Motion};
use vibroimpact::verdict::{StartBox, scattered_starts};
use vibroimpact::{Oscillator, Side, Start, scenario};

/// An impact, as bits: phase, speed of arrival, time since the event before; and the side.
type Bits = (u64, u64, u64, Side);

/// How a slot was followed to its last impact.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Last {
    /// As many impacts as were asked for.
    Enough,
    /// The batch listed it as settling.
    Settling,
    /// The careful search found something else than an impact.
    Other(Contact),
}

/// What a slot did.
#[derive(Clone, Debug, PartialEq)]
struct Record {
    impacts: Vec<Bits>,
    last: Option<Last>,
    /// Flights the careful search decided.
    careful: u32,
}

/// What becomes of a slot that is followed no more.
#[derive(Clone, Copy, Debug)]
enum Leftover {
    /// It flies on, or flies something harmless, and nobody looks.
    Stays,
    /// It is taken out and the last slot takes its number.
    Leaves,
}

/// A start that is legal for every oscillator, to fill a slot with.
fn harmless(osc: &Oscillator) -> Start {
    let (lowest, highest) = Start::room(osc);
    Start { x: highest - 0.5 * (highest - lowest).min(1.0), v: -0.3, phase: 0.5 }
}

fn available() -> impl Iterator<Item = Width> {
    Width::ALL.into_iter().filter(|width| width.available())
}

/// Follows each start over at most `most` impacts; `None` if lanes do not fly this oscillator.
fn side_by_side(osc: &Oscillator, starts: &[Start], width: Width, most: usize, then: Leftover) -> Option<Vec<Record>> {
    let mut batch = Batch::new(osc, starts.len(), width)?;
    let mut records = vec![Record { impacts: Vec::new(), last: None, careful: 0 }; starts.len()];
    // whose motion is in the slot
    let mut owners: Vec<usize> = (0..starts.len()).collect();
    for start in starts {
        batch.push(*start);
    }
    // a flight is at most some seventy steps, each halved or not
    let mut rounds_left = 100 * (most + 1);
    while records.iter().any(|record| record.last.is_none()) {
        assert!(rounds_left > 0, "{osc:?} {starts:?}: some slot never strikes");
        rounds_left -= 1;
        batch.round();
        let mut struck = batch.struck().to_vec();
        let mut settling = batch.settling().to_vec();
        for slot in batch.rare().to_vec() {
            let record = &mut records[owners[slot as usize]];
            if record.last.is_some() {
                batch.launch(slot, harmless(osc));
                continue;
            }
            record.careful += 1;
            match batch.carefully(slot, SearchLimits::default()).0 {
                Contact::Impact { .. } => {
                    struck.push(slot);
                    if batch.settles_after(slot, &batch.arrival(slot).0) {
                        settling.push(slot);
                    }
                }
                other => {
                    record.last = Some(Last::Other(other));
                    batch.launch(slot, harmless(osc));
                }
            }
        }
        for slot in struck {
            let (state, interval) = batch.arrival(slot);
            let record = &mut records[owners[slot as usize]];
            if record.last.is_none() {
                let bits = (state.phase.to_bits(), state.velocity.to_bits(), interval.to_bits(), state.side);
                record.impacts.push(bits);
                record.last = (record.impacts.len() == most).then_some(Last::Enough);
            }
        }
        for slot in settling {
            let last = &mut records[owners[slot as usize]].last;
            *last = last.or(Some(Last::Settling));
            batch.launch(slot, harmless(osc));
        }
        if let Leftover::Leaves = then {
            for slot in (0..owners.len()).rev().filter(|&slot| records[owners[slot]].last.is_some()).collect::<Vec<_>>()
            {
                batch.remove(u32::try_from(slot).expect("a few dozen slots"));
                owners.swap_remove(slot);
            }
            assert_eq!(batch.len(), owners.len());
        }
    }
    Some(records)
}

/// The record has to be the beginning of the motion from this start.
fn assert_alone(osc: &Oscillator, start: Start, width: Width, record: &Record) {
    let mut motion = Motion::new(osc, start);
    for (k, bits) in record.impacts.iter().enumerate() {
        let event = motion.next();
        let impact = event.and_then(|event| match event.kind {
            EventKind::Impact { velocity_before, .. } => {
                let interval = motion.leg()?.duration;
                Some((event.phase.to_bits(), velocity_before.to_bits(), interval.to_bits(), event.side))
            }
            _ => None,
        });
        assert_eq!(impact.as_ref(), Some(bits), "{width:?} {osc:?} {start:?}: impact {k} is {event:?}");
    }
    let next = motion.next().map(|event| event.kind);
    let agrees = match record.last {
        Some(Last::Enough) => true,
        Some(Last::Settling) => matches!(next, Some(EventKind::Stick { .. })),
        Some(Last::Other(Contact::Grazing { depth, .. })) => next == Some(EventKind::Graze { depth }),
        Some(Last::Other(Contact::Contact { .. })) => {
            matches!(next, Some(EventKind::Stick { .. } | EventKind::Impact { .. }))
        }
        Some(Last::Other(Contact::Never(_) | Contact::NoneUntil(_))) => next.is_none() && motion.end().is_some(),
        Some(Last::Other(Contact::Impact { .. })) | None => false,
    };
    assert!(agrees, "{width:?} {osc:?} {start:?}: {:?} after {} impacts, {next:?}", record.last, record.impacts.len());
}

/// Oscillators with one stop or two, damped or not.
fn oscillator() -> impl Strategy<Value = Oscillator> {
    let damping = prop_oneof![2 => Just(0.0), 2 => 0.0..1.5, 1 => 0.0..0.05];
    let second = prop::option::weighted(0.4, (0.05..3.0, 0.05..=1.0));
    (0.2..5.0, -2.0..5.0, 0.05..=1.0, damping, second).prop_map(|(inverse, gap, restitution, damping, second)| {
        let one = Oscillator::from_inverse_beta(inverse, gap, restitution).and_then(|osc| osc.with_damping(damping));
        // as far below the first stop as drawn
        let all = one.and_then(|osc| match second {
            Some((width, restitution)) => osc.with_second_stop(width - gap, restitution),
            None => Ok(osc),
        });
        all.expect("all of these are legal")
    })
}

/// Starts of an oscillator: anywhere in its box, and every third leaving the upper stop.
fn starts(osc: &Oscillator, count: u64, seed: u64) -> Vec<Start> {
    let area = StartBox::natural(osc);
    let start = |index: u64| {
        let start = scattered_starts(osc, area, seed, index);
        if index % 3 == 2 { Start { x: osc.gap(), v: -0.7 * start.v.abs(), ..start } } else { start }
    };
    (0..count).map(start).collect()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 160,
        // the same oscillators every day
        rng_seed: RngSeed::Fixed(1971),
        failure_persistence: None,
        max_shrink_iters: 60,
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_slot_is_a_motion(osc in oscillator(), seed: u64) {
        let starts = starts(&osc, 24, seed);
        for width in available() {
            let Some(records) = side_by_side(&osc, &starts, width, 60, Leftover::Stays) else { continue };
            for (start, record) in starts.iter().zip(&records) {
                assert_alone(&osc, *start, width, record);
            }
        }
    }

    #[test]
    fn companions_do_not_matter(osc in oscillator(), seed: u64) {
        let starts = starts(&osc, 21, seed);
        for width in available() {
            let Some(records) = side_by_side(&osc, &starts, width, 20, Leftover::Stays) else { continue };
            let removed = side_by_side(&osc, &starts, width, 20, Leftover::Leaves);
            prop_assert_eq!(removed.as_ref(), Some(&records), "taken out, {:?}", width);
            let mut backwards = starts.clone();
            backwards.reverse();
            let mut reversed = side_by_side(&osc, &backwards, width, 20, Leftover::Leaves).unwrap_or_default();
            reversed.reverse();
            prop_assert_eq!(&reversed, &records, "the other way round, {:?}", width);
            // in company of fewer: no slot, lane or number of slots is like the one before
            for few in [1, 2, 3, 5, 8, 9, 13] {
                let from = few % 4;
                let some = side_by_side(&osc, &starts[from..from + few], width, 20, Leftover::Stays);
                prop_assert_eq!(some.as_deref(), Some(&records[from..from + few]), "{} of them, {:?}", few, width);
            }
        }
    }
}

/// Chaos shows the last bit of every operation within a hundred impacts.
#[test]
fn chaos_is_the_same_to_the_last_bit() {
    let osc = scenario::U.oscillator();
    let starts = starts(&osc, 16, 11);
    for width in available() {
        let records =
            side_by_side(&osc, &starts, width, 10_000, Leftover::Stays).expect("lanes fly the paper's points");
        for (start, record) in starts.iter().zip(&records) {
            assert_eq!((record.impacts.len(), record.last), (10_000, Some(Last::Enough)), "{width:?} {start:?}");
            assert_alone(&osc, *start, width, record);
        }
    }
}

/// The comparison would be idle if the lanes left everything to the careful search, or if nothing else ever happened.
#[test]
fn lanes_fly_most_and_leave_some() {
    let (mut impacts, mut careful, mut settling, mut other) = (0, 0, 0, 0);
    for (inverse, gap) in [(1.3, 0.75), (1.11, 3.0), (1.11, -0.5), (0.6, 0.75), (1.7, 2.25), (0.9, 0.0)] {
        let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap();
        let records = side_by_side(&osc, &starts(&osc, 24, 3), Width::best(), 60, Leftover::Stays).unwrap();
        for record in records {
            impacts += record.impacts.len();
            careful += record.careful as usize;
            settling += usize::from(record.last == Some(Last::Settling));
            other += usize::from(matches!(record.last, Some(Last::Other(_))));
        }
    }
    let seen = format!("{impacts} impacts, {careful} by the careful search, {settling} settling, {other} others");
    assert!(impacts > 4000 && careful * 10 < impacts && careful > 0 && settling > 10 && other > 0, "{seen}");
}

/// Fast forcing moves the mass so little that it never gets away from the stop as far as single precision could tell: every step is
/// in doubt, and proven clear in full precision.
#[test]
fn what_hovers_below_a_stop_is_handed_over_in_time() {
    let mut careful = 0;
    for (beta, closeness, damping) in [
        (50.0, 1.25, 0.0),
        (50.0, 1.01, 0.0),
        (30.0, 1.1, 0.0),
        (40.0, 2.0, 0.05),
        (80.0, 1.0001, 0.0),
        (17.0, 1.02, 0.3),
    ] {
        let amplitude = 1.0 / (beta * beta - 1.0);
        let one = Oscillator::new(beta, closeness * amplitude, 0.5).unwrap().with_damping(damping).unwrap();
        for osc in [one, one.with_second_stop(3.0 * amplitude, 0.8).unwrap()] {
            // beside the motion without stops
            let start = |k: u32| {
                let phase = 0.3 * f64::from(k);
                let (x, v) = (-amplitude * phase.sin(), -beta * amplitude * phase.cos());
                Start {
                    x: x.min(osc.gap()),
                    v: v + 1e-2 * amplitude * f64::from(k % 5),
                    phase: phase % core::f64::consts::TAU,
                }
            };
            let starts: Vec<Start> = (0..20).map(start).collect();
            for width in available() {
                let records = side_by_side(&osc, &starts, width, 20, Leftover::Stays).expect("lanes fly them");
                for (start, record) in starts.iter().zip(&records) {
                    assert_alone(&osc, *start, width, record);
                    careful += record.careful;
                }
            }
        }
    }
    assert!(careful > 100, "{careful}");
}
