//! Regimes: what a machine is while no stop or joint changes its state.
//!
//! | idea | file |
//! |---|---|
//! | a machine in mass-normalised coordinates | `normal` |
//! | what a stop or joint does | [`ContactState`] |
//! | prescribed functions of time, linear functions of the state | `signal` |
//! | one mode in closed form | `mode` |
//! | the modes of a structure with any damping | `basis` |
//! | these modes to the last digit | `refined` |
//! | the directions in which it is free | `complement` |
//! | the directions along which the whole machine can be moved | `translations` |
//! | the constant force on its modes at a position | `rest_force` |
//! | a closed stop: its force, and its gap as a function of its modes | `closed_stop` |
//! | what stops at rest and joints that hold prescribe | `constraints` |
//! | the motion in the directions that are left free | `free_motion` |
//! | the structure in one regime | `structure` |
//! | its guards | `guards` |
//! | small changes of its state, and the gradients of guards | `change` |
//! | the panels over which its motion is integrated | `panels` |
//! | polynomials in Bernstein's form | `bernstein` |
//! | how its state moves through a time | `pass` |
//! | its motion over windows of one length | `window` |
//! | its guards at equal steps | `sampled` |

mod basis;
mod bernstein;
mod change;
mod closed_stop;
mod complement;
mod constraints;
mod contact_state;
mod free_motion;
mod guards;
mod mode;
mod normal;
mod panels;
mod pass;
mod refined;
mod rest_force;
mod sampled;
mod signal;
mod structure;
mod translations;
mod window;

pub(crate) use bernstein::{TERMS, bernstein};
pub(crate) use change::ModalChange;
pub(crate) use closed_stop::ClosedStop;
pub(crate) use complement::{Orthonormal, independent};
pub(crate) use constraints::bearing;
pub use contact_state::ContactState;
pub(crate) use guards::GuardKind;
pub(crate) use mode::{FreeMode, Mode, Turned};
pub(crate) use normal::{Normal, NormalRate, compliant, compliant_force};
pub(crate) use panels::{POLYNOMIALS, PRODUCTS, rates};
pub(crate) use rest_force::RestBuffers;
pub(crate) use sampled::{POWERS, REST, SAMPLES, Sampled, Span};
pub(crate) use signal::{Observable, Signal, turned};
pub(crate) use structure::Structure;
pub(crate) use translations::Translations;
pub(crate) use window::{REACH, Window, add_harmonic, derivative_bounds};
