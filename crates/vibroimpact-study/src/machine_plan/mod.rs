//! How the tasks of a plan are computed for a machine.
//!
//! | idea | file |
//! |---|---|
//! | a machine with its start | `source` |
//! | a plan as TOML and JSON | `text` |
//! | the results | [`Results`](crate::machine::Results), `run` |
//! | what motions settle into | `verdicts` |
//! | Lyapunov exponents; points of an attractor in two sections | `lyapunov`, [`SectionPoints`], `section` |
//! | orbits, and the one at which a branch begins | `orbits` |
//! | a line through one number or two | `cut` |
//! | branches of orbits | [`OrbitLine`], `branch` |
//! | which motion each of many points leads to | [`ManyPlan`] |
//! | how far a cycle is from its nearest events | [`MachineMargins`], `margins` |
//! | where in a plane of two numbers a motion exists and is stable | `region` |
//! | a quantity of all motions over a number | `response` |
//! | curves of events over two numbers | `curve` |
//! | basins and maps | `grid` |
//! | a motion after its transient at each value of a number | `diagram`, `after_transient` |
//! | the events of a motion | `simulate` |

mod after_transient;
mod branch;
mod curve;
mod cut;
mod diagram;
mod grid;
mod lyapunov;
mod many;
mod margins;
mod orbits;
mod region;
mod response;
mod run;
mod section;
mod simulate;
mod source;
mod text;
mod verdicts;

pub use branch::{BranchPlace, OrbitLine};
pub(crate) use diagram::step as diagram_step;
pub(crate) use grid::{StartAxis, check_memory, values_of};
pub use many::ManyPlan;
pub use margins::{MachineMargins, NumberEvent, NumberMargin};
pub use orbits::label as machine_label;
pub use response::quantity_path;
pub use run::Results;
pub(crate) use run::run;
pub use section::SectionPoints;
pub(crate) use simulate::check_simulate;
pub use simulate::{events_with_states, most_events};
pub(crate) use text::MachinePlanText;
pub(crate) use verdicts::{check_starts, tile};
