//! The attractors: one row for each, the most frequent first.

use super::Table;
use crate::number::Number;
use vibroimpact::Oscillator;
use vibroimpact::verdict::Census;

/// Label, share and number of the starts, and real and imaginary part of both multipliers if the motion has any.
#[must_use]
pub fn table(found: &Census, osc: &Oscillator) -> Table<'static> {
    let row = |motion: &&vibroimpact::verdict::CountedMotion| {
        let both = motion.verdict.multipliers(osc);
        let parts = both.map_or_else(
            || ",,,".to_owned(),
            |[a, b]| format!("{},{},{},{}", Number(a.re), Number(a.im), Number(b.re), Number(b.im)),
        );
        format!("{},{},{},{parts}", motion.verdict.label(), Number(found.share(motion)), motion.count)
    };
    let rows: Vec<String> = found.by_share().iter().map(row).collect();
    let header = "label,share,starts,multiplier1_re,multiplier1_im,multiplier2_re,multiplier2_im";
    Table::new(header.to_owned(), rows.into_iter())
}
