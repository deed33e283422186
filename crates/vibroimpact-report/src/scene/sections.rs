//! Both sections of the motion that a start has settled into: a few dots of a cycle, a cloud of chaos.

use crate::figure::settle::last_event;
use vibroimpact::chaos::Section;
use vibroimpact::verdict::Settled;
use vibroimpact::{Oscillator, Start, chaos};

/// Impacts and forcing periods that pass beforehand, after it has settled: what is left of the transient is not seen.
const TRANSIENT: u64 = 200;

/// So many impacts and states at phase 0 of the settled motion; dots on one another are one.
pub(super) fn sections(osc: &Oscillator, start: Start, settled: &Settled, points: u64) -> Section {
    let (from, _) = last_event(osc, start, settled.time);
    chaos::section(osc, from, TRANSIENT, points)
}
