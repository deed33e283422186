//! A machine in mass-normalised coordinates $`x = L^Tq`$, $`M = LL^T`$, in which kinetic energy is $`|\dot x|^2/2`$.

use super::contact_state::ContactState;
use super::signal::Signal;
use super::translations::Translations;
use crate::machine::{HarmonicMotion, Machine, MachineParts, Stop, StopLaw};
use crate::math::{Matrix, add_scaled, change_along, dot};

/// The acceleration of a machine without contacts towards a stop, as a function of the mass-normalised state.
#[derive(Clone, Debug)]
pub(crate) struct Approach {
    x: Vec<f64>,
    v: Vec<f64>,
    signal: Signal,
    /// The rate of the damping along the stop.
    pub(crate) drag: f64,
}

impl Approach {
    /// At a state; `turns` are sine and cosine of the harmonics.
    pub(crate) fn at(&self, x: &[f64], v: &[f64], turns: &[(f64, f64)]) -> f64 {
        self.signal.constant + self.signal.swing(turns) - dot(&self.x, x) - dot(&self.v, v)
    }
}

/// A machine in mass-normalised coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Normal {
    /// Number of coordinates.
    pub(crate) n: usize,
    /// $`L^{-1}KL^{-T}`$.
    pub(crate) stiffness: Matrix,
    /// $`L^{-1}CL^{-T}`$.
    pub(crate) damping: Matrix,
    /// The force on each coordinate.
    pub(crate) force: Vec<Signal>,
    /// The directions $`L^{-1}w`$ of stops and, after them, of joints.
    pub(crate) directions: Vec<Vec<f64>>,
    /// The squares of their lengths.
    pub(crate) squares: Vec<f64>,
    /// The position of each stop, $`d - r(t)`$: it is open while $`w\cdot x`$ is below.
    pub(crate) walls: Vec<Signal>,
    /// How the open machine accelerates towards each stop.
    pub(crate) approaches: Vec<Approach>,
    /// Angular frequencies of the harmonics.
    pub(crate) rates: Vec<f64>,
    /// The same, and 0 for harmonics that neither force nor move anything: no flight changes as fast as they do.
    pub(crate) driven: Vec<f64>,
    /// Orders of the harmonics.
    pub(crate) orders: Vec<f64>,
    /// The directions along which all of it can be moved.
    pub(crate) translations: Translations,
    factor: Matrix,
    /// Its diagonal, if it has no other elements.
    diagonal: Option<Vec<f64>>,
}

impl Normal {
    /// A signal that is zero.
    pub(super) fn no_signal(&self) -> Signal {
        Signal::zero(self.directions.len() - self.walls.len(), self.rates.len())
    }

    pub(crate) fn new(machine: &Machine) -> Self {
        let parts = machine.parts();
        let (n, factor) = (machine.n(), machine.factor().clone());
        // an order that drives several places is one harmonic
        let mut orders: Vec<u32> = parts.forces.iter().map(|force| force.order).collect();
        orders.extend(parts.stops.iter().flat_map(|stop| stop.motion.iter().map(|motion| motion.order)));
        orders.sort_unstable();
        orders.dedup();
        let (force, walls) = signals(parts, &orders, &factor);
        let rates: Vec<f64> = orders.iter().map(|order| f64::from(*order) * parts.frequency.unwrap_or(0.0)).collect();
        let drives = |h: usize| force.iter().chain(&walls).any(|signal: &Signal| signal.harmonics[h] != (0.0, 0.0));
        let driven = rates.iter().enumerate().map(|(h, rate)| if drives(h) { *rate } else { 0.0 }).collect();
        let (stiffness, damping) = (parts.stiffness.reduced(&factor), parts.damping.reduced(&factor));
        let approach = |(stop, wall): (&Stop, &Signal)| {
            let w = factor.solve_lower(&stop.direction);
            // minus the second derivative of the gap: the wall's acceleration counts against that of the body
            let mut signal = wall.derivative(&rates).derivative(&rates);
            // the signal less twice itself is its negative
            signal.add(-2.0, &signal.clone());
            for (factor, force) in w.iter().zip(&force) {
                signal.add(*factor, force);
            }
            let v = damping.apply(&w);
            Approach { x: stiffness.apply(&w), drag: dot(&w, &v) / dot(&w, &w), v, signal }
        };
        let approaches = parts.stops.iter().zip(&walls).map(approach).collect();
        let of_stops = parts.stops.iter().map(|stop| &stop.direction);
        let of_joints = parts.joints.iter().map(|joint| &joint.direction);
        let directions: Vec<Vec<f64>> =
            of_stops.chain(of_joints).map(|direction| factor.solve_lower(direction)).collect();
        Self {
            n,
            stiffness,
            damping,
            approaches,
            force,
            squares: directions.iter().map(|w| dot(w, w)).collect(),
            directions,
            walls,
            rates,
            driven,
            orders: orders.iter().map(|order| f64::from(*order)).collect(),
            translations: Translations::new(parts, &factor),
            // the factor is lower triangular: nothing else stands above the diagonal
            diagonal: (0..n)
                .all(|i| (0..i).all(|j| factor[(i, j)] == 0.0))
                .then(|| (0..n).map(|i| factor[(i, i)]).collect()),
            factor,
        }
    }

    /// The largest way and velocity along a stop or joint, in the units of the machine, of a motion whose mass-normalised coordinates and
    /// velocities have these sizes.
    pub(crate) fn along(&self, contact: usize, (size, speed): (f64, f64)) -> (f64, f64) {
        let length = self.length(contact);
        (length * size, length * speed)
    }

    /// The length of the direction of a stop or joint.
    pub(crate) fn length(&self, contact: usize) -> f64 {
        self.squares[contact].sqrt()
    }

    /// Coordinates, or velocities, from the mass-normalised ones.
    #[inline]
    pub(crate) fn to_machine(&self, x: &[f64]) -> Vec<f64> {
        match &self.diagonal {
            Some(diagonal) => x.iter().zip(diagonal).map(|(x, own)| x / own).collect(),
            None => self.to_coupled_machine(x),
        }
    }

    /// The same if masses couple coordinates.
    fn to_coupled_machine(&self, x: &[f64]) -> Vec<f64> {
        let mut q = Vec::with_capacity(x.len());
        self.factor.solve_lower_transposed_into(x, &mut q);
        q
    }

    /// The same into a vector that is used again.
    pub(crate) fn to_machine_into(&self, x: &[f64], q: &mut Vec<f64>) {
        if let Some(diagonal) = &self.diagonal {
            q.clear();
            q.extend(x.iter().zip(diagonal).map(|(x, own)| x / own));
            return;
        }
        self.factor.solve_lower_transposed_into(x, q);
    }

    /// Moves coordinates, or velocities, so that the gap of each of some stops, or the place of a joint, changes by an amount: all at
    /// once, so that a symmetric state stays one.
    pub(crate) fn move_by(&self, amounts: &[(usize, f64)], x: &mut [f64]) {
        self.move_beside(&[], amounts, x);
    }

    /// The same without a change of what rests and holds in these states of stops and joints, unless it is among those that change.
    pub(crate) fn move_beside(&self, states: &[ContactState], amounts: &[(usize, f64)], x: &mut [f64]) {
        let of = |at: usize, amount: f64| (&self.directions[at][..], amount);
        let mut along: Vec<(&[f64], f64)> = amounts.iter().map(|(at, amount)| of(*at, *amount)).collect();
        let own = along.len();
        let is_kept = |at: &usize| states[*at].constrains() && amounts.iter().all(|(own, _)| own != at);
        along.extend((0..states.len()).filter(is_kept).map(|at| of(at, 0.0)));
        let (moved, kept) = along.split_at(own);
        let meet = moved.iter().any(|(w, _)| kept.iter().any(|(other, _)| dot(w, other) != 0.0));
        if !meet {
            along.truncate(own);
        }
        change_along(&along, x);
    }

    /// The mass-normalised ones from coordinates or velocities.
    pub(crate) fn to_normal(&self, q: &[f64]) -> Vec<f64> {
        self.factor.apply_transposed(q)
    }
}

/// The force on each coordinate, and the position of each stop, with harmonics of these orders.
fn signals(parts: &MachineParts, orders: &[u32], factor: &Matrix) -> (Vec<Signal>, Vec<Signal>) {
    let place = |order: u32| orders.iter().position(|known| *known == order).unwrap_or(0);
    let zero = || Signal::zero(parts.joints.len(), orders.len());
    let mut force: Vec<Signal> = parts.coordinates.iter().map(|_| zero()).collect();
    for (signal, value) in force.iter_mut().zip(factor.solve_lower(&parts.constant)) {
        signal.constant = value;
    }
    for harmonic in &parts.forces {
        let h = place(harmonic.order);
        let (cos, sin) = (factor.solve_lower(&harmonic.cos), factor.solve_lower(&harmonic.sin));
        for (signal, (cos, sin)) in force.iter_mut().zip(cos.into_iter().zip(sin)) {
            signal.harmonics[h].0 += cos;
            signal.harmonics[h].1 += sin;
        }
    }
    let walls = parts.stops.iter().map(|stop| {
        let mut wall = zero();
        wall.constant = stop.gap;
        for HarmonicMotion { order, cos, sin } in &stop.motion {
            let h = place(*order);
            // the wall is at d - r
            wall.harmonics[h].0 -= cos;
            wall.harmonics[h].1 -= sin;
        }
        wall
    });
    let walls = walls.collect();
    (force, walls)
}

/// The derivative of a machine in mass-normalised coordinates by one of its numbers, at fixed $`x`$.
///
/// With $`X = L^{-1}M'L^{-T}`$ the factor changes by $`L' = L\Phi`$, where $`\Phi`$ is the lower triangle of $`X`$ with half
/// its diagonal. So $`(L^{-1}w)' = L^{-1}w' - \Phi L^{-1}w`$.
#[derive(Clone, Debug)]
pub(crate) struct NormalRate {
    /// $`\Phi`$; `None` if the masses do not change.
    pub(crate) turning: Option<Matrix>,
    pub(crate) stiffness: Matrix,
    pub(crate) damping: Matrix,
    pub(crate) force: Vec<Signal>,
    pub(crate) directions: Vec<Vec<f64>>,
    pub(crate) walls: Vec<Signal>,
    /// Of the angular frequencies of the harmonics.
    pub(crate) rates: Vec<f64>,
}

impl NormalRate {
    /// `change` has the derivatives of the numbers of the machine.
    pub(crate) fn new(normal: &Normal, change: &MachineParts) -> Self {
        let factor = &normal.factor;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // they were made from these
        let orders: Vec<u32> = normal.orders.iter().map(|order| *order as u32).collect();
        let (mut force, walls) = signals(change, &orders, factor);
        let stops = change.stops.iter().map(|stop| &stop.direction);
        let all = stops.chain(change.joints.iter().map(|joint| &joint.direction));
        let mut directions: Vec<Vec<f64>> = all.map(|direction| factor.solve_lower(direction)).collect();
        let (mut stiffness, mut damping) = (change.stiffness.reduced(factor), change.damping.reduced(factor));
        let mut turning = change.mass.reduced(factor);
        let turns = turning.largest() > 0.0;
        // Phi from the whole X
        if turns {
            for i in 0..normal.n {
                turning[(i, i)] *= 0.5;
                turning.row_mut(i)[i + 1..].fill(0.0);
            }
            // the derivative of L^-1 K L^-T has -Phi K - K Phi^T: the second term is the transpose of the first, as K
            // is symmetric
            for (own, of) in [(&mut stiffness, &normal.stiffness), (&mut damping, &normal.damping)] {
                let turned = turning.times(of);
                for i in 0..normal.n {
                    for j in 0..normal.n {
                        own[(i, j)] -= turned[(i, j)] + turned[(j, i)];
                    }
                }
            }
            // directions and forces are L^-1 times those of the machine, and turn with it
            for (own, of) in directions.iter_mut().zip(&normal.directions) {
                add_scaled(own, -1.0, &turning.apply(of));
            }
            for (i, own) in force.iter_mut().enumerate() {
                for (factor, of) in turning.row(i).iter().zip(&normal.force) {
                    own.add(-factor, of);
                }
            }
        }
        let frequency = change.frequency.unwrap_or(0.0);
        let rates = normal.orders.iter().map(|order| order * frequency).collect();
        Self { turning: turns.then_some(turning), stiffness, damping, force, directions, walls, rates }
    }
}

/// The force of a closed compliant stop at a gap and its rate; it may be a pull.
pub(crate) fn compliant_force(law: &StopLaw, gap: f64, rate: f64) -> Option<f64> {
    let (stiffness, damping, preload) = compliant(law)?;
    Some(preload - stiffness * gap - damping * rate)
}

/// Stiffness, damping and preload of a compliant stop.
pub(crate) const fn compliant(law: &StopLaw) -> Option<(f64, f64, f64)> {
    match *law {
        StopLaw::Compliant { stiffness, damping, preload, .. } => Some((stiffness, damping, preload)),
        StopLaw::Rigid { .. } => None,
    }
}
