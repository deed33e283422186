//! `A:B:N`: N evenly spaced values from A to B, both included. `A:B:N:log`: N values with a constant ratio.
//!
//! All grids use these values. The command, plans, the Python package and the page pass on the text, and [`Span::at`]
//! computes the values.

mod double;
mod even;

use crate::typed::decimal;
use crate::{PlanError, counted};
use core::fmt;
use core::str::FromStr;
use even::Rule;
use serde::{Deserialize, Serialize};

/// Evenly spaced values, or values with a constant ratio. Both ends are included.
///
/// ```
/// use vibroimpact_study::Span;
/// let span: Span = "0.4:2:33".parse()?;
/// assert_eq!((span.at(0), span.at(32), span.count()), (0.4, 2.0, 33));
/// let decades: Span = "0.01:100:5:log".parse()?;
/// assert_eq!(decades.values().collect::<Vec<_>>(), [0.01, 0.1, 1.0, 10.0, 100.0]);
/// assert!("1:2".parse::<Span>().is_err() && "2:1:0".parse::<Span>().is_err());
/// # Ok::<(), vibroimpact_study::PlanError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Span {
    first: f64,
    last: f64,
    count: u32,
    rule: Rule,
}

/// Maximum number of values on one axis.
const MOST: u64 = 1_000_000;

impl Span {
    /// `count` values from `first` to `last`.
    ///
    /// # Errors
    /// [`PlanError`] for ends that are not finite, for equal ends with more than one value, and for a count outside 1
    /// to 1 000 000.
    pub fn new(first: f64, last: f64, count: u32) -> Result<Self, PlanError> {
        Self::checked(first, last, count, false)
    }

    /// `count` values from `first` to `last` with a constant ratio.
    ///
    /// # Errors
    /// As for [`Span::new`]; and [`PlanError::Refused`] if an end is not positive.
    pub fn logarithmic(first: f64, last: f64, count: u32) -> Result<Self, PlanError> {
        Self::checked(first, last, count, true)
    }

    fn checked(first: f64, last: f64, count: u32, logarithmic: bool) -> Result<Self, PlanError> {
        let given = || written(first, last, count, logarithmic);
        if !(first.is_finite() && last.is_finite()) {
            return Err(PlanError::Range { given: given() });
        }
        if logarithmic && (first <= 0.0 || last <= 0.0) {
            let sentence = format!("range `{}` is logarithmic, so both ends must be positive", given());
            return Err(PlanError::refused(sentence));
        }
        // one value over a distance, or several at one place, is an error of the user
        let many = u64::from(count);
        if !(1..=MOST).contains(&many) || (count == 1) != (first == last) {
            return Err(wrong_count(&given(), many));
        }
        let rule = if logarithmic { Rule::geometric(first, last) } else { Rule::even(first, last, count - 1) };
        Ok(Self { first, last, count, rule })
    }

    /// Value number `k`, counted from 0. The first and the last value are exactly the ends. The others are the doubles
    /// nearest to the exact values between the ends in their decimal form, so a middle value that is a double is exact.
    #[must_use]
    pub fn at(&self, k: u32) -> f64 {
        let steps = self.count - 1;
        match k {
            0 => self.first,
            _ if k >= steps => self.last,
            _ => self.rule.at(self.first, self.last, k, steps),
        }
    }

    /// The number of values.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// Whether the values have a constant ratio (as opposed to even spacing).
    #[must_use]
    pub const fn is_logarithmic(&self) -> bool {
        matches!(self.rule, Rule::Geometric { .. })
    }

    /// The same number of values with the same kind of spacing; both ends are divided by `unit`.
    ///
    /// # Errors
    /// [`PlanError`] if an end overflows or the ends become equal.
    pub fn scaled(&self, unit: f64) -> Result<Self, PlanError> {
        Self::checked(self.first / unit, self.last / unit, self.count, self.is_logarithmic())
    }

    /// The two ends, in the given order.
    #[must_use]
    pub const fn ends(&self) -> (f64, f64) {
        (self.first, self.last)
    }

    /// All values, in order.
    pub fn values(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count).map(|k| self.at(k))
    }
}

/// The error of a range with too few or too many values.
fn wrong_count(given: &str, count: u64) -> PlanError {
    let asked = format!("range `{given}` asks for {}", counted(count, "value"));
    PlanError::refused(format!("{asked}; allowed is 1 to {MOST}, and 1 only when A = B"))
}

/// The text of a range.
fn written(first: f64, last: f64, count: u32, logarithmic: bool) -> String {
    format!("{first}:{last}:{count}{}", if logarithmic { ":log" } else { "" })
}

impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&written(self.first, self.last, self.count, self.is_logarithmic()))
    }
}

impl FromStr for Span {
    type Err = PlanError;

    fn from_str(text: &str) -> Result<Self, PlanError> {
        let bad = || PlanError::Range { given: text.chars().take(60).collect() };
        let parts: Vec<&str> = text.split(':').collect();
        let (logarithmic, parts) = match parts.as_slice() {
            [rest @ .., "log"] => (true, rest),
            all => (false, all),
        };
        let [first, last, count] = parts else {
            return Err(bad());
        };
        let number = |part: &str| decimal(part).filter(|x| x.is_finite()).ok_or_else(bad);
        let count: u64 = count.trim().parse().map_err(|_| bad())?;
        let (first, last) = (number(first)?, number(last)?);
        let Ok(count) = u32::try_from(count) else {
            return Err(wrong_count(text, count));
        };
        Self::checked(first, last, count, logarithmic)
    }
}

impl schemars::JsonSchema for Span {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Span".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "A:B:N, N values from A to B, both included; A:B:N:log spaced evenly in their logarithms.",
            "type": "string",
            "pattern": "^[^:]+:[^:]+:[0-9]+(:log)?$",
        })
    }
}

impl TryFrom<String> for Span {
    type Error = PlanError;

    fn try_from(text: String) -> Result<Self, PlanError> {
        text.parse()
    }
}

impl From<Span> for String {
    fn from(span: Span) -> Self {
        span.to_string()
    }
}

#[cfg(test)]
mod tests;
