//! The tiles of an orbit diagram. A carried sweep is one tile; scattered starts have many.

use super::sweeps::{SweepFill, Swept, kind, stored};
use crate::diagram::{Diagram, DiagramPoint, DiagramStep, Show, Sweep, step};
use crate::field::{Column, Extra, Field, NumberType};
use crate::{DiagramPlan, Parameter, PlanError, SystemPlan, Unit};
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
    type Number = Parameter;
    type Show = Show;
    type Left = (SystemPlan, Start);

    fn plan(&self) -> &DiagramPlan {
        &self.plan
    }

    fn fields(&self) -> Vec<Field> {
        let point = [Extra { name: "point", count: self.keep }];
        let sides = [
            (0, "no_point"),
            (1, "impact"),
            (-1, "impact_on_the_second_stop"),
            (2, "end_of_a_chatter"),
            (-2, "end_of_a_chatter_on_the_second_stop"),
        ];
        let real = |name: &'static str, long_name: &'static str, unit| Field::real(name, long_name, unit, &point);
        let mut fields = vec![kind()];
        match self.plan.show {
            Show::Velocity => {
                fields.push(real("velocity", "speed of arrival of an impact", Unit::VELOCITY));
                fields.push(real("impact_phase", "phase of the force at the impact", Unit::ANGLE));
                fields.push(Field::integers("side", "what the point is", NumberType::I8, &point, &sides));
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

    fn numbers((_, left): &Self::Left) -> Vec<f64> {
        vec![left.x, left.v, left.phase]
    }

    fn left(&self, index: u32, numbers: &[f64]) -> Option<Self::Left> {
        let &[x, v, phase] = numbers else { return None };
        Some((self.plan.system(&self.system, index).ok()?, Start { x, v, phase }))
    }

    fn columns(&self, points: usize, steps: &[(usize, &DiagramStep)]) -> Vec<Column> {
        let mut kind = vec![-1_i8; points];
        let (mut first, mut second) = (vec![f64::NAN; points * self.keep], vec![f64::NAN; points * self.keep]);
        let mut side = vec![0_i8; points * self.keep];
        for (at, step) in steps {
            kind[*at] = step.kind.code();
            for (i, point) in step.points.iter().take(self.keep).enumerate() {
                let k = at * self.keep + i;
                (first[k], second[k], side[k]) = match *point {
                    // a diagram of a quantity has no columns
                    DiagramPoint::Value(_) => continue,
                    DiagramPoint::Impact { stop, phase, speed } => (speed, phase, sign(stop)),
                    DiagramPoint::Chatter { stop, phase } => (0.0, phase, 2 * sign(stop)),
                    DiagramPoint::State { x, v } => (x, v.unwrap_or(f64::NAN), 0),
                };
            }
        }
        let kind = Column::I8(kind);
        match self.plan.show {
            Show::Velocity => vec![kind, Column::F64(first), Column::F64(second), Column::I8(side)],
            Show::Strobe => vec![kind, Column::F64(first), Column::F64(second)],
            Show::Quantity(_) => vec![kind],
        }
    }
}

/// The sign of the number that stands for a stop in stores.
const fn sign(stop: usize) -> i8 {
    if stop == Side::Upper.place() { 1 } else { -1 }
}

/// The diagram from the columns of its study, with the motions in the order of [`Diagram`].
///
/// Motions of tiles that are not complete are left out.
pub(crate) fn diagram_of(plan: &DiagramPlan, columns: &[Column]) -> Diagram {
    let real = |k: usize| columns.get(k).map_or(&[][..], Column::real);
    let (first, second, sides) = (real(1), real(2), columns.get(3).map_or(&[][..], Column::flags));
    let stop = |sign: i8| (if sign > 0 { Side::Upper } else { Side::Lower }).place();
    stored(plan, columns, |at| {
        let (a, b) = (*first.get(at)?, *second.get(at)?);
        Some(match (plan.show, sides.get(at).copied().unwrap_or(0)) {
            (Show::Strobe, _) if !a.is_nan() => DiagramPoint::State { x: a, v: Some(b) },
            (Show::Velocity, sign @ (1 | -1)) => DiagramPoint::Impact { stop: stop(sign), phase: b, speed: a },
            (Show::Velocity, sign @ (2 | -2)) => DiagramPoint::Chatter { stop: stop(sign), phase: b },
            _ => return None,
        })
    })
}
