//! Error bars of the quantities of a chaotic motion.

use super::segment::follow;
use super::sums::{Scale, Sums, mean_over};
use super::verdict::EVENTS;
use super::{Quantities, Quantity, Tally};
use crate::flight::SearchLimits;
use crate::lyapunov::Tail;
use crate::lyapunov::blocks::FEWEST;
use crate::motion::{EventKind, Motion};
use crate::system::Oscillator;
use crate::verdict::Verdict;

/// Three standard errors of the means among the quantities of a chaotic motion ([`of_verdict`](super::of_verdict)): how
/// much the means over its last impacts may differ from those over a longer run. They come from blocks of these impacts,
/// so correlation over more than a 32nd of them is not detected. Impulses, losses and work of neighbouring blocks are
/// anticorrelated, because momentum and energy balance, so few long blocks are used; the error bars of such quantities are
/// still up to four times too wide. NaN for extremes, and for means that are not finite.
///
/// `None` for all other motions, whose quantities are exact to rounding, and if the quantities are not known.
///
/// ```
/// use vibroimpact::{Oscillator, Start, quantities::*, verdict::{SettleOptions, settle}};
/// let osc = Oscillator::from_inverse_beta(1.11, 3.0, 0.5)?;
/// let motion = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
/// let (values, errors) = (of_verdict(&osc, &motion).unwrap(), errors_of_verdict(&osc, &motion).unwrap());
/// let (power, error) = (values.get(Quantity::Power), errors.get(Quantity::Power));
/// assert!(error > 0.0 && error < 0.01 * power && errors.get(Quantity::ImpactSpeedMax).is_nan());
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn errors_of_verdict(osc: &Oscillator, verdict: &Verdict) -> Option<Quantities> {
    let Verdict::Chaotic(chaos) = verdict else { return None };
    of_tail(osc, &chaos.tail)
}

/// The error bars from the last impacts of a run.
fn of_tail(osc: &Oscillator, tail: &Tail) -> Option<Quantities> {
    let (tally, blocks) = blocks_of(osc, tail)?;
    let error = |quantity: Quantity| {
        if !quantity.is_mean() || !tally.knows(quantity) {
            return f64::NAN;
        }
        let mean = mean_over(&blocks, quantity, scale(osc));
        if mean.value.is_finite() { mean.error } else { f64::NAN }
    };
    Some(Quantities::from_fn(error))
}

fn scale(osc: &Oscillator) -> Scale {
    Scale { period: osc.period(), damping: 2.0 * osc.damping() }
}

/// The sums over the tail, and those over each of its blocks. `None` as for the quantities themselves.
fn blocks_of<'a>(osc: &'a Oscillator, tail: &Tail) -> Option<(Tally<'a>, Vec<Sums>)> {
    let means: Vec<Quantity> = Quantity::ALL.into_iter().filter(|quantity| quantity.is_mean()).collect();
    let mut tally = Tally::of_only(osc, &means);
    let mut motion = Motion::after(osc, &tail.from, SearchLimits::default());
    let wanted = tail.impacts.min(FEWEST as u64);
    let mut blocks: Vec<Sums> = Vec::new();
    // both closures below need the tally
    let parts = core::cell::RefCell::new(&mut tally);
    let (mut count, mut events, mut before) = (0, 0, Sums::default());
    follow(
        &mut motion,
        |part| parts.borrow_mut().add(&part),
        |event| {
            count += u64::from(matches!(event.kind, EventKind::Impact { .. }));
            events += 1;
            // block k ends with impact number (k + 1) n / wanted
            let ends = wanted > 0 && count >= (blocks.len() as u64 + 1) * tail.impacts / wanted;
            if ends && matches!(event.kind, EventKind::Impact { .. }) {
                let now = parts.borrow().sums();
                blocks.push(now.since(&before));
                before = now;
            }
            count < tail.impacts && events < EVENTS.saturating_mul(tail.impacts)
        },
    );
    (count == tail.impacts && count > 0).then_some((tally, blocks))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::ImpactState;
    use crate::quantities::of_verdict;
    use crate::system::Start;
    use crate::verdict::{Chaos, SettleOptions, settle};

    /// Chaotic motions: on one stop, with sticking, with damping and a second stop.
    fn chaotic() -> Vec<(Oscillator, Chaos)> {
        let systems = [
            Oscillator::from_inverse_beta(1.11, 3.0, 0.5).unwrap(),
            Oscillator::from_inverse_beta(1.3, 0.2, 0.7).unwrap(),
            Oscillator::from_inverse_beta(1.11, 3.0, 0.5).unwrap().with_damping(0.01).unwrap(),
        ];
        let found = systems.into_iter().filter_map(|osc| {
            match settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict {
                Verdict::Chaotic(chaos) => Some((osc, chaos)),
                _ => None,
            }
        });
        found.collect()
    }

    #[test]
    fn blocks_have_the_means_of_the_quantities() {
        let all = chaotic();
        assert!(!all.is_empty());
        for (osc, chaos) in all {
            let values = of_verdict(&osc, &Verdict::Chaotic(chaos)).unwrap();
            let (_, blocks) = blocks_of(&osc, &chaos.tail).unwrap();
            assert_eq!(blocks.len(), FEWEST);
            for quantity in Quantity::ALL.into_iter().filter(|quantity| quantity.is_mean()) {
                let (mean, value) = (mean_over(&blocks, quantity, scale(&osc)).value, values.get(quantity));
                assert!((mean - value).abs() <= 1e-10 * value.abs(), "{quantity:?}: {mean} {value}");
            }
        }
    }

    /// Means over other stretches of the same motion differ by about as much as the error bars say. Impulses and energies
    /// have wider ones.
    #[test]
    fn means_of_other_stretches_lie_within_the_error_bars() {
        let osc = Oscillator::from_inverse_beta(1.11, 3.0, 0.5).unwrap();
        let Verdict::Chaotic(chaos) = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict else {
            panic!("chaotic")
        };
        // stretches of 1000 impacts, one after another
        let mut tail = chaos.tail;
        let means: Vec<Quantity> = Quantity::ALL.into_iter().filter(|quantity| quantity.is_mean()).collect();
        let mut runs = Vec::new();
        for _ in 0..40 {
            let (_, blocks) = blocks_of(&osc, &tail).unwrap();
            let value = |quantity: &Quantity| mean_over(&blocks, *quantity, scale(&osc));
            runs.push(means.iter().map(value).collect::<Vec<_>>());
            let impacts =
                Motion::after(&osc, &tail.from, SearchLimits::default()).filter_map(|event| match event.kind {
                    EventKind::Impact { velocity_before: velocity, .. } => {
                        Some(ImpactState { side: event.side, phase: event.phase, velocity })
                    }
                    _ => None,
                });
            tail.from = impacts.take(1000).last().unwrap();
        }
        for (k, quantity) in means.iter().enumerate() {
            let n = runs.len() as f64;
            let mean = runs.iter().map(|run| run[k].value).sum::<f64>() / n;
            let spread = (runs.iter().map(|run| (run[k].value - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
            let error = runs.iter().map(|run| run[k].error).sum::<f64>() / n / 3.0;
            let balanced = matches!(
                quantity,
                Quantity::ImpulsePerPeriod
                    | Quantity::DisplacementMean
                    | Quantity::ImpactLossPerPeriod
                    | Quantity::ImpactPower
                    | Quantity::WorkPerPeriod
                    | Quantity::Power
            );
            let widest = if balanced { 4.0 } else { 1.8 };
            if spread > 1e-12 {
                assert!((0.6..widest).contains(&(error / spread)), "{quantity:?}: {error} {spread}");
            }
        }
    }

    #[test]
    fn only_chaos_has_error_bars() {
        let osc = Oscillator::from_inverse_beta(1.8, 0.25, 0.5).unwrap();
        let motion = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
        assert_eq!(errors_of_verdict(&osc, &motion), None);
    }
}
