//! A basin: one row a start, in the order of the cells.

use super::Table;
use crate::Units;
use crate::figure::plane::unit;
use crate::number::Number;
use crate::units::shown;
use vibroimpact_study::{Basin, PlanError};

/// The table of `vibro basin`: what varies, in the units and with the very numbers of the question, and the label.
///
/// # Errors
/// [`PlanError`] where the values of an axis leave the range of numbers in these units.
pub fn table<'a>(found: &'a Basin, units: &Units) -> Result<Table<'a>, PlanError> {
    let axes = &found.plan.axes;
    let names: Vec<&str> = axes.iter().map(|axis| axis.vary.name()).collect();
    let texts = axes.iter().map(|axis| {
        let values = shown(&axis.over, unit(axis.vary, units))?;
        Ok(values.all().into_iter().map(|value| Number(value).to_string()).collect())
    });
    let texts = texts.collect::<Result<Vec<Vec<String>>, PlanError>>()?;
    let labels: Vec<String> = found.motions.iter().map(|motion| motion.verdict.label().into_owned()).collect();
    let rows = found.cells.iter().enumerate().map(move |(k, motion)| {
        let mut rest = k;
        let mut row = String::new();
        for values in &texts {
            row.push_str(&values[rest % values.len()]);
            row.push(',');
            rest /= values.len();
        }
        row + &labels[usize::from(*motion)]
    });
    Ok(Table::new(format!("{},label", names.join(",")), rows))
}
