//! The orbit diagram of an oscillator: its motion after the transient at each value of a parameter, or along a line through two.

use super::follow::{AfterTransient, carried_state};
use super::{DiagramPlan, DiagramPoint, DiagramStep, Show, Sweep, SweepDirection, impacts, settled, strobes};
use crate::field::{Extra, Field, NumberType};
use crate::study::Swept;
use crate::{PlanError, SystemPlan, Unit};
use vibroimpact::verdict::{StartBox, scattered_starts};
use vibroimpact::{Side, Start};

impl Swept for SystemPlan {
    type Left = (Self, Start);

    fn shown_fields(show: &Show, point: &[Extra]) -> Vec<Field> {
        let sides = [
            (0, "no_point"),
            (1, "impact"),
            (-1, "impact_on_the_second_stop"),
            (2, "end_of_a_chatter"),
            (-2, "end_of_a_chatter_on_the_second_stop"),
        ];
        let real = |name: &'static str, long_name: &'static str, unit| Field::real(name, long_name, unit, point);
        match show {
            Show::Velocity => vec![
                real("velocity", "speed of arrival of an impact", Unit::VELOCITY),
                real("impact_phase", "phase of the force at the impact", Unit::ANGLE),
                Field::integers("side", "what the point is", NumberType::I8, point, &sides),
            ],
            Show::Strobe => vec![
                real("x", "position at phase 0 of the force", Unit::LENGTH),
                real("v", "velocity at phase 0 of the force", Unit::VELOCITY),
            ],
            // `Study::new` refuses it
            Show::Quantity(_) => Vec::new(),
        }
    }

    fn numbers_of(point: DiagramPoint) -> Vec<f64> {
        match point {
            // a diagram of a quantity has no columns
            DiagramPoint::Value(_) => Vec::new(),
            DiagramPoint::Impact { stop, phase, speed } => vec![speed, phase, sign(stop)],
            DiagramPoint::Chatter { stop, phase } => vec![0.0, phase, 2.0 * sign(stop)],
            DiagramPoint::State { x, v } => vec![x, v.unwrap_or(f64::NAN)],
        }
    }

    fn step(
        &self,
        plan: &DiagramPlan,
        (index, sweep): (u32, Sweep),
        before: Option<Self::Left>,
    ) -> Result<(DiagramStep, Self::Left), PlanError> {
        let there = plan.system(self, index)?;
        let osc = there.oscillator()?;
        let start = match (plan.direction, sweep, before) {
            (SweepDirection::Scatter { seed, .. }, Sweep::Start(k), _) => {
                scattered_starts(&osc, StartBox::natural(&osc), seed, k)
            }
            (_, _, Some((old, left))) => carried_state(left, &old, &there)?,
            (_, _, None) => Start::at_rest(&osc),
        };
        let AfterTransient { kind, points, last } = match plan.show {
            Show::Velocity => impacts::after_transients(&osc, start, plan.transient, plan.keep),
            Show::Strobe => strobes::after_transients(&osc, start, plan.transient, plan.keep),
            Show::Quantity(quantity) => settled::after_transients(&osc, start, quantity),
        };
        Ok((DiagramStep { index, sweep, kind, points }, (there, last)))
    }

    fn numbers((_, left): &Self::Left) -> Vec<f64> {
        vec![left.x, left.v, left.phase]
    }

    fn left(&self, plan: &DiagramPlan, index: u32, numbers: &[f64]) -> Option<Self::Left> {
        let &[x, v, phase] = numbers else { return None };
        Some((plan.system(self, index).ok()?, Start { x, v, phase }))
    }
}

/// The sign of the number that stands for a stop in stores.
const fn sign(stop: usize) -> f64 {
    if stop == Side::Upper.place() { 1.0 } else { -1.0 }
}

/// The point of a diagram with these [numbers](Swept::numbers_of).
pub(crate) fn point(show: Show, numbers: &[f64]) -> Option<DiagramPoint> {
    let stop = |side: f64| (if side > 0.0 { Side::Upper } else { Side::Lower }).place();
    Some(match (show, numbers) {
        (Show::Strobe, &[x, v]) if !x.is_nan() => DiagramPoint::State { x, v: Some(v) },
        (Show::Velocity, &[speed, phase, side]) if side.abs() == 1.0 => {
            DiagramPoint::Impact { stop: stop(side), phase, speed }
        }
        (Show::Velocity, &[_, phase, side]) if side.abs() == 2.0 => DiagramPoint::Chatter { stop: stop(side), phase },
        _ => return None,
    })
}
