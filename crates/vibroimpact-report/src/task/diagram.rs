//! An orbit diagram: numbers of motions of each kind, and a row for each point.

use crate::figure::tracks;
use crate::json::branch::BranchObject;
use crate::json::event::Stops;
use crate::json::{Pair, Place};
use crate::number::{Number, short};
use crate::text::words::aligned;
use crate::units::shown;
use crate::{ShownValue, Table, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact_study::diagram::{Diagram, DiagramPoint, DiagramStep, MotionKind, Shown, Sweep, SweepDirection};
use vibroimpact_study::{Cut, PlanError, Stretch, counted};

/// The answer to `vibro diagram`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct DiagramAnswer {
    vary: String,
    over: Place,
    #[serde(skip_serializing_if = "Option::is_none")]
    also: Option<Pair>,
    /// The columns of the table.
    columns: Vec<String>,
    sweeps: Vec<Counts>,
}

impl DiagramAnswer {
    pub(crate) fn new<V: Varied, S: ShownValue>(found: &Diagram<V, S>, units: &Units) -> Self {
        let plan = &found.plan;
        Self {
            vary: plan.vary.field(units).to_owned(),
            over: Place::over(&plan.over, plan.vary.unit(units)),
            also: Pair::of(&plan.cut(), units),
            columns: columns(found, units),
            sweeps: counts(found),
        }
    }
}

/// Numbers of motions of each kind in a sweep, or in all scattered starts.
#[derive(Clone, Debug, Default, JsonSchema, Serialize)]
pub struct Counts {
    /// `up`, `down` or `scatter`.
    pub sweep: &'static str,
    /// Number of motions followed.
    pub motions: usize,
    /// Number of motions with impacts.
    pub impact: usize,
    /// Number of motions without further impacts.
    pub none: usize,
    /// Number of motions at rest on a stop for ever.
    pub stuck: usize,
    /// Number of motions whose search used up its steps.
    pub undecided: usize,
    /// Number of points to show.
    pub points: usize,
}

/// The counts, one for each sweep.
pub(crate) fn counts<V, S>(found: &Diagram<V, S>) -> Vec<Counts> {
    let names: &[&str] = match found.plan.direction {
        SweepDirection::Up => &["up"],
        SweepDirection::Down => &["down"],
        SweepDirection::Both => &["up", "down"],
        SweepDirection::Scatter { .. } => &["scatter"],
    };
    let mut counts: Vec<Counts> = names.iter().map(|sweep| Counts { sweep, ..Counts::default() }).collect();
    for step in &found.steps {
        let row = usize::from(step.sweep == Sweep::Down && counts.len() > 1);
        let count = &mut counts[row];
        count.motions += 1;
        count.points += step.points.len();
        *match step.kind {
            MotionKind::Impacts => &mut count.impact,
            MotionKind::NoImpact => &mut count.none,
            MotionKind::Stuck => &mut count.stuck,
            MotionKind::Undecided => &mut count.undecided,
        } += 1;
    }
    counts
}

/// The table of `vibro diagram`: what varies, exactly as in the question, sweep, kind, and what is shown. A motion without points
/// has one row with empty cells.
///
/// # Errors
/// [`PlanError`] if a value of the parameter overflows in these units.
pub fn table<'a, V: Varied, S: ShownValue>(
    found: &'a Diagram<V, S>,
    system: &'a impl Stops,
    units: Units,
) -> Result<Table<'a>, PlanError> {
    let (plan, cut) = (&found.plan, found.plan.cut());
    let over = shown(&plan.over, plan.vary.unit(&units))?;
    let second = cut.also.map(|also| also.parameter.unit(&units));
    let none = ",".repeat(plan.show.columns(&units).len());
    let rows = found.steps.iter().flat_map(move |step| {
        let value = over.at(step.index as usize);
        // the value of the second number, without rounding by a conversion of the first
        let also = second.zip(plan.values(step.index).nth(1)).map(|(unit, value)| format!("{},", Number(value * unit)));
        let head = format!("{},{}{}", Number(value), also.unwrap_or_default(), sweep(step.sweep));
        let alone = step.points.is_empty().then(|| format!("{head},{}{none}", kind(step.kind)));
        let there = plan.vary.units_at(&units, value);
        let units = (there, plan.show.quantity_unit(&there));
        let points = step.points.iter().map(move |point| format!("{head},{}", row(step, point, system, &units)));
        alone.into_iter().chain(points)
    });
    Ok(Table::new(columns(found, &units).join(","), rows))
}

/// The columns of the table.
pub(crate) fn columns<V: Varied, S: ShownValue>(found: &Diagram<V, S>, units: &Units) -> Vec<String> {
    let cut = found.plan.cut();
    let varied = cut.names().map(|number| number.column(units).to_owned());
    varied.chain(["sweep", "kind"].map(str::to_owned)).chain(found.plan.show.columns(units)).collect()
}

/// Kind and numbers of a point, with the unit of a quantity.
fn row(step: &DiagramStep, point: &DiagramPoint, system: &impl Stops, (units, quantity): &(Units, f64)) -> String {
    let closing = |kind: &str, stop: usize, phase: f64, speed: f64| {
        format!("{kind},{},{},{}", system.name_of_stop(stop), Number(phase), Number(speed * units.velocity()))
    };
    match *point {
        DiagramPoint::Impact { stop, phase, speed } => closing("impact", stop, phase, speed),
        DiagramPoint::Chatter { stop, phase } => closing("chatter", stop, phase, 0.0),
        DiagramPoint::State { x, v } => {
            let v = v.map_or_else(String::new, |v| format!(",{}", Number(v * units.velocity())));
            format!("{},{}{v}", kind(step.kind), Number(x * units.length()))
        }
        DiagramPoint::Value(value) => {
            let value = value * quantity;
            // a quantity that is not defined in the frame of these units is an empty cell
            let cell = if value.is_finite() { Number(value).to_string() } else { String::new() };
            format!("{},{cell}", kind(step.kind))
        }
    }
}

fn sweep(sweep: Sweep) -> String {
    match sweep {
        Sweep::Up => "up".into(),
        Sweep::Down => "down".into(),
        Sweep::Start(k) => format!("start {}", k + 1),
    }
}

const fn kind(kind: MotionKind) -> &'static str {
    match kind {
        MotionKind::Impacts => "impact",
        MotionKind::NoImpact => "none",
        MotionKind::Stuck => "stuck",
        MotionKind::Undecided => "undecided",
    }
}

/// The table of `vibro diagram --branches`: the columns of the orbit diagram, and the label and the event of points of branches,
/// which are empty for points from simulation. Of branches, `sweep` has the number, and `kind` is `stable`, `neutral` or `unstable`.
/// There is one row for each closing or state of each point of a branch, or for the quantity that is shown. Solutions that are not
/// admissible are left out.
pub(crate) fn with_branches<V: Varied, S: ShownValue>(
    (behind, units): (&Diagram<V, S>, &Units),
    system: &impl Stops,
    branches: &[BranchObject<'_>],
    shown: tracks::Shown,
) -> Result<Table<'static>, PlanError> {
    let simulated = table(behind, system, *units)?;
    let header = format!("{},label,event", simulated.header);
    let mut rows: Vec<String> = simulated.rows.map(|row| format!("{row},,")).collect();
    for (number, branch) in branches.iter().enumerate() {
        for (k, point) in branch.points.iter().enumerate().filter(|(_, point)| point.admissible) {
            let values: String = point.values().iter().map(|value| format!("{},", Number(*value))).collect();
            let event = branch.event_at(k).map_or("", |event| event.kind);
            let head = format!("{values}branch {},{}", number + 1, point.stability);
            rows.extend(shown.cells(point).into_iter().map(|cells| format!("{head},{cells},{},{event}", point.label)));
        }
    }
    Ok(Table::new(header, rows.into_iter()))
}

/// What varies, and one row for each sweep.
pub(crate) fn text<V: Varied, S: Shown>(found: &Diagram<V, S>, units: &Units) -> String {
    let plan = &found.plan;
    let values = counted(plan.over.count() as u64, "value");
    format!("{values} of {}\n\n{}{}", range(&plan.cut(), units), of_sweeps(&counts(found)), unrepeated(found))
}

/// The ranges of what varies along a line.
pub(crate) fn range<V: Varied>(cut: &Cut<V>, units: &Units) -> String {
    let first = Stretch { parameter: cut.vary.clone(), from: cut.ends.0, to: cut.ends.1 };
    let all = core::iter::once(&first).chain(&cut.also).map(|stretch| over(stretch, units));
    all.collect::<Vec<_>>().join(", ")
}

/// The range of a number.
pub(crate) fn over<V: Varied>(Stretch { parameter, from, to }: &Stretch<V>, units: &Units) -> String {
    let unit = parameter.unit(units);
    format!("{} from {} to {}", parameter.words(units), short(from * unit), short(to * unit))
}

/// How many of the motions did not repeat within what is shown of them.
fn unrepeated<V, S: Shown>(found: &Diagram<V, S>) -> String {
    let (transient, keep) = (found.plan.transient, found.plan.keep);
    let noun = if found.plan.show.is_closings() { "impact" } else { "forcing period" };
    let count = found.steps.iter().filter(|step| step.points.len() as u64 >= keep).count() as u64;
    // of a single point nothing can repeat
    if keep < 2 || count == 0 {
        return String::new();
    }
    format!(
        "\n  {} did not repeat within the {} shown, after {}: chaotic, of a longer period, or not settled by then\n",
        counted(count, "motion"),
        counted(keep, noun),
        counted(transient, noun)
    )
}

/// One row for each sweep.
fn of_sweeps(counts: &[Counts]) -> String {
    let heads = ["<sweep", "motions", "with impacts", "none", "stuck", "undecided", "points"].map(str::to_owned);
    let row = |c: &Counts| {
        let counts = [c.motions, c.impact, c.none, c.stuck, c.undecided, c.points];
        core::iter::once(c.sweep.to_owned()).chain(counts.map(|n| n.to_string())).collect()
    };
    aligned(&heads, &counts.iter().map(row).collect::<Vec<Vec<String>>>())
}
