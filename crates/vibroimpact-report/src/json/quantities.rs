//! The quantities of a motion.

use crate::Units;
use serde::{Serialize, Serializer};
use vibroimpact::quantities::{Quantities, Quantity};

/// All quantities of a motion in these units, by name.
#[derive(Clone, Copy)]
pub(super) struct QuantityFields {
    values: Quantities,
    units: Units,
}

/// The error bars of quantities in these units, by name: only those that there are.
#[derive(Clone, Copy)]
pub(super) struct QuantityErrors(QuantityFields);

impl QuantityErrors {
    pub(super) const fn new(errors: Quantities, units: &Units) -> Self {
        Self(QuantityFields::new(errors, units))
    }
}

impl Serialize for QuantityErrors {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let QuantityFields { values, units } = &self.0;
        let all = Quantity::ALL.map(|quantity| (quantity.name(), units.value_of(values, quantity)));
        to.collect_map(all.into_iter().filter(|(_, error)| error.is_finite()))
    }
}

impl QuantityFields {
    pub(super) const fn new(values: Quantities, units: &Units) -> Self {
        Self { values, units: *units }
    }
}

impl Serialize for QuantityFields {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        // numbers that are not finite become null
        to.collect_map(Quantity::ALL.map(|quantity| (quantity.name(), self.units.value_of(&self.values, quantity))))
    }
}
