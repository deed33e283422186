//! Extremes over a flight. Most flights of a long motion exceed none of those so far, which is proven here at points
//! side by side, unless the amplitudes of the flight show it already.
//!
//! The flight is divided into equal panels, and these into equal intervals. Over an interval of half the length
//! $`\rho`$, a function with $`|f'''| \le B`$ is at most
//! $`\max_{|r| \le \rho}(f + f'r + f''r^2/2) + B\rho^3/6`$, with $`f`$ and its derivatives in the middle. Of the
//! last interval only the part that belongs to the flight counts. If no interval exceeds an extreme, the extremes stay as
//! they are. A panel with one that may is searched, one point at a time ([`Extremes::add_between`]).

use super::points::{MIDDLES, Panels, Points, RHO, Rows, suited};
use super::width::{Task, Width};
use crate::flight::{Ceiling, Extremes, Flight};
use crate::math::{Lane, Mask, POINTS};

/// Includes the first `duration` of a flight; the panels are those of its oscillator.
pub(crate) fn add_extremes(extremes: &mut Extremes, panels: &Panels, flight: &Flight, duration: f64) {
    add_with(Width::best(), extremes, panels, flight, duration);
}

fn add_with(width: Width, extremes: &mut Extremes, panels: &Panels, flight: &Flight, duration: f64) {
    let largest = flight.largest();
    if !suited(flight, duration) {
        if reachable(extremes, largest).1 > 0 {
            extremes.add(flight, duration);
        }
        return;
    }
    let mut from = Part { begin: 0.0, end: duration, point: Points::begin(flight) };
    loop {
        let (low, count) = reachable(extremes, largest);
        if count == 0 {
            return;
        }
        let found = width.run(Above { flight, from, panels, ceilings: &low[..count] });
        let Some(part) = found else { return };
        extremes.add_between(flight, part.begin, part.end);
        if part.end >= duration {
            return;
        }
        let panel = panels.longest(flight);
        from = Part { begin: part.end, end: duration, point: part.point.then(flight.response().beta(), &panel.end) };
    }
}

/// The ceilings that a flight with these [bounds](Flight::largest) could exceed, however long it is, and their number.
fn reachable(extremes: &Extremes, largest: [f64; 3]) -> ([Ceiling; 6], usize) {
    let mut low = [Ceiling::NONE; 6];
    let mut count = 0;
    for ceiling in extremes.ceilings() {
        // a bound that is not a number leaves none out
        let below = largest[ceiling.derivative] < ceiling.level;
        if ceiling.level < f64::INFINITY && !below {
            low[count] = ceiling;
            count += 1;
        }
    }
    (low, count)
}

/// A part of a flight, and the point at its beginning.
#[derive(Clone, Copy)]
struct Part {
    begin: f64,
    end: f64,
    point: Points<f64>,
}

/// The first panel of a part of the flight in which a point may be above one of these ceilings.
struct Above<'a> {
    flight: &'a Flight,
    from: Part,
    panels: &'a Panels,
    ceilings: &'a [Ceiling],
}

/// Position, velocity and their derivatives up to the fourth of the position, at the points of a panel.
type Derivatives = [[f64; POINTS]; 5];

impl Task for Above<'_> {
    type Output = Option<Part>;

    #[inline(always)]
    fn run<L: Lane>(self) -> Option<Part> {
        let panel = self.panels.longest(self.flight);
        let (beta, half) = (self.flight.response().beta(), panel.half);
        let Part { mut begin, end, mut point } = self.from;
        while begin < end {
            let (points, square) = self.derivatives::<L>(&point, &panel.middles);
            // the energy radius grows at most at the rate 1, here from the middle before
            let bounds = self.flight.third_derivatives(square.sqrt() + 2.0 * RHO * half);
            let left = end - begin;
            let mut which = 0;
            while which < self.ceilings.len() {
                let ceiling = &self.ceilings[which];
                if exceeds::<L>(&points, ceiling, bounds[ceiling.derivative], half, left) {
                    return Some(Part { begin, end: if left > 2.0 * half { begin + 2.0 * half } else { end }, point });
                }
                which += 1;
            }
            point = point.then(beta, &panel.end);
            begin += 2.0 * half;
        }
        None
    }
}

impl Above<'_> {
    /// The derivatives in the middles, and the largest square of the energy radius there and at the beginning.
    #[inline(always)]
    fn derivatives<L: Lane>(&self, here: &Points<f64>, middles: &Rows) -> (Derivatives, f64) {
        let (beta, drag) = (self.flight.response().beta(), L::splat(2.0 * self.flight.response().damping()));
        let mut all = Derivatives::default();
        let mut squares = [0.0; POINTS];
        let mut k = 0;
        while k < POINTS {
            let Points { x, v, sin: force, cos } = here.then(beta, &middles.load::<L>(k));
            let a = force - x - drag * v;
            let j = L::splat(beta) * cos - v - drag * a;
            let snap = -(L::splat(beta * beta) * force) - a - drag * j;
            x.store(&mut all[0][k..]);
            v.store(&mut all[1][k..]);
            a.store(&mut all[2][k..]);
            j.store(&mut all[3][k..]);
            snap.store(&mut all[4][k..]);
            (x * x + v * v).store(&mut squares[k..]);
            k += L::WIDTH;
        }
        let mut largest = here.x * here.x + here.v * here.v;
        let mut k = 0;
        while k < POINTS {
            largest = largest.max(squares[k]);
            k += 1;
        }
        (all, largest)
    }
}

/// Whether an interval around one of these points can exceed the ceiling, in the first `left` of the panel.
#[inline(always)]
fn exceeds<L: Lane>(points: &Derivatives, ceiling: &Ceiling, bound: f64, half: f64, left: f64) -> bool {
    let (sign, level) = (L::splat(ceiling.sign), L::splat(ceiling.level));
    let rho = RHO * half;
    let (error, rho, one_half) = (L::splat(bound * rho * rho * rho / 6.0), L::splat(rho), L::splat(0.5));
    let mut k = 0;
    while k < POINTS {
        let f = sign * L::load(&points[ceiling.derivative][k..]);
        let slope = sign * L::load(&points[ceiling.derivative + 1][k..]);
        let second = sign * L::load(&points[ceiling.derivative + 2][k..]);
        let curve = one_half * second;
        // most of them stay far below
        let far = (f + (slope.abs() + curve.abs() * rho) * rho + error).less(level).bits();
        // all intervals must be below, so that NaN is not
        if far.count_ones() as usize != L::WIDTH {
            // the interval is from -rho to end
            let end = (L::splat(left - half) - L::splat(half) * L::load(&MIDDLES[k..])).min(rho);
            // the quadratic part is largest at its peak if that lies inside, otherwise at an end
            let ends = ((curve * rho - slope) * rho).max((curve * end + slope) * end);
            let inside = slope.less(-(second * end)).and((second * rho).less(slope));
            let peak = one_half * slope * slope / L::choose(inside, -second, L::splat(1.0));
            let rise = L::choose(inside, peak, ends);
            let below = (f + rise + error).less(level).or(end.less(-rho)).bits();
            if below.count_ones() as usize != L::WIDTH {
                return true;
            }
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
            let panels = Panels::default();
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
                            add_with(width, found, &panels, &flight, duration);
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
        let from = Part { begin: 0.0, end: 8.0, point: Points::begin(&flight) };
        let panels = &Panels::default();
        let within = |ceilings: &[Ceiling]| Above { flight: &flight, from, panels, ceilings }.run::<f64>().is_none();
        assert!(within(&above));
        // the speed and the acceleration have two ceilings each, of which the motion reaches at least one
        for pair in [&below[0..1], &below[1..2], &below[2..4], &below[4..6]] {
            assert!(!within(pair), "{pair:?}");
        }
    }
}
