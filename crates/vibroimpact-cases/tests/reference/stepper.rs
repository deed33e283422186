//! Time stepping by Moreau and Jean: small equal steps, no event is located. It shares nothing with the simulator but the
//! meaning of the numbers of a machine.
//!
//! The implicit midpoint rule for the structure and the compliant stops that are closed; impulses of rigid stops and joints
//! over each step by the projected method of Gauss and Seidel, so that
//! $`0 \le P \perp \dot g_+ + e\,\dot g_- \ge 0`$ for stops that are closed at the middle of the step. Its error is of the
//! order of the step, times what the events amplify.

use vibroimpact::events::Start;
use vibroimpact::machine::{Machine, Opening, Stop, StopLaw};
use vibroimpact::math::Matrix;

/// A machine that moves in equal steps.
pub(crate) struct Stepper<'a> {
    machine: &'a Machine,
    h: f64,
    pub(crate) q: Vec<f64>,
    v: Vec<f64>,
    steps: u64,
    phase: f64,
    /// Whether each compliant stop is closed, and how far its surface stands back.
    closed: Vec<bool>,
    surfaces: Vec<f64>,
    holds: Vec<bool>,
    /// The step for the last pattern of closed stops.
    system: System,
}

/// The linear step with some compliant stops closed.
struct System {
    closed: Vec<bool>,
    damping: Matrix,
    stiffness: Matrix,
    /// $`(M + \tfrac h2 C + \tfrac{h^2}4 K)^{-1}`$.
    inverse: Matrix,
    /// Its products with the directions of stops and joints.
    across: Vec<Vec<f64>>,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl System {
    fn new(machine: &Machine, h: f64, closed: &[bool]) -> Self {
        let parts = machine.parts();
        let n = machine.n();
        let (mut damping, mut stiffness) = (parts.damping.clone(), parts.stiffness.clone());
        for (stop, _) in parts.stops.iter().zip(closed).filter(|(_, closed)| **closed) {
            let StopLaw::Compliant { stiffness: k, damping: c, .. } = stop.law else { continue };
            for i in 0..n {
                for j in 0..n {
                    stiffness[(i, j)] += k * stop.direction[i] * stop.direction[j];
                    damping[(i, j)] += c * stop.direction[i] * stop.direction[j];
                }
            }
        }
        let mut all = Matrix::zeros(n, n);
        for i in 0..n {
            for j in 0..n {
                all[(i, j)] = parts.mass[(i, j)] + 0.5 * h * (damping[(i, j)] + 0.5 * h * stiffness[(i, j)]);
            }
        }
        let factor = all.cholesky().unwrap();
        let columns: Vec<Vec<f64>> = Matrix::identity(n)
            .values()
            .chunks(n)
            .map(|unit| factor.solve_lower_transposed(&factor.solve_lower(unit)))
            .collect();
        let inverse = Matrix::from_rows(&columns).unwrap();
        let directions = parts.stops.iter().map(|stop| &stop.direction);
        let directions = directions.chain(parts.joints.iter().map(|joint| &joint.direction));
        let across = directions.map(|w| inverse.apply(w)).collect();
        Self { closed: closed.to_vec(), damping, stiffness, inverse, across }
    }
}

impl<'a> Stepper<'a> {
    pub(crate) fn new(machine: &'a Machine, start: &Start, h: f64) -> Self {
        let n = machine.n();
        let vector = |of: &[f64]| if of.is_empty() { vec![0.0; n] } else { of.to_vec() };
        let stops = machine.stops().len();
        let mut stepper = Self {
            machine,
            h,
            q: vector(&start.q),
            v: vector(&start.qdot),
            steps: 0,
            phase: start.phase,
            closed: vec![false; stops],
            surfaces: vec![0.0; stops],
            holds: Vec::new(),
            system: System::new(machine, h, &vec![false; stops]),
        };
        for (j, stop) in machine.stops().iter().enumerate() {
            let StopLaw::Compliant { stiffness, damping, preload, opening } = stop.law else { continue };
            let (gap, rate) = stepper.gap(stop, 0.0, &stepper.q);
            stepper.closed[j] =
                gap < 0.0 && (opening == Opening::Position || preload - stiffness * gap - damping * rate > 0.0);
            stepper.surfaces[j] = if gap < 0.0 && !stepper.closed[j] { -gap } else { 0.0 };
        }
        let slip = |joint: &vibroimpact::machine::FrictionJoint| dot(&joint.direction, &stepper.v) - joint.belt;
        stepper.holds = machine.joints().iter().map(|joint| slip(joint).abs() < 1e-12).collect();
        stepper
    }

    #[allow(clippy::cast_precision_loss, reason = "there are fewer than 2^53 steps")]
    pub(crate) fn time(&self) -> f64 {
        self.steps as f64 * self.h
    }

    /// Displacement and velocity of a stop a time after the beginning of the step.
    fn surface(&self, stop: &Stop, after: f64) -> (f64, f64) {
        let rate = self.machine.parts().frequency.unwrap_or(0.0);
        let angle = rate * (self.time() + after) + self.phase;
        stop.motion.iter().fold((0.0, 0.0), |(r, v), motion| {
            let order = f64::from(motion.order);
            let (sin, cos) = (order * angle).sin_cos();
            (r + motion.cos * cos + motion.sin * sin, v + order * rate * (motion.sin * cos - motion.cos * sin))
        })
    }

    fn gap(&self, stop: &Stop, after: f64, q: &[f64]) -> (f64, f64) {
        let (r, rate) = self.surface(stop, after);
        (stop.gap - dot(&stop.direction, q) - r, -dot(&stop.direction, &self.v) - rate)
    }

    /// Opens and closes compliant stops.
    fn switch(&mut self) {
        for (j, stop) in self.machine.stops().iter().enumerate() {
            let StopLaw::Compliant { stiffness: k, damping: c, preload: p, opening } = stop.law else { continue };
            let (gap, rate) = self.gap(stop, 0.0, &self.q);
            if self.closed[j] {
                let pulls = opening == Opening::Force && p - k * gap - c * rate < 0.0;
                if gap > 0.0 || pulls {
                    self.closed[j] = false;
                    self.surfaces[j] = if c > 0.0 && pulls { (-gap).max(0.0) } else { 0.0 };
                }
            } else {
                if self.surfaces[j] > 0.0 {
                    let offset = p / k;
                    self.surfaces[j] = ((self.surfaces[j] + offset) * (-k / c * self.h).exp() - offset).max(0.0);
                }
                if gap < -self.surfaces[j] {
                    self.closed[j] = true;
                    self.surfaces[j] = 0.0;
                }
            }
        }
        if self.system.closed != self.closed {
            self.system = System::new(self.machine, self.h, &self.closed);
        }
    }

    /// One step.
    pub(crate) fn step(&mut self) {
        self.switch();
        let (parts, h, n) = (self.machine.parts(), self.h, self.machine.n());
        let middle: Vec<f64> = self.q.iter().zip(&self.v).map(|(q, v)| q + 0.5 * h * v).collect();
        // h (f - C v - K (q + h v / 2)), at the middle of the step
        let mut force = parts.constant.clone();
        let rate = parts.frequency.unwrap_or(0.0);
        for harmonic in &parts.forces {
            let angle = f64::from(harmonic.order) * (rate * (self.time() + 0.5 * h) + self.phase);
            let (sin, cos) = angle.sin_cos();
            for (force, (a, b)) in force.iter_mut().zip(harmonic.cos.iter().zip(&harmonic.sin)) {
                *force += a * cos + b * sin;
            }
        }
        let (elastic, viscous) = (self.system.stiffness.apply(&middle), self.system.damping.apply(&self.v));
        for i in 0..n {
            force[i] -= elastic[i] + viscous[i];
        }
        // place, step of the relative velocity that is wanted, impulse
        let mut rigid: Vec<(usize, f64, f64)> = Vec::new();
        for (j, stop) in parts.stops.iter().enumerate() {
            match stop.law {
                StopLaw::Compliant { stiffness: k, damping: c, preload: p, .. } if self.closed[j] => {
                    let (r, rate) = self.surface(stop, 0.5 * h);
                    let push = k * (stop.gap - r) - c * rate - p;
                    force.iter_mut().zip(&stop.direction).for_each(|(force, w)| *force += push * w);
                }
                StopLaw::Rigid { restitution } if self.gap(stop, 0.5 * h, &middle).0 <= 0.0 => {
                    let (_, before) = self.gap(stop, 0.0, &self.q);
                    let (_, rate) = self.surface(stop, h);
                    // w.v+ is at most this
                    rigid.push((j, restitution * before.min(0.0) - rate, 0.0));
                }
                _ => {}
            }
        }
        let force: Vec<f64> = force.iter().map(|force| h * force).collect();
        let change = self.system.inverse.apply(&force);
        let mut v: Vec<f64> = self.v.iter().zip(&change).map(|(v, change)| v + change).collect();
        self.push(&mut v, &mut rigid);
        for i in 0..n {
            self.q[i] = middle[i] + 0.5 * h * v[i];
        }
        self.v = v;
        self.steps += 1;
    }

    /// The impulses of stops and joints, one after another until none changes.
    fn push(&mut self, v: &mut [f64], rigid: &mut [(usize, f64, f64)]) {
        let parts = self.machine.parts();
        let stops = parts.stops.len();
        let mut joints = vec![0.0; parts.joints.len()];
        for _ in 0..2000 {
            let mut change = 0.0_f64;
            let apply = |at: usize, by: f64, v: &mut [f64]| {
                for (v, across) in v.iter_mut().zip(&self.system.across[at]) {
                    *v -= by * across;
                }
            };
            for (j, most, impulse) in rigid.iter_mut() {
                let (w, across) = (&parts.stops[*j].direction, &self.system.across[*j]);
                let excess = dot(w, v) - *most;
                let new = (*impulse + excess / dot(w, across)).max(0.0);
                apply(*j, new - *impulse, v);
                change = change.max((new - *impulse).abs() * dot(w, across));
                *impulse = new;
            }
            for (k, joint) in parts.joints.iter().enumerate() {
                let (w, across) = (&joint.direction, &self.system.across[stops + k]);
                let wanted = joints[k] + (dot(w, v) - joint.belt) / dot(w, across);
                let bound = self.h * if self.holds[k] { joint.limit } else { joint.sliding };
                let new = if wanted.abs() <= bound { wanted } else { (self.h * joint.sliding).copysign(wanted) };
                apply(stops + k, new - joints[k], v);
                change = change.max((new - joints[k]).abs() * dot(w, across));
                joints[k] = new;
            }
            if change < 1e-14 {
                break;
            }
        }
        for (k, joint) in parts.joints.iter().enumerate() {
            self.holds[k] = (dot(&joint.direction, v) - joint.belt).abs() < 1e-10;
        }
    }
}
