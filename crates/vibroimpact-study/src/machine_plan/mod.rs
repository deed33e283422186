//! How the tasks of a plan are computed for a machine.
//!
//! | idea | file |
//! |---|---|
//! | a machine with its start | `source` |
//! | a plan as TOML and JSON | `text` |
//! | the results | [`MachineResults`], `run` |
//! | what motions settle into | `verdicts` |
//! | Lyapunov exponents; points of an attractor in two sections | `lyapunov`, [`MachineSection`], `section` |
//! | orbits, and the one at which a branch begins | `orbits` |
//! | a line through one number or two | `cut` |
//! | branches of orbits | [`MachineBranched`], `branch` |
//! | which motion each of many points leads to | [`ManyPlan`] |
//! | how far a cycle is from its nearest events | [`MachineMargins`], `margins` |
//! | where in a plane of two numbers a motion exists and is stable | `region` |
//! | a quantity of all motions over a number | `response` |
//! | curves of events over two numbers | [`MachineEventCurve`], `curve` |
//! | basins and maps | [`MachineBasin`], [`MachineMap`], `grid`, `axis` |
//! | a motion after its transient at each value of a number | [`MachineDiagram`], `diagram`, `after_transient` |
//! | the events of a motion | [`MachineSimulated`], `simulate` |

mod after_transient;
mod axis;
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

pub(crate) use axis::long_name;
pub use branch::{MachineBranched, MachineFollowed, MachineLine, MachineOrigin};
pub use curve::MachineEventCurve;
pub(crate) use diagram::step as diagram_step;
pub use diagram::{MachineDiagram, MachineDiagramPoint, MachineDiagramStep};
pub use grid::{MachineBasin, MachineMap, MachineShare};
pub(crate) use grid::{StartAxis, check_memory, values_of};
pub use many::ManyPlan;
pub use margins::{MachineMargins, NumberEvent, NumberMargin};
pub use orbits::label as machine_label;
pub use response::quantity_path;
pub use run::MachineResults;
pub(crate) use run::run;
pub use section::MachineSection;
pub(crate) use simulate::check_simulate;
pub use simulate::{MachineSimulated, events_with_states, most_events};
pub(crate) use text::MachinePlanText;
pub(crate) use verdicts::{check_starts, tile};
