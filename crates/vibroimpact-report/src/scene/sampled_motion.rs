//! A motion as points and events, for a page that draws and animates it.

use crate::Units;
use crate::figure::waveform::steady;
use crate::json::event::EventObject;
use serde::Serialize;
use vibroimpact::motion::{Motion, sample};
use vibroimpact::verdict::Settled;
use vibroimpact::{Oscillator, Start};

/// Maximum number of points, and of events.
const MOST_POINTS: usize = 60_000;
const MOST_EVENTS: usize = 20_000;
/// Number of points in a period of the force or of the free motion, whichever is shorter.
const FINE: f64 = 120.0;

/// A motion over a duration: points that are close enough to interpolate between, with one on each side of every event,
/// and the events. The force at a time is `sin(beta * time + phase)`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SampledMotion {
    /// Time from the start of the motion to the first point.
    pub begin: f64,
    /// Phase of the force at the first point, in radians.
    pub phase: f64,
    /// Angular frequency of the force, in radians per unit of time.
    pub beta: f64,
    /// Forcing period.
    pub period: f64,
    /// Positions of the stops: the first one, then the second one if there is one.
    pub stops: Vec<f64>,
    /// Times of the points since the first one.
    pub time: Vec<f64>,
    /// Positions.
    pub position: Vec<f64>,
    /// Velocities.
    pub velocity: Vec<f64>,
    /// Impacts, sticking, releases and grazing contacts, with times since the first point.
    pub events: Vec<EventObject<'static>>,
    /// The units of all these numbers: `si` or `nondimensional`.
    pub units: &'static str,
}

impl SampledMotion {
    /// The motion from `start` for a number of forcing periods. Times since the start of the motion begin at `begin`.
    ///
    /// ```
    /// use vibroimpact::{Oscillator, Start};
    /// use vibroimpact_report::{Units, scene::SampledMotion};
    /// let osc = Oscillator::from_inverse_beta(1.8, 0.25, 0.5)?;
    /// let track = SampledMotion::new(&osc, (Start::at_rest(&osc), 0.0), 5.0, &Units::default());
    /// assert!(track.position.iter().all(|x| *x <= track.stops[0] + 1e-14));
    /// assert_eq!(*track.time.last().unwrap(), 5.0 * osc.period());
    /// # Ok::<(), vibroimpact::SystemError>(())
    /// ```
    #[must_use]
    pub fn new(osc: &Oscillator, (start, begin): (Start, f64), periods: f64, units: &Units) -> Self {
        let asked = periods * osc.period();
        // a period of a slow force may hold billions of events
        let last = Motion::new(osc, start).take_while(|event| event.time < asked).nth(MOST_EVENTS - 1);
        let until = last.map_or(asked, |event| event.time);
        let fine = osc.period().min(core::f64::consts::TAU) / FINE;
        #[allow(clippy::cast_precision_loss)] // far below 2^53
        let step = fine.max(until / MOST_POINTS as f64).max(f64::MIN_POSITIVE);
        let points = sample(osc, start, until, step, 2 * MOST_POINTS + 2 * MOST_EVENTS);
        let events = Motion::new(osc, start).take(MOST_EVENTS).take_while(|event| event.time <= until);
        let (length, time, velocity) = (units.length(), units.time(), units.velocity());
        Self {
            begin: begin * time,
            phase: start.phase,
            beta: osc.beta() / time,
            period: osc.period() * time,
            stops: osc.stops().map(|(side, stop)| side.sign() * stop.gap * length).collect(),
            time: points.iter().map(|point| point.time * time).collect(),
            position: points.iter().map(|point| point.x * length).collect(),
            velocity: points.iter().map(|point| point.v * velocity).collect(),
            events: events.map(|event| EventObject::of_oscillator(osc, &event, units)).collect(),
            units: units.name(),
        }
    }

    /// The settled motion, from its last event before it was recognised.
    #[must_use]
    pub fn settled(osc: &Oscillator, start: Start, settled: &Settled, periods: f64, units: &Units) -> Self {
        let (from, (begin, _)) = steady(osc, start, settled);
        Self::new(osc, (from, begin), periods, units)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact::verdict::{SettleOptions, settle};

    /// Between neighbouring points the cubic with their positions and velocities is the motion to seven digits.
    #[test]
    fn points_are_close_enough_to_interpolate() {
        for (inverse_beta, gap) in [(1.8, 0.25), (0.3, 0.5), (12.0, 0.4)] {
            let osc = Oscillator::from_inverse_beta(inverse_beta, gap, 0.5).unwrap();
            let track = SampledMotion::new(&osc, (Start::at_rest(&osc), 0.0), 4.0, &Units::default());
            let fine = sample(&osc, Start::at_rest(&osc), 4.0 * osc.period(), 1e-3, 1_000_000);
            let mut k = 0;
            for point in fine {
                while track.time[k + 1] < point.time {
                    k += 1;
                }
                let h = track.time[k + 1] - track.time[k];
                let s = (point.time - track.time[k]) / h;
                let [p, q] = [track.position[k], track.position[k + 1]];
                let [v, w] = [track.velocity[k] * h, track.velocity[k + 1] * h];
                let cubic = p + s * (v + s * (3.0 * (q - p) - 2.0 * v - w + s * (2.0 * (p - q) + v + w)));
                assert!(
                    h == 0.0 || (cubic - point.x).abs() < 1e-7,
                    "{inverse_beta} {} {cubic} {}",
                    point.time,
                    point.x
                );
            }
        }
    }

    /// The settled motion of N has its four impacts in each period, and the force belongs to it: in the middle of the
    /// longest flight the acceleration is that of the equation of motion.
    #[test]
    fn a_settled_motion_with_its_force() {
        let osc = Oscillator::from_inverse_beta(1.8, 0.25, 0.5).unwrap();
        let start = Start::at_rest(&osc);
        let settled = settle(&osc, start, &SettleOptions::default());
        let track = SampledMotion::settled(&osc, start, &settled, 3.0, &Units::default());
        let impacts = track.events.iter().filter(|event| event.kind == "impact").count();
        assert!((11..=12).contains(&impacts), "{impacts}");
        let k = track.time.iter().position(|t| *t > 4.0).unwrap();
        assert!(track.position[k] < -0.5, "{}", track.position[k]);
        let slope = (track.velocity[k + 1] - track.velocity[k - 1]) / (track.time[k + 1] - track.time[k - 1]);
        let force = (track.beta * track.time[k] + track.phase).sin();
        assert!((slope - (force - track.position[k])).abs() < 1e-2, "{slope} {force} {}", track.position[k]);
    }

    /// At beta = 1e-9 there are 1e9 impacts in a forcing period.
    #[test]
    fn it_has_an_end() {
        let osc = Oscillator::new(1e-9, 3.9, 0.28).unwrap().with_damping(1e-10).unwrap();
        let track = SampledMotion::new(&osc, (Start { x: -1.4, v: -5.3, phase: 0.0 }, 0.0), 10.0, &Units::default());
        assert!(track.events.len() <= MOST_EVENTS && track.time.len() <= 2 * MOST_POINTS + 2 * MOST_EVENTS);
        assert!(*track.time.last().unwrap() < osc.period());
    }
}
