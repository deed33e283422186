//! Degenerate machines, drawn by family and seed: what random numbers do not draw and engineers build every day.
//!
//! Equal bodies, symmetric structures, bodies that touch, gaps of zero, stops that depend on each other, stops without a
//! load, friction beside stops. A [`Case`] is a machine, a start and what is known of its motion; it depends on the
//! family and the seed alone, so it is named by both.
//!
//! | idea | file |
//! |---|---|
//! | numbers drawn from a seed | [`Draw`] |
//! | a machine, a start, and facts about the motion | [`Case`], [`Drawn`], [`Symmetry`] |
//! | the families, one a file | [`FAMILIES`], `families` |
//! | the same machine written in another way | [`changed`], [`Rewriting`] |
//! | events that do not depend on how a machine is written | [`Standard`] |
//! | gaps, forces and energies from the numbers of a machine alone | `quantities` |
//! | what must hold of every motion | [`faults`], [`Rule`] |
//!
//! ```
//! use vibroimpact_cases::{FAMILIES, DrawnFamily};
//! let case = DrawnFamily::named("twins").unwrap().case(3);
//! assert_eq!(case.machine, DrawnFamily::named("twins").unwrap().case(3).machine);
//! assert!(FAMILIES.len() > 15);
//! ```

mod bodies;
mod case;
mod changes;
mod draw;
mod families;
mod invariance;
mod quantities;
mod rules;

pub use case::{Case, Drawn, Symmetry};
pub use changes::{Changed, Rewriting, changed};
pub use draw::Draw;
pub use families::{DrawnFamily, FAMILIES};
pub use invariance::{Standard, rounded};
pub use rules::{BrokenRule, Budget, Rule, faults};
