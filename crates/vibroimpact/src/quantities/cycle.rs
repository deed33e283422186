//! The parts of a cycle, and its quantities.

use super::segment::follow;
use super::{Quantities, Segment, Tally};
use crate::flight::Flight;
use crate::motion::{EventKind, Motion};
use crate::orbit::Cycle;
use crate::system::{Oscillator, Side, Start};

/// The largest number of events after a release within which the release must recur.
const EVENTS: u32 = 100_000;

/// The quantities of a cycle, stable or not; `None` for a cycle that sticks if the motion after its release does not
/// return to it. They are defined for inadmissible cycles too, whose flights pass through a stop.
///
/// ```
/// use vibroimpact::{Oscillator, orbit, quantities::{Quantity, of_cycle}};
/// // 1/1 without damping: the work of the force is lost in the impact
/// let osc = Oscillator::from_inverse_beta(0.6, 0.75, 0.5)?;
/// let found = orbit::find(&osc, "1/1".parse().unwrap(), orbit::FindOptions::default());
/// let cycle = &found[0].cycle;
/// let quantities = of_cycle(&osc, cycle).unwrap();
/// let speed = cycle.points[0].state.velocity;
/// assert_eq!(quantities.get(Quantity::ImpactLossPerPeriod), 0.5 * (1.0 - 0.25) * speed * speed);
/// assert!((quantities.get(Quantity::WorkPerPeriod) - 0.375 * speed * speed).abs() < 1e-13);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn of_cycle(osc: &Oscillator, cycle: &Cycle) -> Option<Quantities> {
    add_cycle(Tally::new(osc), osc, cycle)
}

/// The quantities of a cycle from empty sums.
pub(super) fn add_cycle(mut tally: Tally<'_>, osc: &Oscillator, cycle: &Cycle) -> Option<Quantities> {
    for segment in cycle_segments(osc, cycle)? {
        tally.add(&segment);
    }
    Some(tally.over(f64::from(cycle.label.periods)))
}

/// The parts of a cycle in order, over its smallest period: from its first impact, or from a release for a cycle that
/// sticks, or from phase 0 without impacts. `None` as for [`of_cycle`].
#[must_use]
pub fn cycle_segments(osc: &Oscillator, cycle: &Cycle) -> Option<Vec<Segment>> {
    if let Some(rest) = cycle.rests.last() {
        return after_release(osc, rest.side, cycle.label.periods);
    }
    if cycle.points.is_empty() {
        return (osc.damping() > 0.0)
            .then(|| vec![Segment::Flight { flight: Flight::new(osc, Start::steady(osc)), duration: osc.period() }]);
    }
    let parts = cycle.points.iter().flat_map(|point| {
        let flight = Flight::new(osc, point.state.rebound(osc));
        [
            Segment::Impact { side: point.state.side, speed: point.state.velocity },
            Segment::Flight { flight, duration: point.interval },
        ]
    });
    Some(parts.collect())
}

/// The parts of the motion after a release, until this release recurs after `periods` forcing periods.
pub(super) fn after_release(osc: &Oscillator, side: Side, periods: u32) -> Option<Vec<Segment>> {
    let mut parts = Vec::new();
    let (mut events, mut closed) = (0, false);
    // half a period before: the time of the release has rounding errors
    let until = (f64::from(periods) - 0.5) * osc.period();
    follow(
        &mut Motion::released(osc, side),
        |part| parts.push(part),
        |event| {
            closed = event.kind == EventKind::Release && event.side == side && event.time > until;
            events += 1;
            !closed && events < EVENTS && event.time < until + osc.period()
        },
    );
    closed.then_some(parts)
}
