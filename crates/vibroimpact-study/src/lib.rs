//! Plans, grids and threaded runs: everything around the core that owns threads and knows files' content.
//!
//! A [`Plan`] says completely what is asked: command line, TOML file, Python call and page build the same one, and it is
//! kept with the results, so that any result can be run again from itself. Running a plan is deterministic: the work is
//! cut into tiles whose results are merged in tile order, so the bytes are the same for any number of threads.
//!
//! | idea | file |
//! |---|---|
//! | the question, checked | [`Plan`], [`SystemPlan`], [`StartPlan`], [`Task`] |
//! | `A:B:N`, N values from A to B | [`Span`] |
//! | tiles over threads, with a stop flag and progress | [`Control`], [`tiles`] |
//! | which motion each start of a plane leads to | [`basin`] |
//! | which motions there are at each point of a parameter plane | [`map`] |
//! | the motions of one system from many starts | [`attractors`] |
//! | the motion after its transient at each value of a parameter | [`diagram()`], [`mod@diagram`] |
//! | the Lyapunov exponents of a motion: the question | [`LyapunovPlan`] |
//! | the parameters by name | [`Parameter`] |

mod attractors;
mod basin;
mod control;
pub mod diagram;
mod error;
mod lyapunov;
mod map;
mod parameter;
mod plan;
mod span;

pub use attractors::attractors;
pub use basin::{Basin, RunError, basin};
pub use control::{Control, Stopped, tiles};
pub use diagram::{Diagram, DiagramPlan, diagram};
pub use error::PlanError;
pub use lyapunov::{DEFAULT_POINTS, LyapunovPlan};
pub use map::{MapPoint, RegionMap, Share, map};
pub use parameter::Parameter;
pub use plan::{BasinPlan, MapPlan, PLAN_VERSION, Plan, SecondStop, StartPlan, SystemPlan, Task};
pub use span::Span;
