//! The border between the starts that lead to one motion and those that lead to others, and the saddle on it.
//!
//! | idea | file |
//! |---|---|
//! | what is asked of a system, and the search | `track` |
//! | the answers of an oscillator | `oscillator` |
//! | the answers of a machine | `machine` |

mod machine;
mod oscillator;
mod track;

pub use track::{Bordered, Edge, EdgeError, EdgeOptions, EdgePoint, edge, edge_while};
