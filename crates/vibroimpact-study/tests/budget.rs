//! A small budget leaves more starts undecided and changes no label.

use vibroimpact::verdict::{SettleOptions, StartBox, scattered_starts, settle};
use vibroimpact_study::SystemPlan;

/// Systems in the plane of the paper, with and without damping, with one stop or two.
fn systems() -> impl Iterator<Item = SystemPlan> {
    (0..400_u32).map(|k| {
        let part = |p: f64| (f64::from(k) * p).fract();
        let (inverse_beta, gap) = (0.05 + 2.4 * part(0.754_877_666), -0.9 + 2.9 * part(0.569_840_296));
        let damping = if k % 3 == 0 { 0.1 * part(0.23) } else { 0.0 };
        SystemPlan { damping, ..SystemPlan::from_inverse_beta(inverse_beta, gap, part(0.362_105_1)) }
    })
}

#[test]
fn what_a_small_budget_decides_the_whole_decides_alike() {
    let (mut decided, mut open) = (0, 0);
    for system in systems() {
        let osc = system.oscillator().unwrap();
        let start = scattered_starts(&osc, StartBox::natural(&osc), 1, 2);
        for impacts in [40, 300, 1500] {
            let brief = settle(&osc, start, &SettleOptions::at_most(impacts)).verdict;
            if brief.label() == "undecided" {
                open += 1;
                continue;
            }
            let whole = settle(&osc, start, &SettleOptions::default()).verdict;
            assert!(brief.same_as(&whole, 1e-6), "{system:?} {impacts}: {} and {}", brief.label(), whole.label());
            decided += 1;
        }
    }
    assert!(decided > 600 && open > 30, "{decided} {open}");
}
