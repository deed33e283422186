//! The motions of a basin as text.

use crate::report::words::{meaning, table};
use vibroimpact_report::json::basin::by_count;
use vibroimpact_report::number::percent;
use vibroimpact_study::Basin;

/// One row for each motion.
pub(crate) fn text(found: &Basin) -> String {
    let heads = ["share", "starts", "<label", "<meaning"].map(str::to_owned);
    let row = |m: usize| {
        let motion = &found.motions[m];
        let label = motion.verdict.label().into_owned();
        vec![percent(found.share(m)), motion.count.to_string(), label, meaning(&motion.verdict)]
    };
    table(&heads, &by_count(found).into_iter().map(row).collect::<Vec<_>>())
}
