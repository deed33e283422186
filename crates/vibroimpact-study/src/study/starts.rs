//! The starts of a basin, and the system of each: over axes, at points, or scattered.

use super::fill::{Over, along_points, dimension, on_axis};
use super::map::side;
use crate::axis;
use crate::basin::start_at;
use crate::grid::{Dimension, Grid};
use crate::points::DIMENSION;
use crate::{BasinPlan, PlanError, PointsPlan, StartPlan, SystemPlan};
use vibroimpact::verdict::{StartBox, scattered_starts};
use vibroimpact::{Oscillator, Start};

/// Default number of points of a tile along each of two axes; a tile takes about a tenth of a second.
const TILE: usize = 256;
/// Default numbers of points of a tile, from and to, where there are no axes: of one system, and of many.
const POINTS: [(usize, usize); 2] = [(512, 65536), (16, 4096)];

/// Where the starts are.
pub(super) enum Starts {
    /// At the points of the axes, and at points of parameters and starts.
    Grid(BasinPlan),
    /// Scattered over an area, by the sequence with this seed.
    Scattered { area: StartBox, seed: u64, count: usize },
}

impl Starts {
    /// The grid of the starts, in tiles with this number of points along each axis. Coordinates of points are several along one
    /// dimension.
    pub(super) fn over(&self, tile: Option<u32>) -> Over {
        let plan = match self {
            Self::Scattered { count, .. } => {
                let tile = tile.map_or(side(TILE, 1), |tile| tile as usize).min(*count);
                let grid = Grid { dimensions: vec![Dimension { name: "start".into(), count: *count, tile }] };
                return Over { grid, coordinates: Vec::new() };
            }
            Self::Grid(plan) => plan,
        };
        let mut over = Over::usual(&plan.axes, tile, side(TILE, plan.axes.len()));
        let Some(points) = &plan.points else { return over };
        let sizes = if plan.axes.is_empty() { POINTS[usize::from(!plan.one_system())] } else { (1, 1) };
        let count = usize::try_from(points.count()).unwrap_or(usize::MAX);
        over.grid.dimensions.insert(0, dimension(DIMENSION, count, tile, sizes));
        over.coordinates.splice(0..0, along_points(points));
        over
    }

    /// The start at a place of the grid, given the system there; `systems` are that of the plan and that at the place.
    pub(super) fn at(&self, osc: &Oscillator, systems: (&SystemPlan, &SystemPlan), index: &[usize]) -> Start {
        let plan = match self {
            Self::Scattered { area, seed, .. } => return scattered_starts(osc, *area, *seed, index[0] as u64),
            Self::Grid(plan) => plan,
        };
        let place = |k: usize| on_axis(index, k);
        let Some(points) = &plan.points else { return start_at(osc, systems, (&plan.start(), &plan.axes), place) };
        if points.one_system() {
            return start_at(osc, systems, (&points.start(&plan.start(), index[0]), &plan.axes), place);
        }
        // the axes are in the units of the system at the point
        let Ok(base) = of_point(systems.0, points, index[0]) else { return Start::at_rest(osc) };
        let start: StartPlan = points.start_in((systems.0, &base), &plan.start(), index[0]);
        start_at(osc, (&base, systems.1), (&start, &plan.axes), place)
    }

    /// The system at a place of the grid. The points and the corners of the axes have been checked, so this fails only
    /// between valid corners.
    pub(super) fn system(&self, system: &SystemPlan, index: &[usize]) -> Option<(SystemPlan, Oscillator)> {
        let Self::Grid(plan) = self else { return None };
        let base = plan.points.as_ref().map_or(Ok(*system), |points| of_point(system, points, index[0])).ok()?;
        let there = axis::system_at(&base, &plan.axes, |k| on_axis(index, k)).ok()?;
        Some((there, there.oscillator().ok()?))
    }

    /// The numbers by which the systems of the grid differ, at a place.
    pub(super) fn key(&self, index: &[usize]) -> Vec<u64> {
        let Self::Grid(plan) = self else { return Vec::new() };
        let of_axes = (plan.axes.iter().enumerate())
            .filter(|(_, axis)| !axis.vary.is_start())
            .map(|(k, axis)| axis.over.at(on_axis(index, k)));
        let of_points = plan.points.iter().flat_map(|points| points.parameters(index[0]).map(|(_, value)| value));
        of_points.chain(of_axes).map(f64::to_bits).collect()
    }

    /// The plan of a grid; `None` for scattered starts.
    pub(super) const fn plan(&self) -> Option<&BasinPlan> {
        if let Self::Grid(plan) = self { Some(plan) } else { None }
    }
}

/// The system with the parameters of a point.
fn of_point(system: &SystemPlan, points: &PointsPlan, k: usize) -> Result<SystemPlan, PlanError> {
    system.with_all(points.parameters(k))
}
