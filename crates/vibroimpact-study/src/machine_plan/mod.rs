//! How the tasks of a plan are computed for a machine.
//!
//! | idea | file |
//! |---|---|
//! | a machine with its start | `source` |
//! | the results | [`Results`](crate::machine::Results), `run` |
//! | what motions settle into | `verdicts` |
//! | Lyapunov exponents; points of an attractor in two sections | `lyapunov`, [`SectionPoints`], `section` |
//! | which motion each of many points leads to | [`ManyPlan`] |
//! | basins and maps | `grid` |
//! | a motion after its transient at each value of a number | `diagram`, `after_transient` |
//! | the events of a motion | `simulate` |

mod after_transient;
mod diagram;
mod grid;
mod lyapunov;
mod many;
mod run;
mod section;
mod simulate;
mod source;
mod verdicts;

pub(crate) use diagram::step as diagram_step;
pub(crate) use grid::{StartAxis, check_memory, values_of};
pub use many::ManyPlan;
pub use run::Results;
pub(crate) use run::run;
pub use section::SectionPoints;
pub(crate) use simulate::check_simulate;
pub use simulate::{events_with_states, most_events};
pub(crate) use verdicts::{check_starts, tile};
