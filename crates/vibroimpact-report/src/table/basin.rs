//! A basin: one row for each start, in the order of the cells.

use super::Table;
use super::quantities::{cells, columns};
use crate::Units;
use crate::number::Number;
use vibroimpact::Oscillator;
use vibroimpact::quantities::of_verdict;
use vibroimpact::verdict::CountedMotion;
use vibroimpact_study::{Basin, PlanError};

/// The table of `vibro basin`: the quantities that vary, in the units and with exactly the numbers of the question, the
/// label, and the quantities that the plan asks for.
///
/// # Errors
/// [`PlanError`] if a value of an axis overflows in these units.
pub fn table<'a>(found: &'a Basin, osc: &Oscillator, units: &Units) -> Result<Table<'a>, PlanError> {
    let axes = &found.plan.axes;
    let names: Vec<&str> = axes.iter().map(|axis| units.column_of_coordinate(axis.vary)).collect();
    let texts = axes.iter().map(|axis| {
        let values = units.shown(axis)?;
        Ok(values.all().into_iter().map(|value| Number(value).to_string()).collect())
    });
    let texts = texts.collect::<Result<Vec<Vec<String>>, PlanError>>()?;
    let fields = &found.plan.fields;
    let ending = |motion: &CountedMotion| {
        let quantities = if fields.is_empty() { None } else { of_verdict(osc, &motion.verdict) };
        format!("{}{}", motion.verdict.label(), cells(fields, quantities, units))
    };
    let endings: Vec<String> = found.motions.iter().map(ending).collect();
    let rows = found.cells.iter().enumerate().map(move |(k, motion)| {
        let mut rest = k;
        let mut row = String::new();
        for values in &texts {
            row.push_str(&values[rest % values.len()]);
            row.push(',');
            rest /= values.len();
        }
        row + &endings[usize::from(*motion)]
    });
    Ok(Table::new(format!("{},label{}", names.join(","), columns(fields, units)), rows))
}
