//! Regions of a plane of two parameters in which an orbit exists or is stable, as polygons.
//!
//! | idea | file |
//! |---|---|
//! | the region | [`region`], [`Region`], [`RegionOptions`] |
//! | orbits on a grid, and the sheets of solutions to which they belong | `search`, `seed` |
//! | the edge of a sheet; from the edge to a point inside and across a fold | `sheet_walk`, `inside` |
//! | where the equations of a sheet are singular | `singular` |
//! | the region of the motion without impacts, in closed form | `free_region` |
//! | the polygons around the points at which a condition holds | `outline` |

mod free_region;
mod inside;
mod options;
mod outline;
mod polygon;
mod region;
mod search;
mod seed;
mod sheet_walk;
mod singular;

pub use options::{RegionKind, RegionOptions};
pub(crate) use outline::Outline;
pub use polygon::{Bound, Polygon, Region, Vertex};
pub use region::{region, region_while};
