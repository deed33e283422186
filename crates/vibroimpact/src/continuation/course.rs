//! A branch by the equations of its impacts, step by step.
//!
//! Steps go by [pseudo-arclength](super) in the phases and speeds of all impacts and the parameter, so folds are passed
//! like any other point. On each step functions are watched that change sign at an event; where one does, the step is
//! searched for the zero, every point tried being a converged solution, so that the parameter of an event is right to
//! rounding. At a grazing impact the signature changes and the branch goes on with one impact more or less.

use super::arc::{Equations, correct, tangent};
use super::options::{BranchError, BranchOptions, Direction};
use super::point::{BranchEvent, SolutionPoint};
use super::test_functions::{Place, Watch};
use super::varied::Varied;
use crate::orbit::{Cycle, Orbit, Ring, ring_cycle, solve};
use crate::system::{Oscillator, ParameterPath, SystemError};
use core::f64::consts::TAU;
use core::ops::RangeInclusive;
use std::collections::VecDeque;

/// A point under way: unknowns, tangent, and the values of what is watched.
#[derive(Clone, Debug)]
pub(super) struct Here {
    pub(super) w: Vec<f64>,
    pub(super) tangent: Vec<f64>,
    pub(super) values: Vec<f64>,
    pub(super) orbit: Orbit,
}

#[derive(Clone, Debug)]
pub(super) struct Course {
    pub(super) range: (f64, f64),
    pub(super) options: BranchOptions,
    pub(super) equations: Varied,
    pub(super) watches: Vec<Watch>,
    /// The sign each watched function has had so far; `None` until one is known.
    pub(super) signs: Vec<Option<bool>>,
    pub(super) here: Here,
    pub(super) step: f64,
    /// Where the branch began: unknowns and tangent, while the signature is the same.
    pub(super) begin: Option<(Vec<f64>, Vec<f64>)>,
    /// Grazing events passed: the second time the branch has closed.
    pub(super) grazed: Vec<(f64, BranchEvent)>,
    pub(super) count: u32,
    pub(super) pending: VecDeque<SolutionPoint>,
    pub(super) over: bool,
}

impl Course {
    /// That of `cycle`, a cycle of `osc` without rests, in what varies over `range`, beginning in `direction`.
    pub(super) fn new(
        osc: &Oscillator,
        cycle: &Cycle,
        varying: ParameterPath,
        range: RangeInclusive<f64>,
        direction: Direction,
        options: BranchOptions,
    ) -> Result<Self, BranchError> {
        let value = place(osc, varying)?;
        let ring = Ring::of(osc, cycle).ok_or(BranchError::Rests)?;
        if ring.len() == 0 && osc.damping() == 0.0 {
            return Err(BranchError::Undamped);
        }
        let (ring, _) = solve(osc, ring).ok_or(BranchError::NoCycle)?;
        let equations = Self::equations(osc, varying, &range, value, &ring)?;
        let w = Varied::join(&ring, value);
        let mut row = equations.parameter_row();
        if direction == Direction::Down {
            row.iter_mut().for_each(|r| *r = -*r);
        }
        let along = tangent(&equations, &w, &row).ok_or(BranchError::NoCycle)?;
        Self::begin(equations, w, along, (*range.start(), *range.end()), options).ok_or(BranchError::NoCycle)
    }

    pub(super) fn equations(
        osc: &Oscillator,
        varying: ParameterPath,
        range: &RangeInclusive<f64>,
        value: f64,
        ring: &Ring,
    ) -> Result<Varied, BranchError> {
        Ok(Varied::new(osc, varying, ring, scale(range, value)?))
    }

    /// From a solution `w` along the tangent `along`.
    pub(super) fn begin(
        equations: Varied,
        w: Vec<f64>,
        along: Vec<f64>,
        range: (f64, f64),
        options: BranchOptions,
    ) -> Option<Self> {
        let (osc, ring) = equations.split(&w)?;
        let watches = Watch::all(&osc, &ring);
        let here = Self::look(&equations, &watches, w, along)?;
        let signs = here.values.iter().map(|&value| sign(value)).collect();
        let begin = Some((here.w.clone(), here.tangent.clone()));
        let step = options.first;
        let mut branch = Self {
            range,
            options,
            equations,
            watches,
            signs,
            here,
            step,
            begin,
            grazed: Vec::new(),
            count: 0,
            pending: VecDeque::new(),
            over: false,
        };
        branch.pending.push_back(branch.point(&branch.here, None));
        Some(branch)
    }

    /// Everything about the point `w`, a solution, whose tangent is given.
    pub(super) fn look(equations: &Varied, watches: &[Watch], w: Vec<f64>, tangent: Vec<f64>) -> Option<Here> {
        let (osc, ring, flights) = equations.flights(&w)?;
        let place = Place { osc: &osc, ring: &ring, flights: &flights };
        let values = watches.iter().map(|watch| watch.value(equations, &tangent, &place)).collect();
        let orbit = Orbit::judged(&osc, ring_cycle(&osc, &ring, &flights));
        Some(Here { w, tangent, values, orbit })
    }

    pub(super) fn point(&self, here: &Here, event: Option<BranchEvent>) -> SolutionPoint {
        let value = here.w.last().copied().unwrap_or(f64::NAN);
        SolutionPoint { value, cycle: here.orbit.cycle.clone(), physical: here.orbit.physical, event }
    }

    /// The solution a distance `h` along the tangent from here, looked for near `guess`.
    pub(super) fn solution(&self, guess: &[f64], h: f64) -> Option<(Vec<f64>, u32)> {
        let row = self.equations.row(&self.here.tangent);
        let level = self.equations.dot(&self.here.tangent, &self.here.w) + h;
        correct(&self.equations, guess, &row, level)
    }

    /// Its tangent, in the direction of the one here.
    pub(super) fn tangent_at(&self, w: &[f64]) -> Option<Vec<f64>> {
        tangent(&self.equations, w, &self.equations.row(&self.here.tangent))
    }

    /// The watched functions that change sign on the way to `there`.
    pub(super) fn crosses<'a>(&'a self, there: &'a Here) -> impl Iterator<Item = usize> + 'a {
        (0..self.watches.len()).filter(move |&j| match (self.signs[j], sign(there.values[j])) {
            (Some(before), Some(after)) => before != after,
            // exactly at zero: found on the next step
            _ => false,
        })
    }

    pub(super) fn value(&self, here: &Here) -> f64 {
        self.value_of(&here.w)
    }

    pub(super) fn value_of(&self, w: &[f64]) -> f64 {
        w.last().copied().unwrap_or(f64::NAN)
    }

    /// Adds an event; a motion it is the end of counts as one still.
    pub(super) fn emit(&mut self, at: &Here, event: BranchEvent) {
        let mut point = self.point(at, Some(event));
        point.physical |= self.here.orbit.physical || event == BranchEvent::BecomesPhysical;
        self.pending.push_back(point);
        self.count += 1;
    }

    /// Ends the branch where it is, or, if it gets no further because impacts are added without end, where that leads.
    pub(super) fn finish(&mut self, event: BranchEvent) {
        let stuck = matches!(event, BranchEvent::NoConvergence | BranchEvent::ImpactLimit);
        match self.accumulation().filter(|_| stuck) {
            Some(limit) => {
                self.pending.push_back(limit);
                self.count += 1;
            }
            None => {
                let here = self.here.clone();
                self.emit(&here, event);
            }
        }
        self.over = true;
    }

    /// Makes `there` the present point.
    pub(super) fn settle(&mut self, there: Here) {
        for (known, value) in self.signs.iter_mut().zip(&there.values) {
            if let Some(now) = sign(*value) {
                *known = Some(now);
            }
        }
        let closed = self.begin.as_ref().is_some_and(|(w, along)| {
            let ahead = |h: &Here| {
                let mut off: Vec<f64> = h.w.iter().zip(w).map(|(a, b)| a - b).collect();
                // phases may have gone round
                let turns = TAU * (off[0] / TAU).round();
                let phases = off.len() - 1;
                off[..phases].iter_mut().step_by(2).for_each(|theta| *theta -= turns);
                (self.equations.dot(&off, along), self.equations.length(&off))
            };
            let ((before, _), (after, away)) = (ahead(&self.here), ahead(&there));
            self.count > 3
                && before < 0.0
                && after >= 0.0
                && away < 2.0 * self.options.longest
                && self.equations.dot(along, &there.tangent) > 0.5
        });
        self.here = there;
        let point = self.point(&self.here, closed.then_some(BranchEvent::Closed));
        self.pending.push_back(point);
        self.count += 1;
        self.over = closed;
    }
}

impl Iterator for Course {
    type Item = SolutionPoint;

    fn next(&mut self) -> Option<SolutionPoint> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}

/// The place of an oscillator among what varies.
pub(super) fn place(osc: &Oscillator, varying: ParameterPath) -> Result<f64, BranchError> {
    varying.get(osc).map_err(|error| match error {
        SystemError::NoSecondStop(name) => BranchError::NoSuchParameter(name),
        _ => BranchError::NoCycle,
    })
}

/// A change of the parameter that counts as much as one of all phases by a radian: a quarter of the range, which has to be
/// one, and hold `value`.
pub(super) fn scale(range: &RangeInclusive<f64>, value: f64) -> Result<f64, BranchError> {
    let (low, high) = (*range.start(), *range.end());
    if !(low.is_finite() && high.is_finite() && low < high && range.contains(&value)) {
        return Err(BranchError::OutOfRange { value, low, high });
    }
    Ok(0.25 * (high - low))
}

/// The sign of a watched value, `None` within rounding of zero.
pub(super) fn sign(value: f64) -> Option<bool> {
    (value.abs() > ZERO).then_some(value > 0.0)
}

/// Below this a watched value has no sign.
const ZERO: f64 = 1e-11;
