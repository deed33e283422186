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

use super::{Machine, MachineParts, Stop, StopLaw};
use crate::math::{atan2, hypot, sin_cos};
use crate::system::{Oscillator, Scales, Side, Start, SystemError, phase};
use core::f64::consts::TAU;

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
/// assert_eq!((same.oscillator.beta(), same.oscillator.gap()), (1.25, 1.0));
/// assert!((same.oscillator.damping() - 0.02).abs() < 1e-17);
/// assert_eq!((same.length(), same.time(), same.sign()), (0.005, 0.05, -1.0));
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduction {
    /// The oscillator.
    pub oscillator: Oscillator,
    scales: Scales,
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

/// The numbers of a machine of one coordinate, with up to two rigid stops, from which its oscillator follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneCoordinate {
    /// Mass.
    pub mass: f64,
    /// Coefficient of the damper.
    pub damping: f64,
    /// Stiffness.
    pub stiffness: f64,
    /// Constant force.
    pub constant: f64,
    /// Angular frequency of the forcing.
    pub frequency: f64,
    /// Amplitudes of sine and cosine of the force.
    pub force: (f64, f64),
    /// The stops.
    pub stops: [Option<RigidStop>; 2],
}

/// A rigid stop of a machine of one coordinate, open while $`d - wq - r`$ is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidStop {
    /// The direction $`w`$.
    pub direction: f64,
    /// The gap $`d`$ at 0.
    pub gap: f64,
    /// Restitution in [0, 1].
    pub restitution: f64,
    /// Amplitudes of sine and cosine of its motion $`r`$.
    pub motion: (f64, f64),
}

impl Machine {
    /// The oscillator that the machine is; `None` unless it has one coordinate on a spring, forcing of order 1 alone that is not 0,
    /// one rigid stop or two on opposite sides, which move together if they move, no friction joints, and numbers that an
    /// [`Oscillator`] can have.
    #[must_use]
    pub fn reduced(&self) -> Option<Reduction> {
        OneCoordinate::of(self.parts())?.reduction().ok().flatten()
    }
}

/// The oscillators of a machine some of whose numbers vary.
#[derive(Clone, Debug)]
pub(crate) struct VariedReduction {
    numbers: OneCoordinate,
    places: Vec<usize>,
}

impl VariedReduction {
    /// The oscillators of machines with other numbers at these paths, which need no machines; `None` if a number is none of those
    /// from which the oscillator follows.
    pub(crate) fn new(machine: &Machine, paths: &[String]) -> Option<Self> {
        let (parts, numbers) = (machine.parts(), OneCoordinate::of(machine.parts())?);
        let place = |path: &String| {
            let mut changed = parts.clone();
            // one is added to the number, to see which of the list it is
            let value = parts.number(path).ok()? + 1.0;
            changed.set(path, value).ok()?;
            let (before, after) = (numbers.list(), OneCoordinate::of(&changed)?.list());
            let mut differ = (0..COUNT).filter(|k| before[*k] != after[*k]);
            // exactly one may change, and to the same value: otherwise other numbers hang on the path
            differ.next().filter(|k| differ.next().is_none() && after[*k] == value)
        };
        Some(Self { numbers, places: paths.iter().map(place).collect::<Option<_>>()? })
    }

    /// With these values of the numbers.
    pub(crate) fn at(&self, values: &[f64]) -> Option<Reduction> {
        let mut list = self.numbers.list();
        self.places.iter().zip(values).for_each(|(place, value)| list[*place] = *value);
        self.numbers.with(&list).reduction().ok().flatten()
    }
}

/// The number of [`OneCoordinate`] with two stops.
const COUNT: usize = 17;

impl OneCoordinate {
    /// Those of a machine; `None` if its coordinates, forces, stops or joints are not those of one that is an oscillator.
    #[must_use]
    pub fn of(parts: &MachineParts) -> Option<Self> {
        if parts.n() != 1 || !parts.joints.is_empty() || parts.stops.len() > 2 {
            return None;
        }
        let stop = |of: &Stop| {
            let StopLaw::Rigid { restitution } = of.law else { return None };
            let motion = first_order(of.motion.iter().map(|motion| (motion.order, motion.sin, motion.cos)))?;
            Some(RigidStop { direction: of.direction[0], gap: of.gap, restitution, motion })
        };
        let mut stops = [None; 2];
        for (place, of) in stops.iter_mut().zip(&parts.stops) {
            *place = Some(stop(of)?);
        }
        Some(Self {
            mass: parts.mass[(0, 0)],
            damping: parts.damping[(0, 0)],
            stiffness: parts.stiffness[(0, 0)],
            constant: parts.constant[0],
            frequency: parts.frequency?,
            force: first_order(parts.forces.iter().map(|force| (force.order, force.sin[0], force.cos[0])))?,
            stops,
        })
    }

    /// All numbers; 0 for those of stops that are not there.
    fn list(&self) -> [f64; COUNT] {
        let mut list = [0.0; COUNT];
        let (one, stops) = list.split_at_mut(7);
        one.copy_from_slice(&[
            self.mass,
            self.damping,
            self.stiffness,
            self.constant,
            self.frequency,
            self.force.0,
            self.force.1,
        ]);
        for (own, stop) in stops.chunks_mut(5).zip(self.stops.iter().flatten()) {
            own.copy_from_slice(&[stop.direction, stop.gap, stop.restitution, stop.motion.0, stop.motion.1]);
        }
        list
    }

    /// The same stops with other numbers.
    fn with(&self, list: &[f64; COUNT]) -> Self {
        let (one, stops) = list.split_at(7);
        let mut changed = Self {
            mass: one[0],
            damping: one[1],
            stiffness: one[2],
            constant: one[3],
            frequency: one[4],
            force: (one[5], one[6]),
            stops: self.stops,
        };
        for (stop, of) in changed.stops.iter_mut().flatten().zip(stops.chunks(5)) {
            *stop = RigidStop { direction: of[0], gap: of[1], restitution: of[2], motion: (of[3], of[4]) };
        }
        changed
    }

    /// The motion of the stops, and those of the sides above and below with their restitutions; `None` if they are not those of an
    /// oscillator.
    #[allow(clippy::type_complexity, reason = "it is taken apart where it is returned")]
    fn walls(&self) -> Option<((f64, f64), [Option<(Wall, f64)>; 2])> {
        let mut walls: [Option<(Wall, f64)>; 2] = [None, None];
        let mut swing: Option<(f64, f64)> = None;
        for (stop, of) in self.stops.iter().flatten().enumerate() {
            let w = of.direction;
            // s = -r/w
            let own = (-of.motion.0 / w, -of.motion.1 / w);
            // equal to the last bit, or their distance would not be constant
            if *swing.get_or_insert(own) != own {
                return None;
            }
            let wall = Wall { stop, at: of.gap / w, direction: w.abs() };
            // two stops on one side: the farther one is never reached, and the oscillator has no place for it
            if walls[usize::from(w < 0.0)].replace((wall, of.restitution)).is_some() {
                return None;
            }
        }
        Some((swing?, walls))
    }

    /// The oscillator that a machine with these numbers is, as [`Machine::reduced`] says; `None` if it is none.
    ///
    /// # Errors
    /// [`SystemError`] names the number that no oscillator has.
    pub fn reduction(&self) -> Result<Option<Reduction>, SystemError> {
        let Self { mass: m, damping: c, stiffness: k, frequency, force, .. } = *self;
        // a single stop is the upper one: below, the machine is mirrored
        let (swing, sign, first, second) = match self.walls() {
            // also if a number is none
            _ if !(m > 0.0 && k > 0.0) => return Ok(None),
            Some((swing, [Some(above), below])) => (swing, 1.0, above, below),
            Some((swing, [None, Some(below)])) => (swing, -1.0, below, None),
            _ => return Ok(None),
        };
        // k - m omega^2 + i omega c, the complex stiffness by which the motion of the stops adds to the force
        let (re, im) = (k - m * frequency * frequency, frequency * c);
        let drive =
            (sign * (force.0 - (re * swing.0 - im * swing.1)), sign * (force.1 - (re * swing.1 + im * swing.0)));
        // a force in phase with the sine, which most have, needs no roots and no angles: they are these to the last bit
        let (amplitude, phase) =
            if drive.1 == 0.0 && drive.0 > 0.0 { drive } else { (hypot(drive.0, drive.1), atan2(drive.1, drive.0)) };
        let natural = (k / m).sqrt();
        let (scales, offset) = (Scales { length: amplitude / k, time: 1.0 / natural, mass: m }, self.constant / k);
        // without a force there is no unit of length; quotients of valid numbers can overflow or underflow
        for (name, value) in [("F/k", scales.length), ("omega_n", natural), ("1/omega_n", scales.time)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SystemError::Scaling { name, value });
            }
        }
        let gap = |wall: &Wall, side: f64| side * (wall.at - offset) / scales.length;
        let mut oscillator = Oscillator::new(frequency / natural, gap(&first.0, sign), first.1)?
            // not the root of the product, which can overflow or underflow although both numbers are valid
            .with_damping(c / (2.0 * (k.sqrt() * m.sqrt())))?;
        if let Some((wall, restitution)) = &second {
            oscillator = oscillator.with_second_stop(gap(wall, -1.0), *restitution)?;
        }
        Ok(Some(Reduction {
            oscillator,
            scales,
            phase,
            offset,
            sign,
            frequency,
            swing,
            upper: first.0,
            lower: second.map(|(wall, _)| wall),
        }))
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
    /// The same with this damping ratio, where it is known better than from the coefficient, which is rounded.
    ///
    /// # Errors
    /// [`SystemError::Damping`] for a ratio that no oscillator has.
    pub fn with_damping(self, zeta: f64) -> Result<Self, SystemError> {
        Ok(Self { oscillator: self.oscillator.with_damping(zeta)?, ..self })
    }

    /// The units of the oscillator in those of the machine.
    #[must_use]
    pub const fn scales(&self) -> Scales {
        self.scales
    }

    /// The unit of length $`|\hat F|/k`$ in that of the machine.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.scales.length
    }

    /// The unit of time $`\sqrt{m/k}`$ in that of the machine.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.scales.time
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

    /// The mass of the machine.
    pub(crate) const fn mass(&self) -> f64 {
        self.scales.mass
    }

    /// The period of the forcing in the unit of time of the machine.
    pub(crate) fn period(&self) -> f64 {
        TAU / self.frequency
    }

    /// The side of a stop of the machine.
    pub(crate) fn side(&self, stop: usize) -> Option<Side> {
        [Side::Upper, Side::Lower].into_iter().find(|side| self.stop(*side) == Some(stop))
    }

    /// Whether the stops of another reduction of the same machine have the same sides.
    pub(crate) fn same_sides(&self, other: &Self) -> bool {
        let stops = |of: &Self| [Side::Upper, Side::Lower].map(|side| of.stop(side));
        self.sign == other.sign && stops(self) == stops(other)
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
        speed * self.scales.velocity() * self.wall(side).map_or(1.0, |wall| wall.direction)
    }

    /// The speed with which the mass of the oscillator arrives on a side, where the machine's stop closes with `speed`.
    pub(crate) fn arrival(&self, side: Side, speed: f64) -> f64 {
        speed / (self.scales.velocity() * self.wall(side).map_or(1.0, |wall| wall.direction))
    }

    /// The motion $`s`$ of the stops at a phase of the machine, and its rate.
    fn swing(&self, phase: f64) -> (f64, f64) {
        if self.swing == (0.0, 0.0) {
            return (0.0, 0.0);
        }
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
        let mut x = self.sign * (q - swing - self.offset) / self.scales.length;
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
        let v = self.sign * (qdot - rate) / self.scales.velocity();
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
        let q = standing.unwrap_or(self.sign * self.scales.length * at.x + self.offset) + swing;
        (q, self.sign * self.scales.velocity() * at.v + rate, phase)
    }
}
