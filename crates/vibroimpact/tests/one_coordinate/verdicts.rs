//! The verdicts on both, the machine followed as any other.

use crate::{System, is_long, some};
use vibroimpact::Start;
use vibroimpact::verdict::{Chaos, NoImpact, SettleOptions, Verdict, settle, settle_unreduced};

/// The labels of the motions of the oscillator from starts with a velocity that is wrong by up to 100 roundings.
pub(crate) fn beside<'a>(system: &'a System, options: &'a SettleOptions) -> impl Iterator<Item = String> + 'a {
    (1..=100).flat_map(move |k| {
        let by = f64::from(k) * f64::EPSILON;
        [1.0 + by, 1.0 - by].map(|factor| {
            let start = Start { v: factor * system.start.v, ..system.start };
            settle(&system.oscillator, start, options).verdict.label().to_string()
        })
    })
}

/// The same labels, cycles and multipliers, and exponents within their error bars. What one of them leaves undecided is not
/// compared. Where a chaotic transient ends in one of several motions, rounding errors of the start can decide which.
#[test]
fn the_same_motions() {
    let options = SettleOptions::default();
    let (mut periodic, mut chaotic, mut others, mut undecided, mut differ) = (0, 0, 0, 0, Vec::new());
    let mut sensitive = 0;
    for system in some() {
        let expected = settle(&system.oscillator, system.start, &options).verdict;
        let found = settle_unreduced(&system.machine(), &system.machine_start(), &options).unwrap().verdict;
        let mut fault =
            |what: String| differ.push(format!("{}: {} {}: {what}", system.text, expected.label(), found.label()));
        match (&expected, &found) {
            (Verdict::Periodic(a), Verdict::Periodic(b)) if a.label == b.label => {
                periodic += 1;
                // the sum of a chatter has an error of 1e-10 of its duration, which the motion after it enlarges
                let within = if a.rests.is_empty() { 1e-9 } else { 1e-7 };
                if (a.fastest() - b.fastest()).abs() > within * (1.0 + a.fastest()) {
                    fault(format!("speeds {} {}", a.fastest(), b.fastest()));
                }
                // a chatter that is summed has a derivative to about 1e-5, which is 0 for the oscillator
                let within = if a.rests.is_empty() { 1e-8 } else { 1e-3 };
                for (one, two) in a.multipliers.iter().zip(&b.multipliers) {
                    if (one.modulus() - two.modulus()).abs() > within {
                        fault(format!("multipliers {one:?} {two:?}"));
                    }
                }
            }
            (Verdict::Chaotic(a), Verdict::Chaotic(Chaos { spectrum, .. })) => {
                chaotic += 1;
                let (a, b) = (a.spectrum.exponents[0], spectrum.exponents[0]);
                // three standard errors of each, over different lengths
                if (a.value - b.value).abs() > 2.0 * (a.error + b.error) {
                    fault(format!("{a:?} {b:?}"));
                }
            }
            _ if expected.label() == found.label() => others += 1,
            // after a long flight without impact the oscillator claims nothing beyond
            (Verdict::NoImpact(NoImpact::ForPeriods(_)) | Verdict::Undecided(_), _) | (_, Verdict::Undecided(_)) => {
                undecided += 1;
            }
            _ if beside(&system, &options).any(|label| label == found.label()) => sensitive += 1,
            _ => fault("labels".to_owned()),
        }
    }
    let summary = format!(
        "{periodic} periodic, {chaotic} chaotic, {others} others, {undecided} undecided, {sensitive} sensitive"
    );
    assert!(differ.is_empty() && sensitive <= 2, "{summary}\n{differ:#?}");
    let least = if is_long() { (150, 250, 20) } else { (30, 50, 4) };
    assert!(periodic > least.0 && others > least.1 && chaotic >= least.2, "{summary}");
}
