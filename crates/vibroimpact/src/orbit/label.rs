//! The label of a periodic motion: `m/n`, m impacts in n forcing periods over its smallest period.
//!
//! `2/2` is not `1/1`: its two impacts differ. A motion with a complete chatter has infinitely many impacts and the
//! label `inf/n`. The steady motion without impacts has the label `0`. A limit cycle of a machine without forcing has the
//! label `m/T`: m closings of stops in its period T. The 1971 paper calls 1/1 fundamental, m/1 of
//! higher order, 1/n fractional and the others super-sub.

use core::fmt;
use core::str::FromStr;
use thiserror::Error;

/// The number of impacts in one period of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Count {
    /// A finite number.
    Finite(u32),
    /// Infinitely many: a complete chatter.
    Infinite,
}

/// The label m/n of a periodic motion.
///
/// ```
/// use vibroimpact::Label;
/// let label: Label = "4/1".parse()?;
/// assert_eq!(label.to_string(), "4/1");
/// assert_eq!("inf/2".parse::<Label>()?.to_string(), "inf/2");
/// assert!("3/0".parse::<Label>().is_err());
/// # Ok::<(), vibroimpact::verdict::LabelError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Label {
    /// Impacts per period.
    pub impacts: Count,
    /// Forcing periods per period of the motion, at least 1; 0 for a machine without forcing.
    pub periods: u32,
}

impl Label {
    /// The label `m/n` with finitely many impacts.
    #[must_use]
    pub const fn new(impacts: u32, periods: u32) -> Self {
        Self { impacts: Count::Finite(impacts), periods }
    }

    /// The label that a text `m/T` stands for, with m from 0 to 10000, or `inf/T`: of a limit cycle of a machine without
    /// forcing. `None` for another text.
    #[must_use]
    pub fn unforced(text: &str) -> Option<Self> {
        let impacts = match text.trim().strip_suffix("/T")? {
            "inf" => Count::Infinite,
            "0" => Count::Finite(0),
            m => Count::Finite(whole(m)?),
        };
        Some(Self { impacts, periods: 0 })
    }
}

/// A whole number from 1 to 10000, in digits.
fn whole(text: &str) -> Option<u32> {
    let digits = text.bytes().all(|b| b.is_ascii_digit());
    text.parse::<u32>().ok().filter(|k| digits && (1..=10_000).contains(k))
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.impacts {
            Count::Finite(m) if self.periods == 0 => write!(f, "{m}/T"),
            Count::Infinite if self.periods == 0 => f.write_str("inf/T"),
            Count::Finite(0) => f.write_str("0"),
            Count::Finite(m) => write!(f, "{m}/{}", self.periods),
            Count::Infinite => write!(f, "inf/{}", self.periods),
        }
    }
}

/// The text is not a label.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error(
    "label `{given}` is not m/n with m and n whole numbers from 1 to 10000 (or inf/n, or 0)\nhint: m impacts in n forcing periods, for example 2/1"
)]
pub struct LabelError {
    given: String,
}

impl FromStr for Label {
    type Err = LabelError;

    fn from_str(text: &str) -> Result<Self, LabelError> {
        let bad = || LabelError { given: text.chars().take(40).collect() };
        let whole = |part: &str| whole(part).ok_or_else(bad);
        if text.trim() == "0" {
            return Ok(Self::new(0, 1));
        }
        let (m, n) = text.trim().split_once('/').ok_or_else(bad)?;
        let impacts = if m == "inf" { Count::Infinite } else { Count::Finite(whole(m)?) };
        Ok(Self { impacts, periods: whole(n)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_labels_parse() {
        for good in ["1/1", "10000/1", "inf/3", "0"] {
            assert_eq!(good.parse::<Label>().unwrap().to_string(), good);
        }
        for good in ["0/T", "12/T", "inf/T"] {
            assert_eq!(Label::unforced(good).unwrap().to_string(), good);
            assert!(good.parse::<Label>().is_err());
        }
        for bad in ["1/1", "/T", "+1/T", "10001/T", "1/t", "T", "0", "1/T/T"] {
            assert_eq!(Label::unforced(bad), None);
        }
        for bad in ["3/0", "0/1", "1", "1/1/1", "-1/2", "+1/2", "1.5/2", "inf/0", "inf", "", "1/99999999999", "nan/1"] {
            let message = bad.parse::<Label>().unwrap_err().to_string();
            assert!(message.contains(bad) && message.contains("1 to 10000"), "{message}");
        }
    }
}
