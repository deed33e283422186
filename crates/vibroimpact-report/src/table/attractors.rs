//! The attractors: one row for each, the most frequent first.

use super::Table;
use super::quantities::{cells, columns};
use crate::Units;
use crate::number::Number;
use vibroimpact::Oscillator;
use vibroimpact::quantities::{Quantity, of_verdict};
use vibroimpact::verdict::Census;

/// Label, share and number of the starts, real and imaginary part of both multipliers if the motion has any, and all
/// quantities in these units.
#[must_use]
pub fn table(found: &Census, osc: &Oscillator, units: &Units) -> Table<'static> {
    let row = |motion: &&vibroimpact::verdict::CountedMotion| {
        let both = motion.verdict.multipliers(osc);
        let parts = both.map_or_else(
            || ",,,".to_owned(),
            |[a, b]| format!("{},{},{},{}", Number(a.re), Number(a.im), Number(b.re), Number(b.im)),
        );
        let quantities = cells(&Quantity::ALL, of_verdict(osc, &motion.verdict), units);
        format!("{},{},{},{parts}{quantities}", motion.verdict.label(), Number(found.share(motion)), motion.count)
    };
    let rows: Vec<String> = found.by_share().iter().map(row).collect();
    let header = "label,share,starts,multiplier_1_re,multiplier_1_im,multiplier_2_re,multiplier_2_im";
    Table::new(format!("{header}{}", columns(&Quantity::ALL, units)), rows.into_iter())
}
