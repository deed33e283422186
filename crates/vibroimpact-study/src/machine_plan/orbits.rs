//! Orbits of a machine with a label, and the orbit at which a branch begins.

use super::verdicts::settle;
use crate::{Chosen, Control, OrbitNumber, PlanError, RunError, Stopped};
use vibroimpact::Label;
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{find_machine_while, machine::Cycle};
use vibroimpact::verdict::{Verdict, scattered_machine_starts};

/// Starts of the search for orbits.
const STARTS: u64 = 48;

/// The label of an orbit of a machine: m/n with forcing, m/T without.
///
/// # Errors
/// [`PlanError`] for a text that is no such label.
pub fn label(machine: &Machine, text: &str) -> Result<Label, PlanError> {
    let given = || text.chars().take(40).collect();
    match (machine.period().is_some(), Label::unforced(text)) {
        (false, label) => label.ok_or_else(|| PlanError::LabelUnforced(given())),
        (true, Some(_)) => Err(PlanError::LabelForced(given())),
        (true, None) => Ok(text.parse()?),
    }
}

/// The orbits with a label, from scattered starts.
pub(super) fn orbits(machine: &Machine, label: Label, control: &Control<'_>) -> Result<Vec<Cycle>, RunError> {
    let starts = (0..STARTS).map(|k| scattered_machine_starts(machine, 1, k));
    let found = find_machine_while(machine, label, starts, &|| !control.stopping());
    found.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
}

/// Checks a label and the number of an orbit with that label.
pub(super) fn check(machine: &Machine, (text, orbit): (Option<&str>, Option<u32>)) -> Result<(), PlanError> {
    match text {
        Some(text) => label(machine, text).map(|_| ()),
        None if orbit.is_some() => Err(PlanError::NumberWithoutLabel),
        None => Ok(()),
    }
}

/// The orbit with a label and a number; without a number, the stable one or else the fastest; without a label, the motion from
/// the start.
pub(super) fn chosen(
    (machine, start): (&Machine, &Start),
    (text, number): (Option<&str>, Option<u32>),
    control: &Control<'_>,
) -> Result<Chosen<Cycle>, RunError> {
    let Some(text) = text else {
        return match settle(machine, start, None, control)?.verdict {
            Verdict::Periodic(cycle) => Ok(Chosen { stability: Some(cycle.stability()), cycle, among: None }),
            other => Err(PlanError::NotPeriodic(other.label().into_owned()).into()),
        };
    };
    let label = label(machine, text)?;
    let found = orbits(machine, label, control)?;
    let count = found.len();
    let index = match number {
        Some(given) => {
            let index = usize::try_from(given).ok().and_then(|n| n.checked_sub(1)).filter(|index| *index < count);
            index.ok_or(PlanError::NoSuchOrbit { given, count, label })?
        }
        None => found.iter().rposition(Cycle::stable).or(count.checked_sub(1)).unwrap_or(0),
    };
    let cycle = found.into_iter().nth(index).ok_or(PlanError::NoMachineOrbit(label))?;
    Ok(Chosen { stability: Some(cycle.stability()), cycle, among: Some(OrbitNumber::new(index, count)) })
}
