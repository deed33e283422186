//! A plan of a machine as TOML and JSON: the tables of a machine file, a version and a task.

use crate::machine::{MachineSource, Named, StartText, WrittenMachine};
use crate::{Plan, Task};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A plan of a machine as it is written.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MachinePlanText {
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
    machine: WrittenMachine,
    /// What is computed.
    pub(crate) task: Task,
}

impl From<MachinePlanText> for Plan {
    fn from(text: MachinePlanText) -> Self {
        let MachinePlanText { version, title, source, summary, parameters, set, start, machine, task, tile, shard } =
            text;
        let machine = MachineSource { title, source, summary, parameters, set, start, machine };
        Self { version, system: machine.into(), task, tile, shard, units: None }
    }
}

impl MachinePlanText {
    /// The text of a plan.
    pub(crate) fn new(
        version: u32,
        machine: &MachineSource,
        task: &Task,
        (tile, shard): (Option<u32>, Option<u32>),
    ) -> Self {
        let MachineSource { title, source, summary, parameters, set, start, machine } = machine.clone();
        Self { version, title, source, summary, parameters, set, start, machine, task: task.clone(), tile, shard }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::is_machine_plan;
    use crate::machine::CATALOGUE;
    use vibroimpact::events::Start;

    /// Every machine of the catalogue, in both languages, with changed numbers and another start.
    #[test]
    fn plans_survive_toml_and_json() {
        for entry in CATALOGUE {
            let source = entry.source().unwrap();
            let (n, path) = (source.parts().unwrap().n(), source.paths().unwrap().pop().unwrap());
            let changed = source.with(&path, source.number(&path).unwrap() * 1.25).unwrap();
            let task = Task::Simulate { start: None, impacts: None, periods: Some(2.5) };
            let start = Start { q: vec![0.1 + 0.2; n], qdot: vec![-1e-300; n], phase: 1.0, ..Start::default() };
            let plan = Plan::new(changed.starting(&start), task);
            let (toml, json) = (plan.to_toml(), serde_json::to_string(&plan).unwrap());
            assert_eq!(Plan::from_text(&toml), Ok(plan.clone()), "{toml}");
            assert_eq!(Plan::from_text(&json), Ok(plan.clone()), "{json}");
            assert_eq!(serde_json::from_str::<Plan>(&json).unwrap(), plan);
            assert!(is_machine_plan(&toml) && is_machine_plan(&json));
            assert!(toml.starts_with("version = 1\n") && toml.contains("[task.simulate]\nperiods = 2.5\n"), "{toml}");
        }
        let source = CATALOGUE[0].source().unwrap();
        let plan = Plan::new(source, Task::Attractors { starts: 1, seed: u64::MAX, impacts: None });
        assert_eq!(Plan::from_text(&plan.to_toml()), Ok(plan));
        assert!(
            !is_machine_plan("version = 1\n[system]\nbeta = 1\n") && !is_machine_plan("{") && !is_machine_plan("[")
        );
    }

    #[test]
    fn wrong_plans_are_explained() {
        let good = "version = 1\n[machine]\nbodies = { a = 1 }\n[task.simulate]\nimpacts = 5\n";
        assert!(Plan::from_text(good).is_ok());
        for (from, to, said) in [
            (
                "impacts",
                "impact",
                "task.simulate.impact: unknown field `impact`, expected one of `start`, `impacts`, `periods` (line 5, column 1)",
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
            let told = Plan::from_text(&text).and_then(|plan| plan.check()).unwrap_err().to_string();
            assert!(told.contains(said), "{text}: {told}");
        }
    }
}
