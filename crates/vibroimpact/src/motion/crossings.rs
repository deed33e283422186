//! The crossings of a position by a motion, found as the first contacts with an imaginary stop there, so that none is
//! missed.

use super::{Leg, Motion, Path};
use crate::flight::{Contact, Flight, SearchLimits, first_contact};
use crate::system::{Oscillator, Side, Start, SystemError, phase};

/// A crossing of a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Time since the start of the motion.
    pub time: f64,
    /// Phase of the force.
    pub phase: f64,
    /// Velocity, positive where the motion crosses upwards.
    pub velocity: f64,
}

/// The crossings of one position by the motions of an oscillator.
///
/// ```
/// use vibroimpact::{Start, motion::Level, scenario};
/// let osc = scenario::N.oscillator();
/// let level = Level::new(&osc, 0.0)?;
/// let crossings: Vec<_> = level.crossings(Start { x: -1.0, v: 0.0, phase: 0.0 }, 50.0).collect();
/// assert!(crossings.windows(2).all(|pair| pair[0].velocity * pair[1].velocity < 0.0));
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Level<'a> {
    osc: &'a Oscillator,
    position: f64,
    /// The oscillator without its stops, and with one stop at the position: from below, and from above.
    walls: [Oscillator; 2],
}

/// After this number of touches of the position without a crossing, a flight counts as one that stays there.
const MOST_TOUCHES: u32 = 8;

impl<'a> Level<'a> {
    /// The crossings of `position`, which lies between the stops.
    ///
    /// # Errors
    /// [`SystemError::BeyondStop`] for a position on a stop or beyond it, or one that is not finite.
    pub fn new(osc: &'a Oscillator, position: f64) -> Result<Self, SystemError> {
        let (lowest, highest) = Start::room(osc);
        if !(lowest < position && position < highest && position.is_finite()) {
            return Err(SystemError::BeyondStop { x: position, lowest, highest });
        }
        let above = Oscillator::new(osc.beta(), position, 1.0)?.with_damping(osc.damping())?;
        // an upper stop that no motion below the real one reaches
        let far = 2.0 * highest.abs() + position.abs() + 1.0;
        let below = Oscillator::new(osc.beta(), far, 1.0)?.with_damping(osc.damping())?;
        Ok(Self { osc, position, walls: [above, below.with_second_stop(-position, 1.0)?] })
    }

    /// The crossings of the motion from a start up to the time `until`, in order.
    pub fn crossings(&self, start: Start, until: f64) -> impl Iterator<Item = Crossing> {
        let limits = SearchLimits::default();
        let limits = SearchLimits { periods: limits.periods.max(until / self.osc.period()), ..limits };
        let mut motion = Motion::with_limits(self.osc, start, limits);
        let legs = core::iter::from_fn(move || {
            if motion.end().is_some() {
                return None;
            }
            motion.next();
            motion.leg().copied()
        });
        legs.take_while(move |leg| leg.begin <= until)
            .flat_map(move |leg| self.of_leg(&leg, (until - leg.begin).min(leg.duration), limits))
    }

    /// The crossings of a leg up to a time after its beginning.
    fn of_leg(&self, leg: &Leg, until: f64, limits: SearchLimits) -> Vec<Crossing> {
        let Path::Flight(flight) = leg.path else { return Vec::new() };
        let (x, v) = flight.state(0.0);
        let mut here = Start { x, v, phase: leg.phase };
        let (mut s, mut touches) = (0.0, 0);
        let mut found = Vec::new();
        let mut side = self.side(&here);
        loop {
            let wall = &self.walls[usize::from(side == Side::Lower)];
            let (time, velocity, crosses) = match first_contact(wall, &Flight::new(wall, here), limits) {
                Contact::Impact { time, velocity, .. } => (time, side.sign() * velocity, true),
                Contact::Grazing { time, .. } => (time, 0.0, false),
                // at rest at the position, with a force to the other side
                Contact::Contact { .. } => (0.0, here.v, true),
                Contact::Never(_) | Contact::NoneUntil(_) => return found,
            };
            s += time;
            touches = if crosses && time > 0.0 { 0 } else { touches + 1 };
            if s > until || touches > MOST_TOUCHES {
                return found;
            }
            here = Start { x: self.position, v: velocity, phase: phase::advance(leg.phase, self.osc.beta(), s) };
            if crosses {
                side = if side == Side::Upper { Side::Lower } else { Side::Upper };
                found.push(Crossing { time: leg.begin + s, phase: here.phase, velocity });
            }
        }
    }

    /// The imaginary stop towards which a state looks: the upper one from below the position.
    fn side(&self, state: &Start) -> Side {
        let away = state.x - self.position;
        let force = crate::math::sin_cos(state.phase).0 - state.x - 2.0 * self.osc.damping() * state.v;
        let above = [away, state.v, force].into_iter().find(|of| *of != 0.0).is_some_and(|of| of > 0.0);
        if above { Side::Lower } else { Side::Upper }
    }
}
