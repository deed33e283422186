//! What a search for the first event finds, and what it keeps from flight to flight.

use super::crossing::Sampling;
use super::dense_series::DenseSeries;
use super::expansion::Expansion;
use super::flight::{MachineFlight, Modes};
use super::guard_polynomial::GuardPolynomial;

/// What ends a flight.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Found {
    /// The guards (by place) that become zero a time after the beginning. If there are several, they are zero at the
    /// same time within rounding.
    Zero { s: f64, guards: Guards },
    /// No zero before this time.
    NoneBefore(f64),
}

/// The guards that are zero at the end of a flight: nearly always one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Guards {
    One([usize; 1]),
    Several(Vec<usize>),
}

impl core::ops::Deref for Guards {
    type Target = [usize];

    fn deref(&self) -> &[usize] {
        match self {
            Self::One(one) => one,
            Self::Several(all) => all,
        }
    }
}

/// A guard that touches zero within rounding and is positive again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch {
    pub(crate) s: f64,
    pub(crate) guard: usize,
}

/// Buffers of a search, kept from flight to flight.
#[derive(Clone, Debug, Default)]
pub(crate) struct Buffers {
    pub(crate) modes: Modes,
    pub(super) dense: DenseSeries,
    pub(super) polynomials: Vec<GuardPolynomial>,
    pub(super) sampling: Sampling,
    pub(super) expansion: Expansion,
    pub(super) known: Vec<usize>,
    pub(super) touched: Vec<bool>,
    pub(super) brackets: Vec<(usize, f64, f64)>,
    /// The square of the size of the coordinates of late: rounding errors of the state at the beginning are relative to it.
    pub(crate) square: f64,
    /// The longest flight of late.
    pub(crate) longest: f64,
    /// Whether touches follow each other at one time, because rounding errors decide how contacts begin: then what stays within
    /// the rounding errors of the motion is passed.
    pub(crate) stalled: bool,
    /// Whether `modes` are those of the last flight at its first zero.
    pub(super) fresh: bool,
}

impl Buffers {
    /// The modes of a flight at a time. Those at the first zero of the flight searched last are known.
    pub(crate) fn modes_at(&mut self, flight: &MachineFlight, s: f64) -> &Modes {
        if !(core::mem::take(&mut self.fresh) && self.modes.s == s) {
            flight.at(s, &mut self.modes);
        }
        &self.modes
    }

    /// The modes at this time, at which they are already, with bounds of their errors.
    pub(crate) fn modes_with_errors(&mut self, flight: &MachineFlight, s: f64) -> &Modes {
        if self.modes.error.len() != self.modes.moved.len() {
            flight.at(s, &mut self.modes);
        }
        &self.modes
    }
}
