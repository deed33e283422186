//! A store that is open.

use crate::layout::Layout;
use crate::shelf::Shelf;
use std::sync::Arc;
use vibroimpact_study::Plan;
use vibroimpact_study::study::Study;

/// The version of the arrangement described here; a store of a later one is refused.
pub const FORMAT: u64 = 1;
/// This program.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A study and where it is stored.
pub struct Store {
    pub(crate) shelf: Arc<dyn Shelf>,
    pub(crate) plan: Plan,
    pub(crate) study: Study,
    pub(crate) layout: Layout,
    /// The version that began it.
    pub(crate) begun_by: String,
}
