//! What stops at rest and joints that hold prescribe in one regime: $`w\cdot x = `$ a function of time for each of them, so that
//! $`x = x_c(t) + N\eta`$ with $`N`$ orthogonal to all directions $`w`$.

use super::basis::inverse;
use super::closed_stop::Contact;
use super::complement::independent;
use super::contact_state::ContactState;
use super::normal::{Normal, compliant};
use super::signal::{Observable, Signal};
use crate::machine::Machine;
use crate::math::{Matrix, add_scaled, dot, sort_by_key};

/// A joint that holds along with a constraint and shares its load.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sharing {
    /// The joint, counted after the stops.
    pub(crate) place: usize,
    /// The constraint.
    pub(crate) held: usize,
    /// Whether its direction is that of the constraint, 1, or the opposite one, -1.
    pub(crate) side: f64,
}

/// The constraints of a regime that do not depend on each other.
pub(super) struct Constraints {
    /// Their places: stops and, after them, joints.
    pub(super) held: Vec<usize>,
    pub(super) directions: Vec<Vec<f64>>,
    /// The limits of joints that hold along with each, in units of its reaction.
    pub(super) shared: Vec<f64>,
    /// These joints.
    pub(super) sharing: Vec<Sharing>,
    /// The inverse of $`G = W^TW`$.
    gram: Matrix,
    /// What each prescribes.
    wanted: Vec<Signal>,
    /// The columns of $`WG^{-1}`$: the impulse of each that changes its own velocity by 1 and those of the others by nothing.
    pub(super) across: Vec<Vec<f64>>,
    /// $`x_c`$ and its rate.
    pub(super) carried: Vec<Signal>,
    pub(super) carried_rate: Vec<Signal>,
}

impl Constraints {
    /// `None` if a stop at rest depends on others.
    pub(super) fn of(machine: &Machine, normal: &Normal, states: &[ContactState]) -> Option<Self> {
        let stops = machine.stops().len();
        let (constraints, held) = bearing(machine, normal, states, |place| states[place] == ContactState::Touching);
        let directions: Vec<Vec<f64>> = held.iter().map(|place| normal.directions[*place].clone()).collect();
        let mut shared = vec![0.0; held.len()];
        let mut sharing = Vec::new();
        for place in constraints.iter().filter(|place| !held.contains(place)) {
            if states[*place] == ContactState::Resting {
                return None;
            }
            // joints that hold along with another constraint share its load: their limits add to its range
            if states[*place] == ContactState::Holding
                && let Some((at, ratio)) = parallel(&directions, &normal.directions[*place])
            {
                shared[at] += ratio.abs() * machine.joints()[*place - stops].limit;
                sharing.push(Sharing { place: *place, held: at, side: ratio.signum() });
            }
        }
        let gram = inverse(&products(&directions))?;
        let wanted: Vec<Signal> = held.iter().map(|place| wanted(machine, normal, *place)).collect();
        let across = across(&gram, &directions, normal.n);
        let mut carried = vec![normal.no_signal(); normal.n];
        // x_c is W G^-1 times what they prescribe
        for (column, signal) in across.iter().zip(&wanted) {
            for (own, factor) in carried.iter_mut().zip(column) {
                own.add(*factor, signal);
            }
        }
        let carried_rate = carried.iter().map(|signal| signal.derivative(&normal.rates)).collect();
        Some(Self { held, directions, shared, sharing, gram, wanted, across, carried, carried_rate })
    }

    /// Their reactions as functions of the modes, $`G^{-1}(W^T(F - Kx - C\dot x) - `$ the second derivatives of what they
    /// prescribe$`)`$. `x` and `v` are coordinates and velocities, `force` and `closed` what acts on them.
    pub(super) fn reactions(
        &self,
        normal: &Normal,
        (force, closed): (&[Signal], &[Contact<'_>]),
        (x, v): (&[Observable], &[Observable]),
        modes: usize,
    ) -> Vec<Observable> {
        let none = Observable { position: vec![0.0; modes], velocity: vec![0.0; modes], signal: normal.no_signal() };
        let reaction = |(j, column): (usize, &Vec<f64>)| {
            let mut sum = none.clone();
            // the matrices are symmetric, so these are rows as well
            let (by_x, by_v) = (normal.stiffness.apply(column), normal.damping.apply(column));
            for contact in closed {
                contact.push_along(column, (x, v), &mut sum);
            }
            for i in 0..normal.n {
                sum.signal.add(column[i], &force[i]);
                sum.add(-by_x[i], &x[i]);
                sum.add(-by_v[i], &v[i]);
            }
            for (i, signal) in self.wanted.iter().enumerate() {
                sum.signal.add(-self.gram[(j, i)], &signal.derivative(&normal.rates).derivative(&normal.rates));
            }
            sum
        };
        self.across.iter().enumerate().map(reaction).collect()
    }

    /// Acceleration per unit of reaction, and rate of the damping, along each.
    pub(super) fn mobility(&self, normal: &Normal, closed: &[Contact<'_>]) -> Vec<(f64, f64)> {
        let of = |(j, column): (usize, &Vec<f64>)| {
            let contacts = closed.iter().map(|contact| {
                let share = dot(contact.direction, column);
                contact.c * share * share
            });
            let drag = dot(column, &normal.damping.apply(column)) + contacts.sum::<f64>();
            // while the other constraints hold
            (1.0 / self.gram[(j, j)], drag / dot(column, column))
        };
        self.across.iter().enumerate().map(of).collect()
    }
}

/// The places of all constraints and of those that bear the loads, which do not depend on each other: `last` says which come last, as
/// contacts without force, which constrain only what is free.
///
/// Where a hold depends on stops at rest and other holds in other directions, as of two bodies that hold and touch, how the loads are
/// shared is undetermined. Then holds come before rests, so that it does not depend on their order.
pub(crate) fn bearing(
    machine: &Machine,
    normal: &Normal,
    states: &[ContactState],
    last: impl Fn(usize) -> bool,
) -> (Vec<usize>, Vec<usize>) {
    let direction = |place: usize| normal.directions[place].as_slice();
    let mut constraints: Vec<usize> = (0..states.len()).filter(|place| states[*place].constrains()).collect();
    sort_by_key(&mut constraints, |place| (last(*place), idles(machine, *place)));
    let bearing = |constraints: &[usize]| -> Vec<usize> {
        let bearing = independent(constraints.iter().map(|place| direction(*place)));
        bearing.iter().map(|at| constraints[*at]).collect()
    };
    let along = |one: usize, other: usize| independent([direction(one), direction(other)].into_iter()).len() == 1;
    let holds = |place: &usize| states[*place] == ContactState::Holding;
    let held = bearing(&constraints);
    let rides =
        |place: &usize| holds(place) && !held.contains(place) && !held.iter().any(|other| along(*other, *place));
    if !constraints.iter().any(rides) {
        return (constraints, held);
    }
    // a joint along a rest shares its load
    let shares = |stop: usize| constraints.iter().any(|place| holds(place) && along(*place, stop));
    let rests: Vec<bool> =
        (0..states.len()).map(|at| states[at] == ContactState::Resting && idles(machine, at) && !shares(at)).collect();
    sort_by_key(&mut constraints, |place| (last(*place), idles(machine, *place), rests[*place]));
    let held = bearing(&constraints);
    (constraints, held)
}

/// The products of the directions with each other.
fn products(directions: &[Vec<f64>]) -> Matrix {
    let mut gram = Matrix::zeros(directions.len(), directions.len());
    for (i, one) in directions.iter().enumerate() {
        for (j, other) in directions.iter().enumerate() {
            gram[(i, j)] = dot(one, other);
        }
    }
    gram
}

/// What a constraint prescribes: the place of the wall, or the set point of a joint and the way of its belt.
fn wanted(machine: &Machine, normal: &Normal, place: usize) -> Signal {
    let Some(joint) = place.checked_sub(machine.stops().len()) else { return normal.walls[place].clone() };
    let mut point = normal.no_signal();
    // the set point of the joint as a number of its own, and the way of its belt
    point.set[joint] = 1.0;
    point.ramp = machine.joints()[joint].belt;
    point
}

fn across(gram: &Matrix, directions: &[Vec<f64>], n: usize) -> Vec<Vec<f64>> {
    let column = |j: usize| {
        let mut column = vec![0.0; n];
        for (i, direction) in directions.iter().enumerate() {
            add_scaled(&mut column, gram[(i, j)], direction);
        }
        column
    };
    (0..directions.len()).map(column).collect()
}

/// The direction to which another one is parallel, and its multiple of it.
fn parallel(directions: &[Vec<f64>], other: &[f64]) -> Option<(usize, f64)> {
    directions.iter().enumerate().find_map(|(at, direction)| {
        let one = core::iter::once(direction.as_slice());
        let depends = independent(one.chain(core::iter::once(other))).len() == 1;
        depends.then(|| (at, dot(other, direction) / dot(direction, direction)))
    })
}

/// Whether a constraint can be without load: not a preloaded stop. Of constraints that depend on each other those that cannot
/// come first.
fn idles(machine: &Machine, place: usize) -> bool {
    machine.stops().get(place).is_none_or(|stop| compliant(&stop.law).is_none())
}
