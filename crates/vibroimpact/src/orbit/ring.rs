//! The impacts of a cycle as a list of unknowns.

use super::cycle::Cycle;
use super::label::Count;
use crate::system::{Oscillator, Side, phase};
use core::f64::consts::TAU;

/// The impacts of a cycle, with phases that increase along the cycle beyond 2 pi. The speeds of an inadmissible
/// solution may be zero or negative.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ring {
    /// The stop of each impact.
    pub(crate) sides: Vec<Side>,
    /// Phase and arrival speed of each impact, alternating: $`\theta_1, U_1, \theta_2, U_2, \dots`$
    pub(crate) unknowns: Vec<f64>,
    /// The number of forcing periods.
    pub(crate) periods: u32,
}

impl Ring {
    /// The impacts of `cycle`; `None` if it sticks, because a finite list of impacts does not determine such a cycle.
    pub(crate) fn of(osc: &Oscillator, cycle: &Cycle) -> Option<Self> {
        if !cycle.rests.is_empty() {
            return None;
        }
        let Some(first) = cycle.points.first() else {
            return (cycle.label.impacts == Count::Finite(0)).then(Self::free);
        };
        let (mut sides, mut unknowns) = (Vec::new(), Vec::new());
        let mut theta = first.state.phase;
        for point in &cycle.points {
            // the phase of the impact plus the multiple of 2 pi that is nearest to the time since the first impact
            let turns = ((theta - point.state.phase) / TAU).round();
            unknowns.extend([point.state.phase + turns * TAU, point.state.velocity]);
            sides.push(point.state.side);
            theta += osc.beta() * point.interval;
        }
        Some(Self { sides, unknowns, periods: cycle.label.periods })
    }

    /// The ring of the steady motion without impacts.
    pub(crate) const fn free() -> Self {
        Self { sides: Vec::new(), unknowns: Vec::new(), periods: 1 }
    }

    /// The number of impacts.
    pub(crate) fn len(&self) -> usize {
        self.sides.len()
    }

    /// The phase of impact `k`, not reduced to one forcing period; `k` may lie in the next period.
    pub(crate) fn theta(&self, k: usize) -> f64 {
        let m = self.len();
        if k < m { self.unknowns[2 * k] } else { self.unknowns[2 * (k - m)] + TAU * f64::from(self.periods) }
    }

    /// The arrival speed of impact `k`.
    pub(crate) fn speed(&self, k: usize) -> f64 {
        self.unknowns[2 * (k % self.len()) + 1]
    }

    /// The stop of impact `k`.
    pub(crate) fn side(&self, k: usize) -> Side {
        self.sides[k % self.len()]
    }

    /// The difference of phase from impact `k` to the next one.
    pub(crate) fn turn(&self, k: usize) -> f64 {
        self.theta(k + 1) - self.theta(k)
    }

    /// Whether every speed and every time of flight is positive.
    pub(crate) fn sensible(&self) -> bool {
        (0..self.len()).all(|k| self.speed(k) > 0.0 && self.turn(k) > 0.0)
    }

    /// Shifts all phases by a multiple of 2 pi, so that the first one lies in $`[0, 2\pi)`$.
    pub(crate) fn wrap(&mut self) {
        let Some(&first) = self.unknowns.first() else { return };
        let shift = phase::wrap(first) - first;
        if shift != 0.0 {
            // a whole number of turns, because the shift itself is rounded
            let turns = (shift / TAU).round();
            self.unknowns.iter_mut().step_by(2).for_each(|theta| *theta += turns * TAU);
        }
    }

    /// The impacts repeated `times` times.
    pub(crate) fn repeated(&self, times: u32) -> Self {
        let mut ring = Self { sides: Vec::new(), unknowns: Vec::new(), periods: self.periods * times };
        for turn in 0..times {
            let shift = TAU * f64::from(self.periods * turn);
            for k in 0..self.len() {
                ring.sides.push(self.side(k));
                ring.unknowns.extend([self.theta(k) + shift, self.speed(k)]);
            }
        }
        ring
    }

    /// The largest difference in phase or speed between each impact and the one `step` impacts later; zero if the ring
    /// repeats itself. `None` if the numbers of impacts and periods are not divisible accordingly, or the stops differ.
    pub(crate) fn unlike_after(&self, step: usize) -> Option<f64> {
        let m = self.len();
        if step == 0 || !m.is_multiple_of(step) || !(self.periods as usize).is_multiple_of(m / step) {
            return None;
        }
        // the shorter cycle takes this angle
        let period = TAU * f64::from(self.periods) / (m / step) as f64;
        let mut unlike = 0.0_f64;
        for k in 0..m {
            if self.side(k) != self.side(k + step) {
                return None;
            }
            let ahead = self.theta(k + step) - self.theta(k) - period;
            unlike = unlike.max(ahead.abs()).max((self.speed(k + step) - self.speed(k)).abs());
        }
        Some(unlike)
    }

    /// The ring over its smallest period; impacts that differ by less than `tolerance` are equal.
    pub(crate) fn smallest(self, tolerance: f64) -> Self {
        let m = self.len();
        let shorter = (1..m).find(|&step| self.unlike_after(step).is_some_and(|unlike| unlike <= tolerance));
        match shorter {
            #[allow(clippy::cast_possible_truncation)] // a divisor of the number of periods
            Some(step) => Self {
                sides: self.sides[..step].to_vec(),
                unknowns: self.unknowns[..2 * step].to_vec(),
                periods: (self.periods as usize * step / m) as u32,
            },
            None => self,
        }
    }

    /// The first half of a ring that repeats a shorter one twice.
    pub(crate) fn half(&self) -> Self {
        let m = self.len() / 2;
        Self { sides: self.sides[..m].to_vec(), unknowns: self.unknowns[..2 * m].to_vec(), periods: self.periods / 2 }
    }

    /// Inserts an impact of speed zero into the flight that leaves impact `k`.
    pub(crate) fn insert(&mut self, k: usize, theta: f64, side: Side) {
        self.sides.insert(k + 1, side);
        self.unknowns.splice(2 * k + 2..2 * k + 2, [theta, 0.0]);
    }

    /// Removes impact `k`.
    pub(crate) fn remove(&mut self, k: usize) {
        self.sides.remove(k);
        self.unknowns.drain(2 * k..2 * k + 2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring() -> Ring {
        Ring { sides: vec![Side::Upper, Side::Upper], unknowns: vec![1.0, 2.0, 3.0, 0.5], periods: 1 }
    }

    #[test]
    fn repeated_and_reduced() {
        let three = ring().repeated(3);
        assert_eq!((three.len(), three.periods), (6, 3));
        assert!((three.turn(5) - (TAU - 2.0)).abs() < 1e-14);
        assert_eq!(three.unlike_after(1), None);
        assert_eq!(three.smallest(1e-12), ring());
        assert_eq!(ring().smallest(1e-12), ring());
    }

    #[test]
    fn an_impact_comes_and_goes() {
        let mut with = ring();
        with.insert(0, 2.0, Side::Lower);
        assert_eq!((with.theta(1), with.speed(1), with.side(1), with.theta(2)), (2.0, 0.0, Side::Lower, 3.0));
        assert!(!with.sensible());
        with.remove(1);
        assert_eq!(with, ring());
        with.unknowns.iter_mut().step_by(2).for_each(|theta| *theta -= 4.0 * TAU);
        with.wrap();
        assert!((with.theta(1) - 3.0).abs() < 1e-14);
    }
}
