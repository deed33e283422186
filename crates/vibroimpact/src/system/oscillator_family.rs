//! An oscillator as a function of numbers that are not its own, as the mass and the force of a machine.

use super::{Oscillator, Parameter, Side, SystemError};
use core::fmt;
use std::sync::Arc;

type Function<const N: usize> = dyn Fn([f64; N]) -> Result<Oscillator, SystemError> + Send + Sync;

/// An oscillator for each value of N numbers.
///
/// ```
/// use vibroimpact::{Oscillator, OscillatorFamily};
/// // the stop moves outwards as the restitution falls
/// let family = OscillatorFamily::new(|[e]| Oscillator::new(0.9, 2.0 - e, e), [0.5]);
/// assert_eq!(family.at([0.75])?.gap(), 1.25);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone)]
pub struct OscillatorFamily<const N: usize> {
    function: Arc<Function<N>>,
    from: [f64; N],
}

impl<const N: usize> OscillatorFamily<N> {
    /// The oscillators that a function gives. The numbers have the values `from` in the system that is varied; their sizes
    /// are those of small changes.
    pub fn new(
        function: impl Fn([f64; N]) -> Result<Oscillator, SystemError> + Send + Sync + 'static,
        from: [f64; N],
    ) -> Self {
        Self { function: Arc::new(function), from }
    }

    /// The values of the numbers in the system that is varied.
    #[must_use]
    pub const fn from(&self) -> [f64; N] {
        self.from
    }

    /// The oscillator for values of the numbers.
    ///
    /// # Errors
    /// [`SystemError`] for values that give no valid system.
    pub fn at(&self, values: [f64; N]) -> Result<Oscillator, SystemError> {
        (self.function)(values)
    }

    /// For each number: the parameters of the oscillator that vary with it, with their change for a change of it by 1. They
    /// are differences with a relative error of about $`10^{-10}`$, exact for a parameter that is the number itself; at the
    /// edge of the allowed range the difference is one-sided. Branches use them for their direction only, so that this
    /// error moves no solution.
    ///
    /// # Errors
    /// [`SystemError`] for values that give no valid system.
    pub(crate) fn rates(&self, values: [f64; N]) -> Result<[Vec<(Parameter, f64)>; N], SystemError> {
        let mut all = [const { Vec::new() }; N];
        for (k, rates) in all.iter_mut().enumerate() {
            *rates = self.rates_by(values, k)?;
        }
        Ok(all)
    }

    fn rates_by(&self, values: [f64; N], k: usize) -> Result<Vec<(Parameter, f64)>, SystemError> {
        let at = |value: f64| {
            let mut values = values;
            values[k] = value;
            self.at(values).map(|osc| numbers(&osc))
        };
        let value = values[k];
        let step = STEP * value.abs().max(self.from[k].abs()).max(f64::MIN_POSITIVE);
        let (low, high) = (value - step, value + step);
        // one-sided where a number would leave its range
        let ((a, from), (b, to)) = match (at(low), at(high)) {
            (Ok(a), Ok(b)) => ((a, low), (b, high)),
            (Err(_), Ok(b)) => ((at(value)?, value), (b, high)),
            (Ok(a), Err(_)) => ((a, low), (at(value)?, value)),
            (Err(error), Err(_)) => return Err(error),
        };
        let rate = |i: usize| (b[i] - a[i]) / (to - from);
        Ok((0..NUMBERS.len()).map(|i| (NUMBERS[i], rate(i))).filter(|(_, rate)| *rate != 0.0).collect())
    }
}

/// Of families with the same function.
impl<const N: usize> PartialEq for OscillatorFamily<N> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.function, &other.function) && self.from == other.from
    }
}

impl<const N: usize> fmt::Debug for OscillatorFamily<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OscillatorFamily").field("from", &self.from).finish_non_exhaustive()
    }
}

/// The step of a difference, relative to the value: about the cube root of the rounding unit.
const STEP: f64 = 6e-6;

/// The parameters of an oscillator in the order of [`numbers`].
const NUMBERS: [Parameter; 6] = [
    Parameter::Beta,
    Parameter::Gap,
    Parameter::Restitution,
    Parameter::Damping,
    Parameter::SecondGap,
    Parameter::SecondRestitution,
];

fn numbers(osc: &Oscillator) -> [f64; 6] {
    let second = osc.stop(Side::Lower);
    let (gap, restitution) = second.map_or((0.0, 0.0), |stop| (stop.gap, stop.restitution));
    [osc.beta(), osc.gap(), osc.restitution(), osc.damping(), gap, restitution]
}
