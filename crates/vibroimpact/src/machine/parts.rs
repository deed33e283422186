//! The numbers of a machine, before they are checked.

use crate::math::Matrix;

/// The description of a machine: a linear structure, the forces on it, its stops and its friction joints.
///
/// $$`M\ddot q + C\dot q + Kq = f_0 + \sum_h (a_h\cos h\theta + b_h\sin h\theta) + \text{contact and friction},
///   \qquad \theta = \omega t + \varphi_0.`$$
///
/// All fields are public. [`Machine::new`](super::Machine::new) checks them. Units are any consistent ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineParts {
    /// The names of the coordinates $`q`$.
    pub coordinates: Vec<String>,
    /// Mass matrix $`M`$: symmetric, positive definite.
    pub mass: Matrix,
    /// Damping matrix $`C`$: symmetric, positive semidefinite.
    pub damping: Matrix,
    /// Stiffness matrix $`K`$: symmetric, positive semidefinite.
    pub stiffness: Matrix,
    /// Constant force $`f_0`$ on each coordinate.
    pub constant: Vec<f64>,
    /// Angular frequency $`\omega`$ of the forcing; `None` without forcing.
    pub frequency: Option<f64>,
    /// The harmonics of the force.
    pub forces: Vec<HarmonicForce>,
    /// The stops.
    pub stops: Vec<Stop>,
    /// The friction joints.
    pub joints: Vec<FrictionJoint>,
    /// How impacts on several rigid stops at one time act.
    pub impacts: ImpactLaw,
}

/// The law of impacts on several rigid stops at one time, or on one while others are closed. Newton's restitution does not
/// say what happens then: three equal elastic balls in contact, the first one at speed 1, go on with -1/3, 2/3, 2/3
/// together, and with 0, 0, 1 in turn. Both keep the momentum; neither gains energy, and both keep it at restitution 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImpactLaw {
    /// All at once, by Moreau's law: each stop that pushes opens with its restitution times its own closing speed.
    #[default]
    Together,
    /// In turn, as in a cradle: the stops that close push, without the ones at rest; those that they make close then push,
    /// until none closes.
    InTurn,
}

/// One harmonic of the force: $`a\cos h\theta + b\sin h\theta`$.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicForce {
    /// Order $`h`$, from 1.
    pub order: u32,
    /// Cosine amplitude on each coordinate.
    pub cos: Vec<f64>,
    /// Sine amplitude on each coordinate.
    pub sin: Vec<f64>,
}

/// One harmonic of the motion of a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarmonicMotion {
    /// Order $`h`$, from 1.
    pub order: u32,
    /// Cosine amplitude.
    pub cos: f64,
    /// Sine amplitude.
    pub sin: f64,
}

/// A stop, open while its gap $`g = d - w\cdot q - r(t)`$ is positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Its name.
    pub name: String,
    /// The direction $`w`$.
    pub direction: Vec<f64>,
    /// The gap $`d`$ at $`q = 0`$.
    pub gap: f64,
    /// The motion $`r(t)`$ of the stop.
    pub motion: Vec<HarmonicMotion>,
    /// What it does when it is closed.
    pub law: StopLaw,
}

/// What a closed stop does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StopLaw {
    /// Impacts: $`\dot g_+ = -e\,\dot g_-`$.
    Rigid {
        /// Restitution $`e`$ in [0, 1].
        restitution: f64,
    },
    /// Pushes with $`\lambda = k(-g) + c(-\dot g) + p`$.
    Compliant {
        /// Stiffness $`k > 0`$.
        stiffness: f64,
        /// Damping $`c \ge 0`$.
        damping: f64,
        /// Preload $`p \ge 0`$: the force at the moment of closing.
        preload: f64,
        /// When it opens.
        opening: Opening,
    },
}

/// When a compliant stop opens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Opening {
    /// When its force falls to zero, or its gap opens, whichever is first: it cannot pull. Its surface stands back then,
    /// and recovers through its own damper.
    #[default]
    Force,
    /// When its gap opens; a damped stop pulls before.
    Position,
}

/// A Coulomb friction joint of a given normal load, on the relative velocity $`s = w\cdot\dot q - v_b`$.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionJoint {
    /// Its name.
    pub name: String,
    /// The direction $`w`$.
    pub direction: Vec<f64>,
    /// The force while it slides.
    pub sliding: f64,
    /// The largest force that holds it; at least `sliding`.
    pub limit: f64,
    /// The velocity $`v_b`$ of the belt.
    pub belt: f64,
}

impl MachineParts {
    /// A structure of these coordinates without mass, springs, dampers, forces, stops and joints.
    #[must_use]
    pub fn new<S: Into<String>>(coordinates: impl IntoIterator<Item = S>) -> Self {
        let coordinates: Vec<String> = coordinates.into_iter().map(Into::into).collect();
        let n = coordinates.len();
        Self {
            coordinates,
            mass: Matrix::zeros(n, n),
            damping: Matrix::zeros(n, n),
            stiffness: Matrix::zeros(n, n),
            constant: vec![0.0; n],
            ..Self::default()
        }
    }

    /// Number of coordinates.
    #[must_use]
    pub fn n(&self) -> usize {
        self.coordinates.len()
    }

    /// The direction that a coordinate has alone.
    #[must_use]
    pub fn along(&self, coordinate: usize) -> Vec<f64> {
        let mut direction = vec![0.0; self.n()];
        direction[coordinate] = 1.0;
        direction
    }

    /// With this mass on a coordinate, added to what is there.
    #[must_use]
    pub fn with_mass(mut self, coordinate: usize, mass: f64) -> Self {
        self.mass[(coordinate, coordinate)] += mass;
        self
    }

    /// With a spring and a damper that act on `direction` $`\cdot q`$, added to what is there. The direction of a link
    /// to the ground is that of one coordinate, of a link between two their difference.
    #[must_use]
    pub fn with_link(mut self, direction: &[f64], stiffness: f64, damping: f64) -> Self {
        // energy (k/2) (w q)^2, so the matrix is k w w^T, symmetric and semidefinite by construction
        self.stiffness.add_outer(stiffness, direction, direction);
        self.damping.add_outer(damping, direction, direction);
        self
    }

    /// With this constant force on a coordinate, added to what is there.
    #[must_use]
    pub fn with_constant(mut self, coordinate: usize, force: f64) -> Self {
        self.constant[coordinate] += force;
        self
    }

    /// With forcing of this angular frequency.
    #[must_use]
    pub const fn with_frequency(mut self, frequency: f64) -> Self {
        self.frequency = Some(frequency);
        self
    }

    /// With the force $`a\cos h\theta + b\sin h\theta`$ on a coordinate.
    #[must_use]
    pub fn with_force(mut self, coordinate: usize, order: u32, cos: f64, sin: f64) -> Self {
        let n = self.n();
        // one entry for each order: forces of one order on several coordinates are one harmonic
        let place = self.forces.iter().position(|force| force.order == order).unwrap_or_else(|| {
            self.forces.push(HarmonicForce { order, cos: vec![0.0; n], sin: vec![0.0; n] });
            self.forces.len() - 1
        });
        self.forces[place].cos[coordinate] += cos;
        self.forces[place].sin[coordinate] += sin;
        self
    }

    /// With a rigid stop at rest.
    #[must_use]
    pub fn with_rigid_stop(self, name: &str, direction: &[f64], gap: f64, restitution: f64) -> Self {
        self.with_stop(name, direction, gap, StopLaw::Rigid { restitution })
    }

    /// With a stop at rest.
    #[must_use]
    pub fn with_stop(mut self, name: &str, direction: &[f64], gap: f64, law: StopLaw) -> Self {
        self.stops.push(Stop { name: name.to_owned(), direction: direction.to_vec(), gap, motion: Vec::new(), law });
        self
    }

    /// With a friction joint.
    #[must_use]
    pub fn with_joint(mut self, name: &str, direction: &[f64], sliding: f64, limit: f64, belt: f64) -> Self {
        self.joints.push(FrictionJoint { name: name.to_owned(), direction: direction.to_vec(), sliding, limit, belt });
        self
    }
}
