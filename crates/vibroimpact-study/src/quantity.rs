//! Lists of quantities, as they are written in plans.

use crate::field::{Extra, Field, NumberType};
use crate::unit::Unit;
pub use vibroimpact::quantities::{Quantities, Quantity};

/// The message about a name that is no quantity.
#[must_use]
pub fn unknown(name: &str) -> String {
    let name: String = name.chars().take(60).collect();
    format!("`{name}` is no quantity; there are {}", Quantity::ALL.map(Quantity::name).join(", "))
}

/// The field of a quantity, with these dimensions in addition to those of the grid.
pub(crate) fn field(quantity: Quantity, extra: Vec<Extra>) -> Field {
    Field {
        name: quantity.name().into(),
        long_name: quantity.description().into(),
        unit: Unit::nondimensional(quantity.kind()),
        kind: NumberType::F64,
        fill: 0,
        extra,
        flags: Vec::new(),
        comment: "",
    }
}

/// The values of a list of quantities; not-a-number where they are not defined.
pub(crate) fn values(list: &[Quantity], of: Option<Quantities>) -> impl Iterator<Item = f64> {
    list.iter().map(move |quantity| of.map_or(f64::NAN, |of| of.get(*quantity)))
}
