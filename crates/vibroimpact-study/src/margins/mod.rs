//! How far a periodic motion is from the events that end or change it.
//!
//! | idea | file |
//! |---|---|
//! | the plan | `plan` |
//! | the range and the scale of a parameter | `scope` |
//! | the nearest event in each parameter, up and down | `events` |
//! | the motion carried from one system to a system nearby | `carry` |
//! | the largest box of parameters in which the motion was found | `tried_box` |

mod carry;
mod events;
mod plan;
mod scope;
mod tried_box;

pub use carry::Loss;
pub(crate) use events::margins;
pub use events::{MarginEnd, MotionMargins, ParameterMargin};
pub use plan::{DEFAULT_LINES, DEFAULT_WITHIN, MarginsPlan};
pub use scope::{ScaledParameter, Scope};
pub(crate) use tried_box::tried_box;
pub use tried_box::{BoxEdge, MotionBox};
