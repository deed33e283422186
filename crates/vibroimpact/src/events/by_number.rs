//! The derivative of a flight by a number of the machine, at a fixed state at the beginning.
//!
//! Let $`e(t)`$ be the derivative of the acceleration by the number, at the state of the flight. Then the state after the time T
//! changes by
//!
//! $$`\delta z(T) = \int_0^T \Phi(T - t)\,\begin{pmatrix}0\\ e(t)\end{pmatrix}dt,`$$
//!
//! with the transition $`\Phi`$ of the regime. The panels of the integral resolve every mode, so it is right to rounding. Where
//! stops rest and joints hold, a number that moves them carries the structure along: $`W^Tx = c(t)`$, so
//! $`\delta x = WG^{-1}(\delta c - \delta W^Tx) + N\eta`$, and the integral gives the part in the free directions N.
//!
//! Phases are fixed at both ends of a flight. So a change of the frequency changes its duration, and shifts the forcing within
//! it by $`t\,\delta\omega`$.

use super::place::Place;
use super::saltation::StateShape;
use crate::arc::{MachineFlight, Modes};
use crate::machine::{FrictionJoint, Machine, MachineParts};
use crate::math::{Matrix, RULE, add_scaled, dot};
use crate::regime::{
    ContactState, ModalChange, Normal, NormalRate, PRODUCTS, RestBuffers, Signal, Structure, compliant, rates,
};

/// The largest number of panels of half a flight.
const MOST_PANELS: usize = 100_000;

/// A number of a machine, to first order.
pub(crate) struct ByNumber<'a> {
    pub(super) machine: &'a Machine,
    pub(super) normal: &'a Normal,
    /// The derivatives of all numbers of the machine.
    pub(super) parts: &'a MachineParts,
    pub(super) rate: NormalRate,
    /// The forces, and the positions of the stops with their first two derivatives by time.
    force: Vec<Moving>,
    walls: Vec<[Moving; 3]>,
    /// The velocities of the stops.
    pub(super) wall_rates: Vec<Signal>,
}

/// The change of a signal, at a fixed time and by a change of the phase.
struct Moving {
    change: Signal,
    by_phase: Signal,
}

impl Moving {
    fn at(&self, (turns, shift): (&[(f64, f64)], f64)) -> f64 {
        let by_phase = if shift == 0.0 { 0.0 } else { shift * self.by_phase.swing(turns) };
        self.change.constant + self.change.swing(turns) + by_phase
    }

    fn is_zero(&self) -> bool {
        self.change.is_zero()
    }
}

/// A state between events with what acts there.
pub(super) struct Instant<'a> {
    pub(super) x: &'a [f64],
    pub(super) v: &'a [f64],
    pub(super) acceleration: &'a [f64],
    /// Sine and cosine of the harmonics, and the change of the phase.
    pub(super) turns: &'a [(f64, f64)],
    pub(super) shift: f64,
    /// The gaps of closed stops.
    gaps: &'a [(usize, f64)],
    /// The time since the beginning, and the coordinates there.
    time: f64,
    begin: &'a [f64],
}

/// Stiffness, damping and preload of a compliant stop.
type Law = (f64, f64, f64);

/// A change of the state: of coordinates, velocities, and surfaces that stand back.
#[derive(Clone, Debug, Default)]
pub(crate) struct StateChange {
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) surfaces: Vec<f64>,
}

impl StateChange {
    fn zero(n: usize) -> Self {
        Self { x: vec![0.0; n], v: vec![0.0; n], surfaces: Vec::new() }
    }
}

impl<'a> ByNumber<'a> {
    /// `parts` has the derivatives of the numbers of the machine.
    pub(crate) fn new(machine: &'a Machine, normal: &'a Normal, parts: &'a MachineParts) -> Self {
        let rate = NormalRate::new(normal, parts);
        let moving =
            |own: &Signal, change: &Signal| Moving { change: change.clone(), by_phase: own.derivative(&normal.orders) };
        // (w s)' = w' s + w s'
        let later = |own: &Signal, change: &Signal| {
            let mut change = change.derivative(&normal.rates);
            change.add(1.0, &own.derivative(&rate.rates));
            (own.derivative(&normal.rates), change)
        };
        let walls = normal.walls.iter().zip(&rate.walls).map(|(own, change)| {
            let (velocity, by_velocity) = later(own, change);
            // the same rule again, for the second derivative
            let (acceleration, by_acceleration) = later(&velocity, &by_velocity);
            [moving(own, change), moving(&velocity, &by_velocity), moving(&acceleration, &by_acceleration)]
        });
        let walls = walls.collect();
        let force = normal.force.iter().zip(&rate.force).map(|(own, change)| moving(own, change)).collect();
        let wall_rates = normal.walls.iter().map(|wall| wall.derivative(&normal.rates)).collect();
        Self { machine, normal, parts, rate, force, walls, wall_rates }
    }

    /// Whether the number changes a flight in this regime.
    fn acts(&self, structure: &Structure) -> bool {
        let still = |values: &[f64]| values.iter().all(|value| *value == 0.0);
        let stops = self.machine.stops().len();
        // of a contact that pushes, rests, slides or holds
        let contact = |place: usize| {
            let moves = place < stops
                && (!self.walls[place][0].is_zero()
                    || self.law(place).is_some_and(|(_, change)| change != (0.0, 0.0, 0.0)));
            let slides = |joint: &FrictionJoint| joint.sliding != 0.0 || joint.belt != 0.0;
            !still(&self.rate.directions[place]) || moves || place >= stops && slides(&self.parts.joints[place - stops])
        };
        let rubs = |(place, ..): (usize, f64, f64)| contact(place);
        self.parts.frequency.is_some_and(|change| change != 0.0)
            || !still(self.rate.stiffness.values())
            || !still(self.rate.damping.values())
            || !self.force.iter().all(Moving::is_zero)
            || structure.closed.iter().any(|closed| contact(closed.place))
            || structure.held.iter().any(|place| contact(*place))
            || self.sliding(structure).any(rubs)
    }

    /// The change of the duration of a flight between fixed phases.
    pub(crate) fn duration(&self, time: f64) -> f64 {
        match (self.machine.parts().frequency, self.parts.frequency) {
            // the time between fixed phases is their difference over the frequency
            (Some(frequency), Some(change)) => -time * change / frequency,
            _ => 0.0,
        }
    }

    /// The change of the position of a stop, differentiated by time so many times.
    pub(super) fn wall(&self, stop: usize, times: usize, at: (&[(f64, f64)], f64)) -> f64 {
        self.walls[stop][times].at(at)
    }

    /// The gap of a stop and its rate.
    fn gap(&self, stop: usize, at: &Instant<'_>) -> (f64, f64) {
        let (w, wall) = (&self.normal.directions[stop], &self.normal.walls[stop]);
        let known = at.gaps.iter().find(|(of, _)| *of == stop);
        // a flight knows the gaps of closed stops with more digits than coordinates and wall
        let gap = known.map_or_else(|| wall.constant + wall.swing(at.turns) - dot(w, at.x), |(_, gap)| *gap);
        (gap, self.wall_rates[stop].swing(at.turns) - dot(w, at.v))
    }

    /// The change of both, where the state changes.
    pub(super) fn gap_change(&self, stop: usize, at: &Instant<'_>, (x, v): (&[f64], &[f64])) -> (f64, f64) {
        let (w, change) = (&self.normal.directions[stop], &self.rate.directions[stop]);
        let wall = |times| self.wall(stop, times, (at.turns, at.shift));
        (wall(0) - dot(change, at.x) - dot(w, x), wall(1) - dot(change, at.v) - dot(w, v))
    }

    /// The numbers of a compliant stop, and their changes.
    pub(super) fn law(&self, stop: usize) -> Option<(Law, Law)> {
        Some((compliant(&self.machine.stops()[stop].law)?, compliant(&self.parts.stops[stop].law)?))
    }

    /// The force with which a closed stop pulls along its direction, and its change.
    pub(super) fn pull(&self, stop: usize, at: &Instant<'_>, change: (&[f64], &[f64])) -> Option<(f64, f64)> {
        let ((k, c, p), (dk, dc, dp)) = self.law(stop)?;
        let ((gap, rate), (by_gap, by_rate)) = (self.gap(stop, at), self.gap_change(stop, at, change));
        // minus the force with which the stop pushes
        Some((k * gap + c * rate - p, dk * gap + k * by_gap + dc * rate + c * by_rate - dp))
    }

    /// The joints that slide: place, force along the direction, and its change.
    fn sliding<'b>(&'b self, structure: &'b Structure) -> impl Iterator<Item = (usize, f64, f64)> + 'b {
        let stops = self.machine.stops().len();
        let joints = self.machine.joints().iter().zip(&self.parts.joints).enumerate();
        joints.filter_map(move |(j, (joint, change))| match structure.states()[stops + j] {
            ContactState::Forward => Some((stops + j, -joint.sliding, -change.sliding)),
            ContactState::Backward => Some((stops + j, joint.sliding, change.sliding)),
            _ => None,
        })
    }

    /// The reactions of the constraints.
    pub(super) fn reactions(&self, structure: &Structure, at: &Instant<'_>) -> Vec<f64> {
        if structure.held.is_empty() {
            return Vec::new();
        }
        // what is missing from the applied force to the acceleration
        let applied = self.normal.force.iter().map(|force| force.constant + force.swing(at.turns));
        let mut missing: Vec<f64> = applied.zip(at.acceleration).map(|(force, own)| force - own).collect();
        subtract(&mut missing, &self.normal.stiffness, at.x);
        subtract(&mut missing, &self.normal.damping, at.v);
        let still = vec![0.0; self.normal.n];
        for closed in &structure.closed {
            let pull = self.pull(closed.place, at, (&still, &still)).map_or(0.0, |(pull, _)| pull);
            add_scaled(&mut missing, pull, &self.normal.directions[closed.place]);
        }
        for (place, force, _) in self.sliding(structure) {
            add_scaled(&mut missing, force, &self.normal.directions[place]);
        }
        // each row takes out of what is missing the reaction of one constraint
        structure.across.iter().map(|across| dot(across, &missing)).collect()
    }

    /// The change of the force on the structure where its state changes, with these reactions.
    pub(super) fn force(
        &self,
        structure: &Structure,
        at: &Instant<'_>,
        reactions: &[f64],
        change: (&[f64], &[f64]),
    ) -> Option<Vec<f64>> {
        let mut force = Vec::new();
        self.force_into(structure, at, reactions, change, &mut force)?;
        Some(force)
    }

    /// The same into a vector that is used again.
    fn force_into(
        &self,
        structure: &Structure,
        at: &Instant<'_>,
        reactions: &[f64],
        (x, v): (&[f64], &[f64]),
        force: &mut Vec<f64>,
    ) -> Option<()> {
        force.clear();
        force.extend(self.force.iter().map(|force| force.at((at.turns, at.shift))));
        subtract(force, &self.rate.stiffness, at.x);
        subtract(force, &self.rate.damping, at.v);
        subtract(force, &self.normal.stiffness, x);
        subtract(force, &self.normal.damping, v);
        for closed in &structure.closed {
            let (pull, change) = self.pull(closed.place, at, (x, v))?;
            add_scaled(force, pull, &self.rate.directions[closed.place]);
            add_scaled(force, change, &self.normal.directions[closed.place]);
        }
        for (place, own, change) in self.sliding(structure) {
            add_scaled(force, own, &self.rate.directions[place]);
            add_scaled(force, change, &self.normal.directions[place]);
        }
        // a reaction pushes against its direction, which the number turns
        for (place, reaction) in structure.held.iter().zip(reactions) {
            add_scaled(force, -reaction, &self.rate.directions[*place]);
        }
        Some(())
    }

    /// The change of the state that the constraints carry along.
    fn carried_into(&self, structure: &Structure, at: &Instant<'_>, still: &[f64], carried: &mut StateChange) {
        let stops = self.machine.stops().len();
        carried.x.fill(0.0);
        carried.v.fill(0.0);
        // what the constraints demand: gaps that stay zero, joints that stay where they began on their belt
        for (place, across) in structure.held.iter().zip(&structure.across) {
            let (way, rate) = if *place < stops {
                self.gap_change(*place, at, (still, still))
            } else {
                let (change, belt) = (&self.rate.directions[*place], self.parts.joints[*place - stops].belt);
                (belt * at.time + dot(change, at.begin) - dot(change, at.x), belt - dot(change, at.v))
            };
            add_scaled(&mut carried.x, way, across);
            add_scaled(&mut carried.v, rate, across);
        }
    }

    /// The change of the state `before` at the end of the flight from `from` over a time.
    pub(crate) fn flown(
        &self,
        shape: &StateShape,
        flight: &MachineFlight,
        (from, before): (&Place, &Place),
        time: f64,
    ) -> Option<StateChange> {
        let (n, structure) = (self.normal.n, &flight.structure);
        let pace = self.parts.frequency.unwrap_or(0.0);
        let modes = structure.modes.len();
        let zeros = || vec![0.0; modes];
        let mut sum =
            ModalChange { y: zeros(), v: zeros(), push: zeros(), set: vec![0.0; self.machine.joints().len()] };
        let mut seen = Seen::default();
        let still = vec![0.0; n];
        let (mut change, mut buffers, mut free) = (ModalChange::default(), RestBuffers::default(), Vec::new());
        let (mut carried, mut force) = (StateChange::zero(n), Vec::new());
        let all = if modes > 0 && self.acts(structure) {
            // decays are steep at the beginning, and those of the transition at the end
            PRODUCTS.between_ends(&rates(structure), time.abs(), MOST_PANELS)?
        } else {
            Vec::new()
        };
        for (begin, length) in all {
            // the rule is symmetric: half of its points are listed
            for (point, weight) in RULE.iter().flat_map(|(point, weight)| [(*point, *weight), (-point, *weight)]) {
                let t = (begin + 0.5 * length * (1.0 + point)) * time.signum();
                let at = seen.at(flight, t, pace * t, &from.x);
                // the change of the acceleration at this point, carried on to the end of the flight
                let reactions = self.reactions(structure, &at);
                self.carried_into(structure, &at, &still, &mut carried);
                self.force_into(structure, &at, &reactions, (&carried.x, &carried.v), &mut force)?;
                structure.modal_change_into(self.normal, (&still, &force), &mut buffers, &mut change);
                structure.free_modes(time - t, &mut free);
                structure.carry(&mut change, &free, time - t);
                let weight = 0.5 * length * weight * time.signum();
                add_scaled(&mut sum.y, weight, &change.y);
                add_scaled(&mut sum.v, weight, &change.v);
            }
        }
        let mut end = carried;
        self.carried_into(structure, &seen.at(flight, time, pace * time, &from.x), &still, &mut end);
        for i in 0..n {
            end.x[i] += structure.changed(&structure.x[i], &sum);
            end.v[i] += structure.changed(&structure.v[i], &sum);
        }
        let later = self.duration(time);
        // the flight ends later, with the velocities and accelerations that it has at its end
        if later != 0.0 {
            let flow = shape.flow(structure, self.normal, before);
            add_scaled(&mut end.x, later, &flow[..n]);
            add_scaled(&mut end.v, later, &flow[n..2 * n]);
        }
        end.surfaces = (0..before.surfaces.len())
            .map(|j| match (before.surfaces[j], self.law(j)) {
                (Some(surface), Some(((_, c, _), (dk, dc, _)))) => {
                    // the rate is k/c: its change, and that of the duration, act on e^{-rate t}
                    let rate = (dk - surface.rate * dc) / c;
                    -(rate * time + surface.rate * later) * surface.size
                }
                _ => 0.0,
            })
            .collect();
        Some(end)
    }
}

/// Subtracts the product of a matrix and a vector.
fn subtract(from: &mut [f64], matrix: &Matrix, vector: &[f64]) {
    for (i, value) in from.iter_mut().enumerate() {
        *value -= dot(matrix.row(i), vector);
    }
}

/// Memory for the states of a flight.
#[derive(Default)]
pub(super) struct Seen {
    modes: Modes,
    x: Vec<f64>,
    v: Vec<f64>,
    own: Vec<f64>,
    acceleration: Vec<f64>,
    turns: Vec<(f64, f64)>,
    gaps: Vec<(usize, f64)>,
}

impl Seen {
    /// A flight at a time, at which the phase changes by `shift`; it began at the coordinates `begin`.
    pub(super) fn at<'b>(&'b mut self, flight: &MachineFlight, time: f64, shift: f64, begin: &'b [f64]) -> Instant<'b> {
        flight.at(time, &mut self.modes);
        flight.state(&self.modes, &mut self.x, &mut self.v);
        flight.accelerations(&self.modes, &mut self.own, &mut self.acceleration);
        flight.turns_at(&self.modes, &mut self.turns);
        self.gaps.clear();
        self.gaps.extend(flight.closed_gaps(&self.modes));
        let Self { x, v, acceleration, turns, gaps, .. } = self;
        Instant { x, v, acceleration, turns, shift, gaps, time, begin }
    }
}
