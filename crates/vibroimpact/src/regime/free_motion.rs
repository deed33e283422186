//! The motion in the directions that the constraints of a regime leave free: $`\ddot\eta + C\dot\eta + K\eta = f(t)`$, and its
//! modes.

use super::basis::Basis;
use super::closed_stop::Contact;
use super::complement::complement;
use super::constraints::Constraints;
use super::normal::Normal;
use super::refined::refined;
use super::rest_force::{RestContact, RestForce};
use super::signal::{Observable, Signal};
use crate::math::Matrix;

/// What moves in the free directions.
pub(super) struct FreeMotion {
    /// These directions, $`N`$.
    pub(super) directions: Matrix,
    /// The components of the directions of closed stops in them.
    pub(super) shares: Vec<Vec<f64>>,
    stiffness: Matrix,
    damping: Matrix,
    /// The force, without constraints.
    pub(super) force: Vec<Signal>,
}

impl FreeMotion {
    /// `None` if the constraints depend on each other. `force` acts on the coordinates.
    pub(super) fn new(
        normal: &Normal,
        force: &[Signal],
        closed: &[Contact<'_>],
        constraints: &Constraints,
    ) -> Option<Self> {
        let along: Vec<&[f64]> = closed.iter().map(|contact| contact.direction).collect();
        let (directions, shares) = complement(&constraints.directions, &along, normal.n)?;
        // N'AN, made exactly symmetric
        let turned = |a: &Matrix| directions.transposed().times(&a.times(&directions)).symmetrised();
        let mut stiffness = turned(&normal.stiffness);
        let mut damping = turned(&normal.damping);
        let mut on_free = turned_force(normal, force, constraints, &directions);
        // a closed stop is a spring and a damper along its direction
        for (contact, share) in closed.iter().zip(&shares) {
            stiffness.add_outer(contact.k, share, share);
            damping.add_outer(contact.c, share, share);
            let pushed = contact.push_on_free(constraints);
            for (signal, factor) in on_free.iter_mut().zip(share) {
                signal.add(*factor, &pushed);
            }
        }
        Some(Self { directions, shares, stiffness, damping, force: on_free })
    }

    /// The modes; where damping couples nearly defective ones, the free directions themselves, with their stiffness and damping.
    pub(super) fn basis(&self) -> (Basis, Option<(Matrix, Matrix)>) {
        let basis = Basis::new(&self.stiffness, &self.damping).map(|basis| {
            // without coupling the shapes come from rotations, which keep the digits of small components
            let refined = if basis.coupled { refined(&basis, &self.stiffness, &self.damping) } else { None };
            refined.unwrap_or(basis)
        });
        match basis {
            Some(basis) => (basis, None),
            None => {
                let dense = (self.stiffness.clone(), self.damping.clone());
                (Basis::identity(&self.stiffness, &self.damping), Some(dense))
            }
        }
    }

    /// What drives each mode, and its slip $`P_1`$: with $`\dot y = z + P_1`$ and $`\dot z = -ky - 2dz + P_2`$ there is
    /// $`\ddot y + 2d\dot y + ky = P_2 + \dot P_1 + 2dP_1`$.
    pub(super) fn drive(&self, normal: &Normal, basis: &Basis) -> (Vec<Signal>, Vec<Signal>) {
        // z is y' less this: of the force the modes take what changes y at once
        let slip = applied(normal, &basis.a[1], &self.force);
        let mut drive = applied(normal, &basis.b[1], &self.force);
        for (i, signal) in drive.iter_mut().enumerate() {
            signal.add(1.0, &slip[i].derivative(&normal.rates));
            signal.add(2.0 * basis.modes[i].1, &slip[i]);
        }
        (drive, slip)
    }

    /// Coordinates $`x = x_c + N(E_1y + E_2(\dot y - P_1))`$ as functions of the modes, or velocities alike.
    pub(super) fn state(
        &self,
        normal: &Normal,
        from: &[Matrix; 2],
        carried: &[Signal],
        slip: &[Signal],
    ) -> Vec<Observable> {
        let (one, two) = (self.directions.times(&from[0]), self.directions.times(&from[1]));
        let offset = applied(normal, &two, slip);
        let row = |i: usize| {
            let mut signal = carried[i].clone();
            signal.add(-1.0, &offset[i]);
            Observable { position: one.row(i).to_vec(), velocity: two.row(i).to_vec(), signal }
        };
        (0..normal.n).map(row).collect()
    }

    /// What is needed for the constant force on the modes at a given position. `force` acts on the coordinates.
    pub(super) fn rest_force(
        &self,
        normal: &Normal,
        force: &[Signal],
        closed: &[Contact<'_>],
        constraints: &Constraints,
        basis: &Basis,
    ) -> RestForce {
        let Constraints { carried, carried_rate, .. } = constraints;
        // of a force the modes take B_2 + 2d A_2, the constant part of what drives them
        let mut push = basis.b[1].clone();
        for (i, (_, d)) in basis.modes.iter().enumerate() {
            for j in 0..self.directions.columns() {
                push[(i, j)] += 2.0 * d * basis.a[1][(i, j)];
            }
        }
        let drag = |i: usize| {
            let less = |sum, j: usize| sum - normal.damping[(i, j)] * carried_rate[j].constant;
            (0..normal.n).fold(force[i].constant, less)
        };
        let contact = |(contact, share): (&Contact<'_>, &Vec<f64>)| {
            let along = contact.direction.iter().zip(carried_rate).map(|(w, rate)| w * rate.constant);
            RestContact {
                stiffness: contact.k,
                force: -contact.p - contact.c * along.sum::<f64>(),
                direction: contact.direction.to_vec(),
                push: push.apply(share),
            }
        };
        RestForce {
            stiffness: normal.stiffness.clone(),
            force: (0..normal.n).map(drag).collect(),
            free: self.directions.clone(),
            contacts: closed.iter().zip(&self.shares).map(contact).collect(),
            carried: carried.clone(),
            carries: carried.iter().any(Signal::moves),
            push_of_force: push.times(&self.directions.transposed()),
            drift: basis.a[1].clone(),
            drifts: basis.a[1].largest() > 0.0,
        }
    }
}

/// The force in the free directions, less what stiffness and damping make of what the constraints carry along.
fn turned_force(normal: &Normal, force: &[Signal], constraints: &Constraints, directions: &Matrix) -> Vec<Signal> {
    let mut pull = force.to_vec();
    for (i, pulled) in pull.iter_mut().enumerate() {
        for j in 0..normal.n {
            pulled.add(-normal.stiffness[(i, j)], &constraints.carried[j]);
            pulled.add(-normal.damping[(i, j)], &constraints.carried_rate[j]);
        }
    }
    let along = |k: usize| {
        let mut sum = normal.no_signal();
        for (i, pulled) in pull.iter().enumerate() {
            sum.add(directions[(i, k)], pulled);
        }
        sum
    };
    (0..directions.columns()).map(along).collect()
}

/// The product of a matrix with signals.
pub(super) fn applied(normal: &Normal, matrix: &Matrix, signals: &[Signal]) -> Vec<Signal> {
    let row = |i: usize| {
        let mut sum = normal.no_signal();
        for (factor, signal) in matrix.row(i).iter().zip(signals) {
            sum.add(*factor, signal);
        }
        sum
    };
    (0..matrix.rows()).map(row).collect()
}
