//! A plan as it is written by hand: what an axis varies need not be given twice.

use crate::plan::{Plan, SecondStop, SystemPlan, Task};
use crate::{Axis, Coordinate, Parameter, PlanError};
use serde::Deserialize;

/// The fields of [`Plan`], with gaps.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Written {
    version: u32,
    #[serde(default)]
    system: System,
    task: Task,
    #[serde(default)]
    tile: Option<u32>,
}

/// The fields of [`SystemPlan`], any of them absent.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct System {
    beta: Option<f64>,
    inverse_beta: Option<f64>,
    gap: Option<f64>,
    restitution: Option<f64>,
    #[serde(default)]
    damping: f64,
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
            Self::Diagram(diagram) => vec![(diagram.vary, diagram.over.at(0))],
            _ => Vec::new(),
        }
    }
}

impl Plan {
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
