//! A store that is open.

use super::layout::Layout;
use super::shelf::Shelf;
use crate::Plan;
use crate::study::Study;
use std::sync::Arc;

/// The version of the arrangement described here; a store of a later one is refused.
pub const FORMAT: u64 = 1;
/// This program.
pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A study and where it is stored.
pub struct Store {
    pub(super) shelf: Arc<dyn Shelf>,
    pub(super) plan: Plan,
    pub(super) study: Study,
    pub(super) layout: Layout,
    /// The version that began it.
    pub(super) begun_by: String,
}
