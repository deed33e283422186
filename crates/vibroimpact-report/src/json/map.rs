//! The labels of a map and their frequencies.

use super::Place;
use crate::{Asked, PROGRAM, Units};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use vibroimpact_plot::{GROUPS, legend_group};
use vibroimpact_study::{Axis, Coordinate, Parameter, PhysicalPlan, Plan, RegionMap, SystemPlan};

/// The fields of `vibro map`.
#[derive(Serialize)]
struct MapFields<'a> {
    system: serde_json::Map<String, Value>,
    #[serde(flatten)]
    axes: serde_json::Map<String, Value>,
    starts: u64,
    seed: u64,
    points: usize,
    units: &'static str,
    coexisting: usize,
    labels: Vec<LabelCount>,
    plan: &'a Plan,
    program: &'static str,
}

/// The frequency of a label.
#[derive(Clone, Debug, Serialize)]
pub struct LabelCount {
    /// The label.
    pub label: String,
    /// Number of points that have a motion with this label.
    pub points: u64,
    /// Its share of all starts.
    pub share: f64,
}

/// The object of `vibro map`.
#[must_use]
pub fn document<'a>(asked: &Asked, plan: &'a Plan, found: &RegionMap) -> impl Serialize + use<'a> {
    let task = &found.plan;
    let (system, axes) = objects(&plan.system, &task.axes, &asked.units);
    MapFields {
        system,
        axes,
        starts: task.starts,
        seed: task.seed,
        points: found.points.len(),
        units: asked.units.name(),
        coexisting: coexisting(found),
        labels: counts(found),
        plan,
        program: PROGRAM,
    }
}

/// Number of points where several motions coexist.
#[must_use]
pub fn coexisting(found: &RegionMap) -> usize {
    found.points.iter().filter(|point| point.motions.len() > 1).count()
}

/// The parameters with one value, and those that vary.
fn objects(
    system: &SystemPlan,
    axes: &[Axis],
    units: &Units,
) -> (serde_json::Map<String, Value>, serde_json::Map<String, Value>) {
    let range =
        |axis: &Axis| serde_json::to_value(Place::over(&axis.over, units.of_coordinate(axis.vary))).unwrap_or_default();
    let name = |vary: Coordinate| match vary {
        Coordinate::Parameter(parameter) => units.name_of(parameter),
        start => start.name(),
    };
    let varying = axes.iter().map(|axis| (name(axis.vary).to_owned(), range(axis))).collect();
    (fixed_machine(system, axes).unwrap_or_else(|| fixed_parameters(system, axes)), varying)
}

/// The parameters of the oscillator that do not vary.
fn fixed_parameters(system: &SystemPlan, axes: &[Axis]) -> serde_json::Map<String, Value> {
    let mut fixed = serde_json::Map::new();
    for parameter in Parameter::ALL {
        let given = match parameter {
            Parameter::Beta => system.beta,
            Parameter::InverseBeta => system.inverse_beta,
            Parameter::SecondGap | Parameter::SecondRestitution => None,
            _ => system.value(parameter).ok(),
        };
        if let Some(value) = given.filter(|_| !axes.iter().any(|axis| axis.vary == Coordinate::Parameter(parameter))) {
            fixed.insert(parameter.name().to_owned(), value.into());
        }
    }
    if let Some(stop) = system.second_stop {
        fixed.insert("second_stop".into(), serde_json::json!({ "gap": stop.gap, "restitution": stop.restitution }));
    }
    fixed
}

/// The numbers of the machine that do not vary; `None` if none of its numbers varies. A number that varies may determine
/// several parameters of the oscillator, so these are not listed then.
fn fixed_machine(system: &SystemPlan, axes: &[Axis]) -> Option<serde_json::Map<String, Value>> {
    let varied = |axis: &Axis| match axis.vary {
        Coordinate::Parameter(Parameter::Physical(number)) => Some(number),
        _ => None,
    };
    let mut machine = PhysicalPlan::from(system.machine.as_ref()?);
    axes.iter().any(|axis| varied(axis).is_some()).then_some(())?;
    axes.iter().filter_map(varied).for_each(|number| machine.set(number, None));
    let Ok(Value::Object(mut numbers)) = serde_json::to_value(machine) else { return None };
    numbers.retain(|name, _| axes.iter().all(|axis| axis.vary.name() != name));
    Some(numbers)
}

/// Labels in the order of a legend, then by name.
#[must_use]
pub fn counts(found: &RegionMap) -> Vec<LabelCount> {
    let mut counts: BTreeMap<(usize, String), (u64, f64)> = BTreeMap::new();
    for point in &found.points {
        let mut here: Vec<String> = Vec::new();
        for motion in &point.motions {
            let label = motion.verdict.label().into_owned();
            let group = legend_group(&label);
            let rank = GROUPS.iter().position(|g| *g == group).unwrap_or(GROUPS.len());
            let entry = counts.entry((rank, label.clone())).or_default();
            entry.1 += motion.share;
            if !here.contains(&label) {
                entry.0 += 1;
                here.push(label);
            }
        }
    }
    #[allow(clippy::cast_precision_loss)] // at most 1e8
    let all = found.points.len() as f64;
    counts.into_iter().map(|((_, label), (points, share))| LabelCount { label, points, share: share / all }).collect()
}
