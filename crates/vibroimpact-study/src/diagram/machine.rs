//! The orbit diagram of a machine: its motion after the transient at each value of a number.

use super::after_transient::{closings, settled, strobes};
use super::{AfterTransient, DiagramPoint, DiagramStep, Shown, Sweep, SweepDirection, check_order, check_shown};
use crate::field::{Extra, Field, NumberType};
use crate::machine::MachineSource;
use crate::study::Swept;
use crate::{DiagramPlan, PlanError, Unit};
use vibroimpact::events::{ContactStart, Start};
use vibroimpact::machine::Machine;
use vibroimpact::quantities::machine_quantity;
use vibroimpact::regime::ContactState;
use vibroimpact::verdict::scattered_machine_starts;

/// What is shown of a motion of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ShownPath {
    /// The phase and speed of each closing of a stop.
    Speed,
    /// A coordinate at phase 0.
    Q(usize),
    /// A velocity at phase 0.
    Qdot(usize),
    /// A quantity of the settled motion.
    Quantity,
}

impl DiagramPlan<String, String> {
    /// What is shown.
    fn shown(&self, machine: &Machine) -> Result<ShownPath, PlanError> {
        let names = &machine.parts().coordinates;
        let of = |name: &str| names.iter().position(|known| known == name);
        let found = match self.show.split_once('.') {
            Some(("q", name)) => of(name).map(ShownPath::Q),
            Some(("qdot", name)) => of(name).map(ShownPath::Qdot),
            None if self.show.is_closings() => Some(ShownPath::Speed),
            _ => None,
        };
        let quantity = || machine_quantity(machine, &self.show).ok().map(|_| ShownPath::Quantity);
        let found = found.or_else(quantity);
        let show = found.ok_or_else(|| {
            let known = "speed, q.NAME, qdot.NAME, or a quantity by its path, as power or stop.NAME.impact_speed_max";
            let hint = format!("{known}; the coordinates are {}", names.join(", "));
            PlanError::refused(format!("`{}` is nothing that a diagram of a machine shows\nhint: {hint}", self.show))
        })?;
        if matches!(show, ShownPath::Q(_) | ShownPath::Qdot(_)) && machine.period().is_none() {
            return Err(PlanError::Unforced);
        }
        Ok(show)
    }

    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        check_order(&self.over)?;
        let cut = self.cut();
        cut.check(source)?;
        for end in [cut.ends.0, cut.ends.1] {
            self.shown(&cut.source(source, end)?.machine()?)?;
        }
        check_shown(&self.over, self.direction, (self.transient, self.keep))
    }
}

impl Swept for MachineSource {
    type Left = Start;

    fn shown_fields(show: &String, point: &[Extra]) -> Vec<Field> {
        if !show.is_closings() {
            let states = show.is_states();
            let long_name =
                if states { format!("{show} at phase 0 of the forcing") } else { format!("{show} of the motion") };
            return vec![Field::real(show.clone(), long_name, Unit::CONSISTENT, point)];
        }
        let of_stop = "number of the stop that closes, counted from 0 in the order of the machine";
        vec![
            Field::real("speed", "speed of a closing", Unit::CONSISTENT, point),
            Field::real("closing_phase", "phase of the forcing at the closing", Unit::ANGLE, point),
            Field::integers("stop", of_stop, NumberType::I32, point, &[(-1, "no_point")]),
        ]
    }

    fn numbers_of(point: DiagramPoint) -> Vec<f64> {
        match point {
            DiagramPoint::Impact { stop, phase, speed } => {
                vec![speed, phase, i32::try_from(stop).map_or(-1.0, f64::from)]
            }
            DiagramPoint::State { x: value, .. } | DiagramPoint::Value(value) => vec![value],
            // of an oscillator only
            DiagramPoint::Chatter { .. } => Vec::new(),
        }
    }

    /// The first value starts from the start of the machine file. A state beyond a rigid stop that has moved is put onto it.
    fn step(
        &self,
        plan: &DiagramPlan<String, String>,
        (index, sweep): (u32, Sweep),
        before: Option<Start>,
    ) -> Result<(DiagramStep, Start), PlanError> {
        let machine = plan.cut().with(self, plan.values(index))?.machine()?;
        let start = match (plan.direction, sweep, before) {
            (SweepDirection::Scatter { seed, .. }, Sweep::Start(k), _) => scattered_machine_starts(&machine, seed, k),
            (_, _, Some(left)) => left,
            (_, _, None) => self.start()?,
        };
        let (start, length) = (start.within_stops(&machine), (plan.transient, plan.keep));
        let AfterTransient { kind, points, last } = match plan.shown(&machine)? {
            ShownPath::Speed => closings(&machine, &start, length)?,
            ShownPath::Q(i) => strobes(&machine, &start, length, |sample| sample.q[i])?,
            ShownPath::Qdot(i) => strobes(&machine, &start, length, |sample| sample.qdot[i])?,
            ShownPath::Quantity => settled(&machine, &start, &plan.show)?,
        };
        Ok((DiagramStep { index, sweep, kind, points }, last))
    }

    fn numbers(left: &Start) -> Vec<f64> {
        // surfaces of stops that stand back, with the numbers of their stops
        let back = left.contacts.iter().filter(|contact| contact.surface > 0.0);
        let back =
            back.flat_map(|contact| [f64::from(u32::try_from(contact.place).unwrap_or(u32::MAX)), contact.surface]);
        left.q.iter().chain(&left.qdot).copied().chain([left.phase]).chain(back).collect()
    }

    fn left(&self, _: &DiagramPlan<String, String>, _: u32, numbers: &[f64]) -> Option<Start> {
        let n = self.parts().ok()?.coordinates.len();
        let (q, rest) = numbers.split_at_checked(n)?;
        let (qdot, rest) = rest.split_at_checked(n)?;
        let (phase, back) = rest.split_first()?;
        let (back, rest) = back.as_chunks::<2>();
        // the numbers of stops are small
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let contact = |[place, surface]: &[f64; 2]| ContactStart {
            place: *place as usize,
            state: ContactState::Open,
            surface: *surface,
        };
        rest.is_empty().then(|| Start {
            q: q.to_vec(),
            qdot: qdot.to_vec(),
            phase: *phase,
            contacts: back.iter().map(contact).collect(),
            ..Start::default()
        })
    }
}

/// The point of a diagram with these [numbers](Swept::numbers_of).
pub(crate) fn point(show: &String, numbers: &[f64]) -> Option<DiagramPoint> {
    Some(match *numbers {
        [value, ..] if value.is_nan() => return None,
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // the numbers of stops are small
        [speed, phase, stop] if stop >= 0.0 => DiagramPoint::Impact { stop: stop as usize, phase, speed },
        [x] if show.is_states() => DiagramPoint::State { x, v: None },
        [value] => DiagramPoint::Value(value),
        _ => return None,
    })
}
