//! The object of a machine: its start, the events of its motion, and the reason why the list ends.

use super::branch::BranchFields;
use super::certainty::Certainty;
use super::diagram::{Counts, machine_counts};
use super::event::{EventOf, StateObject};
use super::machine_curve::curved;
use super::map::MapFields;
use super::motion::{ChaosObject, Estimate, MotionObject, SharedMotion, estimates};
use super::simulate::EndObject;
use super::system::SystemObject;
use super::{AxisObject, Document, Pair, Place};
use crate::{MachineAnswer, PROGRAM};
use serde::ser::Error;
use serde::{Serialize, Serializer};
use vibroimpact::chaos::Measured;
use vibroimpact_study::{MachineDiagramPlan, MachineResults, MachineSimulated, MachineTask, events_with_states};

/// The fields of `vibro simulate --machine`. Events are converted while they are written.
#[derive(Serialize)]
struct Simulation<'a> {
    #[serde(serialize_with = "each_event")]
    events: (&'a MachineAnswer, usize),
    end: EndObject,
}

#[derive(Serialize)]
struct Settled<'a> {
    motion: MotionObject<'a>,
    events_followed: u64,
    time_followed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    chaotic_transient: Option<ChaosObject>,
}

#[derive(Serialize)]
struct Attractors<'a> {
    motions: Vec<SharedMotion<'a>>,
    #[serde(flatten)]
    certainty: Certainty,
    starts: u64,
}

#[derive(Serialize)]
struct OrbitObject<'a> {
    #[serde(flatten)]
    motion: MotionObject<'a>,
    admissible: bool,
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
struct Basin<'a> {
    motions: Vec<SharedMotion<'a>>,
    starts: usize,
    /// Starts beyond a rigid stop.
    refused: usize,
    axes: Vec<AxisObject<'a>>,
    /// The number of the motion of each start, the first axis varying fastest; null beyond a rigid stop.
    cells: &'a [Option<usize>],
}

#[derive(Serialize)]
struct Diagrammed<'a> {
    vary: &'a str,
    over: Place,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Pair<'a>>,
    show: &'a str,
    sweeps: Vec<Counts>,
}

impl Serialize for MachineAnswer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { machine, results, .. } = self;
        match results {
            MachineResults::Simulate(MachineSimulated { events, reason, time, .. }) => {
                let end = EndObject { reason, time: *time, horizon: None };
                self.document(Simulation { events: (self, events.len()), end }, to)
            }
            MachineResults::Settle(found) => self.document(
                Settled {
                    motion: MotionObject::of_machine(machine, &found.verdict),
                    events_followed: found.events,
                    time_followed: found.time,
                    chaotic_transient: found.transient.as_ref().map(ChaosObject::of_machine),
                },
                to,
            ),
            MachineResults::Attractors(census) => {
                let motions = census.by_share().into_iter().map(|found| SharedMotion {
                    motion: MotionObject::of_machine(machine, &found.verdict),
                    share: census.share(found),
                    starts: found.count,
                });
                let counts = census.by_share().into_iter().map(|found| found.count);
                let certainty = Certainty::of(counts, census.total());
                self.document(Attractors { motions: motions.collect(), certainty, starts: census.total() }, to)
            }
            MachineResults::Orbit(found) => {
                let orbits = found.iter().map(|found| OrbitObject { motion: MotionObject::of_cycle(machine, found), admissible: true });
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
                        motion: MotionObject::of_machine(machine, &found.motion),
                    },
                    to,
                )
            }
            MachineResults::Branch(found) => {
                let MachineTask::Branch(plan) = &self.plan.task else { return Err(other_task()) };
                let cut = plan.cut(&self.plan.machine).map_err(Error::custom)?;
                self.document(BranchFields::of_machine(self, plan, &cut, found), to)
            }
            MachineResults::Curve(found) => {
                let MachineTask::Curve(plan) = &self.plan.task else { return Err(other_task()) };
                self.document(curved(machine, plan, found), to)
            }
            MachineResults::Basin(found) => {
                let motions = found.motions.iter().zip(found.shares()).map(|(verdict, (starts, share))| SharedMotion {
                    motion: MotionObject::of_machine(machine, verdict),
                    share,
                    starts,
                });
                self.document(
                    Basin {
                        motions: motions.collect(),
                        starts: found.cells.len(),
                        refused: found.refused(),
                        axes: AxisObject::of_machine(&found.axes),
                        cells: &found.cells,
                    },
                    to,
                )
            }
            MachineResults::Diagram(found) => {
                let MachineDiagramPlan { vary, over, also, show, .. } = &found.plan;
                let also = also.as_ref().map(|also| Pair { parameter: &also.path, from: also.from, to: also.to });
                self.document(Diagrammed { vary, over: Place::over(over, 1.0), also, show, sweeps: machine_counts(found) }, to)
            }
            MachineResults::Map(found) => {
                let MachineTask::Map(plan) = &self.plan.task else { return Err(other_task()) };
                self.document(MapFields::of_machine(machine, plan, found), to)
            }
        }
    }
}

/// A plan and its results come together, so this does not occur.
fn other_task<E: Error>() -> E {
    E::custom("the plan is that of another task")
}

impl MachineAnswer {
    /// Writes the object with these fields.
    fn document<S: Serializer, T: Serialize>(&self, result: T, to: S) -> Result<S::Ok, S::Error> {
        let Self { name, plan, machine, start, .. } = self;
        let (system, start) = (SystemObject::of_machine(name, machine), Some(StateObject::of(machine, start)));
        Document { system, start, units: None, result, plan, program: PROGRAM }.serialize(to)
    }
}

/// The events with their states.
fn each_event<S: Serializer>((answer, count): &(&MachineAnswer, usize), serializer: S) -> Result<S::Ok, S::Error> {
    let MachineAnswer { plan, machine, start, .. } = answer;
    let MachineTask::Simulate { periods, .. } = plan.task else { return Err(other_task()) };
    let events = events_with_states(machine, start, periods).map_err(Error::custom)?;
    serializer.collect_seq(events.take(*count).map(|event| EventOf(machine, event)))
}
