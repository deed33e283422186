//! An open store.

use crate::costs::Costs;
use crate::layout::Layout;
use crate::shelf::Shelf;
use std::sync::Arc;
use vibroimpact_study::Plan;
use vibroimpact_study::study::Study;

/// The latest format of stores that this program knows: 1 without shards, 2 with shards. A store with a later format is
/// refused.
pub const FORMAT: u64 = 2;
/// The format of stores whose tiles are files of their own.
pub(crate) const PLAIN: u64 = 1;
/// The version of this program.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A study and the place where it is stored.
pub struct Store {
    pub(crate) shelf: Arc<dyn Shelf>,
    pub(crate) plan: Plan,
    pub(crate) study: Study,
    pub(crate) layout: Layout,
    /// The version that began it.
    pub(crate) begun_by: String,
    /// The costs of its tiles, if they are recorded.
    pub(crate) costs: Option<Costs>,
}
