//! The response of a machine over one of its numbers: a quantity of the motions that sweeps up and down find, and of the branches on
//! which their cycles lie.

use super::branch::OrbitLine;
use super::grid::check_fields;
use super::verdicts::settle;
use crate::machine::{MachineSource, VariedMachine};
use crate::map::check_impacts;
use crate::response::{MOST_BRANCHES, MOST_POINTS, check_values};
use crate::{Control, Cut, PlanError, ResponseCurves, ResponsePlan, ResponseRow, RunError};
use vibroimpact::continuation::{
    Direction,
    machine::{BranchEvent, SolutionPoint},
};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::math::sort_by;
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::quantities::machine::Quantities;
use vibroimpact::quantities::{machine_cycle_quantities, machine_quantities, machine_quantity_paths};
use vibroimpact::verdict::Verdict;

/// The path of the quantity of a response: the displacement amplitude of the first coordinate if none is given.
#[must_use]
pub fn quantity_path(given: Option<&str>, machine: &Machine) -> String {
    let first = || machine.parts().coordinates.first().map_or("", String::as_str);
    given.map_or_else(|| format!("q.{}.displacement_amplitude", first()), str::to_owned)
}

impl ResponsePlan<String, String> {
    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, source: &MachineSource, machine: &Machine) -> Result<(), PlanError> {
        check_values(&self.over, "the number")?;
        check_impacts(self.impacts)?;
        check_fields(machine, &[quantity_path(self.quantity.as_deref(), machine)])?;
        let (from, to) = self.over.extent();
        [from, to]
            .into_iter()
            .try_for_each(|value| Ok(source.with_all([(self.vary.as_str(), value)])?.machine().map(drop)?))
    }
}

/// The machines over the values, and all quantities of their motions.
struct Ground<'a> {
    varied: VariedMachine,
    plan: &'a ResponsePlan<String, String>,
    names: &'a [String],
}

impl Ground<'_> {
    fn machine(&self, value: f64) -> Option<Machine> {
        self.varied.at(&[value])
    }

    fn all(&self, found: Option<Quantities>) -> Vec<f64> {
        found.map_or_else(|| vec![f64::NAN; self.names.len()], |found| found.iter().map(|(.., of)| of.value).collect())
    }

    /// The motions of one sweep with their cycles; `before` motions were done before. Each begins with the state of the motion at
    /// the value before.
    fn sweep(
        &self,
        start: &Start,
        rising: bool,
        before: usize,
        control: &Control<'_>,
    ) -> Result<Vec<(ResponseRow, Option<Cycle>)>, RunError> {
        let mut values: Vec<f64> = self.plan.over.all();
        sort_by(&mut values, f64::total_cmp);
        if !rising {
            values.reverse();
        }
        let mut motions = Vec::with_capacity(values.len());
        let mut state = start.clone();
        for value in values {
            let Some(machine) = self.machine(value) else { continue };
            state = state.within_stops(&machine);
            let verdict = settle(&machine, &state, self.plan.impacts, control)?.verdict;
            state = verdict.reached(&machine).unwrap_or(state);
            let row = ResponseRow {
                value,
                label: verdict.label().into_owned(),
                admissible: true,
                stability: verdict.stability(&machine),
                event: None,
                quantities: self.all(machine_quantities(&machine, &verdict)),
            };
            motions.push((row, if let Verdict::Periodic(cycle) = verdict { Some(cycle) } else { None }));
            (control.progress)((before + motions.len()) as u64);
        }
        Ok(motions)
    }

    fn row(&self, point: &SolutionPoint) -> ResponseRow {
        let cycle = &point.cycle;
        let found = self.machine(point.value).and_then(|machine| machine_cycle_quantities(&machine, cycle));
        ResponseRow {
            value: point.value,
            label: cycle.label.to_string(),
            // a branch of a machine ends where its orbit ceases to be admissible
            admissible: true,
            stability: Some(cycle.stability()),
            event: point.event.map(|event| event.name()),
            quantities: self.all(found),
        }
    }
}

/// Computes both sweeps and the branches.
pub(super) fn response(
    source: &MachineSource,
    (machine, start): (&Machine, &Start),
    plan: &ResponsePlan<String, String>,
    control: &Control<'_>,
) -> Result<ResponseCurves, RunError> {
    let names = machine_quantity_paths(machine);
    let (from, to) = plan.over.extent();
    let samples = [from, 0.5 * (from + to), to].map(|value| vec![value]);
    let varied = VariedMachine::new(source, [plan.vary.as_str()].into_iter(), &samples);
    let ground = Ground { varied, plan, names: &names };
    let up = ground.sweep(start, true, 0, control)?;
    let down = ground.sweep(start, false, up.len(), control)?;
    let line = OrbitLine::new(source, &Cut { vary: plan.vary.clone(), ends: (from, to), also: None }, MOST_POINTS);
    let mut branches: Vec<Vec<SolutionPoint>> = Vec::new();
    for (row, cycle) in up.iter().chain(&down) {
        let Some(cycle) = cycle.as_ref().filter(|_| branches.len() < MOST_BRANCHES) else { continue };
        if !branches.iter().any(|points| passes(points, row.value, cycle)) {
            let points = both_ways(&line, (row.value, cycle), control)?;
            // a motion without events has no equations to be followed by
            branches.extend((!points.is_empty()).then_some(points));
        }
    }
    let shown = quantity_path(plan.quantity.as_deref(), machine).replace('-', "_");
    Ok(ResponseCurves {
        shown: names.iter().position(|name| *name == shown).unwrap_or(0),
        up: up.into_iter().map(|(row, _)| row).collect(),
        down: down.into_iter().map(|(row, _)| row).collect(),
        branches: branches.iter().map(|points| points.iter().map(|point| ground.row(point)).collect()).collect(),
        quantities: names,
    })
}

/// The points of the branch through a cycle, from its end downwards to its end upwards.
fn both_ways(line: &OrbitLine, at: (f64, &Cycle), control: &Control<'_>) -> Result<Vec<SolutionPoint>, RunError> {
    let way = |direction| match line.trace(at, direction, control) {
        // a cycle that cannot be followed, as one without events, is no branch
        Err(RunError::Plan(_)) => Ok(Vec::new()),
        other => other,
    };
    let mut points = way(Direction::Down)?;
    if points.last().is_some_and(|point| point.event == Some(BranchEvent::Closed)) {
        return Ok(points);
    }
    points.reverse();
    // both begin with the cycle itself
    points.extend(way(Direction::Up)?.into_iter().skip(usize::from(!points.is_empty())));
    Ok(points)
}

/// Whether a branch passes through a cycle at a value: between two of its points with this label, which differ from the cycle by no
/// more than from each other.
fn passes(points: &[SolutionPoint], value: f64, cycle: &Cycle) -> bool {
    points.windows(2).any(|pair| {
        let [a, b] = [&pair[0], &pair[1]];
        let between = (a.value.min(b.value)..=a.value.max(b.value)).contains(&value);
        let speeds = [a.cycle.fastest(), b.cycle.fastest()];
        let apart = (speeds[0] - speeds[1]).abs() + CLOSE * cycle.fastest();
        between
            && [a, b].iter().any(|point| point.cycle.label == cycle.label && point.cycle.counts == cycle.counts)
            && speeds.iter().all(|speed| (speed - cycle.fastest()).abs() <= apart)
    })
}

/// Two speeds that differ by less than this part of them are equal.
const CLOSE: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plan, Results, Span, Task, machine, run};

    fn response(name: &str, plan: ResponsePlan<String, String>) -> ResponseCurves {
        let plan = Plan::new(MachineSource::open(name).unwrap(), Task::from(plan));
        let plan = Plan::from_text(&plan.to_toml()).unwrap();
        let Results::Machine(machine::Results::Response(found)) = run(&plan, &Control::default()).unwrap() else {
            panic!()
        };
        found
    }

    /// Motions of both sweeps lie on the branches through them.
    #[test]
    fn sweeps_lie_on_branches() {
        let over = "0.9:1.2:7".parse::<Span>().unwrap().into();
        let quantity = Some("stop.anvil.impact-speed-max".to_owned());
        let plan = ResponsePlan { vary: "frequency".to_owned(), over, quantity, impacts: None };
        let found = response("two-mass-hammer", plan);
        assert_eq!((found.up.len(), found.down.len()), (7, 7));
        assert_eq!(found.quantities[found.shown], "stop.anvil.impact_speed_max");
        let (mut compared, shown) = (0, found.shown);
        for motion in found.up.iter().chain(&found.down).filter(|motion| motion.label.contains('/')) {
            let near = found.branches.iter().flat_map(|branch| branch.windows(2)).any(|pair| {
                let ((a, x), (b, y)) = ((pair[0].value, &pair[0].quantities), (pair[1].value, &pair[1].quantities));
                let apart = (x[shown] - y[shown]).abs() + 1e-6;
                (a.min(b)..=a.max(b)).contains(&motion.value) && (motion.quantities[shown] - x[shown]).abs() <= apart
            });
            assert!(near, "{} at {}", motion.label, motion.value);
            compared += 1;
        }
        assert!(compared >= 10 && found.branches.iter().flatten().any(|row| row.event == Some("fold")));
    }
}
