//! The tiles of a study of Lyapunov exponents: at each point both exponents and the kind of the motion.

use super::fill::{Along, Fill, along, grid_of, on_axis};
use super::map::side;
use crate::axis;
use crate::field::{Column, Extra, Field, NumberType};
use crate::{Block, Grid, LyapunovPlan, SystemPlan, Unit};
use vibroimpact::chaos::{Grounds, Measured, exponents};

/// Default number of points of a tile along each of two axes; a tile takes some seconds.
const TILE: usize = 8;

pub(super) struct LyapunovFill {
    system: SystemPlan,
    plan: LyapunovPlan,
    grid: Grid,
}

impl LyapunovFill {
    pub(super) fn new(system: &SystemPlan, plan: &LyapunovPlan, tile: Option<u32>) -> Self {
        let grid = grid_of(&plan.axes, tile, side(TILE, plan.axes.len()));
        Self { system: *system, plan: plan.clone(), grid }
    }
}

const GROUNDS: [(i32, &str); 7] = [
    (-1, "not_computed"),
    (0, "undecided"),
    (1, "measured"),
    (2, "no_more_impacts"),
    (3, "sticks_in_each_turn"),
    (4, "stuck"),
    (5, "touches_without_speed"),
];

const fn grounds(of: &Grounds) -> i8 {
    match of {
        Grounds::Undecided { .. } => 0,
        Grounds::Measured { .. } => 1,
        Grounds::Flight(_) => 2,
        Grounds::Sticks(_) => 3,
        Grounds::Stuck(_) => 4,
        Grounds::Touches(_) => 5,
    }
}

impl Fill for LyapunovFill {
    type Tile = Vec<Column>;

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn coordinates(&self) -> Vec<Along> {
        along(&self.plan.axes)
    }

    fn fields(&self) -> Vec<Field> {
        let real = |name: &'static str, long_name: &'static str, unit, extra: &[Extra]| Field {
            name: name.into(),
            long_name: long_name.into(),
            unit,
            kind: NumberType::F64,
            fill: 0,
            extra: extra.to_vec(),
            flags: Vec::new(),
            comment: "",
        };
        let both = [Extra { name: "direction", count: 2 }];
        let mut fields = vec![
            real("exponent", "Lyapunov exponents per unit time, the larger first", Unit::RATE, &both),
            real("exponent_error", "three standard errors of the exponents", Unit::RATE, &both),
            real("impacts_per_period", "impacts per forcing period", Unit::NUMBER, &[]),
            real("impacts_per_period_error", "three standard errors of the impacts per period", Unit::NUMBER, &[]),
            real("dimension", "Kaplan-Yorke dimension of the stroboscopic section", Unit::NUMBER, &[]),
        ];
        fields.push(Field {
            kind: NumberType::I8,
            fill: -1,
            flags: GROUNDS.to_vec(),
            ..real("grounds", "where the exponents come from", Unit::NUMBER, &[])
        });
        fields
    }

    fn compute(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        let points = block.points();
        let mut numbers = [2, 2, 1, 1, 1].map(|width| vec![f64::NAN; width * points]);
        let mut why = vec![0_i8; points];
        for (k, why) in why.iter_mut().enumerate() {
            let index = block.index(k);
            let (place, axes) = (|axis: usize| on_axis(&index, axis), &self.plan.axes);
            // the corners are valid; a point between them that is not has no result
            let question = axis::system_at(&self.system, axes, place).and_then(|there| {
                let osc = there.oscillator()?;
                Ok((osc, axis::start_at((&self.system, &there), &self.plan.start, axes, place).start(&osc)?))
            });
            if let Ok((osc, start)) = question {
                let found = exponents(&osc, start, &self.plan.options());
                let mut put = |array: usize, at: usize, value: f64| numbers[array][at] = value;
                for (i, Measured { value, error }) in found.exponents.into_iter().enumerate() {
                    put(0, 2 * k + i, value);
                    put(1, 2 * k + i, error);
                }
                put(2, k, found.impacts_per_period.value);
                put(3, k, found.impacts_per_period.error);
                put(4, k, found.section_dimension.map_or(f64::NAN, |d| d.value));
                *why = grounds(&found.grounds);
            }
            if tick() {
                return None;
            }
        }
        Some(numbers.into_iter().map(Column::F64).chain([Column::I8(why)]).collect())
    }

    fn columns(&self, _: &Block, tile: Vec<Column>) -> Vec<Column> {
        tile
    }
}
