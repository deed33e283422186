//! Plans of machines: a machine as it is written, where it starts, and what is computed.
//!
//! | idea | file |
//! |---|---|
//! | a plan, its checks | [`MachinePlan`], [`MachineTask`], `plan` |
//! | a plan as TOML and JSON | `text` |
//! | the function that turns a plan into its result | [`run_machine`], [`MachineResults`], `run` |
//! | what motions settle into | `verdicts` |
//! | Lyapunov exponents | [`MachineLyapunovPlan`], `lyapunov` |
//! | points of an attractor in two sections | [`MachineSection`], `section` |
//! | orbits, and the one at which a branch begins | `orbits` |
//! | a line through one number or two | [`MachineCut`], [`MachineStretch`], [`MachineTarget`], `cut` |
//! | branches of orbits | [`MachineBranchPlan`], [`MachineBranched`], `branch` |
//! | which motion each of many points leads to | [`MachineManyPlan`], `many` |
//! | how far a cycle is from its nearest events | [`MachineMarginsPlan`], [`MachineMargins`], `margins` |
//! | where in a plane of two numbers a motion exists and is stable | [`MachineRegionPlan`], `region` |
//! | a quantity of all motions over a number | [`MachineResponsePlan`], `response` |
//! | curves of events over two numbers | [`MachineCurvePlan`], [`MachineEventCurve`], `curve` |
//! | an axis of a grid | [`MachineAxis`] |
//! | basins and maps: plans and results | [`MachineBasinPlan`], [`MachineBasin`], [`MachineMapPlan`], [`MachineMap`], `grid` |
//! | a motion after its transient at each value of a number | [`MachineDiagramPlan`], [`MachineDiagram`], `diagram`, `after_transient` |
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
mod plan;
mod region;
mod response;
mod run;
mod section;
mod simulate;
mod text;
mod verdicts;

pub use axis::MachineAxis;
pub use branch::{MachineBranchPlan, MachineBranched, MachineFollowed, MachineLine, MachineOrigin};
pub use curve::{MachineCurvePlan, MachineEventCurve, MachineFollowedEvent};
pub use cut::{MachineCut, MachineStretch, MachineTarget};
pub(crate) use diagram::step as diagram_step;
pub use diagram::{MachineDiagram, MachineDiagramPlan, MachineDiagramPoint, MachineDiagramStep};
pub use grid::{MachineBasin, MachineBasinPlan, MachineMap, MachineMapPlan, MachineShare};
pub(crate) use grid::{StartAxis, check_memory, values_of};
pub use lyapunov::MachineLyapunovPlan;
pub use many::MachineManyPlan;
pub use margins::{MachineMargins, MachineMarginsPlan, NumberEvent, NumberMargin};
pub use orbits::label as machine_label;
pub use plan::{MachinePlan, MachineTask};
pub use region::MachineRegionPlan;
pub use response::MachineResponsePlan;
pub use run::{MachineResults, run_machine};
pub use section::MachineSection;
pub use simulate::{MachineSimulated, events_with_states};
pub use text::is_machine_plan;
