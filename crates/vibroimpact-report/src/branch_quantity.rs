//! The quantity that stands for each cycle of a branch of a machine without stops, which has no speeds of closings.

use vibroimpact::continuation::machine::SolutionPoint;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::{Quantity, machine_cycle_quantities};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::{Branches, Cut};

/// The largest displacement of the first coordinate, or its largest velocity where the displacement is not defined, as in a
/// machine that moves on as a whole.
#[derive(Clone, Debug)]
pub struct BranchQuantity<'a> {
    /// Its path.
    pub path: String,
    source: &'a MachineSource,
    cut: Cut<String>,
}

impl<'a> BranchQuantity<'a> {
    /// That of the branches of a machine; `None` if it has stops.
    pub(crate) fn of(
        machine: &Machine,
        source: &'a MachineSource,
        cut: &Cut<String>,
        found: &Branches<Cycle, SolutionPoint>,
    ) -> Option<Self> {
        if !machine.stops().is_empty() {
            return None;
        }
        let (name, first) = (machine.parts().coordinates.first()?, found.followed.first()?.points.first()?);
        let of = |quantity: Quantity| Self::at_path(format!("q.{name}.{}", quantity.name()), source, cut);
        let displacement = of(Quantity::DisplacementMax);
        Some(if displacement.at(first).is_finite() { displacement } else { of(Quantity::VelocityMax) })
    }

    /// The quantity at a path.
    pub(crate) fn at_path(path: String, source: &'a MachineSource, cut: &Cut<String>) -> Self {
        Self { path, source, cut: cut.clone() }
    }

    /// Its value at a point; `NaN` if it is not defined there.
    pub(crate) fn at(&self, point: &SolutionPoint) -> f64 {
        let value = || {
            let machine = self.cut.source(self.source, point.value).ok()?.machine().ok()?;
            machine_cycle_quantities(&machine, &point.cycle)?.value(&machine, &self.path).ok()
        };
        value().unwrap_or(f64::NAN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::{BranchPlan, Control, Plan, PlanResults, Results, run};

    /// The belt carries the mass to x = fs, and from there it swings about x = f with the speed V at the beginning.
    #[test]
    fn the_largest_displacement_of_stick_slip() {
        let source = MachineSource::open("stick-slip").unwrap();
        let branch: BranchPlan<String> = serde_json::from_str(r#"{"vary": "V", "to": 0.5}"#).unwrap();
        let plan = Plan::new(source.clone(), branch.clone());
        let (machine, cut) = (source.machine().unwrap(), branch.cut(&source).unwrap());
        let results = run(&plan, &Control::default()).unwrap();
        let PlanResults::Machine(Results::Branch(found)) = results else { panic!() };
        let quantity = BranchQuantity::of(&machine, &source, &cut, &found).unwrap();
        assert_eq!(quantity.path, "q.mass.displacement_max");
        let (holds, slides) = (source.number("fs").unwrap(), source.number("f").unwrap());
        for point in &found.followed[0].points {
            let exact = slides + (holds - slides).hypot(point.value);
            assert!((quantity.at(point) - exact).abs() < 1e-12, "{} {} {exact}", point.value, quantity.at(point));
        }
        let hammer = MachineSource::open("two-mass-hammer").unwrap();
        assert!(BranchQuantity::of(&hammer.machine().unwrap(), &hammer, &cut, &found).is_none());
    }
}
