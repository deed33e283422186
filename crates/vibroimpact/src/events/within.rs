//! A start that lies beyond rigid stops, put onto them.

use super::event::Start;
use crate::machine::{Machine, StopLaw};
use crate::math::{dot, sin_cos};

/// The largest number of rounds over all stops. Independent stops need one; of stops that move each other, each round leaves a part
/// of the gap.
const ROUNDS: u32 = 256;

impl Start {
    /// The same start if it lies beyond no rigid stop; else with coordinates that lie on the stops that it was beyond. Each
    /// stop $`w`$ moves the coordinates along $`M^{-1}w`$, as its impulse would, until its gap is 0. If stops contradict
    /// each other, the result lies beyond one of them and is no valid start.
    ///
    /// The state may be that of another machine: what stops and joints do follows from coordinates and velocities. Surfaces that
    /// stand back are kept.
    ///
    /// ```
    /// use vibroimpact::events::Start;
    /// use vibroimpact::machine::{Machine, MachineParts};
    /// let parts = MachineParts::new(["a", "b"]).with_mass(0, 1.0).with_mass(1, 3.0);
    /// // a may not pass b: the heavy body moves a third of the way of the light one
    /// let machine = Machine::new(parts.with_rigid_stop("contact", &[1.0, -1.0], 1.0, 0.5))?;
    /// let start = Start { q: vec![5.0, 0.0], ..Start::default() };
    /// assert_eq!(start.within_stops(&machine).q, [2.0, 1.0]);
    /// # Ok::<(), vibroimpact::machine::MachineError>(())
    /// ```
    #[must_use]
    pub fn within_stops(&self, machine: &Machine) -> Self {
        let mut start = self.clone();
        start.q.resize(machine.n(), 0.0);
        start.contacts.retain(|contact| contact.surface > 0.0);
        start.exact.clear();
        // the mass is positive definite, as `Machine::new` has checked
        let Some(mass) = machine.parts().mass.cholesky() else { return start };
        for _ in 0..ROUNDS {
            let mut moved = false;
            for stop in machine.stops().iter().filter(|stop| matches!(stop.law, StopLaw::Rigid { .. })) {
                let motion = stop.motion.iter().map(|harmonic| {
                    let (sine, cosine) = sin_cos(f64::from(harmonic.order) * start.phase);
                    harmonic.cos * cosine + harmonic.sin * sine
                });
                let gap = stop.gap - motion.sum::<f64>() - dot(&stop.direction, &start.q);
                if gap < 0.0 {
                    // M^-1 w, by the factor of the mass
                    let along = mass.solve_lower_transposed(&mass.solve_lower(&stop.direction));
                    let share = gap / dot(&stop.direction, &along);
                    start.q.iter_mut().zip(along).for_each(|(q, along)| *q += share * along);
                    moved = true;
                }
            }
            if !moved {
                break;
            }
        }
        start
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::{Limits, Motion};
    use crate::machine::MachineParts;

    /// A start beyond several stops becomes a valid one, and one that is valid stays the same bits.
    #[test]
    fn starts_beyond_stops_become_valid() {
        let parts = MachineParts::new(["a", "b"]).with_mass(0, 0.3).with_mass(1, 1.7).with_frequency(1.1);
        let parts =
            parts.with_rigid_stop("between", &[1.0, -1.0], 0.1, 0.5).with_rigid_stop("wall", &[0.0, 1.0], 0.7, 0.2);
        let machine = Machine::new(parts).unwrap();
        for k in 0..200 {
            let x = f64::from(k);
            let q = vec![3.0 * (0.7 * x).sin(), 2.0 * (1.3 * x).cos()];
            let start = Start { q, qdot: vec![0.1, -0.2], phase: 0.4, ..Start::default() };
            let within = start.within_stops(&machine);
            let valid = |start: &Start| Motion::new(&machine, start, Limits::default()).is_ok();
            assert!(valid(&within), "{start:?} {within:?}");
            if start.q[0] - start.q[1] < 0.1 && start.q[1] < 0.7 {
                assert_eq!(within, start);
            }
        }
    }
}
