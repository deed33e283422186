//! A basin: one row for each start, in the order of the cells.

use super::Table;
use super::quantities::finite;
use super::remarks::remarks;
use crate::json::event::Stops;
use crate::number::Number;
use crate::units::shown;
use crate::{FieldName, Units, Varied};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::{System, Verdict};
use vibroimpact_study::{Basin, PlanError};

/// Bytes of an ordinary row.
const ROW: usize = 64;

/// The table of `vibro basin`: what varies, in the units and with exactly the numbers of the question, the label, and the quantities
/// that the plan asks for. `remarks` returns what is said of a start beside its label.
fn rows_of_starts<'a, S: System, V: Varied, F: FieldName>(
    found: &'a Basin<S, V, F>,
    units: &Units,
    (heads, remarks): (Vec<&'static str>, impl Fn(usize) -> String + 'a),
) -> Result<Table<'a>, PlanError> {
    let (axes, fields) = (&found.plan.axes, &found.plan.fields);
    let texts = axes.iter().map(|axis| {
        let values = shown(&axis.over, axis.vary.unit(units))?;
        Ok(values.all().into_iter().map(|value| format!("{},", Number(value))).collect())
    });
    let texts = texts.collect::<Result<Vec<Vec<String>>, PlanError>>()?;
    let cells = |values: &Vec<f64>| {
        let value = |(k, field): (usize, &F)| values.get(k).map_or(f64::NAN, |value| value * field.unit(units));
        finite(&fields.iter().enumerate().map(value).collect::<Vec<_>>())
    };
    let quantities: Vec<String> = found.quantities.iter().map(cells).collect();
    // the label of each motion once, because a basin has millions of starts and few motions
    let labels: Vec<String> = found.motions.iter().map(|motion| motion.verdict.label().into_owned()).collect();
    let rows = (0..found.cells.len()).map(move |k| {
        let mut rest = k;
        let mut row = String::with_capacity(ROW);
        for values in &texts {
            row.push_str(&values[rest % values.len()]);
            rest /= values.len();
        }
        let motion = found.motion(k);
        match motion {
            Some(number) => row.push_str(&labels[number]),
            None => row.push_str(&found.label(k)),
        }
        row.push_str(&remarks(k));
        match motion {
            Some(number) => row.push_str(&quantities[number]),
            None => (0..fields.len()).for_each(|_| row.push(',')),
        }
        row
    });
    let varied = axes.iter().map(|axis| axis.vary.column(units).to_owned());
    let own = ["label"].into_iter().chain(heads).map(str::to_owned);
    let header: Vec<String> = varied.chain(own).chain(fields.iter().map(|field| field.column(units))).collect();
    Ok(Table::new(header.join(","), rows))
}

/// One row a start of an oscillator.
///
/// # Errors
/// [`PlanError`] if a value of an axis overflows in these units.
pub fn table<'a>(found: &'a Basin, units: &Units) -> Result<Table<'a>, PlanError> {
    rows_of_starts(found, units, (Vec::new(), |_| String::new()))
}

/// The same of a machine, with what stops and events say more of the label; `refused` beyond a rigid stop.
pub(crate) fn of_machine<'a>(
    machine: &'a impl Stops,
    found: &'a Basin<Machine, String, String>,
) -> Result<Table<'a>, PlanError> {
    let remarks = remarks(found.motions.iter().map(|motion| &motion.verdict));
    let cells = move |k: usize| {
        let verdict = found.motion(k).map(|number| &found.motions[number].verdict);
        remarks.cells(machine, &verdict.map_or_else(Vec::new, Verdict::closed), found.seen_events[k])
    };
    rows_of_starts(found, &Units::default(), (remarks.heads().collect(), cells))
}
