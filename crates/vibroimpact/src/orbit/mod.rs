//! Periodic orbits: found by closed form or by shooting, whether stable or not.
//!
//! | idea | file |
//! |---|---|
//! | a periodic motion: its impacts, label, multipliers | [`Cycle`] |
//! | one impact in n forcing periods, in closed form | [`one_impact`] |
//! | Newton's method on the m-fold impact map | [`shoot`] |
//! | cycles that stick, from their release | [`from_release`] |
//! | all orbits of a label from many seeds | [`find`] |

mod cycle;
mod find;
mod one_impact;
mod release;
mod shooting;

pub use cycle::{Cycle, CyclePoint, RestSpan};
pub use find::{FindOptions, Orbit, find};
pub use one_impact::{OneImpact, one_impact};
pub use release::{DEFAULT_EVENTS, from_release};
pub use shooting::{ShootingError, shoot};

pub(crate) use cycle::distance as cycle_distance;
pub(crate) use shooting::{Lap, flight_limits};
