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
    use crate::lyapunov::{Measured, Spectrum};
    use crate::motion::ImpactState;
    use crate::quantities::of_verdict;
    use crate::system::Start;
    use crate::verdict::Chaos;

    /// The next impacts of a motion.
    fn impacts<'a>(motion: &'a mut Motion<'_>) -> impl Iterator<Item = ImpactState> + 'a {
        motion.filter_map(|event| event.arrival())
    }

    /// A motion from rest after a transient, as chaos.
    fn chaotic(osc: &Oscillator) -> Chaos {
        let mut motion = Motion::new(osc, Start::at_rest(osc));
        let mut later = |count: usize| impacts(&mut motion).nth(count - 1).unwrap();
        let tail = Tail { from: later(4000), last: later(1000), impacts: 1000 };
        let unknown = Measured::exact(f64::NAN);
        let spectrum = Spectrum { exponents: [unknown; 2], impact_rate: unknown, time: f64::NAN };
        Chaos { spectrum, impacts: 5000, tail }
    }

    #[test]
    fn blocks_have_the_means_of_the_quantities() {
        // on one stop, with sticking, with damping
        for osc in [
            Oscillator::from_inverse_beta(1.11, 3.0, 0.5).unwrap(),
            Oscillator::from_inverse_beta(1.3, 0.2, 0.7).unwrap(),
            Oscillator::from_inverse_beta(1.11, 3.0, 0.5).unwrap().with_damping(0.01).unwrap(),
        ] {
            let chaos = chaotic(&osc);
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
        // stretches of 1000 impacts, one after another
        let mut tail = chaotic(&osc).tail;
        let means: Vec<Quantity> = Quantity::ALL.into_iter().filter(|quantity| quantity.is_mean()).collect();
        let mut runs = Vec::new();
        for _ in 0..40 {
            let (_, blocks) = blocks_of(&osc, &tail).unwrap();
            let value = |quantity: &Quantity| mean_over(&blocks, *quantity, scale(&osc));
            runs.push(means.iter().map(value).collect::<Vec<_>>());
            let mut motion = Motion::after(&osc, &tail.from, SearchLimits::default());
            tail.from = impacts(&mut motion).nth(999).unwrap();
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
}
