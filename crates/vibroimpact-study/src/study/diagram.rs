//! The tiles of an orbit diagram. A carried sweep is one tile; scattered starts have many.

use super::fill::Along;
use super::sweeps::{KINDS, SweepFill, Swept, in_order};
use crate::axis::Coordinate;
use crate::diagram::{Diagram, DiagramPoint, DiagramStep, MotionKind, Show, Sweep, SweepDirection, number_of, step};
use crate::field::{Column, Extra, Field, NumberType};
use crate::{DiagramPlan, PlanError, SystemPlan, Unit, Values};
use vibroimpact::{Side, Start};

/// Oscillators over a parameter, or along a line through two.
pub(crate) struct OscillatorDiagram {
    system: SystemPlan,
    plan: DiagramPlan,
    keep: usize,
}

impl SweepFill<OscillatorDiagram> {
    pub(crate) fn new(system: &SystemPlan, plan: &DiagramPlan, tile: Option<u32>) -> Self {
        let keep = usize::try_from(plan.keep).unwrap_or(usize::MAX);
        Self::of(OscillatorDiagram { system: *system, plan: plan.clone(), keep }, tile)
    }
}

impl Swept for OscillatorDiagram {
    type Step = DiagramStep;
    type Left = (SystemPlan, Start);

    fn sweep(&self) -> (&str, &Values, SweepDirection) {
        (self.plan.vary.name(), &self.plan.over, self.plan.direction)
    }

    fn varied(&self) -> Vec<Along> {
        let cut = self.plan.cut();
        // the values of the second parameter are a second coordinate of the same dimension
        let values = cut.parameters().enumerate().map(|(k, parameter)| {
            let value = |index: u32| self.plan.values(index).nth(k).map_or(f64::NAN, |(_, value)| value);
            let parameter = Coordinate::Parameter(parameter);
            Along {
                name: parameter.name().to_owned(),
                dimension: cut.vary.name().to_owned(),
                values: (0..number_of(&self.plan.over)).map(value).collect(),
                long_name: parameter.long_name().into(),
                unit: parameter.unit(),
            }
        });
        values.collect()
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
            KINDS.to_vec(),
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

    fn step(&self, at: (u32, Sweep), before: Option<Self::Left>) -> Result<(DiagramStep, Self::Left), PlanError> {
        step(&self.system, &self.plan, at, before)
    }

    fn index(step: &DiagramStep) -> u32 {
        step.index
    }

    fn numbers((_, left): &Self::Left) -> Vec<f64> {
        vec![left.x, left.v, left.phase]
    }

    fn left(&self, index: u32, numbers: &[f64]) -> Option<Self::Left> {
        let &[x, v, phase] = numbers else { return None };
        Some((self.plan.system(&self.system, index).ok()?, Start { x, v, phase }))
    }

    fn columns(&self, points: usize, steps: &[(usize, &DiagramStep)]) -> Vec<Column> {
        let mut tile = Tile::empty(points, self.keep);
        steps.iter().for_each(|(at, step)| tile.put(*at, step, self.keep));
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
    let (count, keep) = (plan.over.count(), usize::try_from(plan.keep).unwrap_or(usize::MAX));
    let whole = |k: usize| if let Some(Column::I8(values)) = columns.get(k) { values.as_slice() } else { &[] };
    let real = |k: usize| columns.get(k).map_or(&[][..], Column::real);
    let (kinds, first, second, sides) = (whole(0), real(1), real(2), whole(3));
    let motion = |row: usize, index: u32, sweep: Sweep| {
        let at = row * count + index as usize;
        let kind = MotionKind::of_code(*kinds.get(at)?)?;
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
    let steps = in_order(&plan.over, plan.direction, motion);
    Diagram { plan: plan.clone(), steps }
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
        kind[at] = step.kind.code();
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
