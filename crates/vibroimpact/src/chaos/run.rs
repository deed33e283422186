//! The measurement along the impacts of an oscillator in progress.

use crate::lyapunov::{Run, Tail, tangent};
use crate::motion::ImpactState;
use crate::system::{Oscillator, Side};

/// The least number of impacts of the transient, in which the tangent vectors converge to their directions.
const TURNING: u64 = 100;

/// The state of a measurement; impacts are added one by one.
pub(super) struct Impacts {
    pub(super) run: Run,
    /// Time since the last impact or release.
    pub(super) since: f64,
    /// The number of impacts since the start.
    pub(super) seen: u64,
    chatters: u64,
    /// The last impacts of the measurement; `None` before it begins.
    pub(super) tail: Option<Tail>,
    /// When the mass last stuck on each stop, with the numbers of impacts and chatters until then.
    stuck: [Option<(f64, u64, u64)>; 2],
}

impl Impacts {
    pub(super) fn new(impacts: u64, transient: u64) -> Self {
        Self {
            run: Run::new(tangent::frame(), transient.max(TURNING), impacts),
            since: 0.0,
            seen: 0,
            chatters: 0,
            tail: None,
            stuck: [None; 2],
        }
    }

    /// Adds an impact to the transient or to the measurement.
    pub(super) fn impact(&mut self, osc: &Oscillator, state: ImpactState) {
        let interval = core::mem::take(&mut self.since);
        self.run.add(|frame| tangent::through(frame, osc, interval, &state), interval, 1.0);
        self.seen += 1;
        match (self.run.measured(), &mut self.tail) {
            (Some(0), tail) => *tail = Some(Tail::new(state)),
            (Some(_), Some(tail)) => tail.impact(&state, self.run.left()),
            _ => {}
        }
    }

    /// Records that the mass sticks on a stop; the second time, the number of impacts per forcing period.
    pub(super) fn stick(&mut self, osc: &Oscillator, side: Side, time: f64, chatter: bool) -> Option<f64> {
        self.chatters += u64::from(chatter);
        let now = (time, self.seen, self.chatters);
        let (then, seen, chatters) = self.stuck[usize::from(side == Side::Lower)].replace(now)?;
        let periods = ((time - then) / osc.period()).round();
        #[allow(clippy::cast_precision_loss)] // a few
        let impacts = (self.seen - seen) as f64;
        Some(if self.chatters > chatters { f64::INFINITY } else { impacts / periods })
    }

    /// Begins again: the mass was released, or the motion has settled after the measurement had begun.
    pub(super) fn begin_again(&mut self) {
        self.since = 0.0;
        self.run.begin_again();
    }
}
