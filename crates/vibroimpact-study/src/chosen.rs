//! The orbit at which a branch begins.

use vibroimpact::orbit::{Cycle, Stability};

/// The orbit at which a branch or a curve of any system begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen<C = Cycle> {
    /// The orbit.
    pub cycle: C,
    /// Which of those with its label it is; `None` for the motion from the start of a machine.
    pub among: Option<OrbitNumber>,
    /// Its stability; `None` for a solution that is not admissible.
    pub stability: Option<Stability>,
}

/// The number of an orbit among those with its label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OrbitNumber {
    /// Counted from 1 in order of rising speed.
    pub number: u32,
    /// How many there are.
    pub count: u32,
}

impl OrbitNumber {
    /// Of an orbit with this index.
    pub(crate) fn new(index: usize, count: usize) -> Self {
        let counted = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Self { number: counted(index + 1), count: counted(count) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Dynamics;
    use crate::{Control, PlanError, RunError, StartPlan, SystemPlan};
    use core::sync::atomic::AtomicBool;

    fn chosen(system: &SystemPlan, label: &str, number: Option<u32>) -> Result<Chosen, RunError> {
        system.setup(StartPlan::default())?.chosen((Some(label), number), &Control::default())
    }

    fn at(inverse_beta: f64, gap: f64) -> SystemPlan {
        SystemPlan::from_inverse_beta(inverse_beta, gap, 0.5)
    }

    #[test]
    fn the_stable_one_else_the_fastest_motion() {
        let system = at(1.11, 2.0);
        let one = chosen(&system, "1/1", None).unwrap();
        assert!(one.stability.is_some() && !one.cycle.stable());
        let half = chosen(&system, "1/2", None).unwrap();
        assert_eq!(half.stability, Some(Stability::Stable));
        let OrbitNumber { number, count } = half.among.unwrap();
        assert_eq!(chosen(&system, "1/2", Some(number)).unwrap(), half);
        for given in [0, count + 1] {
            let error = chosen(&system, "1/2", Some(given)).unwrap_err();
            assert!(matches!(error, RunError::Plan(PlanError::NoSuchOrbit { given: g, .. }) if g == given));
        }
        let stop = AtomicBool::new(true);
        let control = Control { stop: &stop, ..Control::default() };
        let stopped = system.setup(StartPlan::default()).unwrap().chosen((Some("2/1"), None), &control);
        assert!(matches!(stopped, Err(RunError::Stopped(_))), "{stopped:?}");
        let far = at(0.7, 40.0);
        let error = chosen(&far, "1/1", None).unwrap_err().to_string();
        assert!(error.starts_with("no admissible orbit 1/1 was found"), "{error}");
        // without damping the motion without impacts is one of a continuous family
        let error = chosen(&far, "0", None).unwrap_err().to_string();
        assert!(error.starts_with("without damping the steady motion without impacts"), "{error}");
        let osc = system.oscillator().unwrap();
        let followable = |text| SystemPlan::label(&osc, text, true);
        assert!(followable(Some("inf/1")).is_err() && followable(Some("1/0")).is_err() && followable(None).is_err());
        assert!(followable(Some("2/1")).is_ok());
    }
}
