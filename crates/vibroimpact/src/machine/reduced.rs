//! A machine that is an oscillator: one coordinate on a spring, one harmonic, one or two rigid stops.
//!
//! $$`m\ddot q + c\dot q + kq = f_0 + a\cos\theta + b\sin\theta, \qquad w_jq < d_j - r_j(\theta), \qquad \theta = \omega t + \varphi_0.`$$
//!
//! Stops that move move together, by $`s = -r_j/w_j`$. The distance $`z = q - s - f_0/k`$ from the equilibrium between them obeys
//! the equation of a machine whose stops stand still,
//!
//! $$`m\ddot z + c\dot z + kz = \operatorname{Im}\,\hat F e^{i\theta}, \qquad w_jz < d_j - w_jf_0/k,`$$
//! $$`\hat F = b + ia - (k - m\omega^2 + i\omega c)(s_s + is_c), \qquad s = s_s\sin\theta + s_c\cos\theta.`$$
//!
//! The unit of length is $`|\hat F|/k`$, that of time $`\sqrt{m/k}`$. A single stop is the upper one, so that a machine whose
//! stop lies below is mirrored; of two the upper one has the positive direction. In a machine of unit mass, stiffness and force
//! alone no number changes, not by its last bit.

use super::{Machine, StopLaw};
use crate::math::{atan2, hypot, sin_cos};
use crate::system::{Oscillator, Side, Start, phase};

/// A start that is nearer to a stop than this part of the lengths is on it.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// The oscillator that a machine is, and how its numbers are converted to those of the machine.
///
/// ```
/// use vibroimpact::machine::{Machine, MachineParts};
/// // a body of 2 kg on a spring of 800 N/m, with a wall 5 mm below, under 4 N at 25 rad/s
/// let parts = MachineParts::new(["body"])
///     .with_mass(0, 2.0)
///     .with_link(&[1.0], 800.0, 1.6)
///     .with_frequency(25.0)
///     .with_force(0, 1, 0.0, 4.0)
///     .with_rigid_stop("wall", &[-1.0], 0.005, 0.5);
/// let same = Machine::new(parts)?.reduced().unwrap();
/// assert_eq!((same.oscillator.beta(), same.oscillator.damping(), same.oscillator.gap()), (1.25, 0.02, 1.0));
/// assert_eq!((same.length(), same.time(), same.sign()), (0.005, 0.05, -1.0));
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduction {
    /// The oscillator.
    pub oscillator: Oscillator,
    length: f64,
    time: f64,
    phase: f64,
    offset: f64,
    sign: f64,
    frequency: f64,
    /// The motion of the stops: amplitudes of sine and cosine.
    swing: (f64, f64),
    upper: Wall,
    lower: Option<Wall>,
}

/// A stop of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wall {
    /// Its number.
    stop: usize,
    /// Where it stands when the stops do not swing: $`d/w`$.
    at: f64,
    /// The length of its direction.
    direction: f64,
}

impl Machine {
    /// The oscillator that the machine is; `None` unless it has one coordinate on a spring, forcing of order 1 alone that is not 0,
    /// one rigid stop or two on opposite sides, which move together if they move, no friction joints, and numbers that an
    /// [`Oscillator`] can have.
    #[must_use]
    pub fn reduced(&self) -> Option<Reduction> {
        let parts = self.parts();
        if self.n() != 1 || !parts.joints.is_empty() {
            return None;
        }
        let (m, c, k) = (parts.mass[(0, 0)], parts.damping[(0, 0)], parts.stiffness[(0, 0)]);
        let frequency = parts.frequency.filter(|_| k > 0.0)?;
        let force = first_order(parts.forces.iter().map(|force| (force.order, force.sin[0], force.cos[0])))?;
        let mut walls: [Option<(Wall, f64)>; 2] = [None, None];
        let mut swing: Option<(f64, f64)> = None;
        for (stop, of) in parts.stops.iter().enumerate() {
            let (StopLaw::Rigid { restitution }, w) = (of.law, of.direction[0]) else { return None };
            let moved = first_order(of.motion.iter().map(|motion| (motion.order, motion.sin, motion.cos)))?;
            let own = (-moved.0 / w, -moved.1 / w);
            if *swing.get_or_insert(own) != own {
                return None;
            }
            let wall = Wall { stop, at: of.gap / w, direction: w.abs() };
            if walls[usize::from(w < 0.0)].replace((wall, restitution)).is_some() {
                return None;
            }
        }
        let swing = swing?;
        let [above, below] = walls;
        let (sign, first, second) = if above.is_some() { (1.0, above?, below) } else { (-1.0, below?, None) };
        let (re, im) = (k - m * frequency * frequency, frequency * c);
        let drive =
            (sign * (force.0 - (re * swing.0 - im * swing.1)), sign * (force.1 - (re * swing.1 + im * swing.0)));
        let amplitude = hypot(drive.0, drive.1);
        let (length, time, offset) = (amplitude / k, (m / k).sqrt(), parts.constant[0] / k);
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let gap = |wall: &Wall, side: f64| side * (wall.at - offset) / length;
        let oscillator = Oscillator::new(frequency * time, gap(&first.0, sign), first.1).ok()?;
        let mut oscillator = oscillator.with_damping(0.5 * c / (k * m).sqrt()).ok()?;
        if let Some((wall, restitution)) = &second {
            oscillator = oscillator.with_second_stop(gap(wall, -1.0), *restitution).ok()?;
        }
        Some(Reduction {
            oscillator,
            length,
            time,
            phase: atan2(drive.1, drive.0),
            offset,
            sign,
            frequency,
            swing,
            upper: first.0,
            lower: second.map(|(wall, _)| wall),
        })
    }
}

/// The amplitudes of sine and cosine of harmonics that are all of order 1, or 0; `None` if one is not.
fn first_order(all: impl Iterator<Item = (u32, f64, f64)>) -> Option<(f64, f64)> {
    let mut sum = (0.0, 0.0);
    for (order, sin, cos) in all.filter(|(_, sin, cos)| *sin != 0.0 || *cos != 0.0) {
        if order != 1 {
            return None;
        }
        sum = (sum.0 + sin, sum.1 + cos);
    }
    Some(sum)
}

impl Reduction {
    /// The unit of length $`|\hat F|/k`$ in that of the machine.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.length
    }

    /// The unit of time $`\sqrt{m/k}`$ in that of the machine.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.time
    }

    /// The phase of the oscillator at phase 0 of the machine, in radians.
    #[must_use]
    pub const fn phase(&self) -> f64 {
        self.phase
    }

    /// The coordinate of the equilibrium under the constant force.
    #[must_use]
    pub const fn offset(&self) -> f64 {
        self.offset
    }

    /// 1, or -1 if positions are mirrored.
    #[must_use]
    pub const fn sign(&self) -> f64 {
        self.sign
    }

    /// The number of the stop on that side; `None` if there is none.
    #[must_use]
    pub fn stop(&self, side: Side) -> Option<usize> {
        self.wall(side).map(|wall| wall.stop)
    }

    fn wall(&self, side: Side) -> Option<&Wall> {
        if side == Side::Upper { Some(&self.upper) } else { self.lower.as_ref() }
    }

    /// The speed of closing of the machine's stop on that side, where the mass of the oscillator arrives with `speed`.
    #[must_use]
    pub fn speed(&self, side: Side, speed: f64) -> f64 {
        speed * (self.length / self.time) * self.wall(side).map_or(1.0, |wall| wall.direction)
    }

    /// The motion $`s`$ of the stops at a phase of the machine, and its rate.
    fn swing(&self, phase: f64) -> (f64, f64) {
        let (sin, cos) = sin_cos(phase);
        let (of_sin, of_cos) = self.swing;
        (of_sin * sin + of_cos * cos, self.frequency * (of_sin * cos - of_cos * sin))
    }

    /// The start of the oscillator at a coordinate, velocity and phase of the machine. What is on a stop to rounding is on it
    /// exactly. `None` beyond a stop, and where a number is too large.
    #[must_use]
    pub fn start(&self, q: f64, qdot: f64, phase: f64) -> Option<Start> {
        if !(-phase::LARGEST..=phase::LARGEST).contains(&phase) {
            return None;
        }
        let phase = phase::wrap(phase);
        let (swing, rate) = self.swing(phase);
        let mut x = self.sign * (q - swing - self.offset) / self.length;
        for (side, stop) in self.oscillator.stops() {
            let wall = self.wall(side)?;
            let room = side.sign() * self.sign * (wall.at + swing - q);
            if room.abs() <= ROUNDED * (wall.at.abs() + swing.abs() + q.abs()) {
                x = side.sign() * stop.gap;
            } else if room > 0.0 {
                // the gap of the oscillator has a rounding error of its own
                x = if side == Side::Upper { x.min(stop.gap) } else { x.max(-stop.gap) };
            }
        }
        let v = self.sign * (qdot - rate) / (self.length / self.time);
        Start::new(&self.oscillator, x, v, phase + self.phase).ok()
    }

    /// The coordinate, velocity and phase of the machine at a state of the oscillator. What is on a stop is on that of the
    /// machine to rounding.
    #[must_use]
    pub fn state(&self, at: Start) -> (f64, f64, f64) {
        let phase = phase::wrap(at.phase - self.phase);
        let (swing, rate) = self.swing(phase);
        let on = self.oscillator.stops().find(|(side, stop)| at.x == side.sign() * stop.gap);
        let standing = on.and_then(|(side, _)| self.wall(side)).map(|wall| wall.at);
        let q = standing.unwrap_or(self.sign * self.length * at.x + self.offset) + swing;
        (q, self.sign * (self.length / self.time) * at.v + rate, phase)
    }
}
