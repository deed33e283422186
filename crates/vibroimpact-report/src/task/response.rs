//! The response over a number: the motions of two sweeps, and the branches on which they lie.

use crate::json::Place;
use crate::number::{Number, short};
use crate::table::cycles::finite;
use crate::text::words::aligned;
use crate::{FieldName, Table, Units, Varied};
use schemars::JsonSchema;
use serde::Serialize;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::machine_quantity;
use vibroimpact_plot::plain;
use vibroimpact_study::{
    Name, Parameter, PlanError, Quantity, ResponseCurves, ResponsePlan, ResponseRow, Values, Variable,
};

/// A response with the names and the units of its report.
#[derive(Clone, Debug)]
pub struct ResponseView<'a> {
    /// The response.
    pub found: &'a ResponseCurves,
    /// What varies.
    pub vary: &'a str,
    /// Its values.
    pub over: &'a Values,
    /// The name of its column in a table, and that of the axis of a figure.
    pub column: String,
    /// See above.
    pub axis: String,
    /// The quantity that is reported, in words, and as the name of an axis.
    pub quantity: String,
    /// See above.
    pub ordinate: String,
    /// The names of the columns of all quantities.
    pub columns: Vec<String>,
    /// The unit of a system with physical units, and what varies.
    units: Option<(Units, Parameter)>,
}

impl<'a> ResponseView<'a> {
    /// Of an oscillator, in its units.
    pub(crate) fn of_oscillator(
        found: &'a ResponseCurves,
        asked: &'a ResponsePlan<Variable, String>,
        units: &Units,
    ) -> Result<Self, PlanError> {
        let plan: ResponsePlan = asked.typed()?;
        let quantity = plan.quantity();
        Ok(Self {
            found,
            vary: units.name_of(plan.vary),
            over: &asked.over,
            column: plan.vary.column(units).to_owned(),
            axis: plan.vary.axis(units),
            quantity: quantity.description().to_owned(),
            ordinate: quantity.axis(units),
            columns: Quantity::ALL.map(|quantity| units.column(quantity.name(), quantity.kind())).to_vec(),
            units: Some((*units, plan.vary)),
        })
    }

    /// Of a machine, in the units of its numbers.
    pub(crate) fn of_machine(
        found: &'a ResponseCurves,
        plan: &'a ResponsePlan<Variable, String>,
        machine: &Machine,
    ) -> Self {
        let path = &found.quantities[found.shown];
        Self {
            found,
            vary: plan.vary.text(),
            over: &plan.over,
            column: plan.vary.text().to_owned(),
            axis: plain(plan.vary.text()),
            quantity: machine_quantity(machine, path)
                .map_or_else(|_| path.clone(), |(part, of)| part.description(of).to_owned()),
            ordinate: plain(path),
            columns: found.quantities.clone(),
            units: None,
        }
    }

    /// The unit of what varies.
    pub(crate) fn unit(&self) -> f64 {
        self.units.map_or(1.0, |(units, vary)| units.of(vary))
    }

    /// The smallest and the largest value of what varies.
    pub(crate) fn ends(&self) -> (f64, f64) {
        let (from, to) = self.over.extent();
        (from * self.unit(), to * self.unit())
    }

    /// What varies, at a motion.
    pub(crate) fn parameter(&self, row: &ResponseRow) -> f64 {
        row.value * self.unit()
    }

    /// Quantity number `k` of a motion.
    pub(crate) fn value(&self, row: &ResponseRow, k: usize) -> f64 {
        let unit = self.units.map_or(1.0, |(units, vary)| units.at(vary, row.value).of_quantity(Quantity::ALL[k]));
        row.quantities[k] * unit
    }

    /// The quantity of a motion that is reported.
    pub(crate) fn shown(&self, row: &ResponseRow) -> f64 {
        self.value(row, self.found.shown)
    }

    /// The same with its unit, as text.
    pub(crate) fn text(&self, row: &ResponseRow) -> String {
        let unit =
            self.units.filter(|(units, _)| units.si).map_or("", |_| Quantity::ALL[self.found.shown].kind().unit());
        format!("{} {unit}", short(self.shown(row))).trim_end().to_owned()
    }
}

/// The answer to `vibro response`.
#[derive(JsonSchema, Serialize)]
pub(crate) struct ResponseAnswer<'a> {
    /// The number that varies.
    vary: &'a str,
    /// Its values.
    over: Place,
    /// The quantity that `value` is.
    quantity: String,
    /// The motions of the sweeps with rising and with falling values.
    sweeps: [SweepObject; 2],
    /// The branches on which their cycles lie.
    branches: Vec<BranchObject>,
}

#[derive(JsonSchema, Serialize)]
struct SweepObject {
    direction: &'static str,
    points: Vec<PointObject>,
}

#[derive(JsonSchema, Serialize)]
struct BranchObject {
    points: Vec<PointObject>,
}

/// A motion of a sweep, or an orbit of a branch.
#[derive(JsonSchema, Serialize)]
struct PointObject {
    /// The value of the parameter.
    parameter: f64,
    /// The label of the motion.
    label: String,
    /// The quantity; null where it is not defined.
    value: f64,
    /// Whether it is stable.
    stable: bool,
    /// `stable`, `neutral` or `unstable`.
    stability: Option<&'static str>,
    /// Whether it is admissible. Motions of a sweep are.
    admissible: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    event: Option<&'static str>,
}

impl<'a> ResponseAnswer<'a> {
    pub(crate) fn new(view: &ResponseView<'a>) -> Self {
        let points = |rows: &[ResponseRow]| {
            let point = |row: &ResponseRow| PointObject {
                parameter: view.parameter(row),
                label: row.label.clone(),
                value: view.shown(row),
                stable: row.stable(),
                stability: row.stability.map(|stability| stability.name()),
                admissible: row.admissible,
                event: row.event,
            };
            rows.iter().map(point).collect()
        };
        let found = view.found;
        Self {
            vary: view.vary,
            over: Place::over(view.over, view.unit()),
            quantity: found.quantities[found.shown].clone(),
            sweeps: [("up", &found.up), ("down", &found.down)]
                .map(|(direction, rows)| SweepObject { direction, points: points(rows) }),
            branches: found.branches.iter().map(|rows| BranchObject { points: points(rows) }).collect(),
        }
    }
}

/// The table of `vibro response`, with all quantities. The first column is `up`, `down` or the number of a branch.
pub(crate) fn table(view: ResponseView<'_>) -> Table<'_> {
    let found = view.found;
    let sweeps = [("up", &found.up), ("down", &found.down)].map(|(name, rows)| (name.to_owned(), rows));
    let branches = found.branches.iter().enumerate().map(|(k, rows)| ((k + 1).to_string(), rows));
    let header = format!("curve,{},label,admissible,stable,stability,event,{}", view.column, view.columns.join(","));
    let curves: Vec<(String, &Vec<ResponseRow>)> = sweeps.into_iter().chain(branches).collect();
    let rows = curves.into_iter().flat_map(move |(name, rows)| {
        let view = view.clone();
        rows.iter().map(move |row| {
            let values: Vec<f64> = (0..row.quantities.len()).map(|k| view.value(row, k)).collect();
            format!(
                "{name},{},{},{},{},{},{}{}",
                Number(view.parameter(row)),
                row.label,
                row.admissible,
                row.stable(),
                row.stability.map_or("", |stability| stability.name()),
                row.event.unwrap_or_default(),
                finite(&values)
            )
        })
    });
    Table::new(header, rows)
}

/// The largest value of each sweep, and one row for each run of values with the same label; `name` is what varies, in words.
pub(crate) fn text(view: &ResponseView<'_>, name: &str) -> String {
    let (found, (from, to)) = (view.found, view.ends());
    let mut text = format!("{} over {name} from {} to {}\n\n", view.quantity, short(from), short(to));
    for (sweep, rows) in [("up", &found.up), ("down", &found.down)] {
        let finite = rows.iter().filter(|row| view.shown(row).is_finite());
        if let Some(most) = finite.max_by(|a, b| view.shown(a).total_cmp(&view.shown(b))) {
            let (value, at) = (view.text(most), short(view.parameter(most)));
            text.push_str(&format!("sweep {sweep}: at most {value} at {at}, {}\n", most.label));
        }
        text.push_str(&runs(rows, view));
        text.push('\n');
    }
    let count = found.branches.len();
    let branches = if count == 1 { "1 branch".to_owned() } else { format!("{count} branches") };
    text + &format!("{branches}; --csv FILE has all points, --plot FILE.png draws them\n")
}

/// Maximum number of rows.
const MOST_ROWS: usize = 30;

/// One row for each run of values with the same label: where it is, and the range of the quantity there.
fn runs(rows: &[ResponseRow], view: &ResponseView<'_>) -> String {
    let runs: Vec<&[ResponseRow]> = rows.chunk_by(|a, b| a.label == b.label).collect();
    let heads = ["<label", "from", "to", "smallest", "largest"].map(str::to_owned);
    let row = |run: &&[ResponseRow]| {
        let values = || run.iter().map(|row| view.shown(row)).filter(|value| value.is_finite());
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let ends =
            run.first().zip(run.last()).map_or((f64::NAN, f64::NAN), |(a, b)| (view.parameter(a), view.parameter(b)));
        let value = |value: f64| if value.is_finite() { short(value) } else { "-".to_owned() };
        vec![
            run.first().map_or_else(String::new, |m| m.label.clone()),
            short(ends.0),
            short(ends.1),
            value(low),
            value(high),
        ]
    };
    let shown: Vec<Vec<String>> = runs.iter().take(MOST_ROWS).map(row).collect();
    let mut text = aligned(&heads, &shown);
    if runs.len() > MOST_ROWS {
        text.push_str(&format!("  ... and {} more\n", runs.len() - MOST_ROWS));
    }
    text
}
