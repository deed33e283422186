//! The quantities of a motion of a machine in JSON, in the units of its numbers: those of the whole machine by name, and
//! objects of its forces by order and of its stops, friction joints and coordinates by name.

use serde_json::{Map, Value};
use vibroimpact::chaos::Measured;
use vibroimpact::machine::Machine;
use vibroimpact::quantities::{MachinePart, MachineQuantities};

/// The values; null where a quantity is not defined.
pub(super) fn values(machine: &Machine, found: &MachineQuantities) -> Map<String, Value> {
    by_part(machine, found, |measured| Some(Value::from(measured.value)))
}

/// Three standard errors of the means of a chaotic motion: only those that there are.
pub(super) fn errors(machine: &Machine, found: &MachineQuantities) -> Map<String, Value> {
    by_part(machine, found, |measured| measured.error.is_finite().then(|| Value::from(measured.error)))
}

fn by_part(
    machine: &Machine,
    found: &MachineQuantities,
    value: impl Fn(Measured) -> Option<Value>,
) -> Map<String, Value> {
    let mut all = Map::new();
    let mut parts = ["forces", "stops", "joints", "coordinates"].map(|kind| (kind, Map::new()));
    for (part, quantity, measured) in found.iter() {
        let Some(value) = value(measured) else { continue };
        let (kind, name) = match part {
            MachinePart::Whole => {
                all.insert(quantity.name().to_owned(), value);
                continue;
            }
            MachinePart::Force(order) => ("forces", order.to_string()),
            MachinePart::Stop(j) => ("stops", machine.stops()[j].name.clone()),
            MachinePart::Joint(j) => ("joints", machine.joints()[j].name.clone()),
            MachinePart::Coordinate(i) => ("coordinates", machine.parts().coordinates[i].clone()),
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
