//! Points that are given one by one.

use crate::name::renamed;
use crate::{Coordinate, PlanError};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The values of one number at all points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ListedColumn<V = Coordinate> {
    /// What varies.
    pub vary: V,
    /// Its value at each point.
    pub values: Vec<f64>,
}

renamed!(ListedColumn: names vary, parts, others values);

/// Maximum number of points.
const MOST: u64 = 1_000_000_000;

/// A number of points as a length in memory.
pub(super) fn length(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

/// Checks that there are points, that all columns have the same length, and that their values are finite.
pub(super) fn check<V: Clone + Into<Cow<'static, str>>>(columns: &[ListedColumn<V>]) -> Result<(), PlanError> {
    let name = |column: &ListedColumn<V>| -> Cow<'static, str> { column.vary.clone().into() };
    let count = columns.first().map_or(0, |column| column.values.len());
    if count == 0 || count as u64 > MOST {
        return Err(PlanError::outside("points", count as u64, (1, MOST)));
    }
    for column in columns {
        if column.values.len() != count {
            let (first, other, length) = (name(&columns[0]), name(column), column.values.len());
            let why = "every column has one value for each point";
            return Err(PlanError::refused(format!("{first} has {count} values and {other} has {length}: {why}")));
        }
        if let Some(k) = column.values.iter().position(|value| !value.is_finite()) {
            let (name, value) = (name(column), column.values[k]);
            return Err(PlanError::refused(format!("{name} = {value} is not finite")).at_point(k));
        }
    }
    Ok(())
}
