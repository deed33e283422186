//! Sums over the parts of a motion, and the quantities from them.

use super::sums::{Sum, Sums};
use super::{Quantity, Segment};
use crate::contact::mirrored;
use crate::flight::{Extreme, Extremes, FlightIntegrals};
use crate::lanes::{Panels, add_extremes, add_integrals};
use crate::math::sin_cos;
use crate::system::{Oscillator, Side, Start};
use core::f64::consts::TAU;

/// The quantities of a motion, nondimensional. A quantity that is not defined is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantities([f64; Quantity::ALL.len()]);

impl Quantities {
    /// The value of a quantity; NaN if it is not defined for this motion, and for those that only parts of machines have.
    #[must_use]
    pub const fn get(&self, quantity: Quantity) -> f64 {
        if (quantity as usize) < self.0.len() { self.0[quantity as usize] } else { f64::NAN }
    }

    /// All quantities with their values.
    pub fn iter(&self) -> impl Iterator<Item = (Quantity, f64)> {
        Quantity::ALL.into_iter().zip(self.0)
    }

    /// From a function that gives the value of each quantity.
    pub(super) fn from_fn(value: impl Fn(Quantity) -> f64) -> Self {
        Self(Quantity::ALL.map(value))
    }
}

/// The longest time in flight, in units of the fastest change of a flight, over which integrals and extremes are
/// computed, and the time that each impact adds to it. They need a few steps for each unit, so the integrals of a cycle
/// at a frequency ratio below 2e-4 would take more than 10 ms.
const LONGEST: f64 = 3e4;
const EACH_IMPACT: f64 = 100.0;

/// Sums over the parts of a motion. Integrals and extremes are NaN if its flights are longer in total than
/// $`3\cdot 10^4 + 100\,m`$ units of $`1/\max(\beta, 1 + 2\zeta)`$ after $`m`$ impacts; sums over impacts are not.
#[derive(Clone, Debug)]
pub struct Tally<'a> {
    osc: &'a Oscillator,
    /// Whether each quantity is computed; sums over impacts always are.
    asked: [bool; Quantity::ALL.len()],
    flown: f64,
    /// Whether a flight was left out of the integrals and extremes.
    skipped: bool,
    /// `None` if no quantity needs them.
    integrals: Option<FlightIntegrals>,
    extremes: Extremes,
    /// The responses at the points of the flights.
    panels: Panels,
    /// All other sums.
    sums: Sums,
    fastest: f64,
    hardest: f64,
}

impl<'a> Tally<'a> {
    /// Empty sums.
    #[must_use]
    pub fn new(osc: &'a Oscillator) -> Self {
        Self::of_only(osc, &Quantity::ALL)
    }

    /// Empty sums for the quantities that are asked for; only the integrals and extremes that these need are computed.
    /// All other quantities but sums over impacts are NaN.
    #[must_use]
    pub fn of_only(osc: &'a Oscillator, asked: &[Quantity]) -> Self {
        let extremes: Vec<Extreme> = asked.iter().flat_map(|quantity| quantity.extremes()).copied().collect();
        let integrals = asked.iter().any(|quantity| quantity.of_integrals());
        Self {
            osc,
            asked: Quantity::ALL.map(|quantity| quantity.of_impacts() || asked.contains(&quantity)),
            flown: 0.0,
            skipped: false,
            integrals: integrals.then(FlightIntegrals::default),
            extremes: Extremes::only(&extremes),
            panels: Panels::default(),
            sums: Sums::default(),
            fastest: 0.0,
            hardest: 0.0,
        }
    }

    /// The same for a motion that does not pass through a stop, so that no position beyond is searched for.
    #[must_use]
    pub fn between_stops(self) -> Self {
        let (lowest, highest) = Start::room(self.osc);
        Self { extremes: self.extremes.within(lowest, highest), ..self }
    }

    /// Whether more than the duration of a flight is needed.
    pub(super) fn flights(&self) -> bool {
        self.integrals.is_some() || self.extremes.any()
    }

    /// Adds a part of the motion.
    pub fn add(&mut self, segment: &Segment) {
        self.pass(segment.duration());
        match *segment {
            Segment::Flight { flight, duration } => {
                // in units of the fastest change
                self.flown += duration * self.osc.beta().max(1.0 + 2.0 * self.osc.damping());
                self.skipped |= self.flown > LONGEST + EACH_IMPACT * self.sums[Sum::Impacts];
                if !self.skipped {
                    if let Some(integrals) = &mut self.integrals {
                        add_integrals(integrals, &self.panels, &flight, duration);
                    }
                    add_extremes(&mut self.extremes, &self.panels, &flight, duration);
                }
            }
            Segment::Impact { side, speed } => self.impact(side, speed),
            Segment::Chatter { side, phase, rebound, duration } => self.chatter(side, phase, rebound, duration),
            Segment::Rest { side, duration, .. } => {
                self.sums[Sum::Resting] += duration;
                self.hold(side, duration);
            }
        }
    }

    fn impact(&mut self, side: Side, speed: f64) {
        let rebound = self.osc.stop(side).map_or(0.0, |stop| stop.rebound(speed));
        self.sums[Sum::Impacts] += 1.0;
        self.sums[Sum::Speeds] += speed;
        self.fastest = self.fastest.max(speed);
        self.sums[Sum::Impulse] += speed + rebound;
        self.hardest = self.hardest.max(speed + rebound);
        // half the difference of the squares, as a product in which nothing cancels
        self.sums[Sum::ImpactLoss] += 0.5 * (speed - rebound) * (speed + rebound);
    }

    /// The rest of a chatter. Over a flight of it with the rebound speed $`w`$, to leading order in $`w`$, the mass
    /// moves as $`-ws + as^2/2`$ with the acceleration $`a = \sin\theta - \delta`$ into the stop. So the damper takes
    /// $`\tfrac43\zeta w^3/a`$ and the force does the work $`\tfrac23\beta\cos\theta\,w^3/a^2`$. The speeds are
    /// $`w\varepsilon^k`$, whose cubes have the sum $`w^3/(1-\varepsilon^3)`$. The next terms are smaller by the factor
    /// $`w/a`$, of the order $`10^{-4}`$, and $`w^3`$ itself is of the order $`10^{-12}`$.
    fn chatter(&mut self, side: Side, phase: f64, rebound: f64, duration: f64) {
        let Some(stop) = self.osc.stop(side) else { return };
        let (sin, cos) = sin_cos(mirrored(side, phase));
        let (beta, zeta, eps) = (self.osc.beta(), self.osc.damping(), stop.restitution);
        let a = sin - stop.gap;
        let k = rebound / a;
        let cubes = rebound * k / (1.0 - eps * eps * eps);
        let v_squared = 2.0 / 3.0 * rebound * cubes;
        let work = 2.0 / 3.0 * beta * cos * k * cubes;
        if let Some(integrals) = &mut self.integrals {
            integrals.v_squared += v_squared;
            integrals.work += work;
        }
        // the mass is at rest at the end, so all its energy is lost
        self.sums[Sum::ImpactLoss] += 0.5 * rebound * rebound + work - 2.0 * zeta * v_squared;
        // The impulses balance the force over this time, and the speed at its beginning. With h = beta t / 2, the
        // integral of sin(theta + beta s) is t sin(theta + h) sin(h) / h.
        let half = 0.5 * beta * duration;
        let (sin_half, cos_half) = sin_cos(half);
        let (sin_middle, ratio) = (sin * cos_half + cos * sin_half, if half > 0.0 { sin_half / half } else { 1.0 });
        let impulse = duration * (sin_middle * ratio - stop.gap) - rebound + 2.0 / 3.0 * k * cubes;
        self.sums[Sum::Impulse] += impulse;
        // each impulse is 1 + eps times the speed of arrival
        self.sums[Sum::Speeds] += impulse / (1.0 + eps);
        self.sums[Sum::Impacts] = f64::INFINITY;
        // the force presses the mass until it rests, and right after a rebound the damper too; over so short a time both change
        // steadily, so the largest acceleration is at one of the ends
        let end = sin * (1.0 - 2.0 * sin_half * sin_half) + 2.0 * cos * sin_half * cos_half - stop.gap;
        self.extremes.acceleration = self.extremes.acceleration.max(a + 2.0 * zeta * rebound).max(end);
        self.hold(side, duration);
    }

    /// The mass is at the stop for this time.
    fn hold(&mut self, side: Side, duration: f64) {
        let x = side.sign() * self.osc.stop(side).map_or(0.0, |stop| stop.gap);
        if let Some(integrals) = &mut self.integrals {
            integrals.x += x * duration;
            integrals.x_squared += x * x * duration;
        }
        self.extremes.rest(x);
    }

    /// The number of impacts.
    #[must_use]
    pub fn impacts(&self) -> f64 {
        self.sums[Sum::Impacts]
    }

    /// Adds a time of which only the length is needed.
    pub(super) fn pass(&mut self, duration: f64) {
        self.sums[Sum::Time] += duration;
    }

    /// The sums of all parts so far. The factor of [`Sum::Damping`] is $`2\zeta`$.
    pub(super) fn sums(&self) -> Sums {
        let FlightIntegrals { x, x_squared, v_squared, work } = self.integrals.unwrap_or_default();
        let mut sums = self.sums;
        (sums[Sum::X], sums[Sum::XSquared], sums[Sum::Work]) = (x, x_squared, work);
        (sums[Sum::VSquared], sums[Sum::Damping]) = (v_squared, v_squared);
        sums
    }

    /// The quantities of a motion whose parts, all added, take `periods` forcing periods.
    #[must_use]
    pub fn over(&self, periods: f64) -> Quantities {
        let (sums, time) = (self.sums(), periods * TAU / self.osc.beta());
        let Extremes { lowest, highest, speed, acceleration, .. } = self.extremes;
        let value = |quantity: Quantity| match quantity {
            Quantity::ImpactSpeedMax => self.fastest,
            Quantity::ImpulseMax => self.hardest,
            Quantity::DisplacementMin => lowest,
            Quantity::DisplacementMax => highest,
            Quantity::DisplacementAmplitude => 0.5 * (highest - lowest),
            Quantity::VelocityMax => speed.max(self.fastest),
            Quantity::AccelerationMax => acceleration,
            mean => sums.mean(mean, time, periods, 2.0 * self.osc.damping()),
        };
        Quantities::from_fn(|quantity| if self.knows(quantity) { value(quantity) } else { f64::NAN })
    }

    /// Whether a quantity was asked for and no flight was left out of it.
    pub(super) fn knows(&self, quantity: Quantity) -> bool {
        self.asked[quantity as usize] && (!self.skipped || quantity.of_impacts())
    }

    /// The same over the time of all parts.
    #[must_use]
    pub fn over_all(&self) -> Quantities {
        self.over(self.sums[Sum::Time] * self.osc.beta() / TAU)
    }
}
