//! Branches of cycles of machines, traced by the same tracer as those of the oscillator.
//!
//! | idea | file |
//! |---|---|
//! | a machine as a function of numbers | [`Family`] |
//! | the equations of all events, with one or two numbers of the machine among the unknowns | `equations` |
//! | the test functions of events | `test_functions` |
//! | multipliers that pass the unit circle together, of which these functions tell nothing | `together` |
//! | the problem that the tracer solves, admissible solutions | `problem` |
//! | a point of a branch | [`SolutionPoint`] |
//! | where a tracer begins | `beginning` |
//! | how the events of a motion differ from those of a signature | `change` |
//! | the event that explains how the cycles before and beyond differ | `explained` |
//! | where the solutions along a step cease to be admissible | `edge` |
//! | where a flight comes closest to a stop or another guard | `closest` |
//! | where a rest on a stop, or the hold of a joint, begins or ends | `rest` |
//! | a signature without flights that take no time where a rest begins or ends | `joined` |
//! | the solution at which a rest begins or ends, to rounding | `at_rest` |
//! | the events of a motion, with as many impacts of a chatter as a signature has | `matched` |
//! | how the events of a cycle with a complete chatter change | `summed` |
//! | where the impacts of a chatter become infinitely many | `complete_chatter` |
//! | two events that come so close that no further step converges | `meeting` |
//! | the branch through a grazing contact and others whose motion solves the equations of both sides | `through` |
//! | the branch beyond other changes, from the motion there | `beyond` |
//! | the same where a contact grazes at the time of another event | `struck` |
//! | where the structure rests for ever beyond | `rest_for_ever` |
//! | the cycle of twice the period beside a flip, and where it is the other one repeated | `switch`, `halving` |
//! | the branch, and the events of a step | `branch`, `step` |

mod at_rest;
mod beginning;
mod beyond;
mod branch;
mod change;
mod closest;
mod complete_chatter;
mod edge;
mod equations;
mod explained;
mod family;
mod halving;
mod joined;
mod matched;
mod meeting;
mod point;
mod problem;
mod rest;
mod rest_for_ever;
mod step;
mod struck;
mod summed;
mod switch;
mod test_functions;
mod through;
mod together;

pub(crate) use branch::UnreducedBranch;
pub(crate) use change::{Difference, difference};
pub(crate) use closest::closest;
pub(crate) use complete_chatter::{ADAPTED, CompleteChatter};
pub(crate) use edge::edge;
pub(crate) use equations::MachineEquations;
pub use family::Family;
pub(crate) use joined::join;
pub(crate) use matched::matched;
pub use point::SolutionPoint;
pub(crate) use problem::{CLOSED, Judged, judge, over_pairs, seen_on};
pub(crate) use rest::{Limit, RestZero, limits, rest_zero, size, touches};
