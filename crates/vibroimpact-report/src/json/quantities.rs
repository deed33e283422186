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
