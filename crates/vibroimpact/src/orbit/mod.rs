//! Periodic orbits: found by closed form or by shooting, whether stable or not.
//!
//! | idea | file |
//! |---|---|
//! | a periodic motion: its impacts, label, multipliers | [`Cycle`] |
//! | one impact in n forcing periods, in closed form | [`one_impact`] |
//! | Newton's method on the m-fold impact map | [`shoot`] |
//! | all orbits of a label from many seeds | [`find`] |

mod cycle;
mod find;
mod one_impact;
mod shooting;

pub use cycle::{Cycle, CyclePoint, RestSpan};
pub use find::{FindOptions, Orbit, find};
pub use one_impact::{OneImpact, one_impact};
pub use shooting::{ShootingError, shoot};

pub(crate) use cycle::distance as cycle_distance;
pub(crate) use shooting::Lap;
