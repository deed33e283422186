//! The tiles of an orbit diagram. A sweep is one tile; scattered starts have many.

use super::fill::{Along, BegunTile, Fill, Keep};
use crate::diagram::{Sweep, SweepDirection, carried, number_of};
use crate::field::{Column, Field};
use crate::grid::{Block, Dimension, Grid};
use crate::{PlanError, Unit, Values};

/// Number of starts and of values in a tile of scattered starts.
const TILE: (usize, usize) = (16, 64);

/// A system whose motion after the transient is followed at each value of a number.
pub(crate) trait Swept: Send + Sync {
    /// The motion at one value.
    type Step: Send;
    /// The state to carry to the next value.
    type Left;

    /// The name of the number, its values, and how starts are chosen.
    fn sweep(&self) -> (&str, &Values, SweepDirection);

    /// The coordinate values of what varies.
    fn varied(&self) -> Vec<Along>;

    /// The fields.
    fn fields(&self) -> Vec<Field>;

    /// The motion at one value, and the state to carry to the next value.
    fn step(&self, at: (u32, Sweep), before: Option<Self::Left>) -> Result<(Self::Step, Self::Left), PlanError>;

    /// The columns of the steps of a tile, each with its place in the tile.
    fn columns(&self, points: usize, steps: &[(usize, &Self::Step)]) -> Vec<Column>;

    /// The number of the value of a step.
    fn index(step: &Self::Step) -> u32;

    /// The numbers of a state to carry.
    fn numbers(left: &Self::Left) -> Vec<f64>;

    /// The state to carry from value number `index`, from its numbers.
    fn left(&self, index: u32, numbers: &[f64]) -> Option<Self::Left>;
}

/// The motions at all values.
pub(crate) struct SweepFill<S> {
    pub(super) swept: S,
    grid: Grid,
}

impl<S: Swept> SweepFill<S> {
    pub(super) fn of(swept: S, tile: Option<u32>) -> Self {
        let (name, over, direction) = swept.sweep();
        let dimension =
            |name: &str, count: usize, tile: usize| Dimension { name: name.into(), count, tile: tile.min(count) };
        let (values, runs) = (over.count(), usize::try_from(direction.runs()).unwrap_or(usize::MAX));
        let side = |default: usize| tile.map_or(default, |tile| tile as usize);
        let dimensions = match direction {
            SweepDirection::Scatter { .. } => {
                vec![dimension("start", runs, side(TILE.0)), dimension(name, values, side(TILE.1))]
            }
            // a sweep is one tile, because each value starts from the last state at the value before
            _ => vec![dimension("sweep", runs, 1), dimension(name, values, values)],
        };
        Self { grid: Grid { dimensions }, swept }
    }
}

impl<S: Swept> Fill for SweepFill<S> {
    /// The motions of the rows, one row after another, each in the order of its sweep.
    type Tile = Vec<Result<S::Step, PlanError>>;

    fn together(&self) -> u64 {
        match self.swept.sweep().2 {
            SweepDirection::Scatter { .. } => 1,
            // each value starts from the last state at the value before
            _ => u64::MAX,
        }
    }

    fn continues(&self) -> bool {
        !matches!(self.swept.sweep().2, SweepDirection::Scatter { .. })
    }

    fn continued(
        &self,
        block: &Block,
        before: Option<BegunTile>,
        keep: Keep<'_>,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Column>> {
        if !Fill::continues(self) {
            return Some(self.columns(block, self.compute(block, tick)?));
        }
        let (_, over, direction) = self.swept.sweep();
        // a sweep is one row and all values
        let (row, points) = (block.ranges[0].start as u64, block.points());
        let place = |j: usize| Some(carried(over, direction, row, u32::try_from(j).ok()?));
        let known = |done: u64| usize::try_from(done).ok().filter(|done| *done <= points);
        let begun = before.and_then(|begun| Some((known(begun.done)?, begun)));
        let from = begun.as_ref().map_or(0, |(done, _)| *done);
        let mut left = begun.as_ref().and_then(|(done, begun)| {
            let (index, _) = place(done.checked_sub(1)?)?;
            self.swept.left(index, &begun.left)
        });
        // a run that is stopped gets on by one value at least
        (0..from).for_each(|_| {
            let _ = tick();
        });
        let fields = self.swept.fields();
        // the columns of all steps so far: those of this run, and those of the run before
        let columns = |steps: &[(usize, S::Step)]| -> Vec<Column> {
            let own: Vec<(usize, &S::Step)> = steps.iter().map(|(at, step)| (*at, step)).collect();
            let mut columns = self.swept.columns(points, &own);
            if let Some((_, begun)) = &begun {
                for ((field, column), old) in fields.iter().zip(&mut columns).zip(&begun.columns) {
                    let width = field.width();
                    for (index, _) in (0..from).filter_map(place) {
                        column.copy(index as usize * width, old, index as usize * width, width);
                    }
                }
            }
            columns
        };
        let mut steps: Vec<(usize, S::Step)> = Vec::new();
        for j in from..points {
            // the ends were checked, and every value between two valid ends is valid
            let step = self.swept.step(place(j)?, left.take());
            if let Ok((step, next)) = step {
                steps.push((S::index(&step) as usize, step));
                left = Some(next);
            }
            let stops = tick();
            if j + 1 == points {
                break;
            }
            let part = || BegunTile {
                done: j as u64 + 1,
                left: left.as_ref().map(S::numbers).unwrap_or_default(),
                columns: columns(&steps),
            };
            keep(stops, &part);
            if stops {
                return None;
            }
        }
        Some(columns(&steps))
    }

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn grid_mut(&mut self) -> &mut Grid {
        &mut self.grid
    }

    fn coordinates(&self) -> Vec<Along> {
        let sweep = |values: &[f64]| Along {
            name: "sweep".to_owned(),
            dimension: "sweep".to_owned(),
            values: values.to_vec(),
            long_name: "direction of the sweep: 1 with rising values, -1 with falling ones".into(),
            unit: Unit::NUMBER,
        };
        let rows = match self.swept.sweep().2 {
            SweepDirection::Scatter { .. } => None,
            SweepDirection::Up => Some(sweep(&[1.0])),
            SweepDirection::Down => Some(sweep(&[-1.0])),
            SweepDirection::Both => Some(sweep(&[1.0, -1.0])),
        };
        rows.into_iter().chain(self.swept.varied()).collect()
    }

    fn fields(&self) -> Vec<Field> {
        self.swept.fields()
    }

    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Self::Tile> {
        let (rows, values) = (&block.ranges[0], &block.ranges[1]);
        let (_, over, direction) = self.swept.sweep();
        let mut steps = Vec::with_capacity(block.points());
        for row in rows.clone() {
            let mut before = None;
            for j in 0..values.len() {
                let row = row as u64;
                let at = match direction {
                    SweepDirection::Scatter { .. } => (u32::try_from(values.start + j).ok()?, Sweep::Start(row)),
                    _ => carried(over, direction, row, u32::try_from(j).ok()?),
                };
                steps.push(self.swept.step(at, before.take()).map(|(step, left)| {
                    before = Some(left);
                    step
                }));
                if tick() {
                    return None;
                }
            }
        }
        Some(steps)
    }

    fn columns(&self, block: &Block, steps: Self::Tile) -> Vec<Column> {
        let values = &block.ranges[1];
        // the ends were checked, and every value between two valid ends is valid
        let placed: Vec<(usize, &S::Step)> = steps
            .iter()
            .enumerate()
            .filter_map(|(k, step)| Some((k, step.as_ref().ok()?)))
            .map(|(k, step)| (k / values.len() * values.len() + (S::index(step) as usize - values.start), step))
            .collect();
        self.swept.columns(block.points(), &placed)
    }
}

/// The kinds of motions as they are stored.
pub(super) const KINDS: [(i32, &str); 5] =
    [(-1, "not_computed"), (0, "no_impact"), (1, "impacts"), (2, "stuck"), (3, "undecided")];

/// The steps of a stored diagram in the order of its results: sweeps one after another, scattered starts value by value.
/// `motion` returns the step in this row at this value.
pub(super) fn in_order<T>(
    over: &Values,
    direction: SweepDirection,
    motion: impl Fn(usize, u32, Sweep) -> Option<T>,
) -> Vec<T> {
    let values = 0..number_of(over);
    match direction {
        SweepDirection::Scatter { starts, .. } => values
            .flat_map(|index| (0..starts).map(move |start| (index, start)))
            .filter_map(|(index, start)| motion(usize::try_from(start).ok()?, index, Sweep::Start(start)))
            .collect(),
        _ => (0..direction.runs())
            .flat_map(|row| values.clone().map(move |j| (row, j)))
            .filter_map(|(row, j)| {
                let (index, sweep) = carried(over, direction, row, j);
                motion(usize::try_from(row).ok()?, index, sweep)
            })
            .collect(),
    }
}
