//! Both sections of the settled motion of a start: a few dots for a cycle, a cloud for chaos.

use crate::figure::settle::last_event;
use vibroimpact::verdict::Settled;
use vibroimpact::{Oscillator, Start, chaos};
use vibroimpact_study::SectionPoints;

/// Number of impacts and forcing periods after the motion has settled and before the points, so that the rest of the
/// transient is not visible.
const TRANSIENT: u64 = 200;

/// The section with `points` impacts and states at phase 0 of the settled motion.
pub(super) fn sections(osc: &Oscillator, start: Start, settled: &Settled, points: u64) -> SectionPoints {
    let (from, _) = last_event(osc, start, settled.time);
    SectionPoints::of_oscillator(osc, &chaos::section(osc, from, TRANSIENT, points))
}
