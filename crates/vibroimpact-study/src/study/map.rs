//! The tiles of a map: the motions at each point, the most frequent first. The systems are oscillators, or machines
//! (`machine_map.rs`).

use super::code;
use super::fill::{self, Fill, Over, on_axis};
use super::refine::{self, Cell};
use super::remarks;
use crate::field::{Column, Extra, Field, NumberType};
use crate::grid::Index;
use crate::map::{motions, options};
use crate::quantity;
use crate::{Block, MapPlan, PlanError, Share, SystemPlan, Unit};
use vibroimpact::Oscillator;
use vibroimpact::verdict::SettleOptions;

/// Maximum number of motions stored for a point; more have not been observed to coexist in practice.
const MOST_MOTIONS: usize = 8;
/// Default number of points of a tile along each of two axes; a tile takes some seconds.
const TILE: usize = 64;

/// Systems whose motions are found at each point of a grid over numbers of the system.
pub(crate) trait Mapped: Send + Sync + Sized {
    /// The unit of speeds.
    const VELOCITY: Unit;
    /// Whether several starts at a point lead to motions, each with its share.
    const SEVERAL: bool = true;

    /// The motions at points of the grid, the most frequent first, or the error if a point is no valid system. `tick` is
    /// called for each point; if it returns true, the computation stops with `None`.
    fn motions(&self, points: &[Index], tick: &dyn Fn() -> bool) -> Option<Vec<Motions>>;

    /// The number of stops, if [remarks](super::remarks) say more of some motions than the label.
    fn remarked_stops(&self) -> Option<usize> {
        None
    }

    /// The fields of the quantities that the plan asks for.
    fn quantities(&self, extra: &[Extra]) -> Vec<Field>;
}

/// The motions at each point of a grid.
pub(crate) struct MapFill<M> {
    mapped: M,
    over: Over,
    kept: usize,
    refine: Option<u32>,
}

/// Oscillators over parameters.
pub(crate) struct OscillatorMap {
    system: SystemPlan,
    plan: MapPlan,
    options: SettleOptions,
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

impl OscillatorMap {
    /// The oscillator at a point. Only the corners of the grid have been checked.
    fn oscillator(&self, index: &[usize]) -> Result<Oscillator, PlanError> {
        self.plan.oscillator(&self.system, |k| on_axis(index, k))
    }
}

impl Mapped for OscillatorMap {
    const VELOCITY: Unit = Unit::VELOCITY;

    fn motions(&self, points: &[Index], tick: &dyn Fn() -> bool) -> Option<Vec<Motions>> {
        let mut systems = Vec::new();
        let mut numbers = Vec::new();
        let mut found = Vec::new();
        for index in points {
            found.push(self.oscillator(index).map(|osc| {
                systems.push(osc);
                numbers.push(found.len());
                Vec::new()
            }));
        }
        let ended = motions(&systems, &self.plan, &self.options, |k, shares| {
            found[numbers[k]] = Ok(shares);
            tick()
        });
        ended.then_some(found)
    }

    fn quantities(&self, extra: &[Extra]) -> Vec<Field> {
        self.plan.fields.iter().map(|quantity| quantity::field(*quantity, extra)).collect()
    }
}

impl MapFill<OscillatorMap> {
    pub(crate) fn new(system: &SystemPlan, plan: &MapPlan, tile: Option<u32>) -> Self {
        let over = Over::usual(&plan.axes, tile, side(TILE, plan.axes.len()));
        let mapped = OscillatorMap { system: *system, plan: plan.clone(), options: options(plan.impacts) };
        Self::of(mapped, over, plan.starts, plan.refine)
    }
}

impl<M: Mapped> MapFill<M> {
    /// The map over a grid, with so many starts at each point.
    pub(super) fn of(mapped: M, over: Over, starts: u64, refine: Option<u32>) -> Self {
        let kept = usize::try_from(starts).unwrap_or(MOST_MOTIONS).min(MOST_MOTIONS);
        Self { mapped, over, kept, refine }
    }

    /// The motions at the points of a tile; `None` if stopped.
    pub(crate) fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Cell<Motions>>> {
        let points = |wanted: &[usize]| -> Option<Vec<Motions>> {
            self.mapped.motions(&wanted.iter().map(|k| block.index(*k)).collect::<Vec<_>>(), &|| tick())
        };
        match self.refine {
            None => Some(points(&(0..block.points()).collect::<Vec<_>>())?.into_iter().map(Cell::Computed).collect()),
            // corners agree if they have the same labels, in any order
            Some(step) => refine::fill(block, step as usize, points, |a, b| self.labels(a) == self.labels(b)),
        }
    }

    /// The labels of the stored motions of a point, in order.
    fn labels(&self, point: &Motions) -> Vec<i32> {
        let mut labels: Vec<i32> = self.kept(point).iter().map(|found| found.code).collect();
        labels.sort_unstable();
        labels
    }

    /// The stored motions of a point; empty if the point is no valid system.
    fn kept<'a>(&self, point: &'a Motions) -> &'a [Share] {
        let all = point.as_deref().unwrap_or(&[]);
        &all[..all.len().min(self.kept)]
    }

    /// The fields of what is to be said of some motions beside the label.
    fn remarks(&self, extra: &[Extra]) -> Vec<Field> {
        self.mapped.remarked_stops().map_or_else(Vec::new, |stops| remarks::fields(stops, extra))
    }

    /// The columns of some points.
    fn columns_at(&self, cells: &[Cell<Motions>]) -> Vec<Column> {
        let points = cells.len();
        let mut label = vec![if M::SEVERAL { super::NO_MOTION } else { super::REFUSED }; points * self.kept];
        let mut share = vec![f64::NAN; points * self.kept];
        // the largest speed, the largest multiplier, and the quantities
        let mut numbers = vec![vec![f64::NAN; points * self.kept]; 2 + self.mapped.quantities(&[]).len()];
        let stops = self.mapped.remarked_stops();
        let mut remarks = vec![vec![remarks::NONE; points * self.kept]; self.remarks(&[]).len()];
        for (k, cell) in cells.iter().enumerate() {
            let Some((point, own)) = cell.result(cells) else { continue };
            let kept = self.kept(point);
            for (i, found) in kept.iter().enumerate() {
                (label[k * self.kept + i], share[k * self.kept + i]) = (found.code, found.share);
            }
            // the labels are those of the corner that agreed, but the other numbers would be those of another point
            for (i, found) in kept.iter().enumerate().filter(|_| own) {
                let values = [found.speed, found.multiplier].into_iter().chain(found.quantities.iter().copied());
                numbers.iter_mut().zip(values).for_each(|(column, value)| column[k * self.kept + i] = value);
                let values = stops.map_or_else(Vec::new, |stops| remarks::of(stops, &found.stops, found.seen_events));
                remarks.iter_mut().zip(values).for_each(|(column, value)| column[k * self.kept + i] = value);
            }
        }
        let mut columns = vec![Column::I32(label)];
        columns.extend(M::SEVERAL.then_some(Column::F64(share)));
        let quantities = numbers.split_off(2);
        columns.extend(numbers.into_iter().map(Column::F64));
        columns.extend(remarks.into_iter().map(Column::I32));
        columns.extend(quantities.into_iter().map(Column::F64));
        if self.refine.is_some() {
            columns.push(computed_column(cells));
        }
        columns
    }
}

/// The motions at a point, the most frequent first, or the error if the point is no valid system.
pub(crate) type Motions = Result<Vec<Share>, PlanError>;

impl<M: Mapped> Fill for MapFill<M> {
    fn together(&self) -> u64 {
        fill::with_refinement(self.refine, 1)
    }

    fn over(&self) -> &Over {
        &self.over
    }

    fn fields(&self) -> Vec<Field> {
        let motion = if M::SEVERAL { vec![Extra { name: "motion", count: self.kept }] } else { Vec::new() };
        let real = |name: &'static str, long_name: &'static str, unit| Field::real(name, long_name, unit, &motion);
        let label = if M::SEVERAL {
            code::field("motion m/n, the most frequent first", &motion)
        } else {
            let field = code::field("motion m/n that the start leads to", &[]);
            Field { flags: [field.flags, vec![(super::REFUSED, "refused")]].concat(), ..field }
        };
        let mut fields = vec![label];
        let share = || real("share", "share of the starts that lead to the motion", Unit::NUMBER);
        fields.extend(M::SEVERAL.then(share));
        fields.push(real("speed", "largest speed of arrival in a period", M::VELOCITY));
        fields.push(real("multiplier", "largest modulus of the Floquet multipliers", Unit::NUMBER));
        fields.extend(self.remarks(&motion));
        fields.extend(self.mapped.quantities(&motion));
        if self.refine.is_some() {
            fields.push(computed());
        }
        fields
    }

    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        Some(self.columns_at(&self.compute(block, tick)?))
    }

    fn points(&self, points: &[Index], tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        let cells: Vec<_> = self.mapped.motions(points, &|| tick())?.into_iter().map(Cell::Computed).collect();
        Some(self.columns_at(&cells))
    }
}

/// The field that marks the points that were computed.
pub(super) fn computed() -> Field {
    let flags = [(0, "not_computed"), (1, "computed"), (2, "taken_from_agreeing_neighbours")];
    Field::integers("computed", "whether the point was computed itself", NumberType::I8, &[], &flags)
}

pub(super) fn computed_column<T>(cells: &[Cell<T>]) -> Column {
    Column::I8(cells.iter().map(|cell| if matches!(cell, Cell::Computed(_)) { 1 } else { 2 }).collect())
}
