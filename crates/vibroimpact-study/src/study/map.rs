//! The tiles of a map: the motions at each point, the most frequent first.

use super::code;
use super::fill::{Along, Fill, along, grid_of, on_axis};
use super::refine::{self, Cell};
use crate::field::{Column, Extra, Field, NumberType};
use crate::map::motions;
use crate::quantity;
use crate::{Block, Grid, MapPlan, PlanError, Share, SystemPlan, Unit};
use vibroimpact::Oscillator;
use vibroimpact::verdict::{SettleOptions, Verdict};

/// Maximum number of motions stored for a point; more have not been observed to coexist in practice.
const MOST_MOTIONS: usize = 8;
/// Default number of points of a tile along each of two axes; a tile takes some seconds.
const TILE: usize = 64;

pub(crate) struct MapFill {
    system: SystemPlan,
    plan: MapPlan,
    options: SettleOptions,
    grid: Grid,
    kept: usize,
}

/// The side of a tile, chosen so that tiles have a similar number of points for any number of axes.
pub(super) const fn side(plane: usize, axes: usize) -> usize {
    let points = plane * plane;
    match axes {
        1 => points,
        2 => plane,
        3 => 1 << points.ilog2().div_ceil(3),
        _ => 1 << (points.ilog2() / 4),
    }
}

impl MapFill {
    pub(crate) fn new(system: &SystemPlan, plan: &MapPlan, tile: Option<u32>) -> Self {
        let kept = usize::try_from(plan.starts).unwrap_or(MOST_MOTIONS).min(MOST_MOTIONS);
        let grid = grid_of(&plan.axes, tile, side(TILE, plan.axes.len()));
        Self { system: *system, plan: plan.clone(), options: plan.options(), grid, kept }
    }

    /// The oscillator at a point. Only the corners of the grid have been checked.
    fn oscillator(&self, index: &[usize]) -> Result<Oscillator, PlanError> {
        self.plan.oscillator(&self.system, |k| on_axis(index, k))
    }

    /// The motions at a point.
    fn point(&self, index: &[usize]) -> MapTilePoint {
        Ok(motions(&self.oscillator(index)?, &self.plan, &self.options))
    }

    /// The labels of the stored motions of a point, in order.
    fn labels(&self, point: &MapTilePoint) -> Vec<i32> {
        let mut labels: Vec<i32> = self.kept(point).iter().map(|found| code(&found.verdict)).collect();
        labels.sort_unstable();
        labels
    }

    /// The stored motions of a point; empty if the point is no valid system.
    fn kept<'a>(&self, point: &'a MapTilePoint) -> &'a [Share] {
        let all = point.as_deref().unwrap_or(&[]);
        &all[..all.len().min(self.kept)]
    }
}

/// The largest speed before an impact of a cycle.
fn speed(verdict: &Verdict) -> f64 {
    if let Verdict::Periodic(cycle) = verdict { cycle.fastest() } else { f64::NAN }
}

/// The larger modulus of the two multipliers.
fn multiplier(verdict: &Verdict, osc: &Oscillator) -> f64 {
    verdict.multipliers(osc).map_or(f64::NAN, |[a, b]| a.modulus().max(b.modulus()))
}

/// The motions at a point, the most frequent first, or the error if the point is no valid system.
type MapTilePoint = Result<Vec<Share>, PlanError>;

impl Fill for MapFill {
    type Tile = Vec<Cell<MapTilePoint>>;

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn coordinates(&self) -> Vec<Along> {
        along(&self.plan.axes)
    }

    fn fields(&self) -> Vec<Field> {
        let motion = vec![Extra { name: "motion", count: self.kept }];
        let real = Field {
            name: "share",
            long_name: "share of the starts that lead to the motion",
            unit: Unit::NUMBER,
            kind: NumberType::F64,
            fill: 0,
            extra: motion.clone(),
            flags: Vec::new(),
            comment: "",
        };
        let mut fields = vec![
            Field {
                name: "label",
                long_name: "motion m/n, the most frequent first",
                kind: NumberType::I32,
                fill: super::NOT_COMPUTED,
                flags: code::FLAGS.to_vec(),
                comment: code::COMMENT,
                ..real.clone()
            },
            real.clone(),
            Field {
                name: "speed",
                long_name: "largest speed of arrival in a period",
                unit: Unit::VELOCITY,
                ..real.clone()
            },
            Field { name: "multiplier", long_name: "largest modulus of the Floquet multipliers", ..real },
        ];
        fields.extend(self.plan.fields.iter().map(|quantity| quantity::field(*quantity, motion.clone())));
        if self.plan.refine.is_some() {
            fields.push(computed());
        }
        fields
    }

    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Self::Tile> {
        let points = |wanted: &[usize]| -> Option<Vec<MapTilePoint>> {
            wanted.iter().map(|k| (!tick()).then(|| self.point(&block.index(*k)))).collect()
        };
        match self.plan.refine {
            None => Some(points(&(0..block.points()).collect::<Vec<_>>())?.into_iter().map(Cell::Computed).collect()),
            // corners agree if they have the same labels, in any order
            Some(step) => refine::fill(block, step as usize, points, |a, b| self.labels(a) == self.labels(b)),
        }
    }

    fn columns(&self, block: &Block, cells: Self::Tile) -> Vec<Column> {
        let points = block.points();
        let mut label = vec![super::NO_MOTION; points * self.kept];
        let mut numbers = [(); 3].map(|()| vec![f64::NAN; points * self.kept]);
        let mut quantities = vec![vec![f64::NAN; points * self.kept]; self.plan.fields.len()];
        for (k, cell) in cells.iter().enumerate() {
            let (point, own) = match cell {
                Cell::Computed(point) => (point, true),
                Cell::Like(corner) => match &cells[*corner] {
                    Cell::Computed(point) => (point, false),
                    // only computed points have numbers of their own
                    Cell::Like(_) => continue,
                },
            };
            let osc = if own { self.oscillator(&block.index(k)).ok() } else { None };
            for (i, found) in self.kept(point).iter().enumerate() {
                let at = k * self.kept + i;
                label[at] = code(&found.verdict);
                numbers[0][at] = found.share;
                // the labels are those of the corner that agreed, but the other numbers would be those of another point
                if let Some(osc) = &osc {
                    (numbers[1][at], numbers[2][at]) = (speed(&found.verdict), multiplier(&found.verdict, osc));
                    let values = quantity::values(&self.plan.fields, found.quantities);
                    quantities.iter_mut().zip(values).for_each(|(column, value)| column[at] = value);
                }
            }
        }
        let mut columns = vec![Column::I32(label)];
        columns.extend(numbers.into_iter().chain(quantities).map(Column::F64));
        if self.plan.refine.is_some() {
            columns.push(computed_column(&cells));
        }
        columns
    }
}

/// The field that marks the points that were computed.
pub(super) fn computed() -> Field {
    Field {
        name: "computed",
        long_name: "whether the point was computed itself",
        unit: Unit::NUMBER,
        kind: NumberType::I8,
        fill: 0,
        extra: Vec::new(),
        flags: vec![(0, "not_computed"), (1, "computed"), (2, "taken_from_agreeing_neighbours")],
        comment: "",
    }
}

pub(super) fn computed_column<T>(cells: &[Cell<T>]) -> Column {
    Column::I8(cells.iter().map(|cell| if matches!(cell, Cell::Computed(_)) { 1 } else { 2 }).collect())
}
