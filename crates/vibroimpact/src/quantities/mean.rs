//! Error bars of the quantities that are means over a motion.
//!
//! A mean is a quotient of two sums over the motion, such as the impulses over the time, or the square root of one. The
//! error bar of the quotient comes from blocks of equal numbers of impacts (`lyapunov::blocks`). An rms value
//! $`\sqrt q`$ has the error of the mean square $`q`$ divided by $`2\sqrt q`$. Extremes have no error bar.

use super::{Quantity, Tally};
use crate::flight::FlightIntegrals;
use crate::lyapunov::Measured;
use crate::lyapunov::blocks::quotient;
use core::f64::consts::TAU;

/// The sums over a part of a motion of which means are quotients.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub(super) time: f64,
    pub(super) sticking: f64,
    pub(super) impacts: f64,
    pub(super) speeds: f64,
    pub(super) impulse: f64,
    pub(super) lost: f64,
    pub(super) integrals: FlightIntegrals,
}

impl Sums {
    /// The sums over the part after `earlier`.
    pub(super) fn since(&self, earlier: &Self) -> Self {
        let (now, then) = (&self.integrals, &earlier.integrals);
        Self {
            time: self.time - earlier.time,
            sticking: self.sticking - earlier.sticking,
            impacts: self.impacts - earlier.impacts,
            speeds: self.speeds - earlier.speeds,
            impulse: self.impulse - earlier.impulse,
            lost: self.lost - earlier.lost,
            integrals: FlightIntegrals {
                x: now.x - then.x,
                x_squared: now.x_squared - then.x_squared,
                v_squared: now.v_squared - then.v_squared,
                work: now.work - then.work,
            },
        }
    }
}

/// A mean: the quotient of two sums times a factor, or the root of the quotient.
pub(super) struct Mean {
    above: fn(&Sums) -> f64,
    below: fn(&Sums) -> f64,
    factor: f64,
    root: bool,
}

impl Mean {
    /// The sums of a quantity; `None` for an extreme.
    pub(super) fn of(quantity: Quantity, beta: f64, zeta: f64) -> Option<Self> {
        let mean = |above: fn(&Sums) -> f64, factor| Some(Self { above, below: |sums| sums.time, factor, root: false });
        let rms = |above: fn(&Sums) -> f64| Some(Self { above, below: |sums| sums.time, factor: 1.0, root: true });
        let period = TAU / beta;
        match quantity {
            Quantity::ImpactSpeedMean => {
                Some(Self { above: |sums| sums.speeds, below: |sums| sums.impacts, factor: 1.0, root: false })
            }
            Quantity::ImpactsPerPeriod => mean(|sums| sums.impacts, period),
            Quantity::ImpactRate => mean(|sums| sums.impacts, 1.0),
            Quantity::ImpulsePerPeriod => mean(|sums| sums.impulse, period),
            Quantity::ImpactLossPerPeriod => mean(|sums| sums.lost, period),
            Quantity::ImpactPower => mean(|sums| sums.lost, 1.0),
            Quantity::DampingLossPerPeriod => mean(|sums| sums.integrals.v_squared, 2.0 * zeta * period),
            Quantity::DampingPower => mean(|sums| sums.integrals.v_squared, 2.0 * zeta),
            Quantity::WorkPerPeriod => mean(|sums| sums.integrals.work, period),
            Quantity::Power => mean(|sums| sums.integrals.work, 1.0),
            Quantity::DisplacementMean => mean(|sums| sums.integrals.x, 1.0),
            Quantity::DisplacementRms => rms(|sums| sums.integrals.x_squared),
            Quantity::VelocityRms => rms(|sums| sums.integrals.v_squared),
            Quantity::StickingFraction => mean(|sums| sums.sticking, 1.0),
            Quantity::ImpactSpeedMax
            | Quantity::ImpulseMax
            | Quantity::DisplacementMin
            | Quantity::DisplacementMax
            | Quantity::DisplacementAmplitude
            | Quantity::VelocityMax
            | Quantity::AccelerationMax => None,
        }
    }

    /// The mean over blocks of a motion, with three standard errors.
    pub(super) fn over(&self, blocks: &[Sums]) -> Measured {
        let Measured { value, error } = quotient(blocks, 0.0, self.above, self.below);
        if self.root {
            let root = value.max(0.0).sqrt();
            return Measured { value: root, error: error / (2.0 * root) };
        }
        Measured { value: value * self.factor, error: error * self.factor.abs() }
    }
}

impl Quantity {
    /// Whether it is a mean over the motion, as opposed to an extreme.
    #[must_use]
    pub fn is_mean(self) -> bool {
        Mean::of(self, 1.0, 0.0).is_some()
    }
}

impl Tally<'_> {
    /// The sums of all parts so far.
    pub(super) fn sums(&self) -> Sums {
        Sums {
            time: self.time,
            sticking: self.sticking,
            impacts: self.impacts,
            speeds: self.speeds,
            impulse: self.impulse,
            lost: self.lost,
            integrals: self.integrals.unwrap_or_default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 128 blocks whose loss is 2 or 4 by turns in a time of 2: the mean is 1.5 a unit of time, and single blocks deviate
    /// by 1. Joined in pairs they do not deviate.
    #[test]
    fn errors_of_means_and_roots() {
        let block = |k: usize| {
            let lost = if k.is_multiple_of(2) { 2.0 } else { 4.0 };
            let integrals = FlightIntegrals { x_squared: lost, ..FlightIntegrals::default() };
            Sums { time: 2.0, lost, integrals, ..Sums::default() }
        };
        let blocks: Vec<Sums> = (0..128).map(block).collect();
        let standard = (128.0_f64 / 127.0 * 128.0).sqrt() / 256.0;
        let power = Mean::of(Quantity::ImpactPower, 0.5, 0.0).unwrap().over(&blocks);
        assert_eq!(power.value, 1.5);
        assert!((power.error / (3.0 * standard) - 1.0).abs() < 1e-13);
        let loss = Mean::of(Quantity::ImpactLossPerPeriod, 0.5, 0.0).unwrap().over(&blocks);
        assert!((loss.error / (power.error * TAU / 0.5) - 1.0).abs() < 1e-14);
        let rms = Mean::of(Quantity::DisplacementRms, 0.5, 0.0).unwrap().over(&blocks);
        assert!(
            (rms.value * rms.value - 1.5).abs() < 1e-15 && (rms.error * 2.0 * rms.value - power.error).abs() < 1e-15
        );
    }

    #[test]
    fn extremes_are_no_means() {
        for quantity in Quantity::ALL {
            let extreme = matches!(quantity, Quantity::ImpactSpeedMax | Quantity::ImpulseMax);
            assert_eq!(quantity.is_mean(), !extreme && quantity.extremes().is_empty(), "{quantity:?}");
        }
    }
}
