//! Whether rounding errors decide the period of a motion of the oscillator that sticks, by the rule of
//! [`error_growth`](super::error_growth).
//!
//! The phase of a release is exact, so errors begin with the first impact after it, and the next rest forgets them. They are
//! those of position and velocity at a fixed time. A flight of duration $`s`$ and the impact at its end, at the velocity $`v`$, with the
//! accelerations $`a`$ before and $`a_+`$ after it, carry them on by
//!
//! $$`\begin{pmatrix} -\varepsilon & 0 \\ (\varepsilon a + a_+)/v & -\varepsilon \end{pmatrix}
//!    \begin{pmatrix} C & S \\ -S & S' \end{pmatrix}.`$$

use super::error_growth::{self, NEIGHBOURS, NEW};
use super::release::{Excursion, Stretch, Strike};
use crate::lanes::PropagatorCache;
use crate::math::{Matrix2, sin_cos};
use crate::motion::{EventKind, Motion};
use crate::system::{Oscillator, Start};

/// A neighbour is followed over this number of events for each one of the motion, and over at least [`FEWEST`].
const EVENTS: usize = 4;
/// See [`EVENTS`].
const FEWEST: usize = 256;

/// Whether rounding errors decide on which stop and after how many periods the motion comes to rest, after any of its releases.
pub(super) fn rounding_decides(osc: &Oscillator, excursion: &Excursion) -> bool {
    excursion
        .stretches
        .iter()
        .any(|stretch| error_growth::decide(largest_error(osc, stretch), || neighbours_part(osc, stretch)))
}

/// The largest error after any impact, relative to the size of the motion, which is the same of position and velocity, as the natural
/// frequency is 1.
fn largest_error(osc: &Oscillator, stretch: &Stretch) -> f64 {
    let (mut errors, mut largest) = ([[0.0; 2]; 2], 0.0_f64);
    for strike in &stretch.strikes {
        let step = derivative(osc, strike);
        let [[a, b], [c, d]] = step.0;
        // the covariance of the errors, carried over by A E A^T, with a new rounding in each number
        errors = step.times(Matrix2(errors)).times(Matrix2([[a, c], [b, d]])).0;
        errors[0][0] += NEW * NEW;
        errors[1][1] += NEW * NEW;
        let error = errors[0][0].max(errors[1][1]).sqrt();
        if !error.is_finite() {
            return f64::INFINITY;
        }
        largest = largest.max(error);
    }
    largest
}

/// The derivative of position and velocity after an impact by those after the event before.
fn derivative(osc: &Oscillator, strike: &Strike) -> Matrix2 {
    let (state, p) = (strike.state, osc.response().at(strike.flown));
    let (gap, restitution) = osc.stop(state.side).map_or((0.0, 0.0), |stop| (stop.gap, stop.restitution));
    let velocity = state.side.sign() * state.velocity;
    let pressed = sin_cos(state.phase).0 - state.side.sign() * gap;
    let drag = 2.0 * osc.damping() * velocity;
    // the saltation: e times the acceleration before the impact and that after it, by the velocity
    let jump = (restitution * (pressed - drag) + pressed + restitution * drag) / velocity;
    Matrix2([[-restitution, 0.0], [jump, -restitution]]).times(Matrix2([[p.c, p.s], [-p.s, p.s_rate]]))
}

/// Whether neighbours of the motion at the distance of a few roundings, in the middle of the first flight after the release, do not
/// come to rest where it does; `None` without such a flight.
fn neighbours_part(osc: &Oscillator, stretch: &Stretch) -> Option<bool> {
    let rest = stretch.rest?;
    let flown: f64 = stretch.strikes.iter().map(|strike| strike.flown).sum();
    let mut motion = Motion::released(osc, stretch.from);
    motion.advance(None)?;
    let flight = motion.leg()?;
    let early = 0.5 * flight.duration;
    let middle = flight.start(osc, early);
    let left = flown + rest.settled + rest.held - early;
    let gaps = osc.stops().map(|(_, stop)| stop.gap.abs());
    let size = gaps.chain(stretch.strikes.iter().map(|strike| strike.state.velocity)).fold(0.0, f64::max);
    let (lowest, highest) = Start::room(osc);
    Some((0..NEIGHBOURS).any(|neighbour| {
        let [x, v] = [0, 1].map(|i| size * error_growth::beside(neighbour, i));
        let start = Start { x: (middle.x + x).clamp(lowest, highest), v: middle.v + v, phase: middle.phase };
        let (mut motion, cache) = (Motion::new(osc, start), PropagatorCache::new());
        let released = (0..FEWEST.max(EVENTS * stretch.strikes.len()))
            .map_while(|_| motion.advance(Some(&cache)))
            .find(|event| event.kind == EventKind::Release);
        // a release has one phase, so its time can differ by whole periods only
        released.is_none_or(|event| event.side != rest.span.side || (event.time - left).abs() > 0.25 * osc.period())
    }))
}
