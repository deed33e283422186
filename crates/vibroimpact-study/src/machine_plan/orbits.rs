//! Orbits of a machine with a label, and their branches.

use super::verdicts::settle;
use crate::machine::MachineSource;
use crate::{Control, PlanError, RunError, Stopped, limits};
use std::collections::VecDeque;
use vibroimpact::Label;
use vibroimpact::continuation::{
    BranchOptions, Direction, MachineBranch, MachineBranchEvent, MachineFamily, MachinePoint,
};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::{MachineCycle, find_machine_while};
use vibroimpact::verdict::{MachineVerdict, scattered_machine_starts};

/// Starts of the search for orbits.
const STARTS: u64 = 48;

/// A branch of a machine: its points, and which number varies.
#[derive(Clone, Debug)]
pub struct MachineBranched {
    /// The points in order.
    pub points: Vec<MachinePoint>,
    /// The branches of twice the period that begin at flips.
    pub followed: Vec<MachineFollowed>,
}

/// A branch of twice the period that begins at a flip.
#[derive(Clone, Debug)]
pub struct MachineFollowed {
    /// The value of the number at the flip.
    pub flip: f64,
    /// The points in order, away from the flip.
    pub points: Vec<MachinePoint>,
}

/// The label of a task; a machine without forcing has none.
pub(super) fn label(machine: &Machine, text: &str) -> Result<Label, PlanError> {
    if machine.period().is_none() {
        return Err(PlanError::NoPeriodUnforced);
    }
    Ok(text.parse()?)
}

/// The orbits with a label, from scattered starts.
pub(super) fn orbits(machine: &Machine, label: Label, control: &Control<'_>) -> Result<Vec<MachineCycle>, RunError> {
    let starts = (0..STARTS).map(|k| scattered_machine_starts(machine, 1, k));
    let found = find_machine_while(machine, label, starts, || !control.stopping());
    found.ok_or_else(|| Stopped { done: 0, total: 1 }.into())
}

/// The orbit with a label, the stable one or else the fastest; without a label, the motion from the start.
pub(super) fn chosen(
    (machine, start): (&Machine, &MachineStart),
    label: Option<Label>,
    control: &Control<'_>,
) -> Result<MachineCycle, RunError> {
    match label {
        None => match settle(machine, start, None, control)?.verdict {
            MachineVerdict::Periodic(cycle) => Ok(cycle),
            other => Err(PlanError::NotPeriodic(other.label()).into()),
        },
        Some(label) => {
            let found = orbits(machine, label, control)?;
            let stable = found.iter().rev().find(|cycle| cycle.stable());
            Ok(stable.or(found.last()).cloned().ok_or(PlanError::NoMachineOrbit(label))?)
        }
    }
}

/// Checks the number that varies and its range.
pub(super) fn check(source: &MachineSource, vary: &str, to: f64, points: u32) -> Result<(), PlanError> {
    let from = source.number(vary).map_err(PlanError::from)?;
    if !to.is_finite() || to == from {
        return Err(PlanError::MachineRange { path: vary.to_owned(), from, to });
    }
    limits::branch_points(points)?;
    source.with(vary, to)?.parts()?;
    Ok(())
}

/// The branch of an orbit in one number, from its value in the machine to another one.
pub(super) fn branch(
    source: &MachineSource,
    (machine, start): (&Machine, &MachineStart),
    (label, vary, to): (Option<Label>, &str, f64),
    (points, follow): (u32, u32),
    control: &Control<'_>,
) -> Result<MachineBranched, RunError> {
    let from = source.number(vary).map_err(PlanError::from)?;
    let cycle = chosen((machine, start), label, control)?;
    let (source, path) = (source.clone(), vary.to_owned());
    let family = MachineFamily::new(move |value| source.with(&path, value).ok()?.machine().ok());
    let range = from.min(to)..=from.max(to);
    let direction = if to > from { Direction::Up } else { Direction::Down };
    let options = BranchOptions { points, ..BranchOptions::default() };
    let trace = |value: f64, cycle: &MachineCycle, direction: Direction| {
        let mut branch = MachineBranch::new((&family, value), cycle, &range, direction, options)
            .map_err(|error| PlanError::MachineBranch(error.to_string()))?;
        let mut found = Vec::new();
        while !control.stopping() {
            let Some(point) = branch.next() else { return Ok(found) };
            found.push(point);
        }
        Err(RunError::from(Stopped { done: found.len() as u64, total: u64::from(points) }))
    };
    let main = trace(from, &cycle, direction)?;
    // flips of branches that begin at flips are followed in turn
    let mut waiting: VecDeque<MachinePoint> = flips(&main);
    let mut followed = Vec::new();
    while let (Some(flip), true) = (waiting.pop_front(), followed.len() < follow as usize) {
        let scale = 0.25 * (range.end() - range.start());
        let Some((value, doubled)) = flip.doubled(&family, scale).filter(|(value, _)| range.contains(value)) else {
            continue;
        };
        let away = if value > flip.value { Direction::Up } else { Direction::Down };
        let Ok(points) = trace(value, &doubled, away) else { continue };
        waiting.extend(flips(&points));
        followed.push(MachineFollowed { flip: flip.value, points });
    }
    if control.stopping() {
        return Err(Stopped { done: main.len() as u64, total: u64::from(points) }.into());
    }
    Ok(MachineBranched { points: main, followed })
}

/// The flips among some points.
fn flips(points: &[MachinePoint]) -> VecDeque<MachinePoint> {
    points.iter().filter(|point| point.event == Some(MachineBranchEvent::Flip)).cloned().collect()
}
