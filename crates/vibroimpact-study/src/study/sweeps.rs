//! The tiles of an orbit diagram. A sweep is one tile; scattered starts have many.

use super::fill::{Along, BegunTile, Fill, Keep, Over};
use crate::axis::Described;
use crate::diagram::{Diagram, DiagramPoint, DiagramStep, MotionKind, Sweep, SweepDirection, carried, number_of};
use crate::dynamics::Dynamics;
use crate::field::{Column, Extra, Field, NumberType};
use crate::grid::{Block, Dimension, Grid};
use crate::{DiagramPlan, Name, PlanError, Unit};

/// Number of starts and of values in a tile of scattered starts.
const TILE: (usize, usize) = (16, 64);

/// A system whose motion after the transient is followed at each value of a number.
pub(crate) trait Swept: Dynamics<Name: Described + Send + Sync, Shown: Send + Sync> + Send + Sync {
    /// The state to carry to the next value.
    type Left;

    /// The fields of what is shown, with this further dimension.
    fn shown_fields(show: &Self::Shown, point: &[Extra]) -> Vec<Field>;

    /// The numbers of a point in these fields.
    fn numbers_of(point: DiagramPoint) -> Vec<f64>;

    /// The motion at one value, and the state to carry to the next value.
    fn step(
        &self,
        plan: &PlanOf<Self>,
        at: (u32, Sweep),
        before: Option<Self::Left>,
    ) -> Result<(DiagramStep, Self::Left), PlanError>;

    /// The numbers of a state to carry.
    fn numbers(left: &Self::Left) -> Vec<f64>;

    /// The state to carry from value number `index`, from its numbers.
    fn left(&self, plan: &PlanOf<Self>, index: u32, numbers: &[f64]) -> Option<Self::Left>;
}

/// The plan of a diagram of a system.
pub(crate) type PlanOf<D> = DiagramPlan<<D as Dynamics>::Name, <D as Dynamics>::Shown>;

/// The directions of the sweeps, and the values of the numbers.
fn coordinates<V: Described, S>(plan: &DiagramPlan<V, S>) -> Vec<Along> {
    let sweep = |values: &[f64]| Along {
        name: "sweep".to_owned(),
        dimension: "sweep".to_owned(),
        values: values.to_vec(),
        long_name: "direction of the sweep: 1 with rising values, -1 with falling ones".into(),
        unit: Unit::NUMBER,
    };
    let rows = match plan.direction {
        SweepDirection::Scatter { .. } => None,
        SweepDirection::Up => Some(sweep(&[1.0])),
        SweepDirection::Down => Some(sweep(&[-1.0])),
        SweepDirection::Both => Some(sweep(&[1.0, -1.0])),
    };
    // the values of a second number are a second coordinate of the same dimension
    let cut = plan.cut();
    let varied = cut.names().enumerate().map(|(k, number)| {
        let value = |index: u32| plan.values(index).nth(k).unwrap_or(f64::NAN);
        Along::new(number, (0..number_of(&plan.over)).map(value).collect(), plan.vary.text())
    });
    rows.into_iter().chain(varied).collect()
}

/// The motions at all values.
pub(crate) struct SweepFill<D: Dynamics> {
    written: D,
    pub(crate) plan: PlanOf<D>,
    /// Number of points of a motion.
    keep: usize,
    over: Over,
}

impl<D: Swept> SweepFill<D> {
    pub(crate) fn new(written: &D, plan: &PlanOf<D>, tile: Option<u32>) -> Self {
        let DiagramPlan { vary, over, direction, .. } = plan;
        let dimension =
            |name: &str, count: usize, tile: usize| Dimension { name: name.into(), count, tile: tile.min(count) };
        let (values, runs) = (over.count(), usize::try_from(direction.runs()).unwrap_or(usize::MAX));
        let side = |default: usize| tile.map_or(default, |tile| tile as usize);
        let dimensions = match direction {
            SweepDirection::Scatter { .. } => {
                vec![dimension("start", runs, side(TILE.0)), dimension(vary.text(), values, side(TILE.1))]
            }
            // a sweep is one tile, because each value starts from the last state at the value before
            _ => vec![dimension("sweep", runs, 1), dimension(vary.text(), values, values)],
        };
        let keep = usize::try_from(plan.keep).unwrap_or(usize::MAX);
        let over = Over { grid: Grid { dimensions }, coordinates: coordinates(plan) };
        Self { written: written.clone(), plan: plan.clone(), keep, over }
    }

    /// The motions of the rows, one row after another, each in the order of its sweep; `None` if stopped.
    pub(crate) fn compute(
        &self,
        block: &Block,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Result<DiagramStep, PlanError>>> {
        let (rows, values) = (&block.ranges[0], &block.ranges[1]);
        let DiagramPlan { over, direction, .. } = &self.plan;
        let mut steps = Vec::with_capacity(block.points());
        for row in rows.clone() {
            let mut before = None;
            for j in 0..values.len() {
                let row = row as u64;
                let at = match direction {
                    SweepDirection::Scatter { .. } => (u32::try_from(values.start + j).ok()?, Sweep::Start(row)),
                    _ => carried(over, *direction, row, u32::try_from(j).ok()?),
                };
                steps.push(self.written.step(&self.plan, at, before.take()).map(|(step, left)| {
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

    /// The columns of the steps of a tile with so many points, each with its place in the tile.
    fn columns<'s>(&self, points: usize, steps: impl Iterator<Item = (usize, &'s DiagramStep)>) -> Vec<Column> {
        let mut columns: Vec<Column> = self.fields().iter().map(|field| field.empty(points)).collect();
        for (at, step) in steps {
            columns[0].set(at, step.kind.code() as f64);
            for (k, point) in (at * self.keep..(at + 1) * self.keep).zip(&step.points) {
                let numbers = D::numbers_of(*point);
                columns[1..].iter_mut().zip(numbers).for_each(|(column, number)| column.set(k, number));
            }
        }
        columns
    }
}

impl<D: Swept> Fill for SweepFill<D> {
    fn together(&self) -> u64 {
        match self.plan.direction {
            SweepDirection::Scatter { .. } => 1,
            // each value starts from the last state at the value before
            _ => u64::MAX,
        }
    }

    fn continues(&self) -> bool {
        !matches!(self.plan.direction, SweepDirection::Scatter { .. })
    }

    fn continued(
        &self,
        block: &Block,
        before: Option<BegunTile>,
        keep: Keep<'_>,
        tick: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Column>> {
        if !self.continues() {
            return self.fill(block, tick);
        }
        let DiagramPlan { over, direction, .. } = &self.plan;
        // a sweep is one row and all values
        let (row, points) = (block.ranges[0].start as u64, block.points());
        let place = |j: usize| Some(carried(over, *direction, row, u32::try_from(j).ok()?));
        let known = |done: u64| usize::try_from(done).ok().filter(|done| *done <= points);
        let begun = before.and_then(|begun| Some((known(begun.done)?, begun)));
        let from = begun.as_ref().map_or(0, |(done, _)| *done);
        let mut left = begun.as_ref().and_then(|(done, begun)| {
            let (index, _) = place(done.checked_sub(1)?)?;
            self.written.left(&self.plan, index, &begun.left)
        });
        // a run that is stopped gets on by one value at least
        (0..from).for_each(|_| {
            let _ = tick();
        });
        let fields = self.fields();
        // the columns of all steps so far: those of this run, and those of the run before
        let columns = |steps: &[(usize, DiagramStep)]| -> Vec<Column> {
            let mut columns = self.columns(points, steps.iter().map(|(at, step)| (*at, step)));
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
        let mut steps: Vec<(usize, DiagramStep)> = Vec::new();
        for j in from..points {
            // the ends were checked, and every value between two valid ends is valid
            let step = self.written.step(&self.plan, place(j)?, left.take());
            if let Ok((step, next)) = step {
                steps.push((step.index as usize, step));
                left = Some(next);
            }
            let stops = tick();
            if j + 1 == points {
                break;
            }
            let part = || BegunTile {
                done: j as u64 + 1,
                left: left.as_ref().map(D::numbers).unwrap_or_default(),
                columns: columns(&steps),
            };
            keep(stops, &part);
            if stops {
                return None;
            }
        }
        Some(columns(&steps))
    }

    fn over(&self) -> &Over {
        &self.over
    }

    fn fields(&self) -> Vec<Field> {
        let long_name = "what the motion is after the transient";
        let kind = Field::integers("kind", long_name, NumberType::I8, &[], &KINDS);
        let point = [Extra { name: "point", count: self.keep }];
        [kind].into_iter().chain(D::shown_fields(&self.plan.show, &point)).collect()
    }

    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        let (steps, values) = (self.compute(block, tick)?, &block.ranges[1]);
        // the ends were checked, and every value between two valid ends is valid
        let valid = steps.iter().enumerate().filter_map(|(k, step)| Some((k, step.as_ref().ok()?)));
        let row = |k: usize| k / values.len() * values.len();
        Some(self.columns(block.points(), valid.map(|(k, step)| (row(k) + (step.index as usize - values.start), step))))
    }
}

/// The kinds of motions as they are stored.
const KINDS: [(i32, &str); 5] =
    [(-1, "not_computed"), (0, "no_impact"), (1, "impacts"), (2, "stuck"), (3, "undecided")];

/// The diagram from the columns of its study: sweeps one after another, scattered starts value by value. Motions of tiles that are not
/// complete are left out.
pub(crate) fn diagram_of<D: Dynamics>(plan: &PlanOf<D>, columns: &[Column]) -> Diagram<D::Name, D::Shown> {
    let (count, keep) = (plan.over.count(), usize::try_from(plan.keep).unwrap_or(usize::MAX));
    let (kinds, shown) = columns.split_first().map_or((&[][..], columns), |(first, rest)| (first.flags(), rest));
    let point = |at: usize| {
        let numbers: Vec<f64> = shown.iter().filter_map(|column| column.get(at)).collect();
        D::shown_point(&plan.show, &numbers)
    };
    let motion = |row: u64, index: u32, sweep: Sweep| {
        let at = usize::try_from(row).ok()? * count + index as usize;
        let kind = MotionKind::of_code(*kinds.get(at)?)?;
        let points = (at * keep..(at + 1) * keep).map_while(point).collect();
        Some(DiagramStep { index, sweep, kind, points })
    };
    let values = 0..number_of(&plan.over);
    let steps = match plan.direction {
        SweepDirection::Scatter { starts, .. } => values
            .flat_map(|index| (0..starts).map(move |start| (index, start)))
            .filter_map(|(index, start)| motion(start, index, Sweep::Start(start)))
            .collect(),
        direction => (0..direction.runs())
            .flat_map(|row| values.clone().map(move |j| (row, j)))
            .filter_map(|(row, j)| {
                let (index, sweep) = carried(&plan.over, direction, row, j);
                motion(row, index, sweep)
            })
            .collect(),
    };
    Diagram { plan: plan.clone(), steps }
}
