//! The sums over a part of a motion, and the means that are quotients of them, with error bars: of an oscillator, and of each part of
//! a machine.
//!
//! A mean is a quotient of two sums over the motion, such as the impulses over the time, or the square root of one. The
//! error bar of the quotient comes from blocks of equal numbers of impacts (`lyapunov::blocks`). An rms value
//! $`\sqrt q`$ has the error of the mean square $`q`$ divided by $`2\sqrt q`$. Extremes have no error bar.

use super::Quantity;
use crate::lyapunov::Measured;
use crate::lyapunov::blocks::quotient;
use core::ops::{Index, IndexMut};

/// What is summed. Parts of a machine leave the sums that they do not have at 0.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sum {
    Time,
    /// The number of impacts, or closings of a stop, and the sum of their speeds.
    Impacts,
    Speeds,
    /// The impulses of impacts and of the force of a contact, and those of a reaction at rest or of a friction joint.
    Impulse,
    RestImpulse,
    /// Energy lost in impacts, in the dampers of stops and in friction.
    ImpactLoss,
    ContactLoss,
    FrictionLoss,
    /// Energy lost in the damping, but for a constant factor.
    Damping,
    /// Work on the system.
    Work,
    /// The times in which a stop is closed, in which the system rests on it, and in which a joint holds.
    Closed,
    Resting,
    Holding,
    /// The integrals of position and velocity, and of their squares.
    X,
    XSquared,
    V,
    VSquared,
}

/// The number of sums.
const COUNT: usize = Sum::VSquared as usize + 1;

/// The sums over a part of a motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums([f64; COUNT]);

impl Index<Sum> for Sums {
    type Output = f64;

    fn index(&self, sum: Sum) -> &f64 {
        &self.0[sum as usize]
    }
}

impl IndexMut<Sum> for Sums {
    fn index_mut(&mut self, sum: Sum) -> &mut f64 {
        &mut self.0[sum as usize]
    }
}

/// The constants between sums and quantities.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// The forcing period; NaN without forcing.
    pub(super) period: f64,
    /// The factor of [`Sum::Damping`].
    pub(super) damping: f64,
}

impl Sums {
    /// The sums over the part after `earlier`.
    pub(super) fn since(&self, earlier: &Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] - earlier.0[k]))
    }

    /// Adds those of another part of the system.
    pub(super) fn add(&mut self, other: &Self) {
        self.0.iter_mut().zip(other.0).for_each(|(sum, more)| *sum += more);
    }

    /// The upper sum of a mean.
    fn above(&self, quantity: Quantity) -> f64 {
        quantity.sums().iter().map(|sum| self[*sum]).reduce(|a, b| a + b).unwrap_or(f64::NAN)
    }

    /// A mean over a motion that takes this time in all, and so many forcing periods.
    pub(super) fn mean(&self, quantity: Quantity, time: f64, periods: f64, damping: f64) -> f64 {
        let sum = self.above(quantity);
        match quantity {
            Quantity::ImpactSpeedMean => {
                let impacts = self[Sum::Impacts];
                // a chatter has infinitely many impacts, and then the mean speed is not defined
                if impacts > 0.0 && impacts.is_finite() { sum / impacts } else { f64::NAN }
            }
            // a difference of two sums of squares can be negative by rounding
            Quantity::DisplacementRms | Quantity::VelocityRms => (sum.max(0.0) / time).sqrt(),
            Quantity::DampingPower => damping * sum / time,
            Quantity::DampingLossPerPeriod => damping * sum / periods,
            _ => sum / if quantity.per_period() { periods } else { time },
        }
    }
}

/// A mean over blocks of a motion, with three standard errors; NaN for the mean speed of infinitely many impacts.
pub(super) fn mean_over(blocks: &[Sums], quantity: Quantity, scale: Scale) -> Measured {
    let by_impacts = quantity == Quantity::ImpactSpeedMean;
    // the mean speed is one per impact, all others are means over time
    let below = |sums: &Sums| sums[if by_impacts { Sum::Impacts } else { Sum::Time }];
    if by_impacts && !blocks.iter().all(|sums| below(sums).is_finite()) {
        return Measured { value: f64::NAN, error: f64::NAN };
    }
    let found = quotient(blocks, 0.0, |sums| sums.above(quantity), below);
    let factor = match quantity {
        Quantity::DisplacementRms | Quantity::VelocityRms => {
            let root = found.value.max(0.0).sqrt();
            return Measured { value: root, error: found.error / (2.0 * root) };
        }
        Quantity::DampingPower => scale.damping,
        Quantity::DampingLossPerPeriod => scale.damping * scale.period,
        _ if quantity.per_period() => scale.period,
        _ => 1.0,
    };
    found.scaled(factor)
}

impl Quantity {
    /// The sums that make up the upper one of a mean; none for an extreme.
    const fn sums(self) -> &'static [Sum] {
        match self {
            Self::ImpactSpeedMean => &[Sum::Speeds],
            Self::ImpactsPerPeriod | Self::ImpactRate => &[Sum::Impacts],
            Self::ImpulsePerPeriod => &[Sum::Impulse],
            Self::MomentumPerPeriod => &[Sum::Impulse, Sum::RestImpulse],
            Self::ImpactLossPerPeriod | Self::ImpactPower => &[Sum::ImpactLoss],
            Self::ContactLossPerPeriod | Self::ContactPower => &[Sum::ContactLoss],
            Self::FrictionLossPerPeriod | Self::FrictionPower => &[Sum::FrictionLoss],
            Self::DampingLossPerPeriod | Self::DampingPower => &[Sum::Damping],
            Self::WorkPerPeriod | Self::Power => &[Sum::Work],
            Self::DisplacementMean => &[Sum::X],
            Self::DisplacementRms => &[Sum::XSquared],
            Self::VelocityMean => &[Sum::V],
            Self::VelocityRms => &[Sum::VSquared],
            Self::StickingFraction => &[Sum::Resting],
            Self::ContactFraction => &[Sum::Closed, Sum::Resting],
            Self::HoldingFraction => &[Sum::Holding],
            Self::ImpactSpeedMax
            | Self::ImpulseMax
            | Self::ForceMax
            | Self::DisplacementMin
            | Self::DisplacementMax
            | Self::DisplacementAmplitude
            | Self::VelocityMax
            | Self::AccelerationMax => &[],
        }
    }

    /// Whether it is a mean over the motion, as opposed to an extreme.
    #[must_use]
    pub const fn is_mean(self) -> bool {
        !self.sums().is_empty()
    }

    /// Whether it is meant for one forcing period.
    const fn per_period(self) -> bool {
        matches!(
            self,
            Self::ImpactsPerPeriod
                | Self::ImpulsePerPeriod
                | Self::MomentumPerPeriod
                | Self::ImpactLossPerPeriod
                | Self::ContactLossPerPeriod
                | Self::FrictionLossPerPeriod
                | Self::DampingLossPerPeriod
                | Self::WorkPerPeriod
        )
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
            let mut sums = Sums::default();
            (sums[Sum::Time], sums[Sum::ImpactLoss], sums[Sum::XSquared]) = (2.0, lost, lost);
            sums
        };
        let blocks: Vec<Sums> = (0..128).map(block).collect();
        let scale = Scale { period: 4.0, damping: 0.0 };
        let standard = (128.0_f64 / 127.0 * 128.0).sqrt() / 256.0;
        let power = mean_over(&blocks, Quantity::ImpactPower, scale);
        assert_eq!(power.value, 1.5);
        assert!((power.error / (3.0 * standard) - 1.0).abs() < 1e-13);
        let loss = mean_over(&blocks, Quantity::ImpactLossPerPeriod, scale);
        assert!((loss.error / (power.error * 4.0) - 1.0).abs() < 1e-14);
        let rms = mean_over(&blocks, Quantity::DisplacementRms, scale);
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

    #[test]
    fn names_tell_what_is_per_period() {
        for quantity in Quantity::ALL {
            assert_eq!(quantity.per_period(), quantity.name().ends_with("_per_period"), "{quantity:?}");
        }
    }
}
