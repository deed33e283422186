//! Columns of quantities.

use crate::Units;
use crate::number::Number;
use vibroimpact::quantities::{Quantities, Quantity};

/// The names of the columns, each after a comma.
pub(super) fn columns(list: &[Quantity], units: &Units) -> String {
    list.iter().map(|quantity| format!(",{}", units.column(quantity.name(), quantity.kind()))).collect()
}

/// The cells of a row, each after a comma. A quantity that is not defined or infinite is an
/// empty cell.
pub(super) fn cells(list: &[Quantity], of: Option<Quantities>, units: &Units) -> String {
    let value = |quantity: &Quantity| of.map_or(f64::NAN, |of| units.value_of(&of, *quantity));
    finite(&list.iter().map(value).collect::<Vec<_>>())
}

/// Numbers, each after a comma; empty where they are not defined or infinite.
pub(super) fn finite(values: &[f64]) -> String {
    let cell = |value: &f64| if value.is_finite() { format!(",{}", Number(*value)) } else { ",".to_owned() };
    values.iter().map(cell).collect()
}
