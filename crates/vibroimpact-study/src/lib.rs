//! Plans, grids and multithreaded runs. This crate owns all threads; it writes no files.
//!
//! A [`Plan`] is a complete description of a question. The command line, a TOML file, a call in Python and the page all
//! build a plan. The plan is stored with the results, so every result can be computed again. Runs are deterministic:
//! the work is divided into tiles, and their results are merged in tile order, so the bytes are the same for any number
//! of threads.
//!
//! | idea | file |
//! |---|---|
//! | a plan, and the one function that turns it into its result | [`Plan`], [`run`], [`PlanResults`], [`Results`] |
//! | the parts of a plan: system, start, task | [`System`], [`SystemPlan`], [`StartPlan`], [`Task`] |
//! | numbers as people type them | [`typed`] |
//! | `A:B:N`, N values from A to B; a quantity and the values it takes | [`Span`], [`Axis`] |
//! | a grid and its tiles, the arrays over it | [`Grid`], [`Field`] |
//! | the arrays that a tile of a plan holds | [`Study`], [`study`] |
//! | tiles over threads, with a stop flag and progress | [`Control`], [`tiles`] |
//! | points of parameters and starts, listed or drawn from a box | [`PointsPlan`] |
//! | the events of one motion; of many motions, as columns | [`Simulated`]; [`simulate_points`], [`EventColumns`] |
//! | the motion to which each start of a plane leads | [`BasinPlan`], [`Basin`] |
//! | the motions at each point of a parameter plane | [`MapPlan`], [`RegionMap`] |
//! | the motion after its transient at each value of a parameter | [`DiagramPlan`], [`Diagram`], [`diagram`] |
//! | the impacts of a motion on each of two stops | [`ImpactsByStop`] |
//! | the plan for Lyapunov exponents of a motion | [`LyapunovPlan`] |
//! | what tasks ask of an oscillator and of a machine alike | [`Dynamics`] |
//! | a line along which orbits are followed | [`OrbitLine`] |
//! | a branch of periodic orbits in one parameter, and the branches that begin on it | [`BranchPlan`], [`Branches`] |
//! | the orbit at which a branch begins | [`Chosen`] |
//! | a curve of folds, flips or grazing impacts in two parameters | [`CurvePlan`], [`EventCurve`] |
//! | the regions where a motion exists and where it is stable | [`RegionPlan`], [`Regions`], [`stability_regions`] |
//! | a quantity of all motions over one parameter | [`ResponsePlan`], [`ResponseCurves`] |
//! | the border between the starts of two motions, and the saddle on it | [`EdgePlan`] |
//! | the distances of a motion from its nearest events | [`MarginsPlan`], [`MotionMargins`] |
//! | a parameter and its range; a line through one or two of them | [`Stretch`], [`Cut`] |
//! | the parameters of the core in plans | [`Parameter`], `parameter` |
//! | machines as they are written, and their catalogue | [`machine`] |
//! | an oscillator in SI units; the units of a plan | [`Body`], [`UnitsPlan`] |
//! | the quantities of a motion that a plan asks for | [`Quantity`], `quantity` |

pub mod axis;
pub mod basin;
mod branch;
mod by_stop;
mod chosen;
mod control;
mod curve;
mod cut;
pub mod diagram;
mod dynamics;
mod edge;
mod error;
mod event_columns;
mod field;
mod grid;
mod in_memory;
mod limits;
mod lyapunov;
pub mod machine;
mod map;
mod margins;
mod name;
mod orbit_line;
mod parameter;
mod plan;
mod plan_text;
mod points;
mod quantity;
mod region;
mod response;
mod run;
mod simulate;
mod simulate_many;
mod span;
mod stretch;
pub mod study;
mod system;
mod task;
#[cfg(test)]
mod tests_of_plans;
mod text;
pub mod typed;
mod unit;
mod units;
mod words;

pub use axis::{Axis, Coordinate, Values, typed_axes};
pub use basin::{Basin, BasinPlan, NO_START};
pub use branch::{BranchPlan, Branches, DEFAULT_BRANCH_POINTS, Followed, Origin};
pub use by_stop::ImpactsByStop;
pub use chosen::{Chosen, OrbitNumber};
pub use control::{Control, Meter, Stopped, TileMeter, tiles};
pub use curve::{CurvePlan, EventCurve, FollowedEvent};
pub use cut::Cut;
pub use diagram::{Diagram, DiagramPlan};
pub use dynamics::{CycleOf, Dynamics, PointOf, Setup, machine_label};
pub use edge::{EdgePlan, PlacePlan};
pub use error::{PlanError, RunError};
pub use event_columns::{END_REASONS, EventColumns, REAL_COLUMNS};
pub use field::{Column, Extra, Field, NumberType};
pub use grid::{Block, Dimension, Grid, number, place};
pub use limits::PLAN_VERSION;
pub use lyapunov::{DEFAULT_POINTS, LyapunovPlan, SectionClosing, SectionPoints};
pub use machine::{Body, BodyNumber};
pub use map::{MapPlan, RegionMap, Share};
pub use margins::{
    BoxEdge, DEFAULT_LINES, DEFAULT_WITHIN, Loss, MarginEnd, MarginsPlan, MotionBox, MotionMargins, ParameterMargin,
    ScaledParameter, Scope,
};
pub use name::{Name, Variable};
pub use orbit_line::{Along, BranchPlace, OrbitLine, Solution};
pub use parameter::{Parameter, is_length, parameter_names};
pub use plan::Plan;
pub use points::{DrawnPoints, ListedColumn, ManyPlan, PointRange, PointRule, PointsPlan};
pub use quantity::{Quantities, Quantity, unknown as unknown_quantity};
pub use region::{DEFAULT_GRID, Over, RegionPlan, Regions, stability_regions};
pub use response::{ResponseCurves, ResponsePlan, ResponseRow};
pub use run::{Orbit, PlanResults, Results, run};
pub use simulate::{SEARCH_LIMIT, SimulatePlan, Simulated, events_with_states, motion_limits, simulate};
pub use simulate_many::{real_numbers, simulate_points};
pub use span::Span;
pub use stretch::{Stretch, Target};
pub use study::Study;
pub use system::{SecondStop, StartPlan, System, SystemPlan};
pub use task::Task;
pub use text::{TextError, TextPlace};
pub use unit::Unit;
pub use units::{FramePlan, UnitsPlan, natural_hertz};
pub use words::counted;

/// Compiles and runs the listing of this crate's README as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct CrateReadme;
