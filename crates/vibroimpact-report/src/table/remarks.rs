//! What columns say of some motions of machines besides the label.

use crate::answer::Told;
use crate::json::event::Stops;
use vibroimpact::verdict::Verdict;

/// The stops that stay closed for ever in a motion, and the number of events over which chaos was seen.
pub(crate) type Remark = (Vec<usize>, Option<u64>);

/// The names of stops with blanks between, after a comma.
fn stops_of(system: &impl Stops, stops: &[usize]) -> String {
    format!(",{}", stops.iter().map(|stop| system.name_of_stop(*stop)).collect::<Vec<_>>().join(" "))
}

/// The columns that say more of some labels than the label, where such motions are in a table: the stops that stay closed for ever,
/// and the number of events over which chaos was seen.
#[derive(Clone, Copy)]
pub(crate) struct Remarks {
    stops: bool,
    events: bool,
}

impl Remarks {
    pub(crate) fn of(motions: impl Iterator<Item = Remark>) -> Self {
        motions.fold(Self { stops: false, events: false }, |so_far, (stops, events)| Self {
            stops: so_far.stops || !stops.is_empty(),
            events: so_far.events || events.is_some(),
        })
    }

    pub(crate) fn heads(self) -> impl Iterator<Item = &'static str> {
        [("stop", self.stops), ("seen_events", self.events)].into_iter().filter_map(|(name, here)| here.then_some(name))
    }

    /// The cells of a motion, each after a comma.
    pub(crate) fn cells(self, system: &impl Stops, (stops, events): &Remark) -> String {
        let mut cells = String::new();
        if self.stops {
            cells.push_str(&stops_of(system, stops));
        }
        if self.events {
            cells.push_str(&events.map_or_else(|| ",".to_owned(), |events| format!(",{events}")));
        }
        cells
    }
}

/// The remarks on the motions of a table of verdicts.
pub(crate) fn remarks<'a, D: Told<System: 'a>>(verdicts: impl Iterator<Item = &'a Verdict<D::System>>) -> Remarks {
    Remarks::of(verdicts.map(D::remark))
}
