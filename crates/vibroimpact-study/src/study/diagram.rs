//! The tiles of an orbit diagram. A carried sweep is one tile; scattered starts have many.

use super::fill::{Along, Fill};
use crate::axis::Coordinate;
use crate::diagram::{Diagram, DiagramPoint, DiagramStep, MotionKind, Show, Sweep, SweepDirection, carried, step};
use crate::field::{Column, Extra, Field, NumberType};
use crate::grid::{Block, Dimension, Grid};
use crate::{DiagramPlan, PlanError, SystemPlan, Unit};
use vibroimpact::Side;

/// Number of starts and of values in a tile of scattered starts.
const TILE: (usize, usize) = (16, 64);

pub(crate) struct DiagramFill {
    system: SystemPlan,
    plan: DiagramPlan,
    grid: Grid,
    keep: usize,
}

impl DiagramFill {
    pub(crate) fn new(system: &SystemPlan, plan: &DiagramPlan, tile: Option<u32>) -> Self {
        let dimension =
            |name: &str, count: usize, tile: usize| Dimension { name: name.into(), count, tile: tile.min(count) };
        let (values, runs) = (plan.over.count() as usize, usize::try_from(plan.runs()).unwrap_or(usize::MAX));
        let name = plan.vary.name();
        let side = |default: usize| tile.map_or(default, |tile| tile as usize);
        let dimensions = match plan.direction {
            SweepDirection::Scatter { .. } => {
                vec![dimension("start", runs, side(TILE.0)), dimension(name, values, side(TILE.1))]
            }
            // a sweep is one tile, because each value starts from the last state at the value before
            _ => vec![dimension("sweep", runs, 1), dimension(name, values, values)],
        };
        let keep = usize::try_from(plan.keep).unwrap_or(usize::MAX);
        Self { system: *system, plan: *plan, grid: Grid { dimensions }, keep }
    }
}

impl Fill for DiagramFill {
    /// The motions of the rows, one row after another, each in the order of its sweep.
    type Tile = Vec<Result<DiagramStep, PlanError>>;

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn coordinates(&self) -> Vec<Along> {
        let cut = self.plan.cut();
        // the values of the second parameter are a second coordinate of the same dimension
        let values = cut.parameters().enumerate().map(|(k, parameter)| {
            let value = |index: u32| self.plan.values(index).nth(k).map_or(f64::NAN, |(_, value)| value);
            let parameter = Coordinate::Parameter(parameter);
            Along {
                name: parameter.name().to_owned(),
                dimension: cut.vary.name().to_owned(),
                values: (0..self.plan.over.count()).map(value).collect(),
                long_name: parameter.long_name().into(),
                unit: parameter.unit(),
            }
        });
        let sweep = |values: &[f64]| Along {
            name: "sweep".to_owned(),
            dimension: "sweep".to_owned(),
            values: values.to_vec(),
            long_name: "direction of the sweep: 1 with rising values, -1 with falling ones".into(),
            unit: Unit::NUMBER,
        };
        let rows = match self.plan.direction {
            SweepDirection::Scatter { .. } => None,
            SweepDirection::Up => Some(sweep(&[1.0])),
            SweepDirection::Down => Some(sweep(&[-1.0])),
            SweepDirection::Both => Some(sweep(&[1.0, -1.0])),
        };
        rows.into_iter().chain(values).collect()
    }

    fn fields(&self) -> Vec<Field> {
        let point = vec![Extra { name: "point", count: self.keep }];
        let field = |name: &'static str, long_name: &'static str, unit, kind, fill, extra, flags| Field {
            name: name.into(),
            long_name: long_name.into(),
            unit,
            kind,
            fill,
            extra,
            flags,
            comment: "",
        };
        let motions = vec![(-1, "not_computed"), (0, "no_impact"), (1, "impacts"), (2, "stuck"), (3, "undecided")];
        let sides = vec![
            (0, "no_point"),
            (1, "impact"),
            (-1, "impact_on_the_second_stop"),
            (2, "end_of_a_chatter"),
            (-2, "end_of_a_chatter_on_the_second_stop"),
        ];
        let real = |name, long_name, unit| field(name, long_name, unit, NumberType::F64, 0, point.clone(), Vec::new());
        let mut fields = vec![field(
            "kind",
            "what the motion is after the transient",
            Unit::NUMBER,
            NumberType::I8,
            -1,
            Vec::new(),
            motions,
        )];
        match self.plan.show {
            Show::Velocity => {
                fields.push(real("velocity", "speed of arrival of an impact", Unit::VELOCITY));
                fields.push(real("impact_phase", "phase of the force at the impact", Unit::ANGLE));
                fields.push(field("side", "what the point is", Unit::NUMBER, NumberType::I8, 0, point.clone(), sides));
            }
            Show::Strobe => {
                fields.push(real("x", "position at phase 0 of the force", Unit::LENGTH));
                fields.push(real("v", "velocity at phase 0 of the force", Unit::VELOCITY));
            }
            // `Study::new` refuses it
            Show::Quantity(_) => {}
        }
        fields
    }

    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Self::Tile> {
        let (rows, values) = (&block.ranges[0], &block.ranges[1]);
        let mut steps = Vec::with_capacity(block.points());
        for row in rows.clone() {
            let mut before = None;
            for j in 0..values.len() {
                let row = row as u64;
                let (index, sweep) = match self.plan.direction {
                    SweepDirection::Scatter { .. } => (u32::try_from(values.start + j).ok()?, Sweep::Start(row)),
                    _ => carried(&self.plan, row, u32::try_from(j).ok()?),
                };
                steps.push(step(&self.system, &self.plan, (index, sweep), before).map(|(step, left)| {
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
        let mut tile = Tile::empty(block.points(), self.keep);
        // the ends were checked, and every value between two valid ends is valid
        for (k, step) in steps.iter().enumerate().filter_map(|(k, step)| Some((k, step.as_ref().ok()?))) {
            let row = k / values.len();
            tile.put(row * values.len() + (step.index as usize - values.start), step, self.keep);
        }
        match self.plan.show {
            Show::Velocity => {
                vec![tile.kind, tile.first, tile.second, tile.side].into_iter().map(Part::column).collect()
            }
            Show::Strobe => vec![tile.kind, tile.first, tile.second].into_iter().map(Part::column).collect(),
            Show::Quantity(_) => vec![tile.kind.column()],
        }
    }
}

/// The diagram from the columns of its study, with the motions in the order of [`Diagram`].
///
/// Motions of tiles that are not complete are left out.
#[must_use]
pub fn diagram_of(plan: &DiagramPlan, columns: &[Column]) -> Diagram {
    let (count, keep) = (plan.over.count() as usize, usize::try_from(plan.keep).unwrap_or(usize::MAX));
    let whole = |k: usize| if let Some(Column::I8(values)) = columns.get(k) { values.as_slice() } else { &[] };
    let real = |k: usize| columns.get(k).map_or(&[][..], Column::real);
    let (kinds, first, second, sides) = (whole(0), real(1), real(2), whole(3));
    let motion = |row: usize, index: u32, sweep: Sweep| {
        let at = row * count + index as usize;
        let kind = match kinds.get(at)? {
            0 => MotionKind::NoImpact,
            1 => MotionKind::Impacts,
            2 => MotionKind::Stuck,
            3 => MotionKind::Undecided,
            _ => return None,
        };
        let side = |sign: i8| if sign > 0 { Side::Upper } else { Side::Lower };
        let point = |at: usize| {
            let (a, b) = (*first.get(at)?, *second.get(at)?);
            Some(match (plan.show, sides.get(at).copied().unwrap_or(0)) {
                (Show::Strobe, _) if !a.is_nan() => DiagramPoint::State { x: a, v: b },
                (Show::Velocity, sign @ (1 | -1)) => DiagramPoint::Impact { phase: b, velocity: a, side: side(sign) },
                (Show::Velocity, sign @ (2 | -2)) => DiagramPoint::Chatter { phase: b, side: side(sign) },
                _ => return None,
            })
        };
        let points = (at * keep..(at + 1) * keep).map_while(point).collect();
        Some(DiagramStep { index, sweep, kind, points })
    };
    let values = 0..plan.over.count();
    let steps = match plan.direction {
        SweepDirection::Scatter { starts, .. } => values
            .flat_map(|index| (0..starts).map(move |start| (index, start)))
            .filter_map(|(index, start)| motion(usize::try_from(start).ok()?, index, Sweep::Start(start)))
            .collect(),
        _ => (0..plan.runs())
            .flat_map(|row| values.clone().map(move |j| (row, j)))
            .filter_map(|(row, j)| {
                let (index, sweep) = carried(plan, row, j);
                motion(usize::try_from(row).ok()?, index, sweep)
            })
            .collect(),
    };
    Diagram { plan: *plan, steps }
}

enum Part {
    Whole(Vec<i8>),
    Real(Vec<f64>),
}

impl Part {
    fn column(self) -> Column {
        match self {
            Self::Whole(values) => Column::I8(values),
            Self::Real(values) => Column::F64(values),
        }
    }
}

struct Tile {
    kind: Part,
    first: Part,
    second: Part,
    side: Part,
}

impl Tile {
    fn empty(points: usize, keep: usize) -> Self {
        Self {
            kind: Part::Whole(vec![-1; points]),
            first: Part::Real(vec![f64::NAN; points * keep]),
            second: Part::Real(vec![f64::NAN; points * keep]),
            side: Part::Whole(vec![0; points * keep]),
        }
    }

    fn put(&mut self, at: usize, step: &DiagramStep, keep: usize) {
        let Self {
            kind: Part::Whole(kind),
            first: Part::Real(first),
            second: Part::Real(second),
            side: Part::Whole(side),
        } = self
        else {
            return;
        };
        kind[at] = match step.kind {
            MotionKind::NoImpact => 0,
            MotionKind::Impacts => 1,
            MotionKind::Stuck => 2,
            MotionKind::Undecided => 3,
        };
        let sign = |s: Side| if s == Side::Upper { 1 } else { -1 };
        for (i, point) in step.points.iter().take(keep).enumerate() {
            let at = at * keep + i;
            (first[at], second[at], side[at]) = match *point {
                // a diagram of a quantity has no columns
                DiagramPoint::Value { .. } => continue,
                DiagramPoint::Impact { phase, velocity, side } => (velocity, phase, sign(side)),
                DiagramPoint::Chatter { phase, side } => (0.0, phase, 2 * sign(side)),
                DiagramPoint::State { x, v } => (x, v, 0),
            };
        }
    }
}
