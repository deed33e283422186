//! How certain the shares of motions are.

use crate::number::percent;
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact_study::basin::{missed_share, share_interval};
use vibroimpact_study::counted;

/// How certain the shares of motions are, if the starts were random ones.
#[derive(Debug, JsonSchema, Serialize)]
pub(crate) struct Certainty {
    /// The interval of each share at a confidence of 95 %, in the order of the motions.
    share_intervals: Vec<(f64, f64)>,
    /// The largest share of a motion that no start has shown, at a confidence of 95 %.
    missed_below: f64,
}

impl Certainty {
    /// Of motions to which this number of starts leads, of `total` starts.
    pub(crate) fn of(counts: impl Iterator<Item = u64>, total: u64) -> Self {
        let share_intervals = counts.map(|count| share_interval(count, total)).collect();
        Self { share_intervals, missed_below: missed_share(total) }
    }
}

/// The largest error of a share, and the largest share that no start may have shown, both at a confidence of 95 %.
#[allow(clippy::cast_precision_loss)] // counts below 2^53
pub(crate) fn certainty(counts: impl Iterator<Item = u64>, total: u64) -> String {
    let error = |count: u64| {
        let (share, (low, high)) = (count as f64 / total.max(1) as f64, share_interval(count, total));
        (share - low).max(high - share)
    };
    format!(
        "  95 % confidence: shares are right to within {} of the starts; a motion that none of {} leads to has a share below {}\n",
        percent(counts.map(error).fold(0.0, f64::max)),
        counted(total, "start"),
        percent(missed_share(total))
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_and_the_share_that_may_be_missed() {
        // Wilson: (0.5 +- 0.0960) for 50 of 100, and 0 to 0.0370 for 0 of 100; 1 - 0.05^(1/100) = 0.0295
        let text = certainty([50, 50, 0].into_iter(), 100);
        assert!(
            text.contains(
                "within 9.6 % of the starts; a motion that none of 100 starts leads to has a share below 3.0 %"
            ),
            "{text}"
        );
    }
}
