//! Both sections of the motion that a start has settled into: a few dots of a cycle, a cloud of chaos.

use crate::Asked;
use crate::figure::section;
use crate::figure::settle::last_event;
use vibroimpact::verdict::Settled;
use vibroimpact::{Oscillator, Start, chaos};
use vibroimpact_plot::Figure;

/// Impacts and forcing periods that pass beforehand, after it has settled: what is left of the transient is not seen.
const TRANSIENT: u64 = 200;

/// So many impacts and states at phase 0 of the settled motion; dots on one another are one.
#[must_use]
pub fn sections(asked: &Asked, osc: &Oscillator, start: Start, settled: &Settled, points: u64) -> Figure {
    let (from, _) = last_event(osc, start, settled.time);
    section::figure(&chaos::section(osc, from, TRANSIENT, points), osc, asked)
}
