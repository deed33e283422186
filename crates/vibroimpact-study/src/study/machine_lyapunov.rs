//! What the tiles of a study of Lyapunov exponents of a machine hold: all exponents at each point.

use super::fill::{Over, on_axis};
use super::lyapunov::{LyapunovFill, Spectra, Spectrum, TILE};
use super::map::side;
use crate::machine::{MachineSource, StartAxis};
use crate::{LyapunovPlan, PlanError, Unit};
use vibroimpact::chaos::{Grounds, machine_exponents_while};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;

/// A machine and its start over axes.
pub(super) struct Machines {
    source: MachineSource,
    plan: LyapunovPlan<String>,
    /// For each axis where it stands in a start; `None` for a number of the machine.
    places: Vec<Option<StartAxis>>,
    directions: usize,
}

impl LyapunovFill<Machines> {
    pub(super) fn of_machine(
        source: &MachineSource,
        plan: &LyapunovPlan<String>,
        tile: Option<u32>,
    ) -> Result<Self, PlanError> {
        let machine = source.machine()?;
        let over = Over::axes(&plan.axes, tile, (1, side(TILE, plan.axes.len())));
        let places = plan.axes.iter().map(|axis| StartAxis::found(&machine, &axis.vary)).collect::<Result<_, _>>()?;
        let of = Machines { source: source.clone(), plan: plan.clone(), places, directions: 2 * machine.n() };
        Ok(Self { of, over })
    }
}

impl Machines {
    /// The machine and the start at a point.
    fn problem(&self, index: &[usize]) -> Result<(Machine, Start), PlanError> {
        let axes = self.plan.axes.iter().zip(&self.places).enumerate();
        let values: Vec<(&str, Option<&StartAxis>, f64)> = axes
            .map(|(k, (axis, place))| (axis.vary.as_str(), place.as_ref(), axis.over.at(on_axis(index, k))))
            .collect();
        self.source.described_at(&values)
    }
}

const GROUNDS: [(i32, &str); 5] =
    [(-1, "not_computed"), (0, "undecided"), (1, "measured"), (2, "exact"), (3, "refused")];

impl Spectra for Machines {
    const RATE: Unit = Unit::CONSISTENT;
    const REFUSED: i8 = 3;

    fn directions(&self) -> usize {
        self.directions
    }

    fn further(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("impacts_per_period", "closings of stops per forcing period"),
            ("impacts_per_period_error", "three standard errors of the closings per forcing period"),
        ]
    }

    fn grounds(&self) -> &'static [(i32, &'static str)] {
        &GROUNDS
    }

    fn at(&self, index: &[usize]) -> Option<Spectrum> {
        let (machine, start) = self.problem(index).ok()?;
        let found = machine_exponents_while(&machine, &start, self.plan.events(), &|| true).ok()??;
        let closings = found.impact_rate.scaled(machine.period().unwrap_or(f64::NAN));
        Some(Spectrum {
            grounds: match found.grounds {
                Grounds::Undecided { .. } => 0,
                Grounds::Measured { .. } => 1,
                _ => 2,
            },
            further: vec![closings.value, closings.error],
            exponents: found.exponents,
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::study::{Sheet, Study, in_memory};
    use crate::{Control, Plan, PlanError, PlanResults, Results, RunError, Task, run};

    /// A forced mass with a stop at a gap of 0.3; `start` and the axes are written into it.
    fn plan(start: &str, axes: &str) -> Plan {
        let text = format!(
            "version = 1\ntile = 2\nstart = {{ q = {{ mass = {start} }} }}\n[machine]\nbodies = {{ mass = 1 }}\nfrequency = 0.9\n\
             link = [{{ between = [\"ground\", \"mass\"], stiffness = 1, damping = 0.05 }}]\n\
             force = [{{ at = \"mass\", sin = 1 }}]\n\
             stop = [{{ name = \"wall\", at = \"mass\", gap = 0.3, restitution = 0.6 }}]\n\
             [task.lyapunov]\nimpacts = 400\ntransient = 100\n{axes}"
        );
        Plan::from_text(&text).unwrap()
    }

    fn numbers<'a>(sheet: &'a Sheet, name: &str) -> &'a [f64] {
        sheet.columns[sheet.fields.iter().position(|field| field.name == name).unwrap()].real()
    }

    #[test]
    fn each_point_has_the_exponents_of_its_own_plan() {
        let axes =
            "axes = [{ vary = \"q.mass\", over = \"-0.5:1:4\" }, { vary = \"stop.wall.gap\", over = [0.6, 0.2, 0.0] }]";
        let whole = plan("0", axes);
        whole.check().unwrap();
        let study = || Study::new(&whole).unwrap();
        let found = in_memory(study(), &Control::default()).unwrap();
        assert_eq!(found.columns, in_memory(study(), &Control { threads: 1, ..Control::default() }).unwrap().columns);
        let grounds = found.columns.last().unwrap().flags();
        let (mut measured, mut refused) = (0, 0);
        for (k, grounds) in grounds.iter().enumerate() {
            let (x, gap) = ([-0.5, 0.0, 0.5, 1.0][k % 4], [0.6, 0.2, 0.0][k / 4]);
            let exponents = &numbers(&found, "exponent")[2 * k..2 * k + 2];
            let alone = plan(&x.to_string(), "");
            let there = alone.machine().unwrap().with("stop.wall.gap", gap).unwrap();
            let alone = Plan { system: there.into(), ..alone };
            if x > gap {
                refused += 1;
                assert!(*grounds == 3 && exponents.iter().all(|value| value.is_nan()), "{x} {gap}");
                assert!(alone.check().is_err());
                continue;
            }
            let PlanResults::Machine(Results::Lyapunov(direct, None)) = run(&alone, &Control::default()).unwrap()
            else {
                panic!()
            };
            assert_eq!(exponents, direct.exponents.iter().map(|found| found.value).collect::<Vec<_>>());
            let rate = numbers(&found, "impacts_per_period")[k];
            assert!((rate - direct.impact_rate.value * core::f64::consts::TAU / 0.9).abs() < 1e-12);
            assert_eq!(*grounds, if direct.exact() { 2 } else { 1 });
            measured += 1;
        }
        assert_eq!((measured, refused), (7, 5));
    }

    #[test]
    fn axes_are_checked_and_one_motion_has_none() {
        let axis = |vary: &str| plan("0", &format!("axes = [{{ vary = \"{vary}\", over = \"0:1:3\" }}]"));
        for (vary, told) in [("q.other", "q.other"), ("stop.floor.gap", "stop.floor.gap")] {
            let error = axis(vary).check().unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
        let refused = run(&axis("phase"), &Control::default());
        assert!(matches!(refused, Err(RunError::Plan(PlanError::WrongAxis { .. }))), "{refused:?}");
        assert_eq!(
            Study::new(&plan("0", "")).err().unwrap(),
            PlanError::NoMachineStudy("measure the exponents of one motion")
        );
        assert!(matches!(axis("phase").task, Task::Lyapunov(plan) if plan.axes.len() == 1));
    }
}
