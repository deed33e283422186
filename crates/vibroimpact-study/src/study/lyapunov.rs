//! The tiles of a study of Lyapunov exponents: at each point all exponents and where they come from.

use super::fill::{Fill, Over, on_axis};
use super::map::side;
use crate::axis;
use crate::field::{Column, Extra, Field, NumberType};
use crate::{Block, LyapunovPlan, SystemPlan, Unit};
use vibroimpact::chaos::{Grounds, Measured, exponents};

/// Default number of points of a tile along each of two axes; a tile takes some seconds.
pub(super) const TILE: usize = 8;

/// Systems over the points of a grid, of which exponents are measured.
pub(super) trait Spectra: Send + Sync {
    /// The unit of the exponents.
    const RATE: Unit;
    /// The code of a point at which there is no such system or start.
    const REFUSED: i8;

    /// The number of exponents at each point.
    fn directions(&self) -> usize;
    /// The names and descriptions of the further numbers of a [`Spectrum`].
    fn further(&self) -> &'static [(&'static str, &'static str)];
    /// The codes of the reasons why there are these exponents, and their names.
    fn grounds(&self) -> &'static [(i32, &'static str)];
    /// The exponents at a point; `None` where there is no such system or start.
    fn at(&self, index: &[usize]) -> Option<Spectrum>;
}

/// What is measured at a point.
#[derive(Default)]
pub(super) struct Spectrum {
    /// Per unit time, the largest first.
    pub(super) exponents: Vec<Measured>,
    /// The numbers that [`Spectra::further`] names.
    pub(super) further: Vec<f64>,
    /// One of the codes of [`Spectra::grounds`].
    pub(super) grounds: i8,
}

pub(super) struct LyapunovFill<S> {
    pub(super) of: S,
    pub(super) over: Over,
}

/// Oscillators and their starts over axes.
pub(super) struct Oscillators {
    system: SystemPlan,
    plan: LyapunovPlan,
}

impl LyapunovFill<Oscillators> {
    pub(super) fn new(system: &SystemPlan, plan: &LyapunovPlan, tile: Option<u32>) -> Self {
        let over = Over::usual(&plan.axes, tile, side(TILE, plan.axes.len()));
        Self { of: Oscillators { system: *system, plan: plan.clone() }, over }
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
        // an oscillator has no others that are exact
        Grounds::Flight(_) | Grounds::Exact => 2,
        Grounds::Sticks(_) => 3,
        Grounds::Stuck(_) => 4,
        Grounds::Touches(_) => 5,
    }
}

impl Spectra for Oscillators {
    const RATE: Unit = Unit::RATE;
    const REFUSED: i8 = 0;

    fn directions(&self) -> usize {
        2
    }

    fn further(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("impacts_per_period", "impacts per forcing period"),
            ("impacts_per_period_error", "three standard errors of the impacts per period"),
            ("dimension", "Kaplan-Yorke dimension of the stroboscopic section"),
        ]
    }

    fn grounds(&self) -> &'static [(i32, &'static str)] {
        &GROUNDS
    }

    fn at(&self, index: &[usize]) -> Option<Spectrum> {
        let (place, axes) = (|axis: usize| on_axis(index, axis), &self.plan.axes);
        let there = axis::system_at(&self.system, axes, place).ok()?;
        let osc = there.oscillator().ok()?;
        let start = axis::start_at((&self.system, &there), &self.plan.start(), axes, place).start(&osc).ok()?;
        let found = exponents(&osc, start, &self.plan.options());
        let impacts = found.impact_rate.scaled(osc.period());
        Some(Spectrum {
            exponents: found.exponents,
            further: vec![impacts.value, impacts.error, found.section_dimension.map_or(f64::NAN, |d| d.value)],
            grounds: grounds(&found.grounds),
        })
    }
}

impl<S: Spectra> Fill for LyapunovFill<S> {
    fn over(&self) -> &Over {
        &self.over
    }

    fn fields(&self) -> Vec<Field> {
        let each = [Extra { name: "direction", count: self.of.directions() }];
        let mut fields = vec![
            Field::real("exponent", "Lyapunov exponents per unit time, the larger first", S::RATE, &each),
            Field::real("exponent_error", "three standard errors of the exponents", S::RATE, &each),
        ];
        fields.extend(
            self.of.further().iter().map(|(name, long_name)| Field::real(*name, *long_name, Unit::NUMBER, &[])),
        );
        let long_name = "where the exponents come from";
        fields.push(Field::integers("grounds", long_name, NumberType::I8, &[], self.of.grounds()));
        fields
    }

    fn fill(&self, block: &Block, tick: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Column>> {
        let mut columns: Vec<Column> = self.fields().iter().map(|field| field.empty(block.points())).collect();
        for k in 0..block.points() {
            // the corners are valid; a point between them that is not has no result
            let found = self.of.at(&block.index(k));
            let grounds = found.as_ref().map_or(S::REFUSED, |found| found.grounds);
            let Spectrum { exponents, further, .. } = found.unwrap_or_default();
            let places = (self.of.directions() * k..).take(self.of.directions());
            for (place, Measured { value, error }) in places.zip(exponents) {
                columns[0].set(place, value);
                columns[1].set(place, error);
            }
            let further = further.into_iter().chain([f64::from(grounds)]);
            columns.iter_mut().rev().zip(further.rev()).for_each(|(column, value)| column.set(k, value));
            if tick() {
                return None;
            }
        }
        Some(columns)
    }
}
