//! One question: an oscillator and a start, to the last bit.

use core::fmt;
use vibroimpact::flight::{Contact, Flight, SearchLimits, first_contact};
use vibroimpact::{Oscillator, Side, Start, lanes};

/// An oscillator and the state a flight of it begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Case {
    pub(crate) beta: f64,
    pub(crate) zeta: f64,
    pub(crate) gap: f64,
    /// Gap of the second stop.
    pub(crate) second: Option<f64>,
    pub(crate) x: f64,
    pub(crate) v: f64,
    pub(crate) phase: f64,
    /// The flight begins with a release from this stop, `v` = 0.
    pub(crate) release: Option<Side>,
}

impl Case {
    /// An undamped flight from the one stop.
    pub(crate) const fn from_stop(beta: f64, gap: f64, v: f64, phase: f64) -> Self {
        Self { beta, zeta: 0.0, gap, second: None, x: gap, v, phase, release: None }
    }

    pub(crate) fn oscillator(&self) -> Oscillator {
        let osc = Oscillator::new(self.beta, self.gap, 0.5).and_then(|osc| osc.with_damping(self.zeta));
        let osc = match self.second {
            Some(gap) => osc.and_then(|osc| osc.with_second_stop(gap, 0.5)),
            None => osc,
        };
        osc.unwrap_or_else(|error| panic!("{self}: {error}"))
    }

    /// The answer that a motion gets: by strides where they suffice.
    pub(crate) fn answer(&self, limits: SearchLimits) -> Contact {
        let osc = self.oscillator();
        lanes::first_contact(&osc, &self.flight(&osc), limits)
    }

    /// The answer of the careful search alone.
    pub(crate) fn careful_answer(&self, limits: SearchLimits) -> Contact {
        let osc = self.oscillator();
        first_contact(&osc, &self.flight(&osc), limits)
    }

    fn flight(&self, osc: &Oscillator) -> Flight {
        match self.release {
            Some(side) => Flight::release(osc, side, self.phase),
            None => {
                let start = Start::new(osc, self.x, self.v, self.phase).unwrap_or_else(|e| panic!("{self}: {e}"));
                assert_eq!(start.phase, self.phase, "phases are asked in [0, 2 pi)");
                Flight::new(osc, start)
            }
        }
    }

    /// The stop the flight begins on.
    pub(crate) fn begins_on(&self) -> Option<Side> {
        if self.x == self.gap {
            Some(Side::Upper)
        } else if self.second == Some(-self.x) {
            Some(Side::Lower)
        } else {
            None
        }
    }

    /// It begins on a stop and does not leave it: it moves into it, or rests under a force into it.
    pub(crate) fn stays(&self) -> bool {
        self.begins_on().is_some_and(|side| {
            let inwards = side.sign() * self.v;
            inwards > 0.0 || inwards == 0.0 && self.release.is_none() && side.sign() * (self.phase.sin() - self.x) > 0.0
        })
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bits = f64::to_bits;
        let Self { beta, zeta, gap, second, x, v, phase, release } = *self;
        write!(
            f,
            "beta {beta:?} ({:#x}) zeta {zeta:?} ({:#x}) gap {gap:?} ({:#x})",
            bits(beta),
            bits(zeta),
            bits(gap)
        )?;
        if let Some(second) = second {
            write!(f, " second {second:?} ({:#x})", bits(second))?;
        }
        write!(f, " x {x:?} ({:#x}) v {v:?} ({:#x}) phase {phase:?} ({:#x})", bits(x), bits(v), bits(phase))?;
        release.map_or(Ok(()), |side| write!(f, " released from {side:?}"))
    }
}
