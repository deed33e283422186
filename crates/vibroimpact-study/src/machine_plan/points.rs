//! Points of numbers of a machine and of its start: listed, or drawn from ranges.

use crate::PlanError;
use crate::points::PointRule;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Points that are listed or drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MachinePoints {
    /// Points that are given, as one column for each number that varies.
    Listed(Vec<MachineColumn>),
    /// Points of a low-discrepancy sequence or a Latin hypercube.
    Drawn(MachineDrawn),
}

/// The values of one number at all points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineColumn {
    /// The path of a number of the machine, or `q.COORDINATE`, `qdot.COORDINATE` or `phase` of the start.
    pub vary: String,
    /// Its value at each point.
    pub values: Vec<f64>,
}

/// Points drawn from a box by a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineDrawn {
    /// How they are drawn.
    pub rule: PointRule,
    /// How many.
    pub count: u64,
    /// Which of the sequences of the rule.
    #[serde(default)]
    pub seed: u64,
    /// The sides of the box.
    pub over: Vec<MachineRange>,
}

/// The range of one number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineRange {
    /// What varies, as in a [`MachineColumn`].
    pub vary: String,
    /// One end of its range.
    pub from: f64,
    /// The other end.
    pub to: f64,
}

/// Maximum number of points, which are in memory, and of sides of a box.
const MOST: u64 = 10_000_000;
const MOST_SIDES: usize = 16;

impl MachinePoints {
    /// The number of points.
    #[must_use]
    pub fn count(&self) -> u64 {
        match self {
            Self::Listed(columns) => columns.first().map_or(0, |column| column.values.len() as u64),
            Self::Drawn(drawn) => drawn.count,
        }
    }

    /// The points as columns.
    pub(super) fn columns(&self) -> Vec<MachineColumn> {
        let drawn = match self {
            Self::Listed(columns) => return columns.clone(),
            Self::Drawn(drawn) => drawn,
        };
        let column = |(k, MachineRange { vary, from, to }): (usize, &MachineRange)| {
            let at = |point| from + (to - from) * drawn.rule.place(point, k, (drawn.count, drawn.seed));
            let between = |value: f64| value.clamp(from.min(*to), from.max(*to));
            MachineColumn { vary: vary.clone(), values: (0..drawn.count).map(|point| between(at(point))).collect() }
        };
        drawn.over.iter().enumerate().map(column).collect()
    }

    pub(super) fn check(&self) -> Result<(), PlanError> {
        let count = self.count();
        if !(1..=MOST).contains(&count) {
            return Err(PlanError::PointCount { given: count, most: MOST });
        }
        match self {
            Self::Listed(columns) => {
                let uneven = |column: &&MachineColumn| column.values.len() as u64 != count;
                if let Some(column) = columns.iter().find(uneven) {
                    return Err(PlanError::MachinePoints(column.vary.clone()));
                }
                let finite = |column: &&MachineColumn| !column.values.iter().all(|value| value.is_finite());
                columns.iter().find(finite).map_or(Ok(()), |of| Err(PlanError::MachinePoints(of.vary.clone())))
            }
            Self::Drawn(drawn) => {
                if drawn.over.is_empty() || drawn.over.len() > MOST_SIDES {
                    return Err(PlanError::PointSides { given: drawn.over.len(), most: MOST_SIDES });
                }
                let wrong =
                    |side: &&MachineRange| !(side.from.is_finite() && side.to.is_finite() && side.from < side.to);
                drawn.over.iter().find(wrong).map_or(Ok(()), |side| {
                    Err(PlanError::PointRange { path: side.vary.clone(), from: side.from, to: side.to })
                })
            }
        }
    }

    pub(super) fn varied(&self) -> impl Iterator<Item = &str> {
        let (listed, drawn): (&[MachineColumn], &[MachineRange]) = match self {
            Self::Listed(columns) => (columns, &[]),
            Self::Drawn(drawn) => (&[], &drawn.over),
        };
        listed.iter().map(|column| column.vary.as_str()).chain(drawn.iter().map(|side| side.vary.as_str()))
    }
}
