//! What the tiles of an orbit diagram of a machine hold.

use super::fill::{Along, along_machine};
use super::sweeps::{KINDS, SweepFill, Swept, in_order};
use crate::diagram::{MotionKind, Sweep, SweepDirection};
use crate::field::{Column, Extra, Field, NumberType};
use crate::machine::MachineSource;
use crate::machine_plan::{MachineDiagram, MachineDiagramPoint, MachineDiagramStep, diagram_step};
use crate::{Axis, DiagramPlan, PlanError, Unit, Values};
use vibroimpact::events::{ContactStart, MachineStart};
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
    type Step = MachineDiagramStep;
    type Left = MachineStart;

    fn sweep(&self) -> (&str, &Values, SweepDirection) {
        (&self.plan.vary, &self.plan.over, self.plan.direction)
    }

    fn varied(&self) -> Vec<Along> {
        let mut along = along_machine(&[Axis { vary: self.plan.vary.clone(), over: self.plan.over.clone() }]);
        // the values of the second number are a second coordinate of the same dimension
        if let (Some(also), Some(first)) = (&self.plan.also, along.first()) {
            let second = |k: u32| self.plan.values(k).nth(1).unwrap_or(f64::NAN);
            let values = (0..).take(self.plan.over.count()).map(second).collect();
            along.push(Along {
                name: also.parameter.clone(),
                dimension: first.dimension.clone(),
                values,
                ..first.clone()
            });
        }
        along
    }

    fn fields(&self) -> Vec<Field> {
        let kind = Field {
            name: "kind".into(),
            long_name: "what the motion is after the transient".into(),
            unit: Unit::NUMBER,
            kind: NumberType::I8,
            fill: -1,
            extra: Vec::new(),
            flags: KINDS.to_vec(),
            comment: "",
        };
        let extra = vec![Extra { name: "point", count: self.keep }];
        let real =
            Field { unit: Unit::CONSISTENT, kind: NumberType::F64, fill: 0, extra, flags: Vec::new(), ..kind.clone() };
        if !self.plan.shows_closings() {
            let show = &self.plan.show;
            let states = self.plan.shows_states();
            let long_name =
                if states { format!("{show} at phase 0 of the forcing") } else { format!("{show} of the motion") };
            let long_name = long_name.into();
            return vec![kind, Field { name: self.plan.show.clone().into(), long_name, ..real }];
        }
        let stop = Field {
            name: "stop".into(),
            long_name: "number of the stop that closes, counted from 0 in the order of the machine".into(),
            kind: NumberType::I32,
            unit: Unit::NUMBER,
            fill: -1,
            flags: vec![(-1, "no_point")],
            ..real.clone()
        };
        let phase = Field {
            name: "closing_phase".into(),
            long_name: "phase of the forcing at the closing".into(),
            unit: Unit::ANGLE,
            ..real.clone()
        };
        vec![kind, Field { name: "speed".into(), long_name: "speed of a closing".into(), ..real }, phase, stop]
    }

    fn step(
        &self,
        at: (u32, Sweep),
        before: Option<MachineStart>,
    ) -> Result<(MachineDiagramStep, MachineStart), PlanError> {
        diagram_step(&self.source, &self.plan, at, before)
    }

    fn index(step: &MachineDiagramStep) -> u32 {
        step.index
    }

    fn numbers(left: &MachineStart) -> Vec<f64> {
        // surfaces of stops that stand back, with the numbers of their stops
        let back = left.contacts.iter().filter(|contact| contact.surface > 0.0);
        let back =
            back.flat_map(|contact| [f64::from(u32::try_from(contact.place).unwrap_or(u32::MAX)), contact.surface]);
        left.q.iter().chain(&left.qdot).copied().chain([left.phase]).chain(back).collect()
    }

    fn left(&self, _: u32, numbers: &[f64]) -> Option<MachineStart> {
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
        rest.is_empty().then(|| MachineStart {
            q: q.to_vec(),
            qdot: qdot.to_vec(),
            phase: *phase,
            contacts: back.iter().map(contact).collect(),
            ..MachineStart::default()
        })
    }

    fn columns(&self, points: usize, steps: &[(usize, &MachineDiagramStep)]) -> Vec<Column> {
        let mut kind = vec![-1_i8; points];
        let mut value = vec![f64::NAN; points * self.keep];
        let (mut phase, mut stop) = (value.clone(), vec![-1_i32; points * self.keep]);
        for (at, step) in steps {
            kind[*at] = step.kind.code();
            for (i, point) in step.points.iter().take(self.keep).enumerate() {
                let k = at * self.keep + i;
                (value[k], phase[k]) = (point.value, point.phase);
                stop[k] = point.stop.and_then(|stop| i32::try_from(stop).ok()).unwrap_or(-1);
            }
        }
        let mut columns = vec![Column::I8(kind), Column::F64(value)];
        if self.plan.shows_closings() {
            columns.extend([Column::F64(phase), Column::I32(stop)]);
        }
        columns
    }
}

/// The diagram from the columns of its study, with the motions in the order of [`MachineDiagram`].
///
/// Motions of tiles that are not complete are left out.
#[must_use]
pub fn machine_diagram_of(plan: &DiagramPlan<String, String>, columns: &[Column]) -> MachineDiagram {
    let (count, keep) = (plan.over.count(), usize::try_from(plan.keep).unwrap_or(usize::MAX));
    let kinds = columns.first().map_or(&[][..], Column::flags);
    let real = |k: usize| columns.get(k).map_or(&[][..], Column::real);
    let (values, phases, stops) = (real(1), real(2), columns.get(3).map_or(&[][..], Column::whole));
    let motion = |row: usize, index: u32, sweep: Sweep| {
        let at = row * count + index as usize;
        let kind = MotionKind::of_code(*kinds.get(at)?)?;
        let point = |k: usize| {
            let value = *values.get(k).filter(|value| !value.is_nan())?;
            let stop = stops.get(k).and_then(|stop| usize::try_from(*stop).ok());
            Some(MachineDiagramPoint { stop, phase: phases.get(k).copied().unwrap_or(0.0), value })
        };
        let points = (at * keep..(at + 1) * keep).map_while(point).collect();
        Some(MachineDiagramStep { index, sweep, kind, points })
    };
    MachineDiagram { steps: in_order(&plan.over, plan.direction, motion), plan: plan.clone() }
}
