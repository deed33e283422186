//! Lists of quantities, as they are written in plans.

use crate::PlanError;
use crate::field::{Extra, Field};
use crate::unit::Unit;
use vibroimpact::machine::Machine;
pub use vibroimpact::quantities::{Quantities, Quantity};
use vibroimpact::quantities::{machine_quantities, machine_quantity};
use vibroimpact::verdict::Verdict;

/// The message about a name that is no quantity.
#[must_use]
pub fn unknown(name: &str) -> String {
    let name: String = name.chars().take(60).collect();
    format!("`{name}` is no quantity; there are {}", Quantity::ALL.map(Quantity::name).join(", "))
}

/// The field of a quantity, with these dimensions in addition to those of the grid.
pub(crate) fn field(quantity: Quantity, extra: &[Extra]) -> Field {
    Field::real(quantity.name(), quantity.description(), Unit::nondimensional(quantity.kind()), extra)
}

/// The values of a list of quantities; not-a-number where they are not defined.
pub(crate) fn values(list: &[Quantity], of: Option<Quantities>) -> impl Iterator<Item = f64> {
    list.iter().map(move |quantity| of.map_or(f64::NAN, |of| of.get(*quantity)))
}

/// Checks that the paths lead to quantities of a machine.
pub(crate) fn check_fields(machine: &Machine, fields: &[String]) -> Result<(), PlanError> {
    let known = |path: &String| machine_quantity(machine, path).map(|_| ());
    fields.iter().try_for_each(known).map_err(|error| PlanError::Machine(error.into()))
}

/// The values of quantities of a machine for a motion; not-a-number where they are not defined.
pub(crate) fn values_of(machine: &Machine, verdict: &Verdict<Machine>, fields: &[String]) -> Vec<f64> {
    if fields.is_empty() {
        return Vec::new();
    }
    let found = machine_quantities(machine, verdict);
    let value = |path: &String| found.as_ref().and_then(|found| found.value(machine, path).ok()).unwrap_or(f64::NAN);
    fields.iter().map(value).collect()
}
