//! The linear structure in one regime: its modes, what drives them, and its guards.

use super::change::ModalChange;
use super::closed_stop::{ClosedStop, Contact};
use super::constraints::{Constraints, Sharing};
use super::contact_state::ContactState;
use super::free_motion::{FreeMotion, applied};
use super::guards::Guard;
use super::mode::Mode;
use super::normal::{Normal, compliant};
use super::pass::Moved;
use super::rest_force::{RestBuffers, RestForce};
use super::sampled::Sampled;
use super::signal::{Observable, Signal};
use super::window::{Window, windows};
use crate::machine::Machine;
use crate::math::{Matrix, add_scaled, dot};
use std::sync::OnceLock;

/// The structure in one regime.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    pub(super) states: Vec<ContactState>,
    /// Number of joints.
    pub(super) joints: usize,
    pub(crate) modes: Vec<Mode>,
    /// Stiffness and damping of free directions that have no modes, because damping couples nearly defective ones. Then
    /// `modes` holds bounds, and the directions themselves stand in the place of modal displacements.
    pub(crate) dense: Option<(Matrix, Matrix)>,
    /// What drives each mode.
    pub(crate) drive: Vec<Signal>,
    /// $`z = \dot y - `$ this.
    pub(crate) slip: Vec<Signal>,
    /// Mass-normalised coordinates and velocities as functions of the modes.
    pub(crate) x: Vec<Observable>,
    pub(crate) v: Vec<Observable>,
    /// Modes from the mass-normalised state: $`y = A_1x + A_2\dot x + `$ a signal, and $`z`$ alike.
    pub(super) to_y: [Matrix; 2],
    pub(super) to_z: [Matrix; 2],
    /// The same maps from coordinates and velocities in the free directions, which are the product of this matrix with those
    /// of the machine.
    back: Matrix,
    from_free: [[Matrix; 2]; 2],
    pub(super) to_y_signal: Vec<Signal>,
    pub(super) to_z_signal: Vec<Signal>,
    pub(crate) guards: Vec<Guard>,
    /// The closed stops.
    pub(crate) closed: Vec<ClosedStop>,
    /// The places of the constraints that do not depend on those before them: stops and, after them, joints.
    pub(crate) held: Vec<usize>,
    /// Their reactions.
    pub(crate) reactions: Vec<Observable>,
    /// The impulse of each constraint that changes its own velocity by 1 and those of the others by nothing.
    pub(crate) across: Vec<Vec<f64>>,
    /// The limits of joints that hold along with each constraint, in units of its reaction.
    pub(crate) shared: Vec<f64>,
    /// These joints.
    pub(crate) sharing: Vec<Sharing>,
    /// Acceleration per unit of reaction, and rate of the damping, along each of these.
    pub(crate) mobility: Vec<(f64, f64)>,
    pub(crate) rates: Vec<f64>,
    /// The same, and 0 for those that move nothing.
    pub(super) driven: Vec<f64>,
    /// What is needed for the constant force on the modes at a given position.
    rest: RestForce,
    /// Whether modal displacements are combinations of coordinates alone, and modal velocities of velocities alone: no damping
    /// couples modes, and no constraint moves.
    pub(crate) plain: bool,
    /// The reactions as functions of the mass-normalised state.
    pressing: Vec<Pressing>,
    /// What the search for zeros of guards uses, built when one is searched for: equations of cycles search for none.
    windows: OnceLock<Vec<Window>>,
    sampled: OnceLock<Option<Sampled>>,
    /// The changes of the modes by each component of the state, for derivatives.
    pub(super) units: OnceLock<Vec<ModalChange>>,
    /// Whether coordinates and velocities have prescribed parts.
    pub(crate) carries: bool,
    /// Whether these have or gaps of closed stops.
    pub(crate) swings: bool,
    /// The fastest rate of the free motion and of the forcing.
    fastest: f64,
}

/// A mode whose stiffness is less than this part of the largest one moves freely.
const SOFT: f64 = 1e-12;

impl Structure {
    /// `None` if the constraints depend on each other.
    pub(crate) fn new(machine: &Machine, normal: &Normal, states: &[ContactState]) -> Option<Self> {
        let force = applied_force(machine, normal, states);
        let contacts = Contact::closed(machine, normal, states);
        let constraints = Constraints::of(machine, normal, states)?;
        let motion = FreeMotion::new(normal, &force, &contacts, &constraints)?;
        let (basis, dense) = motion.basis();
        let (drive, slip) = motion.drive(normal, &basis);
        let x = motion.state(normal, &basis.e, &constraints.carried, &slip);
        let v = motion.state(normal, &basis.v, &constraints.carried_rate, &slip);
        // and back, with eta = N' x, because x_c is orthogonal to N
        let back = motion.directions.transposed();
        let to_modes = |maps: &[Matrix; 2]| [maps[0].times(&back), maps[1].times(&back)];
        let (to_y, to_z) = (to_modes(&basis.a), to_modes(&basis.b));
        let offset = |maps: &[Matrix; 2]| {
            let mut sum = applied(normal, &maps[0], &constraints.carried);
            for (own, other) in sum.iter_mut().zip(applied(normal, &maps[1], &constraints.carried_rate)) {
                own.add(1.0, &other);
            }
            sum
        };
        let closed = contacts.iter().zip(&motion.shares);
        let closed =
            closed.map(|(contact, share)| contact.stop(normal, &constraints, share, (&basis, &slip))).collect();
        let modes: Vec<Mode> = basis.modes.iter().map(|(k, d)| Mode::new(*k, *d, &normal.rates)).collect();
        let structure = Self {
            states: states.to_vec(),
            joints: machine.joints().len(),
            rest: motion.rest_force(normal, &force, &contacts, &constraints, &basis),
            to_y_signal: offset(&to_y),
            to_z_signal: offset(&to_z),
            reactions: constraints.reactions(normal, (&force, &contacts), (&x, &v), modes.len()),
            mobility: constraints.mobility(normal, &contacts),
            modes,
            dense,
            drive,
            slip,
            x,
            v,
            to_y,
            to_z,
            back,
            from_free: [basis.a, basis.b],
            guards: Vec::new(),
            closed,
            held: constraints.held,
            across: constraints.across,
            shared: constraints.shared,
            sharing: constraints.sharing,
            rates: normal.rates.clone(),
            driven: normal.driven.clone(),
            plain: false,
            pressing: Vec::new(),
            windows: OnceLock::new(),
            sampled: OnceLock::new(),
            units: OnceLock::new(),
            carries: false,
            swings: false,
            fastest: 0.0,
        };
        Some(structure.completed(machine, normal))
    }

    /// With what follows from its modes, states and reactions.
    fn completed(mut self, machine: &Machine, normal: &Normal) -> Self {
        let still = |signals: &[Signal]| signals.iter().all(Signal::is_zero);
        self.plain = self.to_y[1].largest() == 0.0
            && self.to_z[0].largest() == 0.0
            && still(&self.to_y_signal)
            && still(&self.to_z_signal)
            && still(&self.slip);
        self.carries = self.x.iter().chain(&self.v).any(|of| of.signal.moves());
        self.swings = self.carries || self.closed.iter().any(|closed| closed.gap.signal.moves());
        self.pressing = self.reactions.iter().map(|reaction| self.pressing(reaction)).collect();
        self.fastest = self.modes.iter().map(|mode| mode.rate).fold(self.forcing(), f64::max);
        // last, because guards read all of the above
        self.guards = self.all_guards(machine, normal);
        self
    }

    /// Windows of useful lengths, the shortest first; none without modes.
    pub(crate) fn windows(&self) -> &[Window] {
        self.windows.get_or_init(|| self.tables(windows).unwrap_or_default())
    }

    /// Its guards at equal steps, if plain crossings can be found by them.
    pub(crate) fn sampled(&self) -> Option<&Sampled> {
        self.sampled.get_or_init(|| self.tables(Sampled::new).flatten()).as_ref()
    }

    /// Tables of all guards; `None` without modes.
    fn tables<T>(&self, of: impl Fn(Moved<'_>, &[&Observable]) -> T) -> Option<T> {
        let moved = Moved { modes: &self.modes, drive: &self.drive, rates: &self.driven };
        let guards: Vec<&Observable> = self.guards.iter().map(|guard| &guard.function).collect();
        self.dense.is_none().then(|| of(moved, &guards))
    }

    /// The states of stops and, after them, joints in it.
    pub(crate) fn states(&self) -> &[ContactState] {
        &self.states
    }

    /// Whether stops and joints have these states in it.
    pub(crate) fn is_in(&self, states: &[ContactState]) -> bool {
        self.states == states
    }

    /// Whether nothing can move.
    pub(crate) const fn is_still(&self) -> bool {
        self.modes.is_empty()
    }

    /// The fastest rate of the harmonics that move something.
    pub(super) fn forcing(&self) -> f64 {
        self.driven.iter().copied().fold(0.0, f64::max)
    }

    /// What dampers and closed stops take from velocities that are these, in a unit of time.
    pub(crate) fn damped(&self, normal: &Normal, velocities: &[f64]) -> Vec<f64> {
        let mut damped = normal.damping.apply(velocities);
        for closed in &self.closed {
            let w = &normal.directions[closed.place];
            add_scaled(&mut damped, closed.law.1 * dot(w, velocities), w);
        }
        damped
    }

    /// The fastest rate of the free motion and of the forcing.
    pub(crate) const fn fastest(&self) -> f64 {
        self.fastest
    }

    /// The slowest rate of the modes with stiffness; `None` if there is none.
    pub(crate) fn slowest(&self) -> Option<f64> {
        let stiff = |least: f64| self.modes.iter().map(|mode| mode.k).filter(move |k| *k > least);
        // a stiffness that is a rounding error of the largest one is none
        let least = SOFT * stiff(0.0).fold(0.0, f64::max);
        stiff(least).min_by(f64::total_cmp).map(f64::sqrt)
    }

    /// $`w\cdot x`$ and its rate.
    fn along(&self, direction: &[f64]) -> (Observable, Observable) {
        let zero = || Observable::zero(self.modes.len(), self.joints, self.rates.len());
        let (mut place, mut rate) = (zero(), zero());
        for (i, factor) in direction.iter().enumerate() {
            place.add(*factor, &self.x[i]);
            rate.add(*factor, &self.v[i]);
        }
        (place, rate)
    }

    /// The gap of a stop, and its rate.
    pub(crate) fn gap(&self, normal: &Normal, stop: usize) -> (Observable, Observable) {
        if let Some(closed) = self.closed.iter().find(|closed| closed.place == stop) {
            return (closed.gap.clone(), closed.rate.clone());
        }
        let (place, rate) = self.along(&normal.directions[stop]);
        let wall = &normal.walls[stop];
        let difference = |signal: &Signal, of: &Observable| {
            let mut gap = of.scaled(-1.0);
            gap.signal.add(1.0, signal);
            gap
        };
        (difference(wall, &place), difference(&wall.derivative(&self.rates), &rate))
    }

    /// The force of a closed compliant stop.
    pub(crate) fn force(&self, machine: &Machine, normal: &Normal, stop: usize) -> Option<Observable> {
        let (k, c, p) = compliant(&machine.stops()[stop].law)?;
        let (gap, rate) = self.gap(normal, stop);
        let mut force = gap.scaled(-k);
        force.add(-c, &rate);
        force.signal.constant += p;
        Some(force)
    }

    /// The relative velocity of a joint.
    pub(crate) fn sliding(&self, machine: &Machine, normal: &Normal, joint: usize) -> Observable {
        let (_, mut rate) = self.along(&normal.directions[machine.stops().len() + joint]);
        rate.signal.constant -= machine.joints()[joint].belt;
        rate
    }

    /// The reaction of a constraint, and what joints that hold along with it can bear besides; `None` if other
    /// constraints bear its load.
    pub(crate) fn reaction(&self, place: usize) -> Option<(&Observable, f64)> {
        self.held.iter().position(|held| *held == place).map(|at| (&self.reactions[at], self.shared[at]))
    }

    /// The constant force on each mode at the position `x`, less that of its own stiffness there: the force that remains if
    /// modal displacements are counted from there. `gaps` are those of the closed stops,
    /// `turns` are sine and cosine of the harmonics there.
    pub(crate) fn rest_force(
        &self,
        x: &[f64],
        v: &[f64],
        turns: &[(f64, f64)],
        gaps: impl Iterator<Item = f64>,
        buffers: &mut RestBuffers,
        force: &mut Vec<f64>,
    ) {
        let drift = self.rest.at(x, v, turns, gaps, buffers, force);
        if self.dense.is_none() {
            if !self.plain {
                for (push, slip) in force.iter_mut().zip(&self.slip) {
                    // the rate of a ramp in $`P_1`$
                    *push += slip.ramp;
                }
            }
            for ((push, drift), mode) in force.iter_mut().zip(drift).zip(&self.modes) {
                *push -= mode.k * drift;
            }
        }
    }

    /// The modal displacements and velocities from the mass-normalised state at the beginning of a flight; `at` is the value
    /// of a signal there.
    pub(crate) fn modal(
        &self,
        x: &[f64],
        v: &[f64],
        at: impl Fn(&Signal) -> f64,
        buffers: &mut RestBuffers,
        (y, rate): (&mut Vec<f64>, &mut Vec<f64>),
    ) {
        if self.plain {
            self.to_y[0].apply_into(x, y);
            self.to_z[1].apply_into(v, rate);
            return;
        }
        // both from the same velocities in the free directions as the constant force of `rest_force`: where they have rounding
        // errors, it is as if the machine had these velocities, and no force is left that a stiff damper would make of them
        let [free, free_rate] = &mut buffers.free;
        self.back.apply_into(x, free);
        self.back.apply_into(v, free_rate);
        let of = |maps: &[Matrix; 2], signals: &[Signal], i: usize| {
            dot(maps[0].row(i), free) + dot(maps[1].row(i), free_rate) - at(&signals[i])
        };
        y.clear();
        rate.clear();
        let modes = 0..self.modes.len();
        y.extend(modes.clone().map(|i| of(&self.from_free[0], &self.to_y_signal, i)));
        rate.extend(modes.map(|i| of(&self.from_free[1], &self.to_z_signal, i) + at(&self.slip[i])));
    }

    /// A linear function of the modes as one of the mass-normalised state.
    fn pressing(&self, of: &Observable) -> Pressing {
        let n = self.x.len();
        let mut pressing = Pressing { x: vec![0.0; n], v: vec![0.0; n], signal: of.signal.clone() };
        for i in 0..self.modes.len() {
            let (a, b) = (of.position[i], of.velocity[i]);
            add_scaled(&mut pressing.x, a, self.to_y[0].row(i));
            add_scaled(&mut pressing.v, a, self.to_y[1].row(i));
            add_scaled(&mut pressing.x, b, self.to_z[0].row(i));
            add_scaled(&mut pressing.v, b, self.to_z[1].row(i));
            // y and z have the signals taken away, and z the slip too
            pressing.signal.add(-a, &self.to_y_signal[i]);
            pressing.signal.add(-b, &self.to_z_signal[i]);
            pressing.signal.add(b, &self.slip[i]);
        }
        pressing
    }

    /// A reaction at a mass-normalised state, if no joint holds, to rounding of its terms; `turns` are sine and cosine of the
    /// harmonics.
    pub(crate) fn reaction_at(&self, held: usize, x: &[f64], v: &[f64], turns: &[(f64, f64)]) -> f64 {
        let Pressing { x: by_x, v: by_v, signal } = &self.pressing[held];
        signal.constant + signal.swing(turns) + dot(by_x, x) + dot(by_v, v)
    }
}

/// A linear function of the mass-normalised state.
#[derive(Clone, Debug)]
struct Pressing {
    x: Vec<f64>,
    v: Vec<f64>,
    signal: Signal,
}

/// The force on each coordinate, with those of joints that slide.
fn applied_force(machine: &Machine, normal: &Normal, states: &[ContactState]) -> Vec<Signal> {
    let mut force = normal.force.clone();
    for (joint, place) in machine.joints().iter().zip(machine.stops().len()..) {
        let size = match states[place] {
            ContactState::Forward => joint.sliding,
            ContactState::Backward => -joint.sliding,
            _ => continue,
        };
        for (signal, factor) in force.iter_mut().zip(&normal.directions[place]) {
            // friction pulls against the sliding
            signal.constant -= size * factor;
        }
    }
    force
}
