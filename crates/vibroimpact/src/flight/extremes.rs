//! The largest and smallest position, and the largest speed and acceleration of a flight.
//!
//! A function $`f`$ with $`|f'''| \le B`$ satisfies $`f(s+r) \le f + f'r + f''r^2/2 + Br^3/6`$. An interval over which
//! this bound does not exceed the largest value so far is left out. In the others a maximum is approached by Newton's
//! method. Around it, on each side as far as $`f'r + f''r^2/2 + Br^3/6 \le 0`$, no value is larger, and what remains
//! is searched again. So no maximum is missed, and only a few points about each one are computed.
//!
//! Most of a long motion is left out by a simpler bound: the energy radius $`\sqrt{x^2+v^2}`$ grows at most at the rate
//! 1 ([`bounds`](super::bounds)).

use super::bounds::{Window, radius};
use super::{Flight, FlightPoint};

/// An extreme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// The smallest position.
    Lowest,
    /// The largest position.
    Highest,
    /// The largest speed.
    Speed,
    /// The largest absolute value of the acceleration.
    Acceleration,
}

/// The extremes over a flight, or over several flights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// The smallest position.
    pub lowest: f64,
    /// The largest position.
    pub highest: f64,
    /// The largest speed.
    pub speed: f64,
    /// The largest absolute value of the acceleration.
    pub acceleration: f64,
    /// Which of them are searched for; the others are those of a few points.
    sought: [bool; 4],
    /// The positions between which the flights are known to stay.
    room: (f64, f64),
}

impl Default for Extremes {
    /// Those of no flight: an empty range of positions, and zero.
    fn default() -> Self {
        Self {
            lowest: f64::INFINITY,
            highest: f64::NEG_INFINITY,
            speed: 0.0,
            acceleration: 0.0,
            sought: [true; 4],
            room: (f64::NEG_INFINITY, f64::INFINITY),
        }
    }
}

/// Accuracy of an extreme, relative to the size of the motion.
const ACCURACY: f64 = 4.0 * f64::EPSILON;
/// The largest number of steps of Newton's method.
const STEPS: u32 = 4;

/// A function whose maximum is an extreme.
#[derive(Clone, Copy)]
struct Target {
    extreme: Extreme,
    sign: f64,
}

const TARGETS: [Target; 6] = [
    Target { extreme: Extreme::Lowest, sign: -1.0 },
    Target { extreme: Extreme::Highest, sign: 1.0 },
    Target { extreme: Extreme::Speed, sign: -1.0 },
    Target { extreme: Extreme::Speed, sign: 1.0 },
    Target { extreme: Extreme::Acceleration, sign: -1.0 },
    Target { extreme: Extreme::Acceleration, sign: 1.0 },
];

/// A level that a function would have to exceed to change an extreme; infinite if the extreme is not searched for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ceiling {
    /// Which derivative of the position the function is: 0, 1 or 2.
    pub(crate) derivative: usize,
    /// 1, or -1 for the function with the opposite sign.
    pub(crate) sign: f64,
    pub(crate) level: f64,
}

impl Ceiling {
    /// None at all.
    pub(crate) const NONE: Self = Self { derivative: 0, sign: 1.0, level: f64::INFINITY };
}

/// A function at a point: its value and derivatives, a bound of its third derivative around, and a difference in value
/// that does not matter.
#[derive(Clone, Copy)]
struct Local {
    value: f64,
    first: f64,
    second: f64,
    bound: f64,
    small: f64,
}

impl Local {
    /// The largest value of the quadratic part over the next `h`, and where that is.
    fn highest(&self, h: f64) -> (f64, f64) {
        let at = |s: f64| self.value + s * (self.first + 0.5 * self.second * s);
        // the vertex of the parabola; beyond the interval, or below, one of the ends is higher
        let peak = -self.first / self.second;
        let inside = self.second < 0.0 && peak > 0.0 && peak < h;
        let ends = if at(h) > self.value { (at(h), h) } else { (self.value, 0.0) };
        if inside { (at(peak), peak) } else { ends }
    }

    /// Whether the slope is that of a maximum, up to a difference in value that does not matter.
    fn flat(&self) -> bool {
        self.second < 0.0 && self.first * self.first <= -self.second * self.small
    }

    /// A distance before (`side` -1) or after this point (1) within which no value is larger.
    fn clear(&self, side: f64) -> f64 {
        let slope = side * self.first;
        // it rises in this direction: only next to a maximum no value is larger
        if slope > 0.0 {
            // f''r^2/2 + B r^3/6 <= f''r^2/4 up to here, which the slope exceeds by slope^2/|f''| at most
            return if self.flat() { -1.5 * self.second / self.bound } else { 0.0 };
        }
        // the positive zero of slope + f''r/2 + B r^2/6
        let (half, c) = (0.5 * self.second, self.bound / 6.0);
        let root = (half * half - 4.0 * c * slope).sqrt();
        // the form in which nothing cancels
        if half > 0.0 { -2.0 * slope / (half + root) } else { (root - half) / (2.0 * c) }
    }
}

/// A part of a flight over which the bounds hold.
struct Piece<'a> {
    flight: &'a Flight,
    /// Bounds of the third derivatives of position, velocity and acceleration,
    bounds: [f64; 3],
    /// and differences in their values that do not matter.
    small: [f64; 3],
}

impl Piece<'_> {
    fn local(&self, point: &FlightPoint, Target { extreme, sign }: Target) -> Local {
        let (k, value, first, second) = match extreme {
            Extreme::Lowest | Extreme::Highest => (0, point.x, point.v, point.a),
            Extreme::Speed => (1, point.v, point.a, point.j),
            Extreme::Acceleration => {
                let (beta, zeta2) = (self.flight.response().beta(), 2.0 * self.flight.response().damping());
                let force = point.a + point.x + zeta2 * point.v;
                (2, point.a, point.j, -beta * beta * force - point.a - zeta2 * point.j)
            }
        };
        let (bound, small) = (self.bounds[k], self.small[k]);
        Local { value: sign * value, first: sign * first, second: sign * second, bound, small }
    }
}

impl Extremes {
    /// Those of no flight, for these extremes alone. The other ones are not searched for, which saves time.
    #[must_use]
    pub fn only(sought: &[Extreme]) -> Self {
        let mut none = Self { sought: [false; 4], ..Self::default() };
        for extreme in sought {
            none.sought[*extreme as usize] = true;
        }
        none
    }

    /// The same for flights that are known to stay between these positions, so that nothing beyond is searched for.
    #[must_use]
    pub const fn within(self, lowest: f64, highest: f64) -> Self {
        Self { room: (lowest, highest), ..self }
    }

    /// Whether an extreme is searched for.
    pub(crate) fn any(&self) -> bool {
        self.sought != [false; 4]
    }

    /// Includes the first `duration` of a flight.
    pub fn add(&mut self, flight: &Flight, duration: f64) {
        if self.any() {
            self.add_between(flight, 0.0, duration);
        }
    }

    /// Includes the part of a flight from the time `begin` to the time `end`.
    pub(crate) fn add_between(&mut self, flight: &Flight, mut begin: f64, end: f64) {
        // over longer windows the bounds are too wide to leave anything out
        let most = 1.5 / (1.0 + flight.fastest);
        self.include_point(&flight.at(end));
        while begin < end {
            let (point, rest) = (flight.at(begin), end - begin);
            self.include_point(&point);
            let quiet = self.quiet(flight, &point);
            let length = quiet.max(most).min(rest);
            if quiet < length {
                self.all(flight, begin, &point, length);
            }
            // exactly the end: a sum of lengths would have rounding errors
            begin = if length < rest { begin + length } else { end };
        }
    }

    /// Includes a position at which the mass rests.
    pub fn rest(&mut self, x: f64) {
        self.lowest = self.lowest.min(x);
        self.highest = self.highest.max(x);
    }

    fn include_point(&mut self, point: &FlightPoint) {
        self.rest(point.x);
        self.speed = self.speed.max(point.v.abs());
        self.acceleration = self.acceleration.max(point.a.abs());
    }

    /// The level of every target.
    pub(crate) fn ceilings(&self) -> [Ceiling; TARGETS.len()] {
        TARGETS.map(|target| {
            let derivative = match target.extreme {
                Extreme::Lowest | Extreme::Highest => 0,
                Extreme::Speed => 1,
                Extreme::Acceleration => 2,
            };
            Ceiling { derivative, sign: target.sign, level: self.best(target, 0.0) }
        })
    }

    /// The largest value of a target so far; infinite if nothing larger is searched for or possible.
    fn best(&self, Target { extreme, .. }: Target, small: f64) -> f64 {
        let (best, most) = match extreme {
            Extreme::Lowest => (-self.lowest, -self.room.0),
            Extreme::Highest => (self.highest, self.room.1),
            Extreme::Speed => (self.speed, f64::INFINITY),
            Extreme::Acceleration => (self.acceleration, f64::INFINITY),
        };
        if self.sought[extreme as usize] && best + small < most { best } else { f64::INFINITY }
    }

    /// A time after a point in which no extreme is exceeded, because the energy radius grows at most at the rate 1. The
    /// acceleration is at most $`1 + (1 + 2\zeta)r`$.
    fn quiet(&self, flight: &Flight, point: &FlightPoint) -> f64 {
        let r = radius(point.x, point.v);
        let left = |target: &Target| match target.extreme {
            Extreme::Acceleration => (self.best(*target, 0.0) - 1.0) / (1.0 + 2.0 * flight.response().damping()) - r,
            _ => self.best(*target, ACCURACY * r) - r,
        };
        TARGETS.iter().map(left).fold(f64::INFINITY, f64::min)
    }

    /// Includes the interval of length `h` that begins at the time `s`, at `point`.
    fn all(&mut self, flight: &Flight, s: f64, point: &FlightPoint, h: f64) {
        let zeta2 = 2.0 * flight.response().damping();
        let r = radius(point.x, point.v);
        let window = Window::new(flight, r, point.v.abs(), h);
        // relative to the largest values so far: at rest in the middle the radius itself is 0
        let size = r.max(self.speed).max(self.highest.abs()).max(self.lowest.abs());
        let small = ACCURACY * size;
        let piece = Piece {
            flight,
            bounds: [window.b3, window.b4(flight), window.b5(flight)],
            small: [small, small, ACCURACY * (1.0 + size + zeta2 * point.v.abs())],
        };
        for target in TARGETS {
            self.search(&piece, target, (s, point), h);
        }
    }

    /// Searches the interval of length `h` that begins at this time and point for larger values of the target.
    fn search(&mut self, piece: &Piece<'_>, target: Target, (s, point): (f64, &FlightPoint), h: f64) {
        let begin = piece.local(point, target);
        let (most, place) = begin.highest(h);
        let error = begin.bound * h * h * h / 6.0;
        if most + error <= self.best(target, begin.small) + begin.small {
            return;
        }
        let (peak, local) = if place > 0.0 { self.climb(piece, target, s, h, place) } else { (0.0, begin) };
        // below this error the quadratic part has the maximum itself
        if error <= begin.small {
            return;
        }
        let (before, after) = (local.clear(-1.0).min(peak), local.clear(1.0).min(h - peak));
        // where a maximum is too flat for these distances, the interval is halved
        let (first, next) = if before + after < 0.25 * h { (0.5 * h, 0.5 * h) } else { (peak - before, peak + after) };
        if first > 0.0 {
            self.search(piece, target, (s, point), first);
        }
        if next < h {
            let point = piece.flight.at(s + next);
            self.include_point(&point);
            self.search(piece, target, (s + next, &point), h - next);
        }
    }

    /// Approaches a maximum of the target in the interval of length `h` from the time `s`, beginning at `place`; returns
    /// the last place and the function there.
    fn climb(&mut self, piece: &Piece<'_>, target: Target, s: f64, h: f64, mut place: f64) -> (f64, Local) {
        let mut steps = 0;
        loop {
            let point = piece.flight.at(s + place);
            self.include_point(&point);
            let local = piece.local(&point, target);
            // Newton's method for a zero of the slope
            let next = (place - local.first / local.second).clamp(0.0, h);
            steps += 1;
            if steps > STEPS || local.second >= 0.0 || local.flat() || next == place {
                return (place, local);
            }
            place = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Oscillator, Start};

    /// Against the largest of very many points of the flight, from above, and to within their spacing.
    #[test]
    fn nothing_exceeds_the_extremes() {
        for (beta, zeta) in [(0.05, 0.0), (0.7, 0.02), (1.0, 0.0), (1.0, 0.5), (2.3, 0.1), (11.0, 0.0), (0.4, 20.0)] {
            let osc = Oscillator::new(beta, 9.0, 0.5).unwrap().with_damping(zeta).unwrap();
            for (x, v, phase) in [(0.0, 0.0, 0.0), (0.7, -1.1, 4.0), (-2.0, 0.3, 1.0), (1e-3, 1e-3, 6.0)] {
                let flight = Flight::new(&osc, Start { x, v, phase });
                for duration in [1e-6, 0.4, 3.0, 25.0] {
                    let mut found = Extremes::default();
                    found.add(&flight, duration);
                    let mut seen = Extremes::default();
                    for k in 0..=20_000 {
                        seen.include_point(&flight.at(duration * f64::from(k) / 20_000.0));
                    }
                    let spacing = (1.0 + flight.fastest) * duration / 20_000.0;
                    for (found, seen) in [
                        (-found.lowest, -seen.lowest),
                        (found.highest, seen.highest),
                        (found.speed, seen.speed),
                        (found.acceleration, seen.acceleration),
                    ] {
                        let scale = 1.0 + seen.abs();
                        assert!(found >= seen - 1e-14 * scale, "beta {beta} zeta {zeta} {duration}: {found} {seen}");
                        assert!(found <= seen + (1.0 + beta + zeta).powi(3) * spacing * spacing * scale + 1e-14);
                    }
                }
            }
        }
    }

    /// The steady response at resonance with damping 1/4 is -2 cos(s), which has all extremes inside the flight.
    #[test]
    fn extremes_of_a_sine_are_right_to_rounding() {
        let osc = Oscillator::new(1.0, 5.0, 0.5).unwrap().with_damping(0.25).unwrap();
        let (begin, pi) = (0.3_f64, core::f64::consts::PI);
        let start = Start { x: -2.0 * begin.cos(), v: 2.0 * begin.sin(), phase: begin };
        let mut found = Extremes::default();
        found.add(&Flight::new(&osc, start), 2.0 * pi);
        for value in [-found.lowest, found.highest, found.speed, found.acceleration] {
            assert!((value - 2.0).abs() < 4e-15, "{found:?}");
        }
    }
}
