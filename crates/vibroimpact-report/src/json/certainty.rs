//! How certain the shares of motions are.

use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact_study::basin::{missed_share, share_interval};

/// How certain the shares of motions are, if the starts were random ones.
#[derive(Debug, JsonSchema, Serialize)]
pub(super) struct Certainty {
    /// The interval of each share at a confidence of 95 %, in the order of the motions.
    share_intervals: Vec<(f64, f64)>,
    /// The largest share of a motion that no start has shown, at a confidence of 95 %.
    missed_below: f64,
}

impl Certainty {
    /// Of motions to which this number of starts leads, of `total` starts.
    pub(super) fn of(counts: impl Iterator<Item = u64>, total: u64) -> Self {
        let share_intervals = counts.map(|count| share_interval(count, total)).collect();
        Self { share_intervals, missed_below: missed_share(total) }
    }
}
