//! The fields and the numbers of a basin as they are stored.

use super::{BasinTile, OscillatorBasin};
use crate::field::Column;
use crate::quantity::{self, Quantities};
use crate::study::reason;
use crate::study::refine::Cell;
use vibroimpact::math::Multiplier;
use vibroimpact::quantities::of_verdict_only;
use vibroimpact::verdict::{CountedMotion, Ending, Verdict};

/// The name, the description and the value of a part of the two multipliers of a motion.
type PartOfMultipliers = (&'static str, &'static str, fn(&[Multiplier; 2]) -> f64);

/// The multipliers as they are stored for points.
pub(super) const MULTIPLIERS: [PartOfMultipliers; 4] = [
    ("multiplier_1_re", "real part of the larger Floquet multiplier", |of| of[0].re),
    ("multiplier_1_im", "imaginary part of the larger Floquet multiplier", |of| of[0].im),
    ("multiplier_2_re", "real part of the smaller Floquet multiplier", |of| of[1].re),
    ("multiplier_2_im", "imaginary part of the smaller Floquet multiplier", |of| of[1].im),
];

impl OscillatorBasin {
    /// The columns of reasons, where the starts are points, of multipliers, and of the lengths of the transients.
    pub(super) fn details(&self, tile: &BasinTile<Self>) -> Vec<Column> {
        let mut columns = Vec::new();
        if self.of_points() {
            columns.push(reason::column(&tile.notes.endings));
        }
        if self.of_systems() {
            for part in MULTIPLIERS.map(|(_, _, part)| part) {
                let known: Vec<f64> =
                    tile.notes.found.iter().map(|found| found.multipliers.as_ref().map_or(f64::NAN, part)).collect();
                columns.push(Column::F64(tile.numbers().map(|number| known[number.unwrap_or(0) as usize]).collect()));
            }
        }
        if self.transient() {
            let own = |(cell, ending): (&Cell<Option<u32>>, &Ending)| match cell {
                Cell::Computed(_) => i32::try_from(ending.impacts).unwrap_or(i32::MAX),
                Cell::Like(_) => -1,
            };
            columns.push(Column::I32(tile.cells.iter().zip(&tile.notes.endings).map(own).collect()));
        }
        columns
    }

    /// The columns of the quantities that the plan asks for. Cells that took the motion of their neighbours have its quantities if
    /// all starts belong to one system.
    pub(super) fn quantities<'a>(
        &'a self,
        tile: &'a BasinTile<Self>,
        stored: &dyn Fn(&'a Verdict) -> &'a Verdict,
    ) -> Vec<Column> {
        let asked = self.asked();
        let mut columns = vec![Vec::with_capacity(tile.cells.len()); asked.len()];
        if asked.is_empty() {
            return Vec::new();
        }
        let known: Vec<Option<Quantities>> = match &self.one {
            Some((osc, _)) => {
                let of = |found: &'a CountedMotion| of_verdict_only(osc, stored(&found.verdict), asked);
                tile.met.motions().iter().map(of).collect()
            }
            None => tile.notes.found.iter().map(|found| found.quantities).collect(),
        };
        for cell in &tile.cells {
            let own = |(_, own): &(&Option<u32>, bool)| *own || self.one.is_some();
            let number = cell.result(&tile.cells).filter(own).and_then(|(number, _)| *number);
            let of = number.and_then(|number| known.get(number as usize).copied().flatten());
            columns.iter_mut().zip(quantity::values(asked, of)).for_each(|(column, value)| column.push(value));
        }
        columns.into_iter().map(Column::F64).collect()
    }
}
