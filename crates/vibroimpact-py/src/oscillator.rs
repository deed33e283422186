//! An oscillator as it is given, which is checked at construction and immutable.

use crate::error::Trouble;
use crate::plan::text;
use pyo3::prelude::*;
use std::collections::HashMap;
use vibroimpact::{Scales, Side};
use vibroimpact_study::{Body, SecondStop, SystemPlan};

/// An oscillator as it is given: its nondimensional numbers, or those of a body in SI units.
#[pyclass(frozen, from_py_object, module = "vibroimpact._core")]
#[derive(Clone, Copy)]
pub(crate) struct OscillatorFile {
    pub(crate) plan: SystemPlan,
    pub(crate) osc: vibroimpact::Oscillator,
}

/// One unit of length in m, of time in s, and the mass in kg.
pub(crate) type ScalesOf = (f64, f64, f64);

/// The units with these sizes.
pub(crate) const fn scales((length_m, time_s, mass_kg): ScalesOf) -> Scales {
    Scales { length: length_m, time: time_s, mass: mass_kg }
}

/// The numbers of an oscillator, and what follows from them.
#[derive(IntoPyObject)]
pub(crate) struct Numbers {
    beta: f64,
    inverse_beta: f64,
    gap: f64,
    restitution: f64,
    damping: f64,
    second_gap: Option<f64>,
    second_restitution: Option<f64>,
    period: f64,
    free_amplitude: f64,
}

impl OscillatorFile {
    fn checked(plan: SystemPlan) -> Result<Self, Trouble> {
        Ok(Self { plan, osc: plan.oscillator()? })
    }
}

#[pymethods]
impl OscillatorFile {
    /// Of nondimensional numbers; the second stop has a gap and a restitution.
    #[new]
    fn new(
        beta: Option<f64>,
        inverse_beta: Option<f64>,
        gap: f64,
        restitution: f64,
        damping: f64,
        second: Option<(f64, f64)>,
    ) -> Result<Self, Trouble> {
        let second_stop = second.map(|(gap, restitution)| SecondStop { gap, restitution });
        Self::checked(SystemPlan { beta, inverse_beta, gap, restitution, damping, second_stop, body: None })
    }

    /// Of the numbers of a body by their names in SI units.
    #[staticmethod]
    fn physical(numbers: HashMap<String, f64>, stop_in_space: bool) -> Result<Self, Trouble> {
        if let Some((name, value)) = numbers.iter().find(|(_, value)| !value.is_finite()) {
            return Err(Trouble::question(format!("{name} = {value} is not a finite number")));
        }
        let mut fields: serde_json::Map<String, serde_json::Value> =
            numbers.into_iter().map(|(name, value)| (name, value.into())).collect();
        fields.insert("stop_in_space".to_owned(), stop_in_space.into());
        let body: Body = serde_json::from_value(fields.into()).map_err(|error| Trouble::question(error.to_string()))?;
        Self::checked(SystemPlan::of_body(&body)?)
    }

    /// Of the system of a plan, which is JSON.
    #[staticmethod]
    fn read(given: &str) -> Result<Self, Trouble> {
        let plan = serde_json::from_str(given);
        Self::checked(plan.map_err(|error| Trouble::question(format!("the system does not read: {error}")))?)
    }

    /// As the system of a plan.
    #[getter]
    fn json(&self) -> Result<String, Trouble> {
        text(&self.plan)
    }

    /// The same with another number, by its name.
    fn with_number(&self, name: &str, value: f64) -> Result<Self, Trouble> {
        Self::checked(self.plan.with(crate::axis::parameter(name)?, value)?)
    }

    fn numbers(&self) -> Numbers {
        let (osc, second) = (&self.osc, self.osc.stop(Side::Lower));
        Numbers {
            beta: osc.beta(),
            // exactly as given if it was given
            inverse_beta: self.plan.inverse_beta.unwrap_or(1.0 / osc.beta()),
            gap: osc.gap(),
            restitution: osc.restitution(),
            damping: osc.damping(),
            second_gap: second.map(|stop| stop.gap),
            second_restitution: second.map(|stop| stop.restitution),
            period: osc.period(),
            free_amplitude: osc.free_amplitude(),
        }
    }

    /// The units of a body.
    fn scales(&self) -> Option<ScalesOf> {
        self.plan.scales().map(|of| (of.length, of.time, of.mass))
    }
}
