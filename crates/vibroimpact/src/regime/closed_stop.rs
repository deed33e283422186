//! A closed compliant stop: its force on the coordinates, and its gap as a function of the modes.

use super::basis::Basis;
use super::constraints::Constraints;
use super::contact_state::ContactState;
use super::normal::{Normal, compliant};
use super::signal::{Observable, Signal};
use crate::machine::Machine;
use crate::math::{Matrix, dot, sort_by};

/// A closed stop.
#[derive(Clone, Debug)]
pub(crate) struct ClosedStop {
    pub(crate) place: usize,
    /// Its stiffness, damping and preload.
    pub(crate) law: (f64, f64, f64),
    /// Its gap, and the rate of this.
    pub(crate) gap: Observable,
    pub(crate) rate: Observable,
}

/// The force of a closed stop on the coordinates, $`k(d - w\cdot x) + c(\dot d - w\cdot\dot x) - p`$ along its direction $`w`$,
/// with the place $`d`$ of its wall.
pub(super) struct Contact<'a> {
    pub(super) place: usize,
    pub(super) k: f64,
    pub(super) c: f64,
    pub(super) p: f64,
    /// The force at $`x = 0`$.
    pub(super) pushed: Signal,
    pub(super) direction: &'a [f64],
}

/// A closed stop has no share in a direction if it is this part of the product of both lengths.
const ACROSS: f64 = 1e-15;

impl<'a> Contact<'a> {
    /// The closed stops, the stiffest first: their directions become the first free ones, so that a large stiffness is added to
    /// few elements and hides no digits of the others.
    pub(super) fn closed(machine: &Machine, normal: &'a Normal, states: &[ContactState]) -> Vec<Self> {
        let contact = |place: usize| {
            let (k, c, p) = compliant(&machine.stops()[place].law)?;
            let wall = &normal.walls[place];
            // k d + c d' - p
            let mut pushed = normal.no_signal();
            pushed.add(k, wall);
            pushed.add(c, &wall.derivative(&normal.rates));
            pushed.constant -= p;
            Some(Self { place, k, c, p, pushed, direction: &normal.directions[place] })
        };
        let places = (0..normal.walls.len()).filter(|place| states[*place] == ContactState::Closed);
        let mut closed: Vec<Self> = places.filter_map(contact).collect();
        let weight = |contact: &Self| contact.k * dot(contact.direction, contact.direction);
        sort_by(&mut closed, |one, other| weight(other).total_cmp(&weight(one)));
        closed
    }

    /// The force without what the constraints carry along already.
    pub(super) fn push_on_free(&self, constraints: &Constraints) -> Signal {
        let mut pushed = self.pushed.clone();
        for (i, factor) in self.direction.iter().enumerate() {
            pushed.add(-self.k * factor, &constraints.carried[i]);
            pushed.add(-self.c * factor, &constraints.carried_rate[i]);
        }
        pushed
    }

    /// Adds the force along another direction, a column, as a function of the modes; `x` and `v` are coordinates and velocities.
    pub(super) fn push_along(&self, column: &[f64], (x, v): (&[Observable], &[Observable]), sum: &mut Observable) {
        let share = dot(self.direction, column);
        let lengths = dot(self.direction, self.direction).sqrt() * dot(column, column).sqrt();
        // a rounding error of the share would be a force for a stiff stop
        if share.abs() <= ACROSS * lengths {
            return;
        }
        sum.signal.add(share, &self.pushed);
        for (i, factor) in self.direction.iter().enumerate() {
            sum.add(-share * self.k * factor, &x[i]);
            sum.add(-share * self.c * factor, &v[i]);
        }
    }

    /// The stop as a function of the modes. `share` are the components of its direction in the free directions.
    pub(super) fn stop(
        &self,
        normal: &Normal,
        constraints: &Constraints,
        share: &[f64],
        (basis, slip): (&Basis, &[Signal]),
    ) -> ClosedStop {
        // the wall, without what the constraints carry along
        let prescribed = |wall: &Signal, carried: &[Signal]| {
            let mut signal = wall.clone();
            for (factor, carried) in self.direction.iter().zip(carried) {
                signal.add(-factor, carried);
            }
            signal
        };
        let wall = &normal.walls[self.place];
        let place = prescribed(wall, &constraints.carried);
        let rate = prescribed(&wall.derivative(&normal.rates), &constraints.carried_rate);
        ClosedStop {
            place: self.place,
            law: (self.k, self.c, self.p),
            gap: less_motion(place, share, &basis.e, slip),
            rate: less_motion(rate, share, &basis.v, slip),
        }
    }
}

/// A prescribed signal less the motion along a direction: the gap of a stop from the place of its wall, or its rate from that
/// of its wall. `share` are the components of the direction in the free directions, with exact zeros, so that the little by
/// which soft modes move a stiff stop keeps its digits. `from` are the free coordinates or velocities as functions of the modes,
/// $`E_1y + E_2z`$ with $`z = \dot y - `$ `slip`.
fn less_motion(prescribed: Signal, share: &[f64], from: &[Matrix; 2], slip: &[Signal]) -> Observable {
    let [position, velocity] = [0, 1].map(|i| from[i].apply_transposed(share).iter().map(|x| -x).collect::<Vec<f64>>());
    let mut signal = prescribed;
    for (factor, slip) in velocity.iter().zip(slip) {
        signal.add(-factor, slip);
    }
    Observable { position, velocity, signal }
}
