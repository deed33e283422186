//! The object of a machine: its start, the events of its motion, and the reason why the list ends.

use super::branch::ChosenObject;
use super::certainty::Certainty;
use super::diagram::{Counts, machine_counts};
use super::machine_curve::curved;
use super::machine_event::{EventObject, EventOf, StateObject, event_object};
use super::machine_motion::{Estimate, MotionObject, cycle, drift, estimates, motion, multipliers};
use crate::branch_quantity::BranchQuantity;
use crate::{MachineAnswer, PROGRAM};
use core::iter::once;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use vibroimpact::chaos::Measured;
use vibroimpact::continuation::{MachineBranchEvent, MachinePoint};
use vibroimpact_study::{
    MachineAxis, MachineCut, MachineDiagramPlan, MachineFollowed, MachinePlan, MachineResults, MachineSimulated,
    MachineStretch, MachineTask, Values, events_with_states,
};

/// The object that a command prints: the machine, the start, the fields of the command, and the plan.
#[derive(Serialize)]
struct Document<'a, T> {
    machine: &'a str,
    coordinates: &'a [String],
    start: StateObject<'a>,
    #[serde(flatten)]
    result: T,
    plan: &'a MachinePlan,
    program: &'static str,
}

/// The fields of `vibro simulate --machine`. Events are converted while they are written.
#[derive(Serialize)]
struct Simulation<'a> {
    #[serde(serialize_with = "each_event")]
    events: (&'a MachineAnswer, usize),
    end: EndObject,
}

#[derive(Serialize)]
struct EndObject {
    reason: &'static str,
    time: f64,
}

#[derive(Serialize)]
struct Settled<'a> {
    motion: MotionObject<'a>,
    events_followed: u64,
    time_followed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    chaotic_transient: Option<Vec<Estimate>>,
}

#[derive(Serialize)]
struct Shared<'a> {
    #[serde(flatten)]
    motion: MotionObject<'a>,
    share: f64,
    count: u64,
}

#[derive(Serialize)]
struct Attractors<'a> {
    motions: Vec<Shared<'a>>,
    #[serde(flatten)]
    certainty: Certainty,
    starts: u64,
}

#[derive(Serialize)]
struct OrbitObject<'a> {
    #[serde(flatten)]
    motion: MotionObject<'a>,
    physical: bool,
}

#[derive(Serialize)]
struct Orbits<'a> {
    orbits: Vec<OrbitObject<'a>>,
}

#[derive(Serialize)]
struct Exponents<'a> {
    exponents: Option<Vec<Estimate>>,
    impacts_per_period: Option<Estimate>,
    exact: bool,
    motion: MotionObject<'a>,
}

#[derive(Serialize)]
struct PointObject<'a> {
    parameter: f64,
    /// Values of both numbers, on a line through two.
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<[f64; 2]>,
    label: String,
    /// The time of one period.
    period: f64,
    cycle: Vec<EventObject<'a>>,
    multipliers: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drift: Option<Map<String, Value>>,
    /// The quantity that the figure shows, of a machine without stops.
    #[serde(skip_serializing_if = "Option::is_none")]
    quantities: Option<Map<String, Value>>,
    stable: bool,
    stability: &'static str,
    physical: bool,
}

#[derive(Serialize)]
struct BranchEventObject<'a> {
    kind: &'static str,
    parameter: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    values: Option<[f64; 2]>,
    /// Number of the point, counted from 0.
    point: usize,
    label: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    appears: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turns: Option<bool>,
}

#[derive(Serialize)]
struct Branched<'a> {
    vary: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<&'a MachineStretch>,
    /// Absent for the motion from the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    orbit: Option<ChosenObject>,
    #[serde(flatten)]
    main: PointsObject<'a>,
    /// The branches that begin at flips and branch points.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    followed: Vec<FollowedObject<'a>>,
}

#[derive(Serialize)]
struct PointsObject<'a> {
    points: Vec<PointObject<'a>>,
    events: Vec<BranchEventObject<'a>>,
}

#[derive(Serialize)]
struct FollowedObject<'a> {
    /// The value of the number at the flip or branch point at which it begins.
    #[serde(skip_serializing_if = "Option::is_none")]
    flip: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    branch_point: Option<f64>,
    #[serde(flatten)]
    branch: PointsObject<'a>,
}

#[derive(Serialize)]
struct Basin<'a> {
    motions: Vec<Shared<'a>>,
    starts: usize,
    /// Starts beyond a rigid stop.
    refused: usize,
    axes: &'a [MachineAxis],
    /// The number of the motion of each start, the first axis varying fastest; null beyond a rigid stop.
    cells: &'a [Option<usize>],
}

#[derive(Serialize)]
struct Mapped<'a> {
    axes: &'a [MachineAxis],
    /// How many points have each label.
    labels: BTreeMap<String, u64>,
    /// The smallest number of events over which chaos was seen at a point; absent without chaos.
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_events: Option<u64>,
    points: usize,
}

#[derive(Serialize)]
struct Diagrammed<'a> {
    vary: &'a str,
    over: &'a Values,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<&'a MachineStretch>,
    show: &'a str,
    sweeps: Vec<Counts>,
}

impl Serialize for MachineAnswer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { machine, results, .. } = self;
        match results {
            MachineResults::Simulate(MachineSimulated { events, reason, time, .. }) => {
                let end = EndObject { reason, time: *time };
                self.document(Simulation { events: (self, events.len()), end }, to)
            }
            MachineResults::Settle(found) => self.document(
                Settled {
                    motion: motion(machine, &found.verdict),
                    events_followed: found.events,
                    time_followed: found.time,
                    chaotic_transient: found.transient.as_ref().map(estimates),
                },
                to,
            ),
            MachineResults::Attractors(census) => {
                let motions = census.by_share().into_iter().map(|found| Shared {
                    motion: motion(machine, &found.verdict),
                    share: census.share(found),
                    count: found.count,
                });
                let counts = census.by_share().into_iter().map(|found| found.count);
                let certainty = Certainty::of(counts, census.total());
                self.document(Attractors { motions: motions.collect(), certainty, starts: census.total() }, to)
            }
            MachineResults::Orbit(found) => {
                let orbits = found.iter().map(|found| OrbitObject { motion: cycle(machine, found), physical: true });
                self.document(Orbits { orbits: orbits.collect() }, to)
            }
            MachineResults::Lyapunov(found, _) => {
                let spectrum = found.spectrum.as_ref();
                let rate = spectrum.zip(machine.period()).map(|(spectrum, period)| Measured {
                    value: spectrum.closings.value * period,
                    error: spectrum.closings.error * period,
                });
                self.document(
                    Exponents {
                        exponents: spectrum.map(estimates),
                        impacts_per_period: rate.map(Estimate::from),
                        exact: found.exact,
                        motion: motion(machine, &found.motion),
                    },
                    to,
                )
            }
            MachineResults::Branch(found) => {
                let MachineTask::Branch(plan) = &self.plan.task else {
                    return Err(serde::ser::Error::custom("the plan is that of another task"));
                };
                let cut = plan.cut(&self.plan.machine).map_err(serde::ser::Error::custom)?;
                let quantity = BranchQuantity::of(machine, &self.plan.machine, &cut, found);
                let points = |points| self.points(points, &cut, quantity.as_ref());
                let followed = found.followed.iter();
                let at = |followed: &MachineFollowed, event| (followed.event == event).then_some(followed.at);
                let followed = followed
                    .map(|followed| FollowedObject {
                        flip: at(followed, MachineBranchEvent::Flip),
                        branch_point: at(followed, MachineBranchEvent::BranchPoint),
                        branch: points(&followed.points),
                    })
                    .collect();
                let (orbit, main) = (ChosenObject::of_machine(found.among), points(&found.points));
                self.document(Branched { vary: &cut.vary, also: cut.also.as_ref(), orbit, main, followed }, to)
            }
            MachineResults::Curve(found) => {
                let MachineTask::Curve(plan) = &self.plan.task else {
                    return Err(serde::ser::Error::custom("the plan is that of another task"));
                };
                self.document(curved(machine, plan, found), to)
            }
            MachineResults::Basin(found) => {
                let motions = found.motions.iter().zip(found.shares()).map(|(verdict, (count, share))| Shared {
                    motion: motion(machine, verdict),
                    share,
                    count,
                });
                self.document(
                    Basin {
                        motions: motions.collect(),
                        starts: found.cells.len(),
                        refused: found.refused(),
                        axes: &found.axes,
                        cells: &found.cells,
                    },
                    to,
                )
            }
            MachineResults::Diagram(found) => {
                let MachineDiagramPlan { vary, over, also, show, .. } = &found.plan;
                let also = also.as_ref();
                self.document(Diagrammed { vary, over, also, show, sweeps: machine_counts(found) }, to)
            }
            MachineResults::Map(found) => {
                let (labels, points) = (found.labels(), found.cells.len());
                self.document(Mapped { axes: &found.axes, labels, seen_events: found.seen_events(), points }, to)
            }
        }
    }
}

impl MachineAnswer {
    /// Writes the object with these fields.
    fn document<S: Serializer, T: Serialize>(&self, result: T, to: S) -> Result<S::Ok, S::Error> {
        let Self { name, plan, machine, start, .. } = self;
        let coordinates = machine.parts().coordinates.as_slice();
        let start = StateObject::of(machine, start);
        Document { machine: name, coordinates, start, result, plan, program: PROGRAM }.serialize(to)
    }

    fn points<'a>(
        &'a self,
        points: &'a [MachinePoint],
        cut: &MachineCut,
        quantity: Option<&BranchQuantity<'_>>,
    ) -> PointsObject<'a> {
        let machine = &self.machine;
        let values = |value: f64| cut.values(value).nth(1).map(|second| [value, second]);
        let events = points.iter().enumerate().filter_map(|(k, point)| {
            let event = point.event?;
            let (appears, turns) = match event {
                MachineBranchEvent::Grazing { appears, turns, .. } => (Some(appears), Some(turns)),
                _ => (None, None),
            };
            Some(BranchEventObject {
                kind: event.name(),
                parameter: point.value,
                values: values(point.value),
                point: k,
                label: point.cycle.label.to_string(),
                stop: event.place().map(|place| machine.name_of(place)),
                appears,
                turns,
            })
        });
        let of = |point: &'a MachinePoint| PointObject {
            parameter: point.value,
            values: values(point.value),
            label: point.cycle.label.to_string(),
            period: point.cycle.period,
            cycle: point.cycle.events.iter().map(|event| event_object(machine, event)).collect(),
            multipliers: multipliers(&point.cycle.multipliers),
            drift: drift(machine, &point.cycle),
            quantities: quantity.map(|quantity| once((quantity.path.clone(), quantity.at(point).into())).collect()),
            stable: point.cycle.stable(),
            stability: point.cycle.stability().name(),
            physical: true,
        };
        PointsObject { points: points.iter().map(of).collect(), events: events.collect() }
    }
}

/// The events with their states.
fn each_event<S: Serializer>((answer, count): &(&MachineAnswer, usize), serializer: S) -> Result<S::Ok, S::Error> {
    let MachineAnswer { plan, machine, start, .. } = answer;
    let MachineTask::Simulate { periods, .. } = plan.task else {
        return Err(serde::ser::Error::custom("the plan is that of another task"));
    };
    let events = events_with_states(machine, start, periods).map_err(serde::ser::Error::custom)?;
    serializer.collect_seq(events.take(*count).map(|event| EventOf(machine, event)))
}
