//! A plan of a machine as TOML and JSON: the tables of a machine file, a version and a task.

use super::plan::{MachinePlan, MachineTask};
use crate::PlanError;
use crate::machine::{MachineSource, MachineText, Named, StartText, headed_toml};
use crate::text::Document;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A plan of a machine as it is written.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MachinePlanText {
    /// The version of the plan's fields: 1.
    #[schemars(range(min = 1, max = 1))]
    version: u32,
    /// Points of a tile along each axis, where results are stored; each task has a size of its own when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    tile: Option<u32>,
    /// Tiles of a shard along each axis, where results are stored; 1 for no shards. When absent, a store has shards if it
    /// has more than 4096 tiles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1024))]
    shard: Option<u32>,
    /// A title in a few words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    title: Option<String>,
    /// Where the machine comes from: authors, title, year, DOI.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<String>,
    /// What it is, and what was chosen where the source says nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    summary: Option<String>,
    /// Numbers that expressions use, in the notation of the source.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    parameters: Named<f64>,
    /// Numbers of the expansion that are changed after it, by path.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    set: Named<f64>,
    /// Where the motion starts; at rest at 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<StartText>,
    /// The machine.
    machine: MachineText,
    /// What is computed.
    task: MachineTask,
}

impl From<MachinePlanText> for MachinePlan {
    fn from(text: MachinePlanText) -> Self {
        let MachinePlanText { version, title, source, summary, parameters, set, start, machine, task, tile, shard } =
            text;
        Self {
            version,
            machine: MachineSource { title, source, summary, parameters, set, start, machine },
            task,
            tile,
            shard,
        }
    }
}

impl From<MachinePlan> for MachinePlanText {
    fn from(MachinePlan { version, machine, task, tile, shard }: MachinePlan) -> Self {
        let MachineSource { title, source, summary, parameters, set, start, machine } = machine;
        Self { version, title, source, summary, parameters, set, start, machine, task, tile, shard }
    }
}

impl MachinePlan {
    /// Reads a plan written as TOML or, where it begins with a brace, as JSON. `files` returns the text of a file that
    /// the machine names, or says why not.
    ///
    /// # Errors
    /// [`PlanError::Text`] with the path of the part, the line and the column, and what is expected there;
    /// [`PlanError::Machine`] for a file that cannot be read.
    pub fn from_text(text: &str, files: impl FnOnce(&str) -> Result<String, String>) -> Result<Self, PlanError> {
        Self::of_document(&Document::parse(text)?, files)
    }

    pub(crate) fn of_document(
        document: &Document<'_>,
        files: impl FnOnce(&str) -> Result<String, String>,
    ) -> Result<Self, PlanError> {
        let mut plan = Self::from(document.read::<MachinePlanText>()?);
        plan.machine.read_modes(files)?;
        Ok(plan)
    }

    /// The plan as TOML. Numbers have all their digits.
    #[must_use]
    pub fn to_toml(&self) -> String {
        headed_toml(self)
    }

    /// The JSON schema of plans of machines, for editors and other programs.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        let mut schema = schemars::schema_for!(MachinePlanText).to_value();
        schema["title"] = "a plan of vibroimpact for a machine".into();
        schema
    }
}

/// Whether a text is a plan of a machine: it has a table `machine`.
#[must_use]
pub fn is_machine_plan(text: &str) -> bool {
    Document::parse(text).is_ok_and(|document| document.has_machine())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{CATALOGUE, no_files};
    use vibroimpact::events::MachineStart;

    /// Every machine of the catalogue, in both languages, with changed numbers and another start.
    #[test]
    fn plans_survive_toml_and_json() {
        for entry in CATALOGUE {
            let source = entry.source().unwrap();
            let (n, path) = (source.parts().unwrap().n(), source.paths().unwrap().pop().unwrap());
            let changed = source.with(&path, source.number(&path).unwrap() * 1.25).unwrap();
            let task = MachineTask::Simulate { impacts: None, periods: Some(2.5) };
            let plan = MachinePlan::new(changed, task).starting(&MachineStart {
                q: vec![0.1 + 0.2; n],
                qdot: vec![-1e-300; n],
                phase: 1.0,
                ..MachineStart::default()
            });
            let (toml, json) = (plan.to_toml(), serde_json::to_string(&plan).unwrap());
            assert_eq!(MachinePlan::from_text(&toml, no_files), Ok(plan.clone()), "{toml}");
            assert_eq!(MachinePlan::from_text(&json, no_files), Ok(plan.clone()), "{json}");
            assert_eq!(serde_json::from_str::<MachinePlan>(&json).unwrap(), plan);
            assert!(is_machine_plan(&toml) && is_machine_plan(&json));
            assert!(toml.starts_with("version = 1\n") && toml.contains("[task.simulate]\nperiods = 2.5\n"), "{toml}");
        }
        let source = CATALOGUE[0].source().unwrap();
        let plan = MachinePlan::new(source, MachineTask::Attractors { starts: 1, seed: u64::MAX, impacts: None });
        assert_eq!(MachinePlan::from_text(&plan.to_toml(), no_files), Ok(plan));
        assert!(
            !is_machine_plan("version = 1\n[system]\nbeta = 1\n") && !is_machine_plan("{") && !is_machine_plan("[")
        );
    }

    #[test]
    fn wrong_plans_are_explained() {
        let good = "version = 1\n[machine]\nbodies = { a = 1 }\n[task.simulate]\nimpacts = 5\n";
        assert!(MachinePlan::from_text(good, no_files).is_ok());
        for (from, to, said) in [
            (
                "impacts",
                "impact",
                "task.simulate.impact: unknown field `impact`, expected `impacts` or `periods` (line 5, column 1)",
            ),
            ("[task.simulate]", "[task.settel]", "task.settel: unknown"),
            ("version = 1", "version = 2", "the plan has version 2"),
            ("impacts = 5", "impacts = 0", "impacts = 0 lies outside"),
            ("impacts = 5", "periods = 3", "no forcing"),
            ("bodies", "bodis", "unknown field `bodis`"),
            ("bodies = { a = 1 }", "modes = \"m.csv\"", "the file `m.csv` cannot be read here"),
            ("[machine]", "[start]\nq = [1, 2]\n[machine]", "start.q: has 2 numbers, and 1 are needed"),
        ] {
            let text = good.replace(from, to);
            let told = MachinePlan::from_text(&text, no_files).and_then(|plan| plan.check()).unwrap_err().to_string();
            assert!(told.contains(said), "{text}: {told}");
        }
    }
}
