//! A measurement in progress; events are added one by one.

use crate::lyapunov::Tail;
use crate::lyapunov::blocks::{BLOCKS, Block};
use crate::lyapunov::tangent::Frame;
use crate::motion::ImpactState;
use crate::system::{Oscillator, Side};

/// The least number of impacts of the transient, in which the tangent vectors converge to their directions.
const TURNING: u64 = 100;

/// The state of a measurement.
pub(super) struct Run {
    impacts: u64,
    pub(super) transient: u64,
    frame: Frame,
    /// Time since the last impact or release.
    pub(super) since: f64,
    /// Impacts since the last release.
    passed: u64,
    /// The number of impacts since the start.
    pub(super) seen: u64,
    chatters: u64,
    block: Block,
    pub(super) blocks: Vec<Block>,
    /// The last impacts of the measurement; `None` before it begins.
    pub(super) tail: Option<Tail>,
    /// When the mass last stuck on each stop, with the numbers of impacts and chatters until then.
    stuck: [Option<(f64, u64, u64)>; 2],
}

impl Run {
    pub(super) fn new(impacts: u64, transient: u64) -> Self {
        Self {
            impacts: impacts.max(1),
            transient: transient.max(TURNING),
            frame: Frame::default(),
            since: 0.0,
            passed: 0,
            seen: 0,
            chatters: 0,
            block: Block::default(),
            blocks: Vec::new(),
            tail: None,
            stuck: [None; 2],
        }
    }

    /// Adds an impact to the transient or to the measurement.
    pub(super) fn impact(&mut self, osc: &Oscillator, state: ImpactState) {
        let interval = core::mem::take(&mut self.since);
        let area = self.frame.through(osc, interval, &state);
        (self.seen, self.passed) = (self.seen + 1, self.passed + 1);
        let Some(measured) = self.passed.checked_sub(self.transient) else { return };
        if measured == 0 {
            // the transient has ended; the stretches so far are discarded
            self.frame.take();
            self.tail = Some(Tail::new(state));
            return;
        }
        if let Some(tail) = &mut self.tail {
            tail.impact(state, self.impacts.saturating_sub(measured));
        }
        self.block = self.block.plus(&Block { stretch: [0.0; 2], area, time: interval, impacts: 1.0 });
        // blocks of equal length, to within one impact, that fill the run
        let blocks = BLOCKS.min(self.impacts);
        let end = u128::from(self.impacts) * (self.blocks.len() as u128 + 1) / u128::from(blocks);
        if u128::from(measured) >= end {
            let block = core::mem::take(&mut self.block);
            self.blocks.push(Block { stretch: self.frame.take(), ..block });
        }
    }

    pub(super) fn complete(&self) -> bool {
        self.blocks.len() as u64 >= BLOCKS.min(self.impacts)
    }

    /// Whether the transient is over and the measurement has begun.
    pub(super) const fn measuring(&self) -> bool {
        self.passed > self.transient
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
        (self.frame, self.since, self.passed, self.block) = (Frame::default(), 0.0, 0, Block::default());
        self.blocks.clear();
    }
}
