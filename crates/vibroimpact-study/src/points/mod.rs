//! Points in the space of the parameters of a system and the coordinates of a start: listed, or drawn from a box. They are
//! an axis of a grid along which several of them vary at once. What varies is a [`Coordinate`] of an oscillator, or a path of
//! a machine as text.

mod drawn;
mod listed;
mod many;
mod rule;

pub use drawn::{DrawnPoints, PointRange};
pub use listed::ListedColumn;
pub use many::ManyPlan;
pub use rule::PointRule;

use crate::axis::none_twice;
use crate::name::{Name, Renamed, Variable};
use crate::{Control, Coordinate, Parameter, PlanError, RunError, StartPlan, SystemPlan, tiles};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use vibroimpact::{Oscillator, Start};

/// Points of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum PointsPlan<V = Coordinate> {
    /// Points that are given, as one column for each number that varies.
    Listed(Vec<ListedColumn<V>>),
    /// Points of a low-discrepancy sequence or a Latin hypercube.
    Drawn(DrawnPoints<V>),
}

/// The name of the dimension of points.
pub(crate) const DIMENSION: &str = "sample";
/// Number of points of a tile.
const TILE: u64 = 32;

impl PointsPlan<Variable> {
    /// The points with the names of a system.
    ///
    /// # Errors
    /// [`PlanError::Name`] for a name that the system does not have.
    pub fn typed<W: Name>(&self) -> Result<PointsPlan<W>, PlanError> {
        self.named(&|name: &Variable| W::of(name.text()))
    }
}

impl<V> Renamed<V> for PointsPlan<V> {
    type With<W> = PointsPlan<W>;

    fn named<W, E>(&self, name: &impl Fn(&V) -> Result<W, E>) -> Result<PointsPlan<W>, E> {
        Ok(match self {
            Self::Listed(columns) => PointsPlan::Listed(columns.named(name)?),
            Self::Drawn(drawn) => PointsPlan::Drawn(drawn.named(name)?),
        })
    }
}

impl<V: Clone + Into<Cow<'static, str>>> PointsPlan<V> {
    /// The number of points.
    #[must_use]
    pub fn count(&self) -> u64 {
        match self {
            Self::Listed(columns) => columns.first().map_or(0, |column| column.values.len() as u64),
            Self::Drawn(drawn) => drawn.count,
        }
    }

    /// The number of numbers that vary.
    #[must_use]
    pub fn width(&self) -> usize {
        match self {
            Self::Listed(columns) => columns.len(),
            Self::Drawn(drawn) => drawn.over.len(),
        }
    }

    /// What column number `column` varies.
    ///
    /// # Panics
    /// If there is no such column.
    #[must_use]
    pub fn vary(&self, column: usize) -> V {
        match self {
            Self::Listed(columns) => columns[column].vary.clone(),
            Self::Drawn(drawn) => drawn.over[column].vary.clone(),
        }
    }

    /// The value of column number `column` at point number `k`.
    ///
    /// # Panics
    /// If there is no such column or point.
    #[must_use]
    pub fn at(&self, column: usize, k: usize) -> f64 {
        match self {
            Self::Listed(columns) => columns[column].values[k],
            Self::Drawn(drawn) => drawn.at(column, k),
        }
    }

    /// What the columns vary, in order.
    pub fn varied(&self) -> impl Iterator<Item = V> + '_ {
        (0..self.width()).map(|column| self.vary(column))
    }

    /// Checks the number of points and that their values are finite, or the box from which they are drawn.
    pub(crate) fn check_values(&self) -> Result<(), PlanError> {
        match self {
            Self::Listed(columns) => listed::check(columns),
            Self::Drawn(drawn) => drawn.check(),
        }
    }
}

impl PointsPlan {
    /// Whether all points belong to one system.
    pub(crate) fn one_system(&self) -> bool {
        self.varied().all(Coordinate::is_start)
    }

    /// The parameters of the system at point number `k`.
    pub(crate) fn parameters(&self, k: usize) -> impl Iterator<Item = (Parameter, f64)> + '_ {
        (0..self.width()).filter_map(move |column| match self.vary(column) {
            Coordinate::Parameter(parameter) => Some((parameter, self.at(column, k))),
            _ => None,
        })
    }

    /// The start at point number `k`; coordinates that do not vary are those of `start`.
    pub(crate) fn start(&self, start: &StartPlan, k: usize) -> StartPlan {
        let mut there = *start;
        for (column, vary) in self.varied().enumerate() {
            vary.place(&mut there, || self.at(column, k));
        }
        there
    }

    /// Checks the number of points and their values, and that `valid` accepts each listed point, or the corners
    /// of the box from which points are drawn.
    pub(crate) fn check(
        &self,
        system: &SystemPlan,
        start: &StartPlan,
        valid: impl Fn(&SystemPlan, &StartPlan) -> Result<(), PlanError>,
    ) -> Result<(), PlanError> {
        none_twice(self.varied())?;
        self.check_values()?;
        if let Self::Drawn(drawn) = self {
            return Self::Listed(drawn.corners()).check(system, start, valid);
        }
        let fixed = self.one_system();
        // the starts of one system are a convex set, so the corners of a box that holds the points say that all are valid
        if fixed && self.hull(start).iter().all(|corner| valid(system, corner).is_ok()) {
            return Ok(());
        }
        (0..listed::length(self.count())).try_for_each(|k| {
            let here = || {
                if fixed {
                    return valid(system, &self.start(start, k));
                }
                let there = system.with_all(self.parameters(k))?;
                valid(&there, &self.start_in((system, &there), start, k))
            };
            here().map_err(|error| error.at_point(k))
        })
    }

    /// The start with the smallest of all listed coordinates, and that with the largest.
    fn hull(&self, start: &StartPlan) -> [StartPlan; 2] {
        let mut corners = [*start; 2];
        let Self::Listed(columns) = self else { return corners };
        for column in columns {
            let values = column.values.iter().copied();
            column.vary.place(&mut corners[0], || values.clone().reduce(f64::min).unwrap_or(f64::NAN));
            column.vary.place(&mut corners[1], || values.reduce(f64::max).unwrap_or(f64::NAN));
        }
        corners
    }

    /// As [`Self::start`], in the units of the system `there` at the point; `system` is that of the plan.
    pub(crate) fn start_in(&self, systems: (&SystemPlan, &SystemPlan), start: &StartPlan, k: usize) -> StartPlan {
        let start = self.start(start, k);
        let (x, v) = systems.0.state_in(systems.1, (start.x.unwrap_or(0.0), start.v));
        StartPlan { x: start.x.map(|_| x), v, ..start }
    }

    /// The oscillator and the start at point number `k`; other numbers are those of `system` and `start`.
    pub(crate) fn problem(
        &self,
        system: &SystemPlan,
        start: &StartPlan,
        k: usize,
    ) -> Result<(Oscillator, Start), PlanError> {
        let there = if self.one_system() { *system } else { system.with_all(self.parameters(k))? };
        let osc = there.oscillator()?;
        Ok((osc, self.start_in((system, &there), start, k).start(&osc)?))
    }

    /// The results of `work` at all points, in order.
    ///
    /// # Errors
    /// [`RunError`] for the first invalid point, or when stopped.
    pub fn each<T: Send>(
        &self,
        (system, start): (&SystemPlan, &StartPlan),
        control: &Control<'_>,
        work: impl Fn(&Oscillator, Start) -> T + Sync,
    ) -> Result<Vec<T>, RunError> {
        self.check(system, start, |there, start| start.start(&there.oscillator()?).map(|_| ()))?;
        let parts = tiles(self.count(), TILE, control, |range, tick| {
            let mut found = Vec::new();
            for k in range {
                let problem = self.problem(system, start, usize::try_from(k).unwrap_or(usize::MAX));
                found.push(problem.map(|(osc, start)| work(&osc, start)));
                if tick() {
                    break;
                }
            }
            found
        })?;
        parts.into_iter().flatten().map(|found| found.map_err(RunError::from)).collect()
    }
}
