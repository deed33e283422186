//! The labels of a map and their frequencies, and the motions at its points.

use crate::json::event::{StateObject, Stops};
use crate::json::system::SystemObject;
use crate::json::{AxisObject, Document};
use crate::number::{Number, percent};
use crate::table::Remarks;
use crate::table::cycles::finite;
use crate::text::words::aligned;
use crate::text::words::leading;
use crate::units::shown;
use crate::{Asked, FieldName, PROGRAM, Table, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::{BTreeMap, BTreeSet};
use vibroimpact::Start;
use vibroimpact_plot::{GROUPS, legend_group};
use vibroimpact_study::study::{UNDECIDED, label_of};
use vibroimpact_study::{
    Axis, BasinPlan, Coordinate, ImpactsByStop, ListedColumn, Parameter, Plan, PlanError, PointsPlan, RegionMap, Share,
    SystemPlan, counted,
};

/// The answer to `vibro map`, and to `vibro settle-many`, whose points are on no axes.
#[derive(JsonSchema, Serialize)]
pub(crate) struct MapAnswer {
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
    pub(crate) fn new<V: Varied, F: FieldName>(
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
pub(crate) fn counts<V, F>(found: &RegionMap<V, F>) -> Vec<LabelCount> {
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

/// The table of `vibro map`: what varies, in the units and with exactly the numbers of the question, the label, its share of the
/// starts, and the quantities that the plan asks for; with `remarked` also what stops and events say more of the label. Of points
/// that are no grid their number comes first, and there is no share.
pub(crate) fn table<'a, V: Varied, F: FieldName>(
    found: &'a RegionMap<V, F>,
    system: &'a impl Stops,
    (units, remarked): (Units, bool),
) -> Result<Table<'a>, PlanError> {
    let motions = found.motions().filter(|_| remarked);
    let remarks = Remarks::of(motions.map(|motion| (motion.stops.clone(), motion.seen_events)));
    let grid = found.columns.is_empty();
    let axes = &found.axes;
    let values = axes.iter().map(|axis| Ok(shown(&axis.over, axis.vary.unit(&units))?.all()));
    let values = values.collect::<Result<Vec<Vec<f64>>, PlanError>>()?;
    let rows = found.points.iter().enumerate().flat_map(move |(k, motions)| {
        let mut place = if grid { String::new() } else { format!("{},", k + 1) };
        let mut rest = k;
        for values in &values {
            place.push_str(&format!("{},", Number(values[rest % values.len()])));
            rest /= values.len();
        }
        for column in &found.columns {
            place.push_str(&format!("{},", Number(column.values[k] * column.vary.unit(&units))));
        }
        let there = units.at_point(axes, k);
        let row = |motion: &Share| {
            let share = if grid { format!(",{}", Number(motion.share)) } else { String::new() };
            let remarks = remarks.cells(system, &(motion.stops.clone(), motion.seen_events));
            let value =
                |(k, field): (usize, &F)| motion.quantities.get(k).map_or(f64::NAN, |value| value * field.unit(&there));
            let quantities: Vec<f64> = found.fields.iter().enumerate().map(value).collect();
            format!("{place}{}{share}{remarks}{}", motion.label, finite(&quantities))
        };
        let mut rows: Vec<String> = motions.iter().map(row).collect();
        if rows.is_empty() && !grid {
            // numbers that are not allowed, or a start beyond a stop
            let empty = ",".repeat(remarks.heads().count() + found.fields.len());
            rows.push(format!("{place}refused{empty}"));
        }
        rows
    });
    let mut header: Vec<String> = if grid { Vec::new() } else { vec!["sample".to_owned()] };
    header.extend(found.varied().map(|vary| vary.column(&units).to_owned()));
    let own = ["label", "share"].into_iter().take(if grid { 2 } else { 1 });
    header.extend(own.chain(remarks.heads()).map(str::to_owned));
    header.extend(found.fields.iter().map(|field| field.column(&units)));
    Ok(Table::new(header.join(","), rows))
}

/// The number of points with so many starts each, and one row for each label; with the impacts on each of two stops.
pub(crate) fn text<V, F>(found: &RegionMap<V, F>, starts: u64, two_stops: bool) -> String {
    let labels = counts(found);
    let table = if two_stops { by_stop(found, &labels) } else { label_table(&labels) };
    let text = head(found.points.len(), starts, found.coexisting()) + &table;
    match found.points.iter().filter(|motions| motions.is_empty()).count() {
        0 => text,
        refused => text + &format!("  {} refused\n", counted(refused as u64, "point")),
    }
}

/// The number of events over which chaos was seen.
pub(crate) fn seen<V, F>(found: &RegionMap<V, F>) -> String {
    let text = |events| format!("  chaos was seen over at least {}\n", counted(events, "event"));
    found.seen_events().map_or_else(String::new, text)
}

fn head(points: usize, starts: u64, several: usize) -> String {
    let (points, starts) = (counted(points as u64, "point"), counted(starts, "start"));
    format!("{points}, {starts} each; several motions coexist at {several} of them\n\n")
}

/// The text of a table of labels: the most frequent ones, and the others together.
#[must_use]
pub fn label_table(labels: &[LabelCount]) -> String {
    let heads = ["<label", "points", "share of starts"].map(str::to_owned);
    let row = |count: &&LabelCount| vec![count.label.clone(), count.points.to_string(), percent(count.share)];
    let undecided = label_of(UNDECIDED).unwrap_or_default();
    let labels = leading(labels.iter().collect(), |count| count.share, |count| count.label == undecided);
    aligned(&heads, &labels.rows(row, "label", (0, 2, heads.len())))
}

/// The table of labels with the impacts of their motions on each stop.
fn by_stop<V, F>(found: &RegionMap<V, F>, labels: &[LabelCount]) -> String {
    let mut seen: BTreeMap<String, BTreeSet<ImpactsByStop>> = BTreeMap::new();
    for motion in found.motions() {
        if let Some(by_stop) = motion.by_stop {
            seen.entry(motion.label.clone().into_owned()).or_default().insert(by_stop);
        }
    }
    let told = |label: &str| {
        let all = seen.get(label).into_iter().flatten().map(|by| format!("({by})"));
        all.collect::<Vec<_>>().join(" or ")
    };
    let heads = ["<label", "points", "share of starts", "<impacts"].map(str::to_owned);
    let row = |of: &LabelCount| vec![of.label.clone(), of.points.to_string(), percent(of.share), told(&of.label)];
    aligned(&heads, &labels.iter().map(row).collect::<Vec<_>>())
}
