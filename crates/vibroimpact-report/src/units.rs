//! The units of lengths, velocities and times in results.

use crate::number::short;
use crate::varied::Varied;
use vibroimpact::quantities::{Quantities, Quantity};
use vibroimpact::{QuantityKind, Scales};
use vibroimpact_study::{
    Axis, Body, FramePlan, Parameter, Plan, PlanError, Span, SystemPlan, UnitsPlan, Values, is_length, natural_hertz,
};

/// The system of a plan, and the units of its results.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// The nondimensional system.
    pub system: SystemPlan,
    /// The units of results.
    pub units: Units,
}

impl Asked {
    /// The same with the units of the body, after a number of it has changed.
    #[must_use]
    pub fn refreshed(self) -> Self {
        let Some(plan) = UnitsPlan::of_system(&self.system).filter(|_| self.units.si) else { return self };
        let units = Units { scales: Some(plan.scales()), frame: plan.frame, body: self.system.body, ..self.units };
        Self { units, ..self }
    }
}

/// The units of results: nondimensional, or metres and seconds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Units {
    /// The physical units of the system, if it has any.
    pub scales: Option<Scales>,
    /// Whether results are in metres and seconds.
    pub si: bool,
    /// Whether the frequency ratio is reported as the frequency of the force in Hz.
    pub hertz: bool,
    /// The frame of positions and phases, if the body is driven by more than a force.
    pub frame: Option<FramePlan>,
    /// The body, if the system is one.
    pub body: Option<Body>,
}

impl From<&UnitsPlan> for Units {
    fn from(plan: &UnitsPlan) -> Self {
        Self { scales: Some(plan.scales()), si: true, hertz: plan.hertz, frame: plan.frame, body: None }
    }
}

impl Units {
    /// The units of the results of a plan.
    #[must_use]
    pub fn of_plan(plan: &Plan) -> Self {
        let units = plan.units.as_ref().map_or_else(Self::default, Self::from);
        Self { body: plan.oscillator().and_then(|system| system.body), ..units }
    }

    /// The units where a parameter has this value: the units of a body depend on its mass, its stiffness and all that
    /// drives it.
    pub(crate) fn at(&self, parameter: Parameter, value: f64) -> Self {
        let (Parameter::Body(_), Some(body), true) = (parameter, self.body, self.si) else { return *self };
        let changed = body.with(parameter, value).and_then(|body| Ok((body, body.reduction()?)));
        // a value that gives no body has no result either
        changed.map_or(*self, |(body, of)| {
            let frame = self.frame.map(|frame| FramePlan { phase: of.phase(), offset_m: of.offset(), ..frame });
            Self { scales: Some(of.scales()), frame, body: Some(body), ..*self }
        })
    }

    /// The units at a point of the axes; `value(k)` is the value of axis `k`.
    #[must_use]
    pub fn over<V: Varied>(&self, axes: &[Axis<V>], value: impl Fn(usize) -> f64) -> Self {
        axes.iter().enumerate().fold(*self, |units, (k, axis)| axis.vary.units_at(&units, value(k)))
    }

    /// These units as a part of a plan; `None` for nondimensional results.
    #[must_use]
    pub fn plan(&self) -> Option<UnitsPlan> {
        self.scales.as_ref().filter(|_| self.si).map(|scales| UnitsPlan::new(scales, self.hertz, self.frame))
    }

    /// The units at point number `k` of the axes, the first of which varies fastest.
    pub(crate) fn at_point<V: Varied>(&self, axes: &[Axis<V>], k: usize) -> Self {
        let values = if self.body.is_none() { return *self } else { Axis::at(axes, k as u64) };
        self.over(axes, |k| values[k])
    }

    fn factor(&self, of: impl Fn(&Scales) -> f64) -> f64 {
        self.scales.as_ref().filter(|_| self.si).map_or(1.0, of)
    }

    /// The unit of length, as a factor for nondimensional lengths.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.factor(|s| s.length)
    }

    /// The unit of time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.factor(|s| s.time)
    }

    /// The unit of velocity.
    #[must_use]
    pub fn velocity(&self) -> f64 {
        self.factor(Scales::velocity)
    }

    /// The unit of a kind of quantity.
    #[must_use]
    pub fn of_kind(&self, kind: QuantityKind) -> f64 {
        self.factor(|scales| kind.scale(scales))
    }

    /// The value of a quantity in these units; not-a-number if it is not defined.
    #[must_use]
    pub fn value_of(&self, of: &Quantities, quantity: Quantity) -> f64 {
        of.get(quantity) * self.of_quantity(quantity)
    }

    /// The unit of a quantity; not-a-number if it is not defined in the frame of these units.
    #[must_use]
    pub fn of_quantity(&self, quantity: Quantity) -> f64 {
        let equivalent = matches!(
            quantity,
            Quantity::DampingLossPerPeriod | Quantity::DampingPower | Quantity::WorkPerPeriod | Quantity::Power
        );
        if equivalent && self.frame.is_some_and(|frame| frame.apart) {
            return f64::NAN;
        }
        self.of_kind(quantity.kind())
    }

    /// The name of a column with values of this kind, which ends in the unit if there is one.
    #[must_use]
    pub fn column(&self, name: &str, kind: QuantityKind) -> String {
        if self.si { format!("{name}{}", kind.suffix()) } else { name.to_owned() }
    }

    /// The names of the columns of position and velocity, as of all coordinates and all velocities.
    pub(crate) fn states(&self) -> (Vec<String>, Vec<String>) {
        let name = |of, kind| vec![self.column(of, kind)];
        (name("x", QuantityKind::Length), name("v", QuantityKind::Velocity))
    }

    /// A quantity as text, with its unit if there is one.
    #[must_use]
    pub fn text(&self, of: &Quantities, quantity: Quantity) -> String {
        let (number, unit) = (short(self.value_of(of, quantity)), quantity.kind().unit());
        if self.si && !unit.is_empty() { format!("{number} {unit}") } else { number }
    }

    /// The unit of a parameter.
    #[must_use]
    pub fn of(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::Beta if self.hertz => self.factor(natural_hertz),
            _ if is_length(parameter) => self.length(),
            _ => 1.0,
        }
    }

    /// The SI unit of a parameter; empty for a pure number and in nondimensional units.
    pub(crate) const fn unit_of(&self, parameter: Parameter) -> &'static str {
        match parameter {
            Parameter::Beta if self.si && self.hertz => "Hz",
            Parameter::Body(number) => number.unit(),
            _ if self.si && is_length(parameter) => "m",
            _ => "",
        }
    }

    /// The name of a parameter in JSON.
    pub(crate) const fn name_of(&self, parameter: Parameter) -> &'static str {
        match parameter {
            Parameter::Beta if self.si && self.hertz => "frequency_hz",
            _ => parameter.name(),
        }
    }

    /// The values of an axis in these units, exactly as they were given.
    ///
    /// # Errors
    /// [`PlanError`] if a value overflows.
    pub fn shown(&self, axis: &Axis) -> Result<Values, PlanError> {
        shown(&axis.over, Varied::unit(&axis.vary, self))
    }

    /// `name` followed by its unit in brackets, if there is one, such as `time (s)`.
    #[must_use]
    pub fn named(&self, name: &str, unit: &str) -> String {
        if self.si { format!("{name} ({unit})") } else { name.to_owned() }
    }

    /// The name of the units in JSON.
    pub(crate) const fn name(&self) -> &'static str {
        if self.si { "si" } else { "nondimensional" }
    }
}

/// The number that gives `value` when divided by `unit`. Of all such doubles, it is the one with the fewest digits. So
/// `0.005` given in metres is printed as `0.005`, and not as `0.0050000000000000001`.
pub(crate) fn given(value: f64, unit: f64) -> f64 {
    let product = value * unit;
    if unit == 1.0 {
        return value;
    }
    let shorter = |digits: usize| format!("{product:.digits$e}").parse::<f64>().ok();
    (14..=16).filter_map(shorter).find(|candidate| candidate / unit == value).unwrap_or(product)
}

/// The values of a range or list in another unit, as they were [given].
pub(crate) fn shown(values: &Values, unit: f64) -> Result<Values, PlanError> {
    Ok(match values {
        Values::Span(span) => Values::Span(shown_span(span, unit)?),
        Values::Listed(list) => Values::Listed(list.iter().map(|value| given(*value, unit)).collect()),
    })
}

/// A range in another unit, as for [`shown`].
pub(crate) fn shown_span(span: &Span, unit: f64) -> Result<Span, PlanError> {
    let ((first, last), count) = (span.ends(), span.count());
    let (first, last) = (given(first, unit), given(last, unit));
    if span.is_logarithmic() { Span::logarithmic(first, last, count) } else { Span::new(first, last, count) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The original numbers are recovered, for thousands of numbers and units.
    #[test]
    fn what_was_given_comes_back() {
        for k in 1..200_u32 {
            let unit = 0.000_37 * f64::from(k);
            for text in ["0.005", "0.1", "-0.0123456789", "3", "7e-9", "123456.789012345"] {
                let typed: f64 = text.parse().unwrap();
                assert_eq!(given(typed / unit, unit), typed, "{text} in {unit}");
            }
        }
        assert_eq!(given(0.1 + 0.2, 1.0), 0.1 + 0.2);
        assert_eq!(given(0.0, 0.3), 0.0);
        let span: Span = "0.005:0.01:6".parse().unwrap();
        assert_eq!(shown_span(&span.scaled(0.02).unwrap(), 0.02).unwrap(), span);
    }
}
