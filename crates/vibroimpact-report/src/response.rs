//! The response of any system as it is told: names, units and values of what varies and of the quantities.

use crate::{FieldName, Units, Varied};
use vibroimpact::machine::Machine;
use vibroimpact::quantities::machine_quantity;
use vibroimpact_plot::plain;
use vibroimpact_study::{
    Name, Parameter, PlanError, Quantity, ResponseCurves, ResponsePlan, ResponseRow, Values, Variable,
};

/// A response with the names and the units of its report.
#[derive(Clone, Debug)]
pub struct ResponseView<'a> {
    /// The response.
    pub found: &'a ResponseCurves,
    /// What varies.
    pub vary: &'a str,
    /// Its values.
    pub over: &'a Values,
    /// The name of its column in a table, and that of the axis of a figure.
    pub column: String,
    /// See above.
    pub axis: String,
    /// The quantity that is reported, in words, and as the name of an axis.
    pub quantity: String,
    /// See above.
    pub ordinate: String,
    /// The names of the columns of all quantities.
    pub columns: Vec<String>,
    /// The unit of a system with physical units, and what varies.
    units: Option<(Units, Parameter)>,
}

impl<'a> ResponseView<'a> {
    /// Of an oscillator, in its units.
    pub(crate) fn of_oscillator(
        found: &'a ResponseCurves,
        asked: &'a ResponsePlan<Variable, String>,
        units: &Units,
    ) -> Result<Self, PlanError> {
        let plan: ResponsePlan = asked.typed()?;
        let quantity = plan.quantity();
        Ok(Self {
            found,
            vary: units.name_of(plan.vary),
            over: &asked.over,
            column: plan.vary.column(units).to_owned(),
            axis: plan.vary.axis(units),
            quantity: quantity.description().to_owned(),
            ordinate: quantity.axis(units),
            columns: Quantity::ALL.map(|quantity| units.column(quantity.name(), quantity.kind())).to_vec(),
            units: Some((*units, plan.vary)),
        })
    }

    /// Of a machine, in the units of its numbers.
    pub(crate) fn of_machine(
        found: &'a ResponseCurves,
        plan: &'a ResponsePlan<Variable, String>,
        machine: &Machine,
    ) -> Self {
        let path = &found.quantities[found.shown];
        Self {
            found,
            vary: plan.vary.text(),
            over: &plan.over,
            column: plan.vary.text().to_owned(),
            axis: plain(plan.vary.text()),
            quantity: machine_quantity(machine, path)
                .map_or_else(|_| path.clone(), |(part, of)| part.description(of).to_owned()),
            ordinate: plain(path),
            columns: found.quantities.clone(),
            units: None,
        }
    }

    /// The unit of what varies.
    pub(crate) fn unit(&self) -> f64 {
        self.units.map_or(1.0, |(units, vary)| units.of(vary))
    }

    /// The smallest and the largest value of what varies.
    #[must_use]
    pub fn ends(&self) -> (f64, f64) {
        let (from, to) = self.over.extent();
        (from * self.unit(), to * self.unit())
    }

    /// What varies, at a motion.
    #[must_use]
    pub fn parameter(&self, row: &ResponseRow) -> f64 {
        row.value * self.unit()
    }

    /// Quantity number `k` of a motion.
    pub(crate) fn value(&self, row: &ResponseRow, k: usize) -> f64 {
        let unit = self.units.map_or(1.0, |(units, vary)| units.at(vary, row.value).of_quantity(Quantity::ALL[k]));
        row.quantities[k] * unit
    }

    /// The quantity of a motion that is reported.
    #[must_use]
    pub fn shown(&self, row: &ResponseRow) -> f64 {
        self.value(row, self.found.shown)
    }

    /// The same with its unit, as text.
    #[must_use]
    pub fn text(&self, row: &ResponseRow) -> String {
        let unit =
            self.units.filter(|(units, _)| units.si).map_or("", |_| Quantity::ALL[self.found.shown].kind().unit());
        format!("{} {unit}", crate::number::short(self.shown(row))).trim_end().to_owned()
    }
}
