//! The Lyapunov exponents of a motion, with error bars.

/// A measured number with its error bar.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// The estimate.
    pub value: f64,
    /// Three standard errors.
    pub error: f64,
}

impl Measured {
    /// A number without an error.
    pub(crate) const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// The number multiplied by a factor that is not negative.
    #[must_use]
    pub const fn scaled(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor }
    }
}

/// The Lyapunov exponents of a motion: two of an oscillator, and of a machine two for each coordinate and one for each surface
/// of a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum<E = [Measured; 2]> {
    /// Lyapunov exponents per unit of time, the largest first. Minus infinity where neighbouring motions become the same.
    pub exponents: E,
    /// Impacts per unit of time; of a machine, closings of stops.
    pub impact_rate: Measured,
    /// The time of the run.
    pub time: f64,
}

/// The logarithm of the largest stretch during a transient: from a distance of one rounding error, $`2^{-53}`$ (a
/// factor $`e^{36.7}`$), to the size of the motion, and a margin. A motion that leaves an unstable cycle slowly
/// diverges for that long, so steadily that its error bar is narrow.
const TRANSIENT: f64 = 40.0;

impl<E: AsRef<[Measured]>> Spectrum<E> {
    /// Whether neighbours separate: the largest exponent exceeds its error bar.
    #[must_use]
    pub fn diverges(&self) -> bool {
        self.exponents.as_ref().first().is_some_and(|first| first.value > first.error)
    }

    /// Whether neighbours separate, over the whole run, by more than is possible on the way from an unstable cycle to a
    /// stable one.
    #[must_use]
    pub fn chaotic(&self) -> bool {
        self.diverges() && self.exponents.as_ref().first().is_some_and(|first| first.value * self.time > TRANSIENT)
    }
}
