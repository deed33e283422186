//! Points that are drawn from a box.

use super::listed::ListedColumn;
use super::rule::{MOST_SOBOL, PointRule};
use crate::name::renamed;
use crate::{Coordinate, PlanError, limits};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Points drawn from a box by a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DrawnPoints<V = Coordinate> {
    /// How they are drawn.
    pub rule: PointRule,
    /// How many.
    pub count: u64,
    /// Which of the sequences of the rule.
    #[serde(default)]
    pub seed: u64,
    /// The sides of the box.
    pub over: Vec<PointRange<V>>,
}

/// A side of the box: the range of one number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointRange<V = Coordinate> {
    /// What varies.
    pub vary: V,
    /// One end of its range.
    pub from: f64,
    /// The other end.
    pub to: f64,
}

renamed!(DrawnPoints: names, parts over, others rule count seed);
renamed!(PointRange: names vary, parts, others from to);

/// Maximum number of points: the numbers of a permutation have 32 bits.
const MOST: u64 = 1_000_000_000;
/// Maximum number of sides, all of which have their corners checked.
const MOST_SIDES: usize = 16;

impl<V: Clone + Into<Cow<'static, str>>> DrawnPoints<V> {
    /// The value of column number `column` at point number `k`.
    pub(super) fn at(&self, column: usize, k: usize) -> f64 {
        let PointRange { from, to, .. } = self.over[column];
        let place = self.rule.place(k as u64, column, (self.count, self.seed));
        // between the ends also after rounding
        (from + (to - from) * place).clamp(from.min(to), from.max(to))
    }

    /// Checks the number of points, and the sides of the box.
    ///
    /// # Errors
    /// [`PlanError`] for the first error.
    pub fn check(&self) -> Result<(), PlanError> {
        let most = if self.rule == PointRule::Sobol { MOST_SOBOL } else { MOST_SIDES };
        if self.over.is_empty() || self.over.len() > most {
            let given = self.over.len();
            return Err(PlanError::refused(format!("ranges given: {given}; points are drawn from 1 to {most}")));
        }
        limits::check("points", self.count, 1..=MOST)?;
        match self.over.iter().find(|side| !(side.from.is_finite() && side.to.is_finite() && side.from < side.to)) {
            Some(side) => Err(PlanError::no_range(&side.vary.clone().into(), (side.from, side.to))),
            None => Ok(()),
        }
    }

    /// The corners of the box, as columns of points that are listed.
    pub(super) fn corners(&self) -> Vec<ListedColumn<V>> {
        let corners = 0..1_u32 << self.over.len();
        let column = |(k, side): (usize, &PointRange<V>)| ListedColumn {
            vary: side.vary.clone(),
            values: corners.clone().map(|bits| if bits >> k & 1 == 0 { side.from } else { side.to }).collect(),
        };
        self.over.iter().enumerate().map(column).collect()
    }
}
