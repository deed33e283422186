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
