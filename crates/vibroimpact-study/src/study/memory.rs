//! A whole study computed in memory, for grids that fit.

use super::{Study, StudyTable, Tiles};
use crate::field::{Column, Field};
use crate::grid::Grid;
use crate::limits::MOST_CELLS;
use crate::{Block, Control, Meter, PlanError, RunError, Stopped, tiles};

/// A study with all its arrays.
pub struct Sheet {
    /// The study.
    pub study: Study,
    /// Its fields.
    pub fields: Vec<Field>,
    /// The array of each field over the whole grid, in row-major order.
    pub columns: Vec<Column>,
    /// The final tables.
    pub tables: Vec<StudyTable>,
}

/// Checks that one run can keep all numbers of a study in memory.
///
/// # Errors
/// [`PlanError::Refused`] if there are too many.
pub fn check_memory(study: &Study) -> Result<(), PlanError> {
    let width = study.fields().iter().map(|field| field.width() as u64).sum::<u64>();
    let numbers = width.saturating_mul(study.grid().points());
    let (most, hint) = (4 * MOST_CELLS, "give a store, which holds any number");
    let sentence = || format!("{numbers} numbers would have to be kept; at most {most} fit\nhint: {hint}");
    if numbers > most { Err(PlanError::refused(sentence())) } else { Ok(()) }
}

/// Computes all tiles of a study and joins them.
///
/// # Errors
/// [`RunError`] when stopped, or for more numbers than one run keeps in memory.
pub fn in_memory(study: Study, control: &Control<'_>) -> Result<Sheet, RunError> {
    let (fields, grid) = (study.fields(), study.grid().clone());
    check_memory(&study)?;
    let points = usize::try_from(grid.points()).unwrap_or(usize::MAX);
    let parts = each_tile(&grid, control, |k, tick| study.tile(k, tick))?;
    let mut columns: Vec<Column> = fields.iter().map(|field| field.empty(points)).collect();
    let all = grid.whole();
    for (k, part) in parts.into_iter().enumerate() {
        for ((field, column), part) in fields.iter().zip(&mut columns).zip(&part) {
            grid.tile(k as u64).rows(&all, field.width(), |at, from, len| column.copy(at, part, from, len));
        }
    }
    let mut whole = Whole { grid: &grid, fields: &fields, columns: &mut columns };
    let tables = study.conclude(&mut whole).unwrap_or_else(|never| match never {});
    Ok(Sheet { fields, columns, tables, study })
}

/// The results of all tiles of a grid, in the order of the tiles.
pub(crate) fn tiles_of<T: Send>(
    grid: &Grid,
    control: &Control<'_>,
    compute: impl Fn(&Block, &(dyn Fn() -> bool + Sync)) -> Option<T> + Sync,
) -> Result<Vec<(Block, T)>, Stopped> {
    let blocks = (0..grid.tiles()).map(|k| grid.tile(k));
    Ok(blocks.zip(each_tile(grid, control, |k, tick| compute(&grid.tile(k), tick))?).collect())
}

/// Computes the tiles of a grid by several threads. Progress is reported in points.
fn each_tile<T: Send>(
    grid: &Grid,
    control: &Control<'_>,
    compute: impl Fn(u64, &(dyn Fn() -> bool + Sync)) -> Option<T> + Sync,
) -> Result<Vec<T>, Stopped> {
    let meter = Meter::new(control, 0, grid.points());
    // `tiles` counts tiles, but progress is reported in points, so its own report is silenced
    let silent = Control { progress: &|_| {}, ..*control };
    let parts = tiles(grid.tiles(), 1, &silent, |range, finished| {
        let part = meter.tile(grid.tile(range.start).points() as u64);
        let computed = compute(range.start, &|| part.tick());
        if computed.is_some() {
            part.finish();
        }
        finished();
        computed
    });
    let parts = parts.map_err(|_| meter.stopped())?;
    parts.into_iter().collect::<Option<Vec<T>>>().ok_or_else(|| meter.stopped())
}

struct Whole<'a> {
    grid: &'a Grid,
    fields: &'a [Field],
    columns: &'a mut [Column],
}

impl Tiles for Whole<'_> {
    type Error = core::convert::Infallible;

    fn read(&mut self, tile: u64, field: usize) -> Result<Column, Self::Error> {
        let block = self.grid.tile(tile);
        let mut part = self.fields[field].empty(block.points());
        let whole = &self.columns[field];
        block.rows(&self.grid.whole(), self.fields[field].width(), |at, from, len| part.copy(from, whole, at, len));
        Ok(part)
    }

    fn write(&mut self, tile: u64, field: usize, column: &Column) -> Result<(), Self::Error> {
        let block = self.grid.tile(tile);
        let whole = &mut self.columns[field];
        block.rows(&self.grid.whole(), self.fields[field].width(), |at, from, len| whole.copy(at, column, from, len));
        Ok(())
    }
}
