//! The quantities of a motion, in the units of the results: those of the whole system by name, and of a machine objects of its
//! forces by order and of its stops, friction joints and coordinates by name. Numbers that are not finite become null.

use crate::Units;
use serde_json::{Map, Value};
use vibroimpact::chaos::Measured;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::machine::{self, Part};
use vibroimpact::quantities::{Quantities, Quantity};

/// Those of an oscillator.
pub(crate) fn of_oscillator(found: &Quantities, units: &Units) -> Map<String, Value> {
    let value = |quantity: Quantity| (quantity.name().to_owned(), units.value_of(found, quantity).into());
    Quantity::ALL.into_iter().map(value).collect()
}

/// Three standard errors of the means of a chaotic motion of an oscillator: only those that there are.
pub(crate) fn errors_of_oscillator(errors: &Quantities, units: &Units) -> Map<String, Value> {
    of_oscillator(errors, units).into_iter().filter(|(_, error)| !error.is_null()).collect()
}

/// Those of a machine.
pub(crate) fn of_machine(machine: &Machine, found: &machine::Quantities) -> Map<String, Value> {
    by_part(machine, found, |measured| Some(Value::from(measured.value)))
}

/// Three standard errors of the means of a chaotic motion of a machine: only those that there are.
pub(crate) fn errors_of_machine(machine: &Machine, found: &machine::Quantities) -> Map<String, Value> {
    by_part(machine, found, |measured| measured.error.is_finite().then(|| Value::from(measured.error)))
}

fn by_part(
    machine: &Machine,
    found: &machine::Quantities,
    value: impl Fn(Measured) -> Option<Value>,
) -> Map<String, Value> {
    let mut all = Map::new();
    let mut parts = ["forces", "stops", "joints", "coordinates"].map(|kind| (kind, Map::new()));
    for (part, quantity, measured) in found.iter() {
        let Some(value) = value(measured) else { continue };
        let (kind, name) = match part {
            Part::Whole => {
                all.insert(quantity.name().to_owned(), value);
                continue;
            }
            Part::Force(order) => ("forces", order.to_string()),
            Part::Stop(j) => ("stops", machine.stops()[j].name.clone()),
            Part::Joint(j) => ("joints", machine.joints()[j].name.clone()),
            Part::Coordinate(i) => ("coordinates", machine.parts().coordinates[i].clone()),
        };
        for (_, of) in parts.iter_mut().filter(|(own, _)| *own == kind) {
            if let Value::Object(own) = of.entry(name.as_str()).or_insert_with(|| Value::Object(Map::new())) {
                own.insert(quantity.name().to_owned(), value.clone());
            }
        }
    }
    all.extend(parts.into_iter().map(|(kind, of)| (kind.to_owned(), Value::Object(of))));
    all
}
