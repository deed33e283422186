//! The response over a number: a quantity of the motions that sweeps up and down find, and of all branches, stable or
//! not, on which their cycles lie.

mod plan;

pub use plan::ResponsePlan;

use crate::dynamics::{CycleOf, Dynamics, PointOf, Setup, not_stopped};
use crate::orbit_line::{OrbitLine, Solution};
use crate::{Control, Cut, RunError};
use vibroimpact::math::sort_by;
use vibroimpact::verdict::Stability;

/// A motion of a sweep, or an orbit at a point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseRow {
    /// The value of the number that varies.
    pub value: f64,
    /// The label of the motion.
    pub label: String,
    /// Whether it is a motion; a solution of the equations of a branch may pass through a stop.
    pub admissible: bool,
    /// Whether neighbours approach it; `None` if that is not known.
    pub stability: Option<Stability>,
    /// The event of the branch at this point.
    pub event: Option<&'static str>,
    /// All quantities, in the order of their names; not-a-number where one is not defined.
    pub quantities: Vec<f64>,
}

impl ResponseRow {
    /// Whether it is a motion that attracts its neighbourhood.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.admissible && self.stability == Some(Stability::Stable)
    }
}

/// The response over a number. Values and quantities of an oscillator are nondimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseCurves {
    /// The names of the quantities, and which of them is reported.
    pub quantities: Vec<String>,
    /// See above.
    pub shown: usize,
    /// The motions of the sweep with rising values, in this order.
    pub up: Vec<ResponseRow>,
    /// The motions of the sweep with falling values, in this order.
    pub down: Vec<ResponseRow>,
    /// The branches on which cycles of the sweeps lie, from one end to the other.
    pub branches: Vec<Vec<ResponseRow>>,
}

/// Maximum number of branches, and of points in each direction along one.
const MOST_BRANCHES: usize = 40;
const MOST_POINTS: u32 = 3_000;

/// Computes both sweeps and the branches.
///
/// # Errors
/// [`RunError`] for a start that is not allowed, or when stopped. The stop flag is read at every event of a motion and at every point
/// of a branch.
pub(crate) fn response<D: Dynamics>(
    of: &Setup<'_, D>,
    plan: &ResponsePlan<D::Name, D::Quantity>,
    control: &Control<'_>,
) -> Result<ResponseCurves, RunError> {
    let cut = plan.cut();
    let line = of.written.line(&cut, cut.ends.0, MOST_POINTS)?;
    let over = Over { of, plan, cut, line, quantities: D::quantity_names(&of.system), control };
    let up = over.sweep(true, 0)?;
    let down = over.sweep(false, up.len())?;
    let branches = over.branches(up.iter().chain(&down))?;
    let shown = D::quantity(&of.system, plan.quantity.as_ref())?.replace('-', "_");
    let rows = |motions: Vec<SweptMotion<D>>| motions.into_iter().map(|(row, _)| row).collect();
    Ok(ResponseCurves {
        shown: over.quantities.iter().position(|name| *name == shown).unwrap_or(0),
        up: rows(up),
        down: rows(down),
        branches,
        quantities: over.quantities,
    })
}

/// The motion of a sweep at one value, and its cycle if it has one that can be followed.
type SweptMotion<D> = (ResponseRow, Option<CycleOf<D>>);

/// The systems over the values of a number.
struct Over<'a, 'c, D: Dynamics> {
    of: &'a Setup<'a, D>,
    plan: &'a ResponsePlan<D::Name, D::Quantity>,
    cut: Cut<D::Name>,
    line: OrbitLine<D::Along>,
    quantities: Vec<String>,
    control: &'a Control<'c>,
}

impl<D: Dynamics> Over<'_, '_, D> {
    fn system(&self, value: f64) -> Option<D::System> {
        self.of.written.system_on(&self.cut, &self.line, value)
    }

    /// All quantities; not-a-number where they are not defined.
    fn all(&self, found: Option<Vec<f64>>) -> Vec<f64> {
        found.unwrap_or_else(|| vec![f64::NAN; self.quantities.len()])
    }

    /// The motions of one sweep: at each value the motion is settled from the state that the motion at the value before has.
    /// `before` motions were done before.
    fn sweep(&self, rising: bool, before: usize) -> Result<Vec<SweptMotion<D>>, RunError> {
        let mut values: Vec<f64> = self.plan.over.all();
        sort_by(&mut values, f64::total_cmp);
        if !rising {
            values.reverse();
        }
        let mut motions = Vec::with_capacity(values.len());
        let mut last: Option<(f64, D::Start)> = None;
        for value in values {
            let Some(system) = self.system(value) else { continue };
            let start = D::carried(self.of, &self.cut, last, (value, &system))?;
            let motion = D::settle(&system, &start, self.plan.impacts, &|| !self.control.stopping())?.verdict;
            last = Some((value, D::reached(&system, &motion, start)));
            let row = ResponseRow {
                value,
                label: motion.label().into_owned(),
                admissible: true,
                stability: motion.stability(&system),
                event: None,
                quantities: self.all(D::quantities(&system, &motion)),
            };
            motions.push((row, D::cycle(&system, &motion)));
            (self.control.progress)((before + motions.len()) as u64);
        }
        Ok(motions)
    }

    /// The branch of each cycle of the sweeps that lies on none of the branches so far.
    fn branches<'m>(&self, motions: impl Iterator<Item = &'m SweptMotion<D>>) -> Result<Vec<Vec<ResponseRow>>, RunError>
    where
        CycleOf<D>: 'm,
    {
        let mut found: Vec<Vec<PointOf<D>>> = Vec::new();
        for (row, cycle) in motions {
            let Some(cycle) = cycle.as_ref().filter(|_| found.len() < MOST_BRANCHES) else { continue };
            let Some(system) = self.system(row.value) else { continue };
            if found.iter().any(|points| passes::<D>(points, &system, cycle, row.value)) {
                continue;
            }
            let line = self.of.written.line(&self.cut, row.value, MOST_POINTS)?;
            let points = line.both_ways((row.value, cycle), self.control)?;
            // a motion without equations by which it can be followed is no branch
            found.extend((!points.is_empty()).then_some(points));
        }
        let row = |point: &PointOf<D>| {
            not_stopped(self.control)?;
            let quantities = self.system(point.value()).and_then(|there| D::cycle_quantities(&there, point.cycle()));
            Ok(ResponseRow {
                value: point.value(),
                label: point.label().to_string(),
                admissible: point.admissible(),
                stability: Some(point.stability()),
                event: point.event_name(),
                quantities: self.all(quantities),
            })
        };
        found.iter().map(|points| points.iter().map(row).collect()).collect()
    }
}

/// Whether a branch passes through a cycle at a value.
fn passes<D: Dynamics>(points: &[PointOf<D>], system: &D::System, cycle: &CycleOf<D>, value: f64) -> bool {
    points.windows(2).any(|pair| {
        let [a, b] = [&pair[0], &pair[1]];
        let between = (a.value().min(b.value())..=a.value().max(b.value())).contains(&value);
        between && D::passes(system, cycle, [a, b])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::at_rest;
    use crate::machine::MachineSource;
    use crate::{Parameter, Plan, PlanResults, Results, Span, SystemPlan, Task, Values, run};

    fn response(system: &SystemPlan, plan: &ResponsePlan, control: &Control<'_>) -> Result<ResponseCurves, RunError> {
        let problem = at_rest(system);
        plan.check(&problem)?;
        super::response(&problem, plan, control)
    }

    /// A damped oscillator with a wide gap has the classical response of a linear oscillator.
    #[test]
    fn a_linear_oscillator() {
        let system =
            SystemPlan { beta: Some(0.5), gap: 20.0, restitution: 0.5, damping: 0.05, ..SystemPlan::default() };
        let plan = ResponsePlan::new(Parameter::Beta, "0.5:1.5:11".parse::<Span>().unwrap());
        let found = response(&system, &plan, &Control::default()).unwrap();
        let exact = |beta: f64| 1.0 / (1.0 - beta * beta).hypot(0.1 * beta);
        for motion in found.up.iter().chain(&found.down) {
            let value = motion.quantities[found.shown];
            assert!((value - exact(motion.value)).abs() < 1e-12 && motion.label == "0", "{motion:?}");
        }
        let [branch] = found.branches.as_slice() else { panic!("{} branches", found.branches.len()) };
        assert!(branch.len() > 5);
        for point in branch {
            assert!((point.quantities[found.shown] - exact(point.value)).abs() < 1e-12);
        }
    }

    /// Listed values in any order are swept as they rise and fall.
    #[test]
    fn listed_values() {
        let system = SystemPlan::from_inverse_beta(1.3, 0.5, 0.5);
        let listed = ResponsePlan::new(Parameter::Gap, Values::Listed(vec![0.5, 1.5, 0.75, 1.0]));
        let found = response(&system, &listed, &Control::default()).unwrap();
        let values = |list: &[ResponseRow]| list.iter().map(|motion| motion.value).collect::<Vec<_>>();
        assert_eq!(values(&found.up), [0.5, 0.75, 1.0, 1.5]);
        assert_eq!(values(&found.down), [1.5, 1.0, 0.75, 0.5]);
        let even = ResponsePlan::new(Parameter::Gap, "0.5:1.5:5".parse::<Span>().unwrap());
        let ranged = response(&system, &even, &Control::default()).unwrap();
        assert_eq!(found.up[2].label, ranged.up[2].label);
    }

    /// At S of the 1971 paper 1/1 and 2/1 coexist: the sweeps differ there, and both have a branch. Each motion of a
    /// sweep lies on a branch.
    #[test]
    fn sweeps_lie_on_branches() {
        let system = SystemPlan::from_inverse_beta(1.3, 0.5, 0.5);
        let plan = ResponsePlan::new(Parameter::Gap, "0.5:1.5:21".parse::<Span>().unwrap());
        let found = response(&system, &plan, &Control::default()).unwrap();
        let at = |list: &[ResponseRow]| list.iter().find(|m| (m.value - 0.75).abs() < 1e-12).unwrap().label.clone();
        assert_eq!((at(&found.up), at(&found.down)), ("2/1".to_owned(), "1/1".to_owned()));
        for motion in found.up.iter().chain(&found.down).filter(|motion| motion.label.contains('/')) {
            let value = motion.quantities[found.shown];
            // the branch passes the point within its steps
            let near = found.branches.iter().flat_map(|branch| branch.windows(2)).any(|pair| {
                let ((a, qa), (b, qb)) = (
                    (pair[0].value, pair[0].quantities[found.shown]),
                    (pair[1].value, pair[1].quantities[found.shown]),
                );
                (a.min(b) - 1e-9..=a.max(b) + 1e-9).contains(&motion.value)
                    && value > qa.min(qb) - 1e-3
                    && value < qa.max(qb) + 1e-3
            });
            assert!(near, "{} at {} lies on no branch", motion.label, motion.value);
        }
    }

    fn of_machine(name: &str, plan: ResponsePlan<String, String>) -> ResponseCurves {
        let plan = Plan::new(MachineSource::open(name).unwrap(), Task::from(plan));
        let plan = Plan::from_text(&plan.to_toml()).unwrap();
        let PlanResults::Machine(Results::Response(found)) = run(&plan, &Control::default()).unwrap() else { panic!() };
        found
    }

    /// Motions of both sweeps lie on the branches through them.
    #[test]
    fn sweeps_of_a_machine_lie_on_branches() {
        let over = "0.9:1.2:7".parse::<Span>().unwrap().into();
        let quantity = Some("stop.anvil.impact-speed-max".to_owned());
        let plan = ResponsePlan { vary: "frequency".to_owned(), over, quantity, impacts: None };
        let found = of_machine("two-mass-hammer", plan);
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
