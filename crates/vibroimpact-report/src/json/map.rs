//! The labels of a map and their frequencies, and the motions at its points.

use super::event::{StateObject, Stops};
use super::system::SystemObject;
use super::{AxisObject, Document};
use crate::units::shown;
use crate::{Asked, FieldName, PROGRAM, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use vibroimpact::Start;
use vibroimpact_plot::{GROUPS, legend_group};
use vibroimpact_study::{
    Axis, BasinPlan, Coordinate, ListedColumn, Parameter, Plan, PlanError, PointsPlan, RegionMap, Share, SystemPlan,
};

/// The answer to `vibro map`, and to `vibro settle-many`, whose points are on no axes.
#[derive(JsonSchema, Serialize)]
pub(super) struct MapAnswer {
    axes: Vec<AxisObject>,
    starts: u64,
    seed: u64,
    /// Number of points where several motions coexist.
    coexisting: usize,
    /// The smallest number of events (of an oscillator: impacts) over which chaos was seen at a point.
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_events: Option<u64>,
    labels: Vec<LabelCount>,
    points: Vec<PointObject>,
}

/// A point: the values of the axes by path, and the motions there, the most frequent first.
#[derive(JsonSchema, Serialize)]
struct PointObject {
    #[serde(flatten)]
    at: Map<String, Value>,
    motions: Vec<ShareObject>,
}

/// A motion at a point.
#[derive(JsonSchema, Serialize)]
struct ShareObject {
    label: String,
    share: f64,
    /// The stops that stay closed for ever.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    stops: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_events: Option<u64>,
    /// Those that the plan asks for.
    #[serde(skip_serializing_if = "Map::is_empty")]
    quantities: Map<String, Value>,
}

/// The frequency of a label.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct LabelCount {
    /// The label.
    pub label: String,
    /// Number of points that have a motion with this label.
    pub points: u64,
    /// Its share of all starts.
    pub share: f64,
}

impl MapAnswer {
    /// The motions of so many starts at each point, of this sequence.
    pub(super) fn new<V: Varied, F: FieldName>(
        found: &RegionMap<V, F>,
        system: &impl Stops,
        (starts, seed): (u64, u64),
        units: &Units,
    ) -> Self {
        // in the units, and with exactly the numbers, of the question; a value that overflows in them is null
        let all =
            |axis: &Axis<V>| shown(&axis.over, axis.vary.unit(units)).map_or_else(|_| Vec::new(), |all| all.all());
        let columns: Vec<Vec<f64>> = found.axes.iter().map(all).collect();
        let point = |(k, motions): (usize, &Vec<Share>)| {
            let mut rest = k;
            let mut at = Map::new();
            for (axis, column) in found.axes.iter().zip(&columns) {
                let count = axis.over.count();
                at.insert(axis.vary.field(units).to_owned(), column.get(rest % count).copied().into());
                rest /= count;
            }
            for column in &found.columns {
                let value = column.values[k] * column.vary.unit(units);
                at.insert(column.vary.field(units).to_owned(), value.into());
            }
            let columns = found.columns.iter();
            let there = columns
                .fold(units.at_point(&found.axes, k), |units, column| column.vary.units_at(&units, column.values[k]));
            let share = |motion: &Share| ShareObject {
                label: motion.label.clone().into_owned(),
                share: motion.share,
                stops: motion.stops.iter().map(|stop| system.name_of_stop(*stop).to_owned()).collect(),
                seen_events: motion.seen_events,
                quantities: (found.fields.iter().zip(&motion.quantities))
                    .map(|(field, value)| (field.text().to_owned(), (value * field.unit(&there)).into()))
                    .collect(),
            };
            PointObject { at, motions: motions.iter().map(share).collect() }
        };
        Self {
            axes: AxisObject::all(&found.axes, units),
            starts,
            seed,
            coexisting: found.coexisting(),
            seen_events: found.seen_events(),
            labels: counts(found),
            points: found.points.iter().enumerate().map(point).collect(),
        }
    }
}

/// The object of `vibro settle-many`, which is that of a map without axes and with one start at each point. Of each point there is a
/// label, or none where its numbers are not allowed, and a value of each field of the plan, nondimensional.
///
/// # Errors
/// [`PlanError`] for a system that is not allowed.
pub fn of_points<'a>(
    (plan, system): (&'a Plan, &SystemPlan),
    task: &BasinPlan,
    points: &PointsPlan,
    labels: &[Option<String>],
    values: &[Vec<f64>],
) -> Result<impl Serialize + use<'a>, PlanError> {
    let (units, osc) = (Units::of_plan(plan), system.oscillator()?);
    let asked = Asked { system: *system, units };
    let varied: Vec<Coordinate> = points.varied().collect();
    let column = |(column, vary): (usize, &Coordinate)| ListedColumn {
        vary: *vary,
        values: (0..labels.len()).map(|k| points.at(column, k)).collect(),
    };
    let share = |k: usize, label: &String| Share {
        label: label.clone().into(),
        share: 1.0,
        quantities: values.iter().map(|values| values[k]).collect(),
        ..Share::default()
    };
    let motions = labels.iter().enumerate().map(|(k, label)| label.iter().map(|label| share(k, label)).collect());
    let found = RegionMap {
        axes: Vec::new(),
        columns: varied.iter().enumerate().map(column).collect(),
        points: motions.collect(),
        fields: task.fields.clone(),
    };
    let answer = MapAnswer::new(&found, &osc, (1, 0), &units);
    let of_system =
        |vary: &Coordinate| if let Coordinate::Parameter(parameter) = vary { Some(*parameter) } else { None };
    let varied: Vec<Parameter> = varied.iter().filter_map(of_system).collect();
    let start = task.start.unwrap_or_default();
    let start = Start { x: start.x.unwrap_or_else(|| Start::at_rest(&osc).x), v: start.v, phase: start.phase };
    let system = SystemObject::of_oscillator(&asked, &osc, &varied);
    let start = Some(StateObject::of_oscillator(&start, &units));
    Ok(Document { system, start, units: Some(units.name()), result: answer, plan, program: PROGRAM })
}

/// Labels in the order of a legend, then by name.
#[must_use]
pub fn counts<V, F>(found: &RegionMap<V, F>) -> Vec<LabelCount> {
    #[allow(clippy::cast_precision_loss)] // at most 1e8
    let all = found.points.len() as f64;
    let mut counts: BTreeMap<(usize, &str), (u64, f64)> = BTreeMap::new();
    for point in &found.points {
        let mut here: Vec<&str> = Vec::new();
        for Share { label, share, .. } in point {
            let group = legend_group(label);
            let rank = GROUPS.iter().position(|g| *g == group).unwrap_or(GROUPS.len());
            let entry = counts.entry((rank, label)).or_default();
            entry.1 += share;
            if !here.contains(&&**label) {
                entry.0 += 1;
                here.push(label);
            }
        }
    }
    let count = |((_, label), (points, share)): ((usize, &str), (u64, f64))| LabelCount {
        label: label.to_owned(),
        points,
        share: share / all,
    };
    counts.into_iter().map(count).collect()
}
