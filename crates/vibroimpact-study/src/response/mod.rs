//! The response over a parameter: a quantity of the motions that sweeps up and down find, and of all branches, stable or
//! not, on which their cycles lie.

mod branches;
mod plan;
mod row;
mod sweep;

pub(crate) use branches::{MOST_BRANCHES, MOST_POINTS};
pub use plan::ResponsePlan;
pub(crate) use plan::check_values;
pub use row::{ResponseCurves, ResponseRow};

use crate::{Control, Quantity, RunError, Stopped, SystemPlan};
use sweep::SweptMotion;

/// Computes both sweeps and the branches.
///
/// # Errors
/// [`RunError`] for an invalid plan, or when stopped. The stop flag is read at every event of a motion and at every point
/// of a branch.
pub(crate) fn response(
    system: &SystemPlan,
    plan: &ResponsePlan,
    control: &Control<'_>,
) -> Result<ResponseCurves, RunError> {
    plan.check(system)?;
    let total = plan.motions();
    let stopped = |done: usize| Stopped { done: done as u64, total };
    let mut done = 0;
    let mut sweep = |rising: bool| {
        let motions = sweep::sweep(system, plan, rising, done, control)?;
        done += motions.len();
        (motions.len() as u64 == total / 2).then_some(motions).ok_or_else(|| RunError::from(stopped(done)))
    };
    let (up, down) = (sweep(true)?, sweep(false)?);
    let branches = branches::branches(system, plan, up.iter().chain(&down), control)?;
    if control.stopping() {
        return Err(stopped(done).into());
    }
    let rows = |motions: Vec<SweptMotion>| motions.into_iter().map(|motion| motion.row).collect();
    Ok(ResponseCurves {
        quantities: Quantity::ALL.map(|quantity| quantity.name().to_owned()).to_vec(),
        shown: Quantity::ALL.iter().position(|quantity| *quantity == plan.quantity()).unwrap_or(0),
        up: rows(up),
        down: rows(down),
        branches,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Parameter, Plan, Span, Task, Values};

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

    /// Listed values in any order are swept as they rise and fall, and the plan is the same when it is written and read.
    #[test]
    fn listed_values() {
        let system = SystemPlan { inverse_beta: Some(1.3), gap: 0.5, restitution: 0.5, ..SystemPlan::default() };
        let listed = ResponsePlan::new(Parameter::Gap, Values::Listed(vec![0.5, 1.5, 0.75, 1.0]));
        let found = response(&system, &listed, &Control::default()).unwrap();
        let values = |list: &[ResponseRow]| list.iter().map(|motion| motion.value).collect::<Vec<_>>();
        assert_eq!(values(&found.up), [0.5, 0.75, 1.0, 1.5]);
        assert_eq!(values(&found.down), [1.5, 1.0, 0.75, 0.5]);
        let even = ResponsePlan::new(Parameter::Gap, "0.5:1.5:5".parse::<Span>().unwrap());
        let ranged = response(&system, &even, &Control::default()).unwrap();
        assert_eq!(found.up[2].label, ranged.up[2].label);
        let plan = Plan::new(system, Task::from(listed));
        assert_eq!((Plan::from_text(&plan.to_toml()).unwrap(), plan.check()), (plan.clone(), Ok(())));
        let twice = ResponsePlan::new(Parameter::Gap, Values::Listed(vec![0.5, 0.5]));
        assert!(twice.check(&system).unwrap_err().to_string().contains("0.5"));
    }

    /// The parameter that varies need not be in the system, and the plan is the same when it is written and read.
    #[test]
    fn a_plan_survives_its_text() {
        let short = r#"{"version":1,"system":{"inverse_beta":1.3,"restitution":0.5},"task":{"response":{"vary":"gap","over":"0.5:1:3"}}}"#;
        let plan = Plan::from_text(short).unwrap();
        assert_eq!((plan.oscillator().unwrap().gap, plan.check()), (0.5, Ok(())));
        assert_eq!(Plan::from_text(&plan.to_toml()).unwrap(), plan);
        for (over, sentence) in [("1:1:1", "gap is to go from 1 to 1"), ("0:nan:3", "the plan does not read")] {
            let text = short.replace("0.5:1:3", over);
            let error = Plan::from_text(&text).and_then(|plan| plan.check()).unwrap_err().to_string();
            assert!(error.starts_with(sentence), "{error}");
        }
    }

    /// At S of the 1971 paper 1/1 and 2/1 coexist: the sweeps differ there, and both have a branch. Each motion of a
    /// sweep lies on a branch.
    #[test]
    fn sweeps_lie_on_branches() {
        let system = SystemPlan { inverse_beta: Some(1.3), gap: 0.5, restitution: 0.5, ..SystemPlan::default() };
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
}
