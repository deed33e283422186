//! What following one motion gives: the points to show, of what kind they are, and where it was left.

use vibroimpact::verdict::SettleOptions;
use vibroimpact::{Oscillator, Side, Start};

/// What the motion at one value turned out to be, after the transient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// It strikes.
    Impacts,
    /// It strikes no more: for ever, for as long as was searched (a thousand periods at least), or, in a stroboscopic
    /// diagram, in the periods shown.
    NoImpact,
    /// At rest on a stop for ever.
    Stuck,
    /// It was not followed to the end: the budget of search steps ran out.
    Undecided,
}

/// A point of the diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DiagramPoint {
    /// An impact.
    Impact {
        /// Phase of the force.
        phase: f64,
        /// Speed of arrival.
        velocity: f64,
        /// Which stop.
        side: Side,
    },
    /// The end of a complete chatter: infinitely many impacts, ever slower, lie between the last impact and this.
    Chatter {
        /// Phase of the force.
        phase: f64,
        /// Which stop.
        side: Side,
    },
    /// The state at phase 0 of the force.
    State {
        /// Position.
        x: f64,
        /// Velocity.
        v: f64,
    },
}

/// A motion followed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AfterTransient {
    pub(super) kind: MotionKind,
    pub(super) points: Vec<DiagramPoint>,
    /// Its state at the end.
    pub(super) last: Start,
}

/// Two points closer than this (phases in radians, speeds relative to themselves, states to their size) are one point
/// come back: far above what rounding does to a cycle, far below what an eye sees.
pub(super) const SAME: f64 = 1e-9;

/// Search steps and events a motion may take: those of a verdict, and a thousand for each impact or period asked for.
pub(super) fn budget(transient: u64, keep: u64) -> u64 {
    SettleOptions::default().max_steps + 1000 * (transient + keep)
}

/// The state `from` of the oscillator `before` as a start of `osc`: what is on a stop stays on it, what a stop has moved
/// over is on that stop.
pub(super) fn carried(from: Start, before: &Oscillator, osc: &Oscillator) -> Start {
    let (was_lowest, was_highest) = Start::room(before);
    let (lowest, highest) = Start::room(osc);
    let x = if from.x >= was_highest {
        highest
    } else if from.x <= was_lowest {
        lowest
    } else {
        from.x.clamp(lowest, highest)
    };
    Start { x, ..from }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_carried_state_is_within_the_stops() {
        let osc = |gap, second| Oscillator::new(0.9, gap, 0.5).unwrap().with_second_stop(second, 0.5).unwrap();
        let at = |x| Start { x, v: 1.0, phase: 2.0 };
        let (wide, narrow) = (osc(2.0, 2.0), osc(1.0, 0.5));
        for (x, expected) in [(2.0, 1.0), (1.5, 1.0), (0.25, 0.25), (-1.0, -0.5), (-2.0, -0.5)] {
            assert_eq!(carried(at(x), &wide, &narrow), at(expected));
        }
        for (x, expected) in [(1.0, 2.0), (0.25, 0.25), (-0.5, -2.0)] {
            assert_eq!(carried(at(x), &narrow, &wide), at(expected));
        }
    }
}
