//! What lengths, velocities and times of results are measured in.

use vibroimpact::Scales;
use vibroimpact_study::{Parameter, PlanError, Span, SystemPlan, Values, is_length};

/// The system as it goes into a plan, and the units its results are wanted in.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// The system, nondimensional.
    pub system: SystemPlan,
    /// The units of results.
    pub units: Units,
}

/// One unit of the results, in nondimensional units: those themselves, or metres and seconds of a machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Units {
    /// Of the machine, where one was given.
    pub scales: Option<Scales>,
    /// Whether results are in metres and seconds.
    pub si: bool,
}

impl Units {
    fn factor(&self, of: impl Fn(&Scales) -> f64) -> f64 {
        self.scales.as_ref().filter(|_| self.si).map_or(1.0, of)
    }

    /// Of a length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.factor(|s| s.length_m)
    }

    /// Of a time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.factor(|s| s.time_s)
    }

    /// Of a velocity.
    #[must_use]
    pub fn velocity(&self) -> f64 {
        self.factor(Scales::velocity_m_per_s)
    }

    /// Of a parameter.
    #[must_use]
    pub fn of(&self, parameter: Parameter) -> f64 {
        if is_length(parameter) { self.length() } else { 1.0 }
    }

    /// `name`, followed by its unit where there is one: `time (s)`.
    #[must_use]
    pub fn named(&self, name: &str, unit: &str) -> String {
        if self.si { format!("{name} ({unit})") } else { name.to_owned() }
    }

    /// The name of the units in JSON.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        if self.si { "si" } else { "nondimensional" }
    }
}

/// The number that was divided by `unit` to give `value`: of all that do, the one with the fewest digits. So what was given in
/// metres as `0.005` is printed as `0.005`, and not as `0.0050000000000000001`.
pub(crate) fn given(value: f64, unit: f64) -> f64 {
    let product = value * unit;
    if unit == 1.0 {
        return value;
    }
    let shorter = |digits: usize| format!("{product:.digits$e}").parse::<f64>().ok();
    (14..=16).filter_map(shorter).find(|candidate| candidate / unit == value).unwrap_or(product)
}

/// The values of a range or list in another unit, as they were [given].
///
/// # Errors
/// [`PlanError`] where that leaves the range of numbers.
pub(crate) fn shown(values: &Values, unit: f64) -> Result<Values, PlanError> {
    Ok(match values {
        Values::Span(span) => Values::Span(shown_span(span, unit)?),
        Values::Listed(list) => Values::Listed(list.iter().map(|value| given(*value, unit)).collect()),
    })
}

/// The same of a range.
///
/// # Errors
/// As [`shown`].
pub(crate) fn shown_span(span: &Span, unit: f64) -> Result<Span, PlanError> {
    let ((first, last), count) = (span.ends(), span.count());
    let (first, last) = (given(first, unit), given(last, unit));
    if span.is_logarithmic() { Span::logarithmic(first, last, count) } else { Span::new(first, last, count) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What was divided by a unit comes back, for thousands of numbers and units.
    #[test]
    fn what_was_given_comes_back() {
        for k in 1..200_u32 {
            let unit = 0.000_37 * f64::from(k);
            for text in ["0.005", "0.1", "-0.0123456789", "3", "7e-9", "123456.789012345"] {
                let typed: f64 = text.parse().unwrap();
                assert_eq!(given(typed / unit, unit), typed, "{text} in {unit}");
            }
        }
        assert_eq!(given(0.1 + 0.2, 1.0), 0.1 + 0.2);
        assert_eq!(given(0.0, 0.3), 0.0);
        let span: Span = "0.005:0.01:6".parse().unwrap();
        assert_eq!(shown_span(&span.scaled(0.02).unwrap(), 0.02).unwrap(), span);
    }
}
