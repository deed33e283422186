//! What the tiles of an orbit diagram of a machine hold.

use super::sweeps::{SweepFill, Swept, kind, stored};
use crate::diagram::{Diagram, DiagramPoint, DiagramStep, Shown, Sweep, machine_step};
use crate::field::{Column, Extra, Field, NumberType};
use crate::machine::MachineSource;
use crate::{DiagramPlan, PlanError, Unit};
use vibroimpact::events::{ContactStart, Start};
use vibroimpact::regime::ContactState;

/// Machines over a number.
pub(crate) struct MachineSweep {
    source: MachineSource,
    plan: DiagramPlan<String, String>,
    keep: usize,
}

impl SweepFill<MachineSweep> {
    pub(crate) fn of_machine(source: &MachineSource, plan: &DiagramPlan<String, String>, tile: Option<u32>) -> Self {
        let keep = usize::try_from(plan.keep).unwrap_or(usize::MAX);
        Self::of(MachineSweep { source: source.clone(), plan: plan.clone(), keep }, tile)
    }
}

impl Swept for MachineSweep {
    type Number = String;
    type Show = String;
    type Left = Start;

    fn plan(&self) -> &DiagramPlan<String, String> {
        &self.plan
    }

    fn fields(&self) -> Vec<Field> {
        let kind = kind();
        let point = [Extra { name: "point", count: self.keep }];
        if !self.plan.show.is_closings() {
            let show = &self.plan.show;
            let states = self.plan.show.is_states();
            let long_name =
                if states { format!("{show} at phase 0 of the forcing") } else { format!("{show} of the motion") };
            return vec![kind, Field::real(show.clone(), long_name, Unit::CONSISTENT, &point)];
        }
        let speed = Field::real("speed", "speed of a closing", Unit::CONSISTENT, &point);
        let phase = Field::real("closing_phase", "phase of the forcing at the closing", Unit::ANGLE, &point);
        let of_stop = "number of the stop that closes, counted from 0 in the order of the machine";
        let stop = Field::integers("stop", of_stop, NumberType::I32, &point, &[(-1, "no_point")]);
        vec![kind, speed, phase, stop]
    }

    fn step(&self, at: (u32, Sweep), before: Option<Start>) -> Result<(DiagramStep, Start), PlanError> {
        machine_step(&self.source, &self.plan, at, before)
    }

    fn numbers(left: &Start) -> Vec<f64> {
        // surfaces of stops that stand back, with the numbers of their stops
        let back = left.contacts.iter().filter(|contact| contact.surface > 0.0);
        let back =
            back.flat_map(|contact| [f64::from(u32::try_from(contact.place).unwrap_or(u32::MAX)), contact.surface]);
        left.q.iter().chain(&left.qdot).copied().chain([left.phase]).chain(back).collect()
    }

    fn left(&self, _: u32, numbers: &[f64]) -> Option<Start> {
        let n = self.source.parts().ok()?.coordinates.len();
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

    fn columns(&self, points: usize, steps: &[(usize, &DiagramStep)]) -> Vec<Column> {
        let mut kind = vec![-1_i8; points];
        let mut value = vec![f64::NAN; points * self.keep];
        let (mut phase, mut stop) = (value.clone(), vec![-1_i32; points * self.keep]);
        for (at, step) in steps {
            kind[*at] = step.kind.code();
            for (i, point) in step.points.iter().take(self.keep).enumerate() {
                let k = at * self.keep + i;
                (value[k], phase[k], stop[k]) = match *point {
                    DiagramPoint::Impact { stop, phase, speed } => (speed, phase, i32::try_from(stop).unwrap_or(-1)),
                    DiagramPoint::State { x: value, .. } | DiagramPoint::Value(value) => (value, 0.0, -1),
                    // of an oscillator only
                    DiagramPoint::Chatter { .. } => continue,
                };
            }
        }
        let mut columns = vec![Column::I8(kind), Column::F64(value)];
        if self.plan.show.is_closings() {
            columns.extend([Column::F64(phase), Column::I32(stop)]);
        }
        columns
    }
}

/// The diagram of a machine, as [`diagram_of`](super::diagram_of).
pub(crate) fn machine_diagram_of(plan: &DiagramPlan<String, String>, columns: &[Column]) -> Diagram<String, String> {
    let real = |k: usize| columns.get(k).map_or(&[][..], Column::real);
    let (values, phases, stops) = (real(1), real(2), columns.get(3).map_or(&[][..], Column::whole));
    stored(plan, columns, |at| {
        let value = *values.get(at).filter(|value| !value.is_nan())?;
        let phase = phases.get(at).copied().unwrap_or(0.0);
        Some(match stops.get(at).and_then(|stop| usize::try_from(*stop).ok()) {
            Some(stop) => DiagramPoint::Impact { stop, phase, speed: value },
            None if plan.show.is_states() => DiagramPoint::State { x: value, v: None },
            None => DiagramPoint::Value(value),
        })
    })
}
