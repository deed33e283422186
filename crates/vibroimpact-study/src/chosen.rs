//! The orbit at which a branch begins.

use crate::PlanError;
use vibroimpact::continuation::BranchError;
use vibroimpact::orbit::{Cycle, FindOptions, Orbit, find_while};
use vibroimpact::verdict::{Count, Stability};
use vibroimpact::{Label, Oscillator};

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

/// The label of the orbit of an oscillator at which a branch or a curve begins.
///
/// # Errors
/// [`PlanError`] if there is none, or for a text that is no label.
pub(crate) fn label(text: Option<&str>) -> Result<Label, PlanError> {
    Ok(text.ok_or(PlanError::NoLabel)?.parse()?)
}

/// The same; its orbits can be followed in two parameters, so the number of impacts is finite.
///
/// # Errors
/// As [`label`], and for `inf/n`.
pub(crate) fn followable(text: Option<&str>) -> Result<Label, PlanError> {
    let label = label(text)?;
    match label.impacts {
        Count::Finite(_) => Ok(label),
        Count::Infinite => Err(BranchError::Rests.into()),
    }
}

/// The orbit with number `number` among those with this label. Without a number: the stable orbit, or else the fastest
/// admissible one. Returns `None` when `go_on`, which is called at every seed of the search, returns false.
///
/// # Errors
/// [`PlanError`] if there is no such orbit.
pub(crate) fn choose(
    osc: &Oscillator,
    label: Label,
    number: Option<u32>,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<Chosen>, PlanError> {
    if label.impacts == Count::Finite(0) && osc.damping() == 0.0 {
        return Err(BranchError::Undamped.into());
    }
    let Some(orbits) = find_while(osc, label, FindOptions::default(), go_on) else { return Ok(None) };
    let count = orbits.len();
    let index = match number {
        Some(given) => {
            let index = usize::try_from(given).ok().and_then(|n| n.checked_sub(1)).filter(|index| *index < count);
            index.ok_or(PlanError::NoSuchOrbit { given, count, label })?
        }
        None => {
            let rank = |orbit: &Orbit| (orbit.physical, orbit.physical && orbit.cycle.stable());
            // of several with the same rank, the last one, which is the fastest
            let best = (0..count).max_by_key(|index| rank(&orbits[*index]));
            best.filter(|index| orbits[*index].physical).ok_or(PlanError::NoOrbit { label, others: count })?
        }
    };
    let orbit = orbits.into_iter().nth(index).ok_or(PlanError::NoOrbit { label, others: 0 })?;
    let stability = orbit.physical.then(|| orbit.cycle.stability());
    Ok(Some(Chosen { cycle: orbit.cycle, among: Some(OrbitNumber::new(index, count)), stability }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(osc: &Oscillator, label: Label, number: Option<u32>) -> Result<Chosen, PlanError> {
        choose(osc, label, number, &|| true).map(|chosen| chosen.expect("nobody stops it"))
    }

    #[test]
    fn the_stable_one_else_the_fastest_motion() {
        let osc = Oscillator::from_inverse_beta(1.11, 2.0, 0.5).unwrap();
        let one = chosen(&osc, Label::new(1, 1), None).unwrap();
        assert!(one.stability.is_some() && !one.cycle.stable());
        let half = chosen(&osc, Label::new(1, 2), None).unwrap();
        assert_eq!(half.stability, Some(Stability::Stable));
        let OrbitNumber { number, count } = half.among.unwrap();
        assert_eq!(chosen(&osc, Label::new(1, 2), Some(number)).as_ref(), Ok(&half));
        for given in [0, count + 1] {
            let error = chosen(&osc, Label::new(1, 2), Some(given)).unwrap_err();
            assert!(matches!(error, PlanError::NoSuchOrbit { given: g, .. } if g == given));
        }
        assert_eq!(choose(&osc, Label::new(2, 1), None, &|| false), Ok(None));
        let far = Oscillator::from_inverse_beta(0.7, 40.0, 0.5).unwrap();
        let error = chosen(&far, Label::new(1, 1), None).unwrap_err().to_string();
        assert!(error.starts_with("no admissible orbit 1/1 was found"), "{error}");
        // without damping the motion without impacts is one of a continuous family
        let error = chosen(&far, Label::new(0, 1), None).unwrap_err().to_string();
        assert!(error.starts_with("without damping the steady motion without impacts"), "{error}");
        assert!(followable(Some("inf/1")).is_err() && followable(Some("1/0")).is_err() && followable(None).is_err());
        assert!(followable(Some("2/1")).is_ok());
    }
}
