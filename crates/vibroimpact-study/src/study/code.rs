//! Labels as integers, the same in every tile and on every machine: m/n is 10000 m + n.
//!
//! For example 1/1 is 10001 and 3/2 is 30002. A motion with a complete chatter is 1 000 000 000 + n, a motion without
//! impacts is 0. Results that are no periodic motion are negative. A number of periods above 9999 is stored as 0, a
//! number of impacts above 99 999 as 99 999. Motions m/T of machines without forcing are 1 500 000 000 + m, and those with
//! a complete chatter 1 600 000 000.

use crate::field::{Extra, Field, NumberType};
use vibroimpact::Label;
use vibroimpact::verdict::{Count, System, Verdict};

/// The point has not been computed.
pub const NOT_COMPUTED: i32 = -9;
/// The point has no further motion.
pub const NO_MOTION: i32 = -1;
/// Chaotic motion.
pub const CHAOTIC: i32 = -2;
/// At rest on a stop for ever.
pub const STUCK: i32 = -3;
/// Undecided within the budget.
pub const UNDECIDED: i32 = -4;
/// The start of a machine lies beyond a rigid stop.
pub const REFUSED: i32 = -5;
/// No more impacts.
pub const NO_IMPACT: i32 = 0;

const PER_IMPACT: u32 = 10_000;
const CHATTER: u32 = 1_000_000_000;
const UNFORCED: u32 = 1_500_000_000;
const UNFORCED_CHATTER: u32 = 1_600_000_000;

/// Special values without m and n, and their meanings.
pub(super) const FLAGS: [(i32, &str); 6] = [
    (NOT_COMPUTED, "not_computed"),
    (UNDECIDED, "undecided"),
    (STUCK, "stuck"),
    (CHAOTIC, "chaotic"),
    (NO_MOTION, "no_further_motion"),
    (NO_IMPACT, "no_impact"),
];

pub(super) const COMMENT: &str = "10000 m + n for a motion m/n with m impacts in n forcing periods, 1000000000 + n for \
                                  inf/n with a complete chatter; n = 0 stands for more than 9999 periods; 1500000000 + m \
                                  for a motion m/T without forcing, 1600000000 for inf/T";

/// The field of labels; further dimensions are `extra`.
pub(super) fn field(long_name: &'static str, extra: &[Extra]) -> Field {
    Field { comment: COMMENT, ..Field::integers("label", long_name, NumberType::I32, extra, &FLAGS) }
}

/// The code of a motion.
#[must_use]
pub fn code<S: System>(verdict: &Verdict<S>) -> i32 {
    match verdict {
        Verdict::Periodic(cycle) => of(S::label(cycle)),
        Verdict::NoImpact(_) => NO_IMPACT,
        Verdict::Chaotic(_) => CHAOTIC,
        Verdict::Stuck(_) => STUCK,
        Verdict::Undecided(_) => UNDECIDED,
    }
}

fn of(label: Label) -> i32 {
    if label.periods == 0 {
        let code = match label.impacts {
            Count::Finite(m) => UNFORCED + m.min(99_999),
            Count::Infinite => UNFORCED_CHATTER,
        };
        return i32::try_from(code).unwrap_or(UNDECIDED);
    }
    let n = if label.periods < PER_IMPACT { label.periods } else { 0 };
    let m = match label.impacts {
        Count::Finite(0) => return NO_IMPACT,
        Count::Finite(m) => m.min(99_999) * PER_IMPACT,
        Count::Infinite => CHATTER,
    };
    i32::try_from(m + n).unwrap_or(UNDECIDED)
}

/// The label of a code as a word that may be a flag meaning of the CF conventions (3.5), which has no slash: `2_in_1` for 2/1.
#[must_use]
pub fn meaning_of(code: i32) -> Option<String> {
    label_of(code).map(|label| label.replace('/', "_in_"))
}

/// The label of a code as text; `None` if the code stands for no motion.
///
/// ```
/// use vibroimpact_study::study::label_of;
/// assert_eq!(label_of(20_001).as_deref(), Some("2/1"));
/// assert_eq!(label_of(1_000_000_003).as_deref(), Some("inf/3"));
/// assert_eq!(label_of(0).as_deref(), Some("0"));
/// assert_eq!(label_of(-1), None);
/// ```
#[must_use]
pub fn label_of(code: i32) -> Option<String> {
    Some(match code {
        NO_IMPACT => "0".to_owned(),
        CHAOTIC => "chaotic".to_owned(),
        STUCK => "stuck".to_owned(),
        UNDECIDED => "undecided".to_owned(),
        _ => {
            let code = u32::try_from(code).ok()?;
            if code >= UNFORCED_CHATTER {
                return Some("inf/T".to_owned());
            }
            if let Some(m) = code.checked_sub(UNFORCED) {
                return Some(format!("{m}/T"));
            }
            let (m, n) = match code.checked_sub(CHATTER) {
                Some(n) => ("inf".to_owned(), n),
                None => ((code / PER_IMPACT).to_string(), code % PER_IMPACT),
            };
            if n == 0 { format!("{m}/>9999") } else { format!("{m}/{n}") }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_come_back() {
        for text in ["1/1", "2/1", "1/9999", "99999/3", "inf/1", "inf/17", "0"] {
            let label = |text: &str| -> Label {
                // a label that is parsed may not have 99999 impacts
                let (m, n) = text.split_once('/').unwrap_or(("0", "1"));
                let impacts = m.parse().map_or(Count::Infinite, Count::Finite);
                Label { impacts, periods: n.parse().unwrap() }
            };
            assert_eq!(label_of(of(label(text))).unwrap(), text);
        }
        assert_eq!(label_of(of(Label::new(3, 10_000))).unwrap(), "3/>9999");
        assert_eq!(label_of(of(Label::new(4_000_000_000, 1))).unwrap(), "99999/1");
        for m in [0, 1, 17, 99_999] {
            assert_eq!(label_of(of(Label::new(m, 0))).unwrap(), format!("{m}/T"));
        }
        assert_eq!(label_of(of(Label { impacts: Count::Infinite, periods: 0 })).unwrap(), "inf/T");
        for (code, name) in FLAGS {
            assert_eq!(label_of(code).is_some(), !matches!(name, "not_computed" | "no_further_motion"), "{name}");
        }
    }
}
