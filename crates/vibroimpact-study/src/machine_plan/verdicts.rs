//! What motions of a machine settle into, and their exponents.

use crate::map::{check_impacts, options};
use crate::{Control, PlanError, RunError, Stopped, limits, tiles};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::{Machine, MachineError};
use vibroimpact::verdict::{Census, MachineSettled, MachineVerdict, scattered_machine_starts, settle_machine_while};

/// Starts of a tile.
const TILE: u64 = 4;

pub(super) fn refused(error: MachineError) -> RunError {
    RunError::Plan(PlanError::Machine(error.into()))
}

/// Checks a number of starts and a budget of events.
pub(super) fn check_starts(starts: u64, impacts: Option<u32>) -> Result<(), PlanError> {
    limits::starts(starts, limits::MOST_STARTS)?;
    check_impacts(impacts)
}

/// The verdict on a motion.
pub(super) fn settle(
    machine: &Machine,
    start: &MachineStart,
    impacts: Option<u32>,
    control: &Control<'_>,
) -> Result<MachineSettled, RunError> {
    let settled = settle_machine_while(machine, start, &options(impacts), &|| !control.stopping()).map_err(refused)?;
    settled.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
}

/// What `told` makes of the machine and the verdict on each of many starts, in order. A start that is not allowed has none.
pub(super) fn each_verdict<T: Send>(
    total: u64,
    control: &Control<'_>,
    problem: impl Fn(u64) -> Option<(Machine, MachineStart)> + Sync,
    impacts: Option<u32>,
    told: impl Fn(&Machine, MachineVerdict) -> T + Sync,
) -> Result<Vec<Option<T>>, RunError> {
    let options = options(impacts);
    let parts = tiles(total, TILE, control, |range, tick| {
        let mut found = Vec::new();
        for k in range {
            let verdict = problem(k).and_then(|(machine, start)| {
                let settled = settle_machine_while(&machine, &start, &options, &|| !control.stopping());
                settled.ok().flatten().map(|settled| told(&machine, settled.verdict))
            });
            found.push(verdict);
            if tick() {
                break;
            }
        }
        found
    })?;
    Ok(parts.into_iter().flatten().collect())
}

/// The distinct motions from scattered starts, and how many lead to each.
pub(super) fn attractors(
    machine: &Machine,
    (starts, seed, impacts): (u64, u64, Option<u32>),
    control: &Control<'_>,
) -> Result<Census<MachineVerdict>, RunError> {
    let problem = |k| Some((machine.clone(), scattered_machine_starts(machine, seed, k)));
    let mut census = Census::default();
    for verdict in each_verdict(starts, control, problem, impacts, |_, verdict| verdict)?.iter().flatten() {
        census.add(verdict);
    }
    Ok(census)
}
