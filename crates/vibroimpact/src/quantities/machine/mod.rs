//! Quantities of motions of machines, for each of their parts.
//!
//! All come from the closed forms of the flights and are right to rounding: integrals by Gauss-Legendre panels that
//! resolve every mode, extremes from the polynomials through the points of the panels, which miss none.
//!
//! | idea | file |
//! |---|---|
//! | the parts of a machine, and the paths of their quantities | [`Part`] |
//! | sums and extremes of each part | `sums` |
//! | sums along a motion: flights, impacts, chatters | `tally` |
//! | the quantities of a steady motion | [`machine_quantities`], [`Quantities`] |

mod motion;
mod part;
mod sums;
mod tally;

pub use motion::{Quantities, machine_cycle_quantities, machine_quantities};
pub use part::{Part, machine_quantity, machine_quantity_paths, machine_response_quantity};
