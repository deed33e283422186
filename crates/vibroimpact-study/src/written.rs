//! A plan as it is written by hand: what an axis varies need not be given twice.

use crate::plan::{Plan, SecondStop, SystemPlan, Task};
use crate::{Axis, Coordinate, Parameter, PlanError};
use schemars::JsonSchema;
use serde::Deserialize;

/// What is asked, of which system. What varies on an axis need not be given in the system.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Written {
    /// The version of the plan's fields: 1.
    #[schemars(range(min = 1, max = 1))]
    version: u32,
    /// The oscillator.
    #[serde(default)]
    system: System,
    /// What is asked of it.
    task: Task,
    /// Points of a tile along each axis, where results are stored; each task has a size of its own when absent.
    #[serde(default)]
    #[schemars(range(min = 1, max = 4096))]
    tile: Option<u32>,
}

/// The oscillator: exactly one of beta and inverse_beta, one or two stops.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct System {
    /// Frequency ratio omega / omega_n, positive.
    beta: Option<f64>,
    /// Its inverse, the abscissa of the 1971 paper.
    inverse_beta: Option<f64>,
    /// Gap, in units of F/k.
    gap: Option<f64>,
    /// Restitution.
    #[schemars(range(min = 0, max = 1))]
    restitution: Option<f64>,
    /// Damping ratio.
    #[serde(default)]
    #[schemars(range(min = 0))]
    damping: f64,
    /// A stop on the other side.
    second_stop: Option<SecondStop>,
}

impl Task {
    /// The parameters that vary, with their first values.
    fn varied(&self) -> Vec<(Parameter, f64)> {
        let on = |axes: &[Axis]| {
            let first = |axis: &Axis| match axis.vary {
                Coordinate::Parameter(parameter) if axis.over.count() > 0 => Some((parameter, axis.over.at(0))),
                _ => None,
            };
            axes.iter().filter_map(first).collect()
        };
        match self {
            Self::Map(map) => on(&map.axes),
            Self::Basin(basin) => on(&basin.axes),
            Self::Lyapunov(lyapunov) => on(&lyapunov.axes),
            Self::Diagram(diagram) => diagram.cut().values(diagram.over.at(0)).collect(),
            _ => Vec::new(),
        }
    }
}

impl Plan {
    /// Reads a plan written as TOML or, where it begins with a brace, as JSON.
    ///
    /// ```
    /// let plan = vibroimpact_study::Plan::from_text(r#"
    ///     version = 1
    ///     system = { restitution = 0.5 }
    ///     [task.map]
    ///     starts = 8
    ///     axes = [{ vary = "inverse_beta", over = "0.4:2:33" }, { vary = "gap", over = "0:5:41" }]
    /// "#)?;
    /// assert_eq!(vibroimpact_study::Plan::from_text(&plan.to_toml())?, plan);
    /// # Ok::<(), vibroimpact_study::PlanError>(())
    /// ```
    ///
    /// # Errors
    /// [`PlanError::Text`] says where in the text it goes wrong, and what is expected there.
    pub fn from_text(text: &str) -> Result<Self, PlanError> {
        let sentence = |why: String| PlanError::Text(why.trim_end().to_owned());
        if text.trim_start().starts_with('{') {
            serde_json::from_str(text).map_err(|error| sentence(error.to_string()))
        } else {
            toml::from_str(text).map_err(|error| sentence(error.to_string()))
        }
    }

    /// The plan as TOML.
    #[must_use]
    pub fn to_toml(&self) -> String {
        // numbers, texts and lists of them are always TOML
        toml::to_string_pretty(self).unwrap_or_default()
    }

    /// The JSON schema of plans, for editors and other programs.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        let mut schema = schemars::schema_for!(Written).to_value();
        schema["title"] = "a plan of vibroimpact".into();
        schema
    }

    /// The same question in the form in which it is stored: what varies has its first value in the system.
    ///
    /// # Errors
    /// [`PlanError::NoSecondStop`] for a parameter of a second stop that is not there.
    pub fn canonical(&self) -> Result<Self, PlanError> {
        let system =
            self.task.varied().into_iter().try_fold(self.system, |system, (p, value)| system.with(p, value))?;
        Ok(Self { system, ..self.clone() })
    }
}

impl TryFrom<Written> for Plan {
    type Error = PlanError;

    fn try_from(written: Written) -> Result<Self, PlanError> {
        let varied = written.task.varied();
        let varies = |parameter| varied.iter().any(|(other, _)| *other == parameter);
        let given = |value: Option<f64>, parameter: Parameter| match value {
            Some(value) => Ok(value),
            // replaced by its first value at once
            None if varies(parameter) => Ok(0.0),
            None => Err(PlanError::Missing(parameter.name())),
        };
        let asked = written.system;
        let system = SystemPlan {
            beta: asked.beta,
            inverse_beta: asked.inverse_beta,
            gap: given(asked.gap, Parameter::Gap)?,
            restitution: given(asked.restitution, Parameter::Restitution)?,
            damping: asked.damping,
            second_stop: asked.second_stop,
        };
        Self { version: written.version, system, task: written.task, tile: written.tile }.canonical()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_varies_need_not_be_given_twice() {
        let text = r#"{"version":1,"system":{"restitution":0.5},"task":{"map":{"starts":4,"axes":[
            {"vary":"inverse_beta","over":"0.4:2:9"},{"vary":"gap","over":[0.5,1.5]}]}}}"#;
        let plan: Plan = serde_json::from_str(text).unwrap();
        assert_eq!((plan.system.inverse_beta, plan.system.gap), (Some(0.4), 0.5));
        assert_eq!(plan.check(), Ok(()));
        // what is written out is complete, and reads as the same plan
        let full = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&full).unwrap(), plan);
        // a value in the system that differs from the first on the axis counts for nothing
        let other = text.replace("\"system\":{", "\"system\":{\"gap\":7.0,\"beta\":3.0,");
        assert_eq!(serde_json::from_str::<Plan>(&other).unwrap(), plan);
        for (gone, sentence) in [
            ("\"restitution\":0.5", "restitution is missing: it is neither in the system nor on an axis"),
            ("{\"vary\":\"inverse_beta\",\"over\":\"0.4:2:9\"},", ""),
        ] {
            let read = serde_json::from_str::<Plan>(&text.replace(gone, ""));
            let message = read.map_err(|e| e.to_string()).and_then(|p| p.check().map_err(|e| e.to_string()));
            assert!(message.as_ref().is_err_and(|m| m.contains(sentence)), "{message:?}");
        }
        let misspelt = text.replace("restitution", "restituton");
        assert!(serde_json::from_str::<Plan>(&misspelt).unwrap_err().to_string().contains("restituton"));
    }
}
