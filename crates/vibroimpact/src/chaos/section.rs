//! Points of the attractor: its impacts, and its states once in every forcing period.

use super::ExponentOptions;
use crate::motion::{ImpactState, MAX_TOUCHES, Motion, Strobes};
use crate::system::{Oscillator, Start};

/// The points of a motion in the two sections, in the order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Its impacts: the section of the impact map.
    pub impacts: Vec<ImpactState>,
    /// Its states at phase 0 of the force: the stroboscopic section.
    pub strobes: Vec<Start>,
}

/// The number of successive events without an impact after which no impact is expected: sticking, a release and the
/// grazing contacts between two impacts.
const IDLE: u32 = MAX_TOUCHES + 4;

/// The motion of `osc` from `start` in both sections: `points` impacts after `transient` impacts, and `points` states
/// after `transient` forcing periods. There are fewer points if the motion has no more impacts, or if the search limits
/// are reached.
///
/// ```
/// use vibroimpact::{Start, chaos::section, scenario};
/// let osc = scenario::U.oscillator();
/// let found = section(&osc, Start::at_rest(&osc), 500, 1000);
/// assert_eq!((found.impacts.len(), found.strobes.len()), (1000, 1000));
/// assert!(found.strobes.iter().all(|state| state.phase == 0.0 && state.x <= osc.gap()));
/// ```
#[must_use]
pub fn section(osc: &Oscillator, start: Start, transient: u64, points: u64) -> Section {
    // it is never stopped
    section_while(osc, start, transient, points, &|| true).unwrap_or_default()
}

/// The same as [`section`], but stopped when `go_on` returns false, and then `None`. `go_on` is called at every impact
/// and state.
#[must_use]
pub fn section_while(
    osc: &Oscillator,
    start: Start,
    transient: u64,
    points: u64,
    go_on: &dyn Fn() -> bool,
) -> Option<Section> {
    // with the same limit as for exponents over this number of impacts
    let most_steps = ExponentOptions::new(points, transient).max_steps;
    let impacts = impacts(osc, start, most_steps).take_while(|_| go_on());
    let impacts = impacts.skip(whole(transient)).take(whole(points)).collect();
    let strobes = strobes(osc, start, most_steps).take_while(|_| go_on());
    let strobes = strobes.skip(whole(transient)).take(whole(points)).collect();
    go_on().then_some(Section { impacts, strobes })
}

fn whole(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

/// The impacts of a motion, until only grazing contacts are left.
fn impacts(osc: &Oscillator, start: Start, most_steps: u64) -> impl Iterator<Item = ImpactState> {
    let mut motion = Motion::new(osc, start);
    core::iter::from_fn(move || {
        for _ in 0..IDLE {
            if motion.steps() > most_steps {
                return None;
            }
            let arrival = motion.next()?.arrival();
            if arrival.is_some() {
                return arrival;
            }
        }
        None
    })
}

fn strobes(osc: &Oscillator, start: Start, most_steps: u64) -> impl Iterator<Item = Start> {
    let mut strobes = Strobes::new(osc, start, 0.0);
    core::iter::from_fn(move || if strobes.steps() > most_steps { None } else { strobes.next() })
}
