//! The position of T on its line: between the limits of stability of 1/2, beyond the flip of 1/1.

use crate::claims::{Agreement, Section};
use crate::{Error, line};
use vibroimpact::continuation::{BranchEvent, Direction, SolutionPoint};
use vibroimpact::scenario;

/// The ranges of the gap, on the line through T, in which the two motions are stable.
pub(super) fn add(section: &mut Section) -> Result<(), Error> {
    let gap = scenario::T.gap;
    // at a gap where 1/1 is still stable
    let one = line::branch((1, 1), 1.0, Direction::Up)?;
    let doubles = one.iter().find(|p| p.event == Some(BranchEvent::Flip)).map(|p| p.value);
    let half = |direction| -> Result<Option<f64>, Error> {
        let branch = line::branch((1, 2), gap, direction)?;
        let ends = |p: &&SolutionPoint| matches!(p.event, Some(BranchEvent::Flip | BranchEvent::Grazing { .. }));
        Ok(branch.iter().find(ends).map(|p| p.value))
    };
    let (begins, ends) = (half(Direction::Down)?, half(Direction::Up)?);
    let told = |gap: Option<f64>| gap.map_or("nowhere".to_owned(), |gap| format!("at delta = {gap:.9}"));
    let inside = |low: Option<f64>, high: f64| low.is_some_and(|low| low < gap && gap < high);
    section.claim(
        "10",
        "T lies where 1/1 has become unstable and 1/2 has come to be",
        format!(
            "followed over delta at 1/beta = 1.11, 1/1 doubles its period {} and is unstable from there on; 1/2 begins {}, where \
             its flight touches the wall, and doubles {}",
            told(doubles),
            told(begins),
            told(ends)
        ),
        Agreement::of(
            inside(doubles, f64::INFINITY) && inside(begins, ends.unwrap_or(f64::NEG_INFINITY)),
            doubles.is_some() && begins.is_some(),
        ),
    );
    Ok(())
}
