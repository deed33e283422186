//! The orbit diagram of a machine: its motion after the transient at each value of a number.

use super::after_transient::{Followed, closings, settled, strobes};
use crate::diagram::{MotionKind, Sweep, SweepDirection, check_order, check_shown, even};
use crate::machine::MachineSource;
use crate::{Cut, DiagramPlan, PlanError};
use vibroimpact::events::MachineStart;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::machine_quantity;
use vibroimpact::verdict::scattered_machine_starts;

pub use super::after_transient::MachineDiagramPoint;

/// What is shown of closings.
const SPEED: &str = "speed";

pub(super) fn speed() -> String {
    SPEED.to_owned()
}

/// What is shown of a motion of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MachineShow {
    /// The phase and speed of each closing of a stop.
    Speed,
    /// A coordinate at phase 0.
    Q(usize),
    /// A velocity at phase 0.
    Qdot(usize),
    /// A quantity of the settled motion.
    Quantity,
}

/// A motion at one value.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineDiagramStep {
    /// Number of the value among those of the plan, counted from 0.
    pub index: u32,
    /// The sweep or start of the motion.
    pub sweep: Sweep,
    /// The kind of the motion.
    pub kind: MotionKind,
    /// The points to show, in order of time.
    pub points: Vec<MachineDiagramPoint>,
}

/// The motions: for sweeps in the order of the sweep, one sweep after another; for scattered starts value by value.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineDiagram {
    /// The plan.
    pub plan: DiagramPlan<String, String>,
    /// The motions.
    pub steps: Vec<MachineDiagramStep>,
}

impl DiagramPlan<String, String> {
    /// Whether closings are shown, each with its phase and stop.
    #[must_use]
    pub fn shows_closings(&self) -> bool {
        self.show == SPEED
    }

    /// Whether a coordinate or velocity at phase 0 is shown. The path of a quantity of a coordinate has one more name.
    #[must_use]
    pub fn shows_states(&self) -> bool {
        self.show.split_once('.').is_some_and(|(head, name)| matches!(head, "q" | "qdot") && !name.contains('.'))
    }

    /// What is shown.
    ///
    /// # Errors
    /// [`PlanError::MachineShow`] for a name that is none of these, [`PlanError::Unforced`] for a phase without a forcing.
    pub fn shown(&self, machine: &Machine) -> Result<MachineShow, PlanError> {
        let names = &machine.parts().coordinates;
        let of = |name: &str| names.iter().position(|known| known == name);
        let found = match self.show.split_once('.') {
            Some(("q", name)) => of(name).map(MachineShow::Q),
            Some(("qdot", name)) => of(name).map(MachineShow::Qdot),
            None if self.shows_closings() => Some(MachineShow::Speed),
            _ => None,
        };
        let quantity = || machine_quantity(machine, &self.show).ok().map(|_| MachineShow::Quantity);
        let found = found.or_else(quantity);
        let show =
            found.ok_or_else(|| PlanError::MachineShow { given: self.show.clone(), coordinates: names.join(", ") })?;
        if matches!(show, MachineShow::Q(_) | MachineShow::Qdot(_)) && machine.period().is_none() {
            return Err(PlanError::Unforced);
        }
        Ok(show)
    }

    /// The line over which the machine varies.
    #[must_use]
    pub fn cut(&self) -> Cut<String> {
        Cut { vary: self.vary.clone(), ends: self.over.ends(), also: self.also.clone() }
    }

    /// The values of the numbers that vary at value number `k`. If the values are evenly spaced, those of the second number are
    /// too, rounded as a range of that number would be.
    pub fn values(&self, k: u32) -> impl Iterator<Item = f64> + use<> {
        let first = self.over.at(k as usize);
        let second = self.also.as_ref().and_then(|also| even(&self.over, (also.from, also.to), k));
        core::iter::once(first).chain(second.or_else(|| self.cut().values(first).nth(1)))
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
    before: Option<MachineStart>,
) -> Result<(MachineDiagramStep, MachineStart), PlanError> {
    let machine = plan.cut().with(source, plan.values(index))?.machine()?;
    let start = match (plan.direction, sweep, before) {
        (SweepDirection::Scatter { seed, .. }, Sweep::Start(k), _) => {
            scattered_machine_starts(&machine, seed, k).within_stops(&machine)
        }
        (_, _, Some(left)) => left.within_stops(&machine),
        (_, _, None) => MachineStart::from(source.start()?).within_stops(&machine),
    };
    let length = (plan.transient, plan.keep);
    let Followed { kind, points, last } = match plan.shown(&machine)? {
        MachineShow::Speed => closings(&machine, &start, length)?,
        MachineShow::Q(i) => strobes(&machine, &start, length, |sample| sample.q[i])?,
        MachineShow::Qdot(i) => strobes(&machine, &start, length, |sample| sample.qdot[i])?,
        MachineShow::Quantity => settled(&machine, &start, &plan.show)?,
    };
    Ok((MachineDiagramStep { index, sweep, kind, points }, last))
}
