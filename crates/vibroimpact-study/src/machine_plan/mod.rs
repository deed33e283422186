//! Plans of machines: a machine as it is written, where it starts, and what is computed.
//!
//! | idea | file |
//! |---|---|
//! | a plan, its checks | [`MachinePlan`], [`MachineTask`], `plan` |
//! | a plan as TOML and JSON | `text` |
//! | the function that turns a plan into its result | [`run_machine`], [`MachineResults`], `run` |
//! | what motions settle into, their exponents | `verdicts` |
//! | orbits, and branches of them | [`MachineBranched`], `orbits` |
//! | curves of events over two numbers | [`MachineCurvePlan`], [`MachineEventCurve`], `curve` |
//! | an axis of a grid | [`MachineAxis`] |
//! | basins and maps: plans and results | [`MachineBasinPlan`], [`MachineBasin`], [`MachineMapPlan`], [`MachineMap`], `grid` |
//! | a motion after its transient at each value of a number | [`MachineDiagramPlan`], [`MachineDiagram`], `diagram`, `after_transient` |
//! | the events of a motion | [`MachineSimulated`], `simulate` |

mod after_transient;
mod axis;
mod curve;
mod diagram;
mod grid;
mod orbits;
mod plan;
mod run;
mod simulate;
mod text;
mod verdicts;

pub use axis::MachineAxis;
pub use curve::{MachineCurvePlan, MachineEventCurve, MachineFollowedEvent, MachineStretch};
pub(crate) use diagram::step as diagram_step;
pub use diagram::{MachineDiagram, MachineDiagramPlan, MachineDiagramPoint, MachineDiagramStep};
pub use grid::{MachineBasin, MachineBasinPlan, MachineMap, MachineMapPlan, MachineShare};
pub(crate) use grid::{StartAxis, check_memory, values_of};
pub use orbits::{MachineBranched, MachineFollowed};
pub use plan::{MachinePlan, MachineTask};
pub use run::{MachineResults, run_machine};
pub use simulate::MachineSimulated;
pub use text::is_machine_plan;
