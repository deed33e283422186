//! The contents of a store: a summary, and a table with a row for each point and motion.

use crate::failure::Failure;
use crate::hints;
use crate::report::remarks::Remarks;
use crate::report::tallies::computed;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::{self, Write};
use vibroimpact::QuantityKind;
use vibroimpact::math::sort_by;
use vibroimpact_report::number::Number;
use vibroimpact_report::task::diagram;
use vibroimpact_report::task::map::{LabelCount, label_table, of_points};
use vibroimpact_report::{PROGRAM, Told, Units, Varied};
use vibroimpact_store::{Store, StoreError};
use vibroimpact_study::diagram::ShowText;
use vibroimpact_study::study::{Along, NO_MOTION, NOT_COMPUTED, REFUSED, label_of};
use vibroimpact_study::{
    Axis, BasinPlan, Block, Column, DiagramPlan, Dimension, Field, Plan, PlanError, PointsPlan, Quantity, System, Task,
    Values, Variable, typed_axes,
};

/// A JSON object about a store.
#[derive(Serialize)]
pub(crate) struct StoredFields<'a, Filled: Serialize> {
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    filled: Option<Filled>,
    points: u64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    labels: Vec<LabelCount>,
    plan: &'a Plan,
    plan_hash: String,
    program: &'static str,
}

impl<'a, Filled: Serialize> StoredFields<'a, Filled> {
    pub(crate) fn new(store: &'a Store, filled: Option<Filled>) -> Result<Self, Failure> {
        Ok(Self {
            filled,
            points: store.study().grid().points(),
            labels: labels(store)?,
            plan: store.plan(),
            plan_hash: store.plan().hash(),
            program: PROGRAM,
        })
    }
}

/// The JSON object of a study of points, with the motion at each; `None` for another study.
pub(crate) fn points(store: &Store) -> Result<Option<impl Serialize>, Failure> {
    let plan = store.plan();
    let (Some(system), Task::Basin(task)) = (plan.oscillator(), &plan.task) else { return Ok(None) };
    let task: BasinPlan = task.typed()?;
    let Some(points) = &task.points else { return Ok(None) };
    let column = |name: &str| match store.field(name) {
        Some(k) => store.column(k).map_err(Failure::from),
        None => Err(Failure::Failed(format!("the study has no field {name}"))),
    };
    let labels = match column("label")? {
        Column::I32(codes) => codes.into_iter().map(label_of).collect::<Vec<_>>(),
        _ => Vec::new(),
    };
    let values = task.fields.iter().map(|field| match column(field.name())? {
        Column::F64(values) => Ok(values),
        _ => Ok(vec![f64::NAN; labels.len()]),
    });
    let values = values.collect::<Result<Vec<_>, Failure>>()?;
    Ok(Some(of_points((plan, system), &task, points, &labels, &values)?))
}

/// The labels of all complete tiles, the most frequent first.
fn labels(store: &Store) -> Result<Vec<LabelCount>, Failure> {
    let (Some(label), share) = (store.field("label"), store.field("share")) else { return Ok(Vec::new()) };
    let width = store.study().fields()[label].width();
    let mut counts: BTreeMap<i32, (u64, f64)> = BTreeMap::new();
    let mut total = 0_u64;
    let is_motion = |code: i32| ![NO_MOTION, NOT_COMPUTED, REFUSED].contains(&code);
    if let Some(share) = share {
        for tile in 0..store.study().grid().tiles() {
            let (codes, shares) = (store.tile_field(tile, label)?, store.tile_field(tile, share)?);
            for (k, point) in codes.whole().chunks(width).enumerate() {
                let mut seen = Vec::new();
                for (i, code) in point.iter().enumerate().filter(|(_, code)| is_motion(**code)) {
                    let entry = counts.entry(*code).or_default();
                    entry.1 += shares.real()[k * width + i];
                    if !seen.contains(code) {
                        seen.push(*code);
                        entry.0 += 1;
                    }
                }
                total += u64::from(!seen.is_empty());
            }
        }
    } else {
        // one motion at each point
        #[allow(clippy::cast_precision_loss)] // counts below 2^53
        store.count(label, &mut |_, own| {
            for (code, count) in own.iter().filter(|(code, _)| is_motion(*code)) {
                let entry = counts.entry(*code).or_default();
                *entry = (entry.0 + count, entry.1 + *count as f64);
                total += count;
            }
        })?;
    }
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    let count = |(code, (points, share)): (i32, (u64, f64))| LabelCount {
        label: label_of(code).unwrap_or_default(),
        points,
        share: share / total as f64,
    };
    let mut list: Vec<LabelCount> = counts.into_iter().map(count).collect();
    sort_by(&mut list, |a, b| b.share.total_cmp(&a.share));
    Ok(list)
}

/// The text of a summary.
pub(crate) fn summary(store: &Store) -> Result<String, Failure> {
    let grid = store.study().grid();
    let name = |d: &Dimension| column_of(d, store.plan());
    let sides: Vec<String> = grid.dimensions.iter().rev().map(|d| format!("{} {}", d.count, name(d))).collect();
    let mut text = format!("{}\n{} points: {}\n", title(store.plan()), grid.points(), sides.join(" by "));
    if let Some(own) = computed(store)? {
        text.push_str(&format!("computed: {own} of them; the others have the labels of neighbours that agree\n"));
    }
    let labels = labels(store)?;
    if !labels.is_empty() {
        text.push('\n');
        text.push_str(&label_table(&labels));
    }
    Ok(text)
}

/// The title of a plan, with the axes in the units of the results.
pub(crate) fn title(plan: &Plan) -> String {
    let (title, units) = (plan.title(), Units::of_plan(plan));
    let axes = plan_axes(plan);
    let names: Vec<&str> = axes.iter().map(|axis| axis.vary.column(&units)).collect();
    match title.split_once(" over ") {
        Some((what, _)) if !names.is_empty() => format!("{what} over {}", names.join(", ")),
        _ => title,
    }
}

/// The name of a dimension as in the header of the table.
fn column_of(dimension: &Dimension, plan: &Plan) -> String {
    let axes = plan_axes(plan);
    let axis = axes.iter().find(|axis| axis.vary.name() == dimension.name);
    axis.map_or_else(|| dimension.name.clone(), |axis| axis.vary.column(&Units::of_plan(plan)).to_owned())
}

/// Writes the table of an orbit diagram.
fn of_diagram<D: Told>(
    store: &Store,
    system: &D,
    task: &DiagramPlan<Variable, ShowText>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let columns: Result<Vec<Column>, _> = (0..store.study().fields().len()).map(|k| store.column(k)).collect();
    let found = D::diagram_of(&task.typed().map_err(io::Error::other)?, &columns.map_err(io::Error::other)?);
    let setup = system.setup_of(&store.plan().task).map_err(io::Error::other)?;
    let table = diagram::table(&found, &setup.system, Units::of_plan(store.plan()));
    table.map_err(io::Error::other)?.write(out)
}

/// The fields of a short table, which are those of the command without a store.
const SHORT: [&str; 2] = ["label", "share"];

/// Writes a row for each point and motion, or for each point; with `long` it has all fields.
///
/// For an orbit diagram the table is that of `vibro diagram`.
pub(crate) fn table(store: &Store, long: bool, out: &mut dyn Write) -> io::Result<()> {
    let plan = store.plan();
    if let Task::Diagram(task) = &plan.task {
        return match &plan.system {
            System::Oscillator(system) => of_diagram(store, system, task, out),
            System::Machine(machine) => of_diagram(store, &**machine, task, out),
        };
    }
    let (study, all) = (store.study(), store.study().fields());
    let units = Units::of_plan(plan);
    let asked: &[String] = if plan.machine().is_some() { plan.task.fields() } else { &[] };
    let short = |field: &Field| {
        is_short(field)
            || Quantity::from_name(&field.name).is_some()
            || asked.iter().any(|path| field.name.as_ref() == path.as_str())
    };
    // a long table has the numbers of all fields
    let remarks = if long { Remarks::default() } else { Remarks::of(store, &all, failed)? };
    let is_shown = |k: &usize| long || !has_short(&all) || short(&all[*k]) || remarks.has(*k);
    let shown: Vec<usize> = (0..all.len()).filter(is_shown).collect();
    // scattered starts have no axes; their coordinates are fields; those of machines are in their own units
    let axes = plan_axes(store.plan());
    let along = study.grid().dimensions.iter().map(|d| {
        let axis = axes.iter().find(|axis| axis.vary.name() == d.name);
        let own = || study.coordinates().into_iter().find(|along| along.name == d.name).map(|along| along.values);
        Ok(match axis {
            Some(axis) => Some(units.shown(axis)?.all()),
            None => own(),
        })
    });
    let along = along.collect::<Result<Vec<Option<Vec<f64>>>, PlanError>>().map_err(io::Error::other)?;
    let kinds: Vec<QuantityKind> = all.iter().map(|field| field.unit.kind()).collect();
    let extra = all.iter().find_map(|field| field.extra.first());
    let name = |d: &Dimension| column_of(d, store.plan());
    // points have several coordinates along one dimension
    let further: Vec<Along> = study.coordinates().into_iter().filter(|of| of.name != of.dimension).collect();
    let mut head: Vec<String> = study.grid().dimensions.iter().rev().map(name).collect();
    head.extend(further.iter().map(|of| units.column(&of.name, of.unit.kind())));
    let points = plan_points(store.plan());
    let known = |name: Variable| if let Variable::Coordinate(coordinate) = name { Some(coordinate) } else { None };
    let columns = points.into_iter().flat_map(PointsPlan::varied).filter_map(known);
    let columns = columns.map(|vary| Axis::new(vary, Values::Listed(Vec::new())));
    let varied: Vec<Axis> = axes.iter().cloned().chain(columns).collect();
    let of_points = |index: &[usize]| {
        let dimensions = &study.grid().dimensions;
        let place = |of: &Along| dimensions.iter().position(|d| d.name == of.dimension).map_or(0, |k| index[k]);
        let value = |of: &Along| Number(of.values[place(of)] * units.of_kind(of.unit.kind())).to_string();
        further.iter().map(value).collect::<Vec<_>>()
    };
    let numbered = extra.filter(|extra| extra.name == "direction");
    head.extend(numbered.map(|extra| extra.name.to_owned()));
    let name = |k: &usize| {
        if remarks.is_stop(*k) { "stop".to_owned() } else { units.column(&all[*k].name, kinds[*k]) }
    };
    head.extend(shown.iter().map(name));
    writeln!(out, "{}", head.join(","))?;
    let width = extra.map_or(1, |extra| extra.count);
    bands(store, |block, columns| {
        for p in 0..block.points() {
            let index = block.index(p);
            // axis k is dimension number k from the last
            let units = units.over(&varied, |k| match axes.get(k) {
                Some(axis) => axis.over.at(index[index.len() - 1 - k]),
                None => points.map_or(0.0, |points| points.at(k - axes.len(), index[0])),
            });
            let place = index.iter().zip(&along).rev().map(|(i, values)| match values {
                Some(values) => Number(values[*i]).to_string(),
                None => (i + 1).to_string(),
            });
            let place = place.chain(of_points(&index)).collect::<Vec<_>>().join(",");
            for i in 0..width {
                let cell = |k: &usize| {
                    let at = p * all[*k].width() + if all[*k].width() > 1 { i } else { 0 };
                    if remarks.is_stop(*k) {
                        return remarks.stops(columns, at);
                    }
                    // some quantities are not defined in the frame of the machine
                    let unit = Quantity::from_name(&all[*k].name)
                        .map_or_else(|| units.of_kind(kinds[*k]), |quantity| units.of_quantity(quantity));
                    text(&all[*k], &columns[*k], at, unit)
                };
                if i > 0 && all.iter().enumerate().all(|(k, f)| f.width() == 1 || cell(&k).is_empty()) {
                    continue;
                }
                let cells: Vec<String> = shown.iter().map(cell).collect();
                let number = numbered.map_or_else(String::new, |_| format!(",{}", i + 1));
                writeln!(out, "{place}{number},{}", cells.join(","))?;
            }
        }
        Ok(())
    })
}

/// The points of a plan, if it has any.
fn plan_points(plan: &Plan) -> Option<&PointsPlan<Variable>> {
    match &plan.task {
        Task::Basin(basin) => basin.points.as_ref(),
        _ => None,
    }
}

/// The axes of a map or a basin of an oscillator.
fn plan_axes(plan: &Plan) -> Vec<Axis> {
    match (&plan.system, &plan.task) {
        (System::Oscillator(_), Task::Map(_) | Task::Basin(_)) => typed_axes(plan.task.axes()).unwrap_or_default(),
        _ => Vec::new(),
    }
}

fn is_short(field: &Field) -> bool {
    SHORT.contains(&field.name.as_ref())
}

fn has_short(fields: &[Field]) -> bool {
    fields.iter().any(is_short)
}

/// The text of a number of a column: the name of a flag, and an empty text for a missing value.
fn text(field: &Field, column: &Column, at: usize, unit: f64) -> String {
    match column {
        Column::F64(values) if !(values[at] * unit).is_finite() => String::new(),
        Column::F64(values) => Number(values[at] * unit).to_string(),
        Column::I32(values) if field.name == "label" => match values[at] {
            NOT_COMPUTED => "not_computed".to_owned(),
            REFUSED => "refused".to_owned(),
            code => label_of(code).unwrap_or_default(),
        },
        Column::I32(values) => {
            if values[at] < 0 {
                String::new()
            } else {
                values[at].to_string()
            }
        }
        Column::I8(values) => {
            let flag = field.flags.iter().find(|(value, _)| *value == i32::from(values[at]));
            flag.map_or_else(|| values[at].to_string(), |(_, name)| (*name).to_owned())
        }
    }
}

/// The error of a table of a store that cannot be read.
fn failed(error: &StoreError) -> io::Error {
    io::Error::other(hints::worded(error, hints::store(error)))
}

/// Calls `each` for bands of the grid in order. A band is one tile high in the slowest dimension, so the memory used
/// does not depend on the number of bands.
fn bands(store: &Store, mut each: impl FnMut(&Block, &[Column]) -> io::Result<()>) -> io::Result<()> {
    let (grid, fields) = (store.study().grid(), store.study().fields());
    let per_band = grid.tiles() / grid.tiles_along().first().map_or(1, |n| *n as u64);
    for first in (0..grid.tiles()).step_by(usize::try_from(per_band).unwrap_or(1)) {
        let mut whole = grid.whole();
        whole.ranges[0] = grid.tile(first).ranges[0].clone();
        let mut columns: Vec<Column> = fields.iter().map(|field| field.empty(whole.points())).collect();
        for tile in first..first + per_band {
            let (block, parts) = store.tile(tile).map_err(|error| failed(&error))?;
            for ((field, column), part) in fields.iter().zip(&mut columns).zip(&parts) {
                block.put(part, &whole, field.width(), column);
            }
        }
        each(&whole, &columns)?;
    }
    Ok(())
}
