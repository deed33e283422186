//! The border between the starts of two motions, and the motion on it.

use super::motion::MotionObject;
use crate::answer::{AnswerOf, Told};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::edge::{Bordered as _, Edge};

/// The answer to `vibro edge`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct EdgeAnswer<'a> {
    /// The motion of the first start, and that beyond the border.
    sides: [MotionObject<'a>; 2],
    /// Where the border crosses the way from the first start to the second: 0 at the first, 1 at the second.
    part: f64,
    /// The motion on the border.
    track: Vec<TrackObject>,
    /// The motion to which it leads; null if it leads to no cycle that was found.
    saddle: Option<MotionObject<'a>>,
}

/// A state on the border.
#[derive(JsonSchema, Serialize)]
struct TrackObject {
    /// The time since the way between the two starts.
    time: f64,
    q: Vec<f64>,
    qdot: Vec<f64>,
    /// The phase of the force.
    phase: f64,
    /// The distance of the two states between which the border passes, relative to their size.
    apart: f64,
}

impl<'a> EdgeAnswer<'a> {
    pub(crate) fn new<D: Told>(of: &'a AnswerOf<D>, found: &'a Edge<D::System>) -> Self {
        let track = found.track.iter().map(|point| {
            let (q, qdot) = D::numbers(of, &point.state);
            TrackObject {
                time: point.time * of.units.time(),
                q,
                qdot,
                phase: of.system.phase(&point.state),
                apart: point.apart,
            }
        });
        Self {
            sides: found.sides.each_ref().map(|side| D::motion(of, side)),
            part: found.part,
            track: track.collect(),
            saddle: found.saddle.as_ref().map(|saddle| D::motion(of, saddle)),
        }
    }
}
