//! The parts of the start of a machine by path.

use crate::PlanError;
use vibroimpact::events::Start;
use vibroimpact::machine::Machine;

/// Where an axis of a grid stands in a start.
pub(crate) enum StartAxis {
    Q(usize),
    Qdot(usize),
    Phase,
}

impl StartAxis {
    /// The place with this name.
    pub(crate) fn of(machine: &Machine, vary: &str) -> Result<Self, PlanError> {
        Self::found(machine, vary)?.ok_or_else(|| Self::unknown(machine, vary))
    }

    /// The place with this name; `None` for the path of something else.
    pub(crate) fn found(machine: &Machine, vary: &str) -> Result<Option<Self>, PlanError> {
        let names = &machine.parts().coordinates;
        let of = |name: &str| {
            let place = names.iter().position(|known| known == name);
            place.ok_or_else(|| Self::unknown(machine, vary))
        };
        Ok(match vary.split_once('.') {
            Some(("q", name)) => Some(Self::Q(of(name)?)),
            Some(("qdot", name)) => Some(Self::Qdot(of(name)?)),
            None if vary == "phase" => Some(Self::Phase),
            _ => None,
        })
    }

    fn unknown(machine: &Machine, vary: &str) -> PlanError {
        let hint =
            format!("q.NAME, qdot.NAME or phase; the coordinates are {}", machine.parts().coordinates.join(", "));
        PlanError::refused(format!("`{vary}` is no part of a start\nhint: {hint}"))
    }

    /// Puts a value there.
    pub(crate) fn set(&self, start: &mut Start, value: f64) {
        match self {
            Self::Q(i) => start.q[*i] = value,
            Self::Qdot(i) => start.qdot[*i] = value,
            Self::Phase => start.phase = value,
        }
    }
}
