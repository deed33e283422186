//! Quantities of motions of machines.
//!
//! All come from the closed forms of the flights and are right to rounding: integrals by Gauss-Legendre panels that
//! resolve every mode, extremes from the polynomials through the points of the panels, which miss none.
//!
//! | idea | file |
//! |---|---|
//! | the quantities by name and path, and the parts of a machine | [`MachineQuantity`], [`MachinePart`] |
//! | sums and extremes, and means with error bars | `sums` |
//! | sums along a motion: flights, impacts, chatters | `tally` |
//! | the quantities of a steady motion | [`machine_quantities`], [`MachineQuantities`] |

mod motion;
mod quantity;
mod sums;
mod tally;

pub use motion::{MachineQuantities, machine_cycle_quantities, machine_quantities};
pub use quantity::{MachinePart, MachineQuantity, machine_quantity, machine_quantity_paths};
