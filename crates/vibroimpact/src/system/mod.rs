//! The system: the oscillator, its force and its stops.
//!
//! | idea | file |
//! |---|---|
//! | checked parameters of one oscillator | [`Oscillator`] |
//! | its response in closed form, free and forced | [`Response`], `free` |
//! | the same at several times side by side | `nearby` |
//! | frequency ratios that are fractions | [`Oscillator::fraction`] |
//! | its parameters by name, read and changed | [`Parameter`] |
//! | an oscillator as a function of other numbers | [`OscillatorFamily`] |
//! | a line through two parameters, a plane of two | [`ParameterPath`], [`ParameterPlane`] |
//! | a start within the stops | [`Start`] |
//! | the units of an oscillator; the kind of a quantity, and its unit | [`Scales`], [`QuantityKind`] |
//! | the phase of the force, kept in $`[0, 2\pi)`$ | [`phase`] |

mod commensurable;
mod error;
mod free;
mod nearby;
mod oscillator;
mod oscillator_family;
mod parameter;
mod parameter_path;
mod parameter_plane;
pub mod phase;
mod quantity_kind;
mod response;
mod scales;
mod start;

pub(crate) use commensurable::common_period;
pub use error::SystemError;
pub(crate) use free::{FreeResponse, HEAVY, decay, versine};
pub(crate) use nearby::Nearby;
pub use oscillator::{Oscillator, Side, Stop};
pub use oscillator_family::OscillatorFamily;
pub use parameter::Parameter;
pub use parameter_path::ParameterPath;
pub use parameter_plane::ParameterPlane;
pub use quantity_kind::QuantityKind;
pub(crate) use response::{FormKind, UndampedForm};
pub use response::{Propagator, Response};
pub use scales::Scales;
pub use start::Start;
