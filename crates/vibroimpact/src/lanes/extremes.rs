//! Extremes over a flight. Most flights of a long motion exceed none of those so far, which is proven here at points
//! side by side, unless the amplitudes of the flight show it already.
//!
//! Each panel of the quadrature is divided into equal intervals. Over an interval of half the length $`\rho`$, a function
//! with $`|f'''| \le B`$ is at most $`\max_{|r| \le \rho}(f + f'r + f''r^2/2) + B\rho^3/6`$, with $`f`$ and its
//! derivatives in the middle. If no interval of the flight exceeds an extreme, the extremes stay as they are. Otherwise
//! the flight is searched, one point at a time ([`Extremes::add`]).

use super::points::{Points, suited};
use super::width::{Task, Width};
use crate::flight::{Ceiling, Extremes, Flight, panels};
use crate::math::{Lane, Mask, POINTS};

/// Half the length of an interval on [-1, 1].
const RHO: f64 = 1.0 / 16.0;
/// The middles of the intervals.
const MIDDLES: [f64; POINTS] = {
    let mut middles = [RHO - 1.0; POINTS];
    let mut k = 1;
    while k < POINTS {
        middles[k] = middles[k - 1] + 2.0 * RHO;
        k += 1;
    }
    middles
};

/// Includes the first `duration` of a flight.
pub(crate) fn add_extremes(extremes: &mut Extremes, flight: &Flight, duration: f64) {
    add_with(Width::best(), extremes, flight, duration);
}

fn add_with(width: Width, extremes: &mut Extremes, flight: &Flight, duration: f64) {
    let ceilings = extremes.ceilings();
    // most of them are out of reach however long the flight is; a bound that is not a number leaves none out
    let largest = flight.largest();
    let reachable = |ceiling: &Ceiling| {
        let below = largest[ceiling.derivative] < ceiling.level;
        ceiling.level < f64::INFINITY && !below
    };
    let ceilings = &mut ceilings.into_iter().filter(reachable);
    let mut low = [Ceiling::NONE; 6];
    let mut count = 0;
    for (place, ceiling) in low.iter_mut().zip(ceilings) {
        *place = ceiling;
        count += 1;
    }
    // nothing is asked for, or nothing can be exceeded
    if count == 0 {
        return;
    }
    // a first flight exceeds every extreme
    let known = low[..count].iter().all(|ceiling| ceiling.level > f64::NEG_INFINITY);
    let proven =
        known && suited(flight, duration) && { width.run(Within { flight, duration, ceilings: &low[..count] }) };
    if !proven {
        extremes.add(flight, duration);
    }
}

/// Whether no point of the flight is above these ceilings.
struct Within<'a> {
    flight: &'a Flight,
    duration: f64,
    ceilings: &'a [Ceiling],
}

/// Position, velocity and their derivatives up to the fourth of the position, at the points of a panel.
type Derivatives = [[f64; POINTS]; 5];

impl Task for Within<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<L: Lane>(self) -> bool {
        let radius = |x: f64, v: f64| (x * x + v * v).sqrt();
        // the energy radius grows at most at the rate 1, here from the last point before the panel
        let mut before = radius(self.flight.x, self.flight.v);
        for (middle, half) in panels(self.flight, self.duration, 0.0) {
            let points = self.derivatives::<L>(middle, half);
            let mut largest = before;
            let mut k = 0;
            while k < POINTS {
                before = radius(points[0][k], points[1][k]);
                largest = largest.max(before);
                k += 1;
            }
            let bounds = self.flight.third_derivatives(largest + 2.0 * RHO * half);
            let mut which = 0;
            while which < self.ceilings.len() {
                let ceiling = &self.ceilings[which];
                if exceeds::<L>(&points, ceiling, bounds[ceiling.derivative], RHO * half) {
                    return false;
                }
                which += 1;
            }
        }
        true
    }
}

impl Within<'_> {
    #[inline(always)]
    fn derivatives<L: Lane>(&self, middle: f64, half: f64) -> Derivatives {
        let (beta, drag) = (self.flight.response().beta(), L::splat(2.0 * self.flight.response().damping()));
        let mut all = Derivatives::default();
        let mut k = 0;
        while k < POINTS {
            let offset = L::splat(half) * L::load(&MIDDLES[k..]);
            let Points { x, v, force, force_rate } = Points::new(self.flight, middle, offset);
            let a = force - x - drag * v;
            let j = force_rate - v - drag * a;
            let snap = -(L::splat(beta * beta) * force) - a - drag * j;
            x.store(&mut all[0][k..]);
            v.store(&mut all[1][k..]);
            a.store(&mut all[2][k..]);
            j.store(&mut all[3][k..]);
            snap.store(&mut all[4][k..]);
            k += L::WIDTH;
        }
        all
    }
}

/// Whether an interval of half the length `rho` around one of these points can exceed the ceiling.
#[inline(always)]
fn exceeds<L: Lane>(points: &Derivatives, ceiling: &Ceiling, bound: f64, rho: f64) -> bool {
    let (sign, level) = (L::splat(ceiling.sign), L::splat(ceiling.level));
    let (error, rho, half) = (L::splat(bound * rho * rho * rho / 6.0), L::splat(rho), L::splat(0.5));
    let mut k = 0;
    while k < POINTS {
        let f = sign * L::load(&points[ceiling.derivative][k..]);
        let slope = L::load(&points[ceiling.derivative + 1][k..]).abs();
        let second = sign * L::load(&points[ceiling.derivative + 2][k..]);
        // the quadratic part is largest at its peak if that lies inside, otherwise at an end
        let inside = slope.less(-(second * rho));
        let peak = half * slope * slope / L::choose(inside, -second, L::splat(1.0));
        let rise = L::choose(inside, peak, slope * rho + half * second * rho * rho);
        // all lanes must be below, so that NaN is not
        let below = (f + rise + error).less(level).bits();
        if below.count_ones() as usize != L::WIDTH {
            return true;
        }
        k += L::WIDTH;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::Extreme;
    use crate::system::{Oscillator, Start};

    const ALL: [Extreme; 4] = [Extreme::Lowest, Extreme::Highest, Extreme::Speed, Extreme::Acceleration];

    fn values(extremes: &Extremes) -> [f64; 4] {
        [-extremes.lowest, extremes.highest, extremes.speed, extremes.acceleration]
    }

    /// Over many flights the extremes are those of the search of every flight, for each extreme alone and all together,
    /// and the widths agree to the bit.
    #[test]
    fn extremes_are_those_of_the_search_of_every_flight() {
        for (beta, zeta) in [(0.05, 0.0), (0.7, 0.02), (1.0, 0.0), (1.0, 0.3), (2.3, 0.1), (11.0, 0.0), (0.9, 0.6)] {
            let osc = Oscillator::new(beta, 9.0, 0.5).unwrap().with_damping(zeta).unwrap();
            for sought in ALL.map(|extreme| vec![extreme]).into_iter().chain([ALL.to_vec()]) {
                let mut searched = Extremes::only(&sought);
                let mut found = Width::ALL.map(|_| searched);
                for k in 0..60 {
                    let (a, b) = (f64::from(k * 37 % 60) / 60.0, f64::from(k * 23 % 60) / 60.0);
                    let flight = Flight::new(&osc, Start { x: 3.0 * a - 1.0, v: 4.0 * b - 2.0, phase: 6.0 * a * b });
                    let duration = 0.1 + 9.0 * a * b;
                    searched.add(&flight, duration);
                    for (width, found) in Width::ALL.into_iter().zip(&mut found) {
                        if width.available() {
                            add_with(width, found, &flight, duration);
                        } else {
                            *found = searched;
                        }
                    }
                }
                for extreme in &sought {
                    let all = found.map(|found| values(&found)[*extreme as usize]);
                    let right = values(&searched)[*extreme as usize];
                    assert!(
                        (all[0] - right).abs() < 1e-14 * (1.0 + right.abs()),
                        "{beta} {zeta} {extreme:?}: {all:?} {right}"
                    );
                    for (width, other) in Width::ALL.into_iter().zip(all) {
                        let scalar = all[0];
                        if width.available() {
                            assert_eq!(other.to_bits(), scalar.to_bits(), "{width:?} {beta} {zeta} {extreme:?}");
                        }
                    }
                }
            }
        }
    }

    /// A flight that exceeds a ceiling by a little more than rounding is searched.
    #[test]
    fn a_flight_just_above_a_ceiling_is_not_left_out() {
        let osc = Oscillator::new(0.7, 9.0, 0.5).unwrap().with_damping(0.02).unwrap();
        let flight = Flight::new(&osc, Start { x: 0.4, v: -1.3, phase: 2.0 });
        let mut all = Extremes::only(&ALL);
        all.add(&flight, 8.0);
        let below = all.ceilings().map(|ceiling| Ceiling { level: ceiling.level - 1e-12, ..ceiling });
        let above = all.ceilings().map(|ceiling| Ceiling { level: ceiling.level + 0.1, ..ceiling });
        let within = |ceilings: &[Ceiling]| Width::Scalar.run(Within { flight: &flight, duration: 8.0, ceilings });
        assert!(within(&above));
        // the speed and the acceleration have two ceilings each, of which the motion reaches at least one
        for pair in [&below[0..1], &below[1..2], &below[2..4], &below[4..6]] {
            assert!(!within(pair), "{pair:?}");
        }
    }
}
