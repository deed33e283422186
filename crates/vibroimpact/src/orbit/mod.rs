//! Periodic orbits, stable or not: in closed form, by shooting, and by Newton's method on the equations of all impacts.
//!
//! | idea | file |
//! |---|---|
//! | a periodic motion: its impacts, label, multipliers | [`Cycle`] |
//! | its label m/n | [`Label`] |
//! | stable, neutral or unstable | [`Stability`] |
//! | one impact in n forcing periods, in closed form | [`one_impact`] |
//! | Newton's method on the m-fold impact map | [`shoot`] |
//! | cycles that stick, from their release | [`from_release`] |
//! | whether rounding errors decide the period of a motion that comes to rest | `error_growth`, `release_errors` |
//! | the impacts of a cycle as unknowns, and their equations, smooth through grazing | `ring`, `cyclic` |
//! | Newton's method on these equations, and their linear systems | `newton`, `condense`; [`refine`] |
//! | multipliers and test functions from these equations | `floquet` |
//! | whether a solution is admissible, and its distance from a stop | [`earlier_contact`], `clearance` |
//! | whether the speed of an impact is zero to within rounding | `grazing` |
//! | the steady motion without impacts | [`without_impacts`] |
//! | periodic motions of machines | `machine` |
//! | all orbits with a label, from many starting guesses | [`find`] |

mod clearance;
mod condense;
mod cycle;
mod cyclic;
mod error_growth;
mod find;
mod floquet;
mod free;
mod grazing;
mod label;
pub mod machine;
mod newton;
mod one_impact;
mod physical;
mod refine;
mod release;
mod release_errors;
mod ring;
mod shooting;
mod stability;

pub use cycle::{Cycle, CyclePoint, RestSpan};
pub(crate) use find::struck;
pub use find::{FindOptions, find, find_while};
pub use free::without_impacts;
pub use label::{Count, Label, LabelError};
pub(crate) use machine::{
    Chatter, MachineBlock, MachineFrame, MachineLap, MachineRing, Push, Rebound, RingEvent, events_of, flying,
    near_returns, passing, rounding_decides,
};
pub use machine::{find_machine_while, find_unreduced};
pub use one_impact::{OneImpact, one_impact};
pub use physical::{EarlierContact, Orbit, earlier_contact};
pub use refine::refine;
pub use release::{DEFAULT_EVENTS, from_release};
pub use shooting::{ShootingError, shoot};
pub use stability::Stability;

pub(crate) use clearance::{closest, turning_near};
pub(crate) use cycle::distance as cycle_distance;
pub(crate) use cyclic::{Block, blocks, by_parameter, fill};
pub(crate) use floquet::Floquet;
pub(crate) use free::{crest, room};
pub(crate) use newton::{cycle as ring_cycle, solve};
pub(crate) use release::{AfterRelease, Excursion, Stretch};
pub(crate) use ring::Ring;
pub(crate) use shooting::{Lap, flight_limits, shoot_stable};
pub(crate) use stability::rounding;
