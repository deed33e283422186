//! The orbit diagram of a machine: its motion after the transient at each value of a number.

use super::after_transient::{closings, settled, strobes};
use super::{AfterTransient, DiagramStep, Shown, Sweep, SweepDirection, check_order, check_shown};
use crate::machine::MachineSource;
use crate::{DiagramPlan, PlanError};
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::machine_quantity;
use vibroimpact::verdict::scattered_machine_starts;

/// What is shown of a motion of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShownPath {
    /// The phase and speed of each closing of a stop.
    Speed,
    /// A coordinate at phase 0.
    Q(usize),
    /// A velocity at phase 0.
    Qdot(usize),
    /// A quantity of the settled motion.
    Quantity,
}

impl DiagramPlan<String, String> {
    /// What is shown.
    ///
    /// # Errors
    /// [`PlanError::MachineShow`] for a name that is none of these, [`PlanError::Unforced`] for a phase without a forcing.
    pub(crate) fn shown(&self, machine: &Machine) -> Result<ShownPath, PlanError> {
        let names = &machine.parts().coordinates;
        let of = |name: &str| names.iter().position(|known| known == name);
        let found = match self.show.split_once('.') {
            Some(("q", name)) => of(name).map(ShownPath::Q),
            Some(("qdot", name)) => of(name).map(ShownPath::Qdot),
            None if self.show.is_closings() => Some(ShownPath::Speed),
            _ => None,
        };
        let quantity = || machine_quantity(machine, &self.show).ok().map(|_| ShownPath::Quantity);
        let found = found.or_else(quantity);
        let show =
            found.ok_or_else(|| PlanError::MachineShow { given: self.show.clone(), coordinates: names.join(", ") })?;
        if matches!(show, ShownPath::Q(_) | ShownPath::Qdot(_)) && machine.period().is_none() {
            return Err(PlanError::Unforced);
        }
        Ok(show)
    }

    /// Checks everything that can be checked without running the plan.
    ///
    /// # Errors
    /// [`PlanError`] names the first invalid value.
    pub fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        check_order(&self.over)?;
        let cut = self.cut();
        cut.check(source)?;
        for end in [cut.ends.0, cut.ends.1] {
            self.shown(&cut.source(source, end)?.machine()?)?;
        }
        check_shown(&self.over, self.direction, (self.transient, self.keep))
    }
}

/// The motion at one value, and the state to carry to the next value. The first value starts from the start of the
/// machine file. A state beyond a rigid stop that has moved is put onto it.
pub(crate) fn step(
    source: &MachineSource,
    plan: &DiagramPlan<String, String>,
    (index, sweep): (u32, Sweep),
    before: Option<Start>,
) -> Result<(DiagramStep, Start), PlanError> {
    let machine = plan.cut().with(source, plan.values(index))?.machine()?;
    let start = match (plan.direction, sweep, before) {
        (SweepDirection::Scatter { seed, .. }, Sweep::Start(k), _) => {
            scattered_machine_starts(&machine, seed, k).within_stops(&machine)
        }
        (_, _, Some(left)) => left.within_stops(&machine),
        (_, _, None) => source.start()?.within_stops(&machine),
    };
    let length = (plan.transient, plan.keep);
    let AfterTransient { kind, points, last } = match plan.shown(&machine)? {
        ShownPath::Speed => closings(&machine, &start, length)?,
        ShownPath::Q(i) => strobes(&machine, &start, length, |sample| sample.q[i])?,
        ShownPath::Qdot(i) => strobes(&machine, &start, length, |sample| sample.qdot[i])?,
        ShownPath::Quantity => settled(&machine, &start, &plan.show)?,
    };
    Ok((DiagramStep { index, sweep, kind, points }, last))
}
