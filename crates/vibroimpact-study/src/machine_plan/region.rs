//! The regions of a plane of two numbers of a machine in which a motion exists and in which it is stable: those of the oscillator
//! that the machine is.

use super::cut::{check_plane, plane};
use crate::chosen::followable;
use crate::machine::MachineSource;
use crate::region::{self, Plane};
use crate::{Control, PlanError, RegionPlan, Regions, RunError};
use vibroimpact::Oscillator;
use vibroimpact::continuation::Frame;

impl RegionPlan<String> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        region::check(&self.label, self.grid)?;
        check_plane(source, &self.across, &self.up)?;
        self.plane(source).map(|_| ())
    }

    /// The oscillator at the corner of the plane, and the frame.
    fn plane(&self, source: &MachineSource) -> Result<(Oscillator, Frame), PlanError> {
        let plane = plane(source, &self.across, &self.up);
        plane.reduced((self.across.from, self.up.from)).ok_or(PlanError::NoMachineRegion)
    }

    /// Whether the motion loses no energy anywhere in the plane. It is then neutrally stable and has no region of
    /// stability.
    #[must_use]
    pub fn neutral(&self, source: &MachineSource) -> bool {
        let Ok((osc, frame)) = self.plane(source) else { return false };
        let loses = |osc: &Oscillator| osc.stops().any(|(_, stop)| stop.restitution < 1.0);
        frame.everywhere(&osc, |osc| osc.damping() == 0.0 && (self.clears() || !loses(osc)))
    }
}

/// Computes both regions.
pub(super) fn regions(
    source: &MachineSource,
    plan: &RegionPlan<String>,
    control: &Control<'_>,
) -> Result<Regions, RunError> {
    let (osc, frame) = plan.plane(source)?;
    Plane::of(osc, frame, plan.grid).both(followable(Some(&plan.label))?, control)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Parameter, Plan, Results, Stretch, System, SystemPlan, machine, run};

    const MACHINE: &str = r#"
        [machine]
        coordinates = ["body"]
        mass = [1]
        stiffness = [1]
        frequency = 0.9
        [[machine.force]]
        order = 1
        cos = [0]
        sin = [1]
        [[machine.stop]]
        name = "wall"
        direction = [1]
        gap = 1.0
        restitution = 0.5
    "#;

    fn plan(change: impl Fn(&mut RegionPlan<String>)) -> Plan {
        let source = MachineSource::from_text(MACHINE, machine::no_files).unwrap();
        let stretch = |path: &str, from, to| Stretch { parameter: path.to_owned(), from, to };
        let across = stretch("frequency", 0.83, 0.95);
        let up = stretch("stop.wall.gap", 1.0, 2.5);
        let mut region = RegionPlan { label: "1/1".to_owned(), across, up, grid: 5 };
        change(&mut region);
        Plan::new(source, region)
    }

    fn regions(plan: &Plan) -> Regions {
        let Results::Machine(machine::Results::Region(found)) = run(plan, &Control::default()).unwrap() else {
            panic!()
        };
        found
    }

    /// In the units of the oscillator the regions are its own, to the last digit but for the direction of steps.
    #[test]
    fn those_of_the_oscillator() {
        let plan = plan(|_| ());
        let text = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), plan);
        let found = regions(&plan);
        let system = SystemPlan { beta: Some(0.9), gap: 1.0, restitution: 0.5, ..SystemPlan::default() };
        let over = |parameter, from, to| Stretch { parameter, from, to };
        let known = RegionPlan {
            label: "1/1".into(),
            across: over(Parameter::Beta, 0.83, 0.95),
            up: over(Parameter::Gap, 1.0, 2.5),
            grid: 5,
        };
        let known = region::regions(&system, &known, &Control::default()).unwrap();
        for (own, other) in [(&found.existence, &known.existence), (&found.stability, &known.stability)] {
            assert!(own.unresolved.is_empty() && own.polygons.len() == other.polygons.len());
            for k in 0..900 {
                let at = (0.832 + 0.004 * f64::from(k % 30), 1.013 + 0.05 * f64::from(k / 30));
                assert_eq!(own.contains(at), other.contains(at), "{at:?}");
            }
        }
        assert!(found.stability.contains((1.0 / 1.11, 1.828)) && !found.stability.contains((1.0 / 1.11, 1.830)));
    }

    #[test]
    fn other_machines_are_refused() {
        let source = |name| MachineSource::open(name).unwrap();
        let refused = |plan: Plan| run(&plan, &Control::default()).unwrap_err().to_string();
        let hammer = Plan {
            system: System::from(source("two-mass-hammer")),
            ..plan(|plan| {
                plan.across = Stretch { parameter: "frequency".into(), from: 0.9, to: 1.3 };
                plan.up = Stretch { parameter: "b".into(), from: 0.4, to: 0.6 };
            })
        };
        assert!(refused(hammer).starts_with("regions are those of machines of one coordinate on a spring"));
        assert!(refused(plan(|plan| plan.label = "inf/1".into())).starts_with("a cycle that rests"));
        assert!(refused(plan(|plan| plan.grid = 1)).starts_with("grid = 1 lies outside"));
        assert!(refused(plan(|plan| plan.up = plan.across.clone())).contains("frequency"));
        assert!(refused(plan(|plan| plan.up.to = 0.5)).starts_with("stop.wall.gap from 1 to 0.5 is no range"));
    }
}
