//! Plans as text, in TOML and JSON: one form for every system. An oscillator is a table `system`, and its start is a part of the
//! task; a machine is a table `machine` with the other tables of a machine file, its start among them. Parameters of an oscillator
//! that vary on an axis need not be given.

use crate::machine::{MachineSource, Named, StartText, WrittenMachine, headed_toml, no_files};
use crate::name::{Name, Variable};
use crate::plan::Plan;
use crate::system::{SecondStop, System, SystemPlan};
use crate::text::{Document, Value};
use crate::{
    Axis, Body, BodyNumber, Coordinate, DiagramPlan, Parameter, PlanError, PointsPlan, Quantity, Task, UnitsPlan,
};
use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A plan: of an oscillator, or of a machine where it has a table `machine`. What varies on an axis need not be given in the system.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlanText {
    /// The version of the plan's fields: 1.
    #[schemars(range(min = 1, max = 1))]
    version: u32,
    /// The oscillator.
    system: Option<OscillatorText>,
    /// What is asked of the system.
    task: Task,
    /// Points of a tile along each axis, where results are stored; each task has a size of its own when absent.
    #[schemars(range(min = 1, max = 4096))]
    tile: Option<u32>,
    /// Tiles of a shard along each axis, where results are stored; 1 for no shards. When absent, a store has shards if it
    /// has more than 4096 tiles.
    #[schemars(range(min = 1, max = 1024))]
    shard: Option<u32>,
    /// The physical units in which results of an oscillator are reported; those of its numbers in SI units when absent, or else
    /// nondimensional. Numbers of the plan are nondimensional, in these units, unless their names end in a unit.
    units: Option<UnitsPlan>,
    /// A title of the machine in a few words.
    title: Option<String>,
    /// Where the machine comes from: authors, title, year, DOI.
    source: Option<String>,
    /// What the machine is, and what was chosen where the source says nothing.
    summary: Option<String>,
    /// Numbers that expressions of the machine use, in the notation of the source.
    #[serde(default)]
    parameters: Named<f64>,
    /// Numbers of the expansion of the machine that are changed after it, by path.
    #[serde(default)]
    set: Named<f64>,
    /// Where the motion of the machine starts; at rest at 0 when absent.
    start: Option<StartText>,
    /// The machine.
    machine: Option<WrittenMachine>,
}

/// Whether a field has the value that it has when absent, and need not be written.
pub(crate) fn is_usual<T: Default + PartialEq>(field: &T) -> bool {
    *field == T::default()
}

/// The names in a plan that only an oscillator has.
const OF_OSCILLATORS: [&str; 2] = ["system", "units"];
/// The names in a plan that only a machine has, besides its table.
const OF_MACHINES: [&str; 6] = ["title", "source", "summary", "parameters", "set", "start"];

/// The oscillator: exactly one of beta and inverse_beta, one or two stops.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct OscillatorText {
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
    /// A body in SI units, instead of all numbers above.
    #[serde(rename = "machine")]
    body: Option<Body>,
}

impl Task {
    /// The parameters of an oscillator that vary, with their first values.
    fn varied(&self) -> Result<Vec<(Parameter, f64)>, PlanError> {
        let parameter = |(vary, value): (&Variable, f64)| match Coordinate::of(vary.text()) {
            Ok(Coordinate::Parameter(parameter)) => Some((parameter, value)),
            _ => None,
        };
        let on = |axes: &[Axis<Variable>]| {
            let axes = axes.iter().filter(|axis| axis.over.count() > 0);
            axes.filter_map(|axis| parameter((&axis.vary, axis.over.at(0)))).collect::<Vec<_>>()
        };
        Ok(match self {
            Self::Basin(basin) => {
                let points = basin.points.iter().filter(|points| points.count() > 0);
                let first = |points: &PointsPlan<Variable>| {
                    let value = |column| (points.vary(column), points.at(column, 0));
                    let first: Vec<(Variable, f64)> = (0..points.width()).map(value).collect();
                    first.iter().filter_map(|(vary, value)| parameter((vary, *value))).collect::<Vec<_>>()
                };
                points.flat_map(first).chain(on(&basin.axes)).collect()
            }
            // an empty list is refused later
            Self::Diagram(diagram) if diagram.over.count() > 0 => {
                let diagram: DiagramPlan = diagram.typed()?;
                diagram.cut().names().copied().zip(diagram.values(0)).collect()
            }
            Self::Response(response) => parameter((&response.vary, response.over.at(0))).into_iter().collect(),
            // the first value of a branch is that of the system
            task => on(task.axes()),
        })
    }

    /// The task as it is stored for an oscillator: what is not given has its usual value.
    fn filled(mut self) -> Self {
        if let Some(start) = self.start_mut() {
            start.get_or_insert_default();
        }
        if let Self::Lyapunov(plan) = &mut self {
            let (impacts, transient) = plan.lengths();
            (plan.impacts, plan.transient) = (Some(impacts), Some(transient));
        }
        self
    }

    /// Reads the task of a system, written as JSON.
    ///
    /// # Errors
    /// As for [`Plan::from_text`].
    pub fn from_json(text: &str, system: &System) -> Result<Self, PlanError> {
        let mut document = Document::json(text)?;
        let is_machine = system.machine().is_some();
        if is_machine {
            fill_for_machine(&mut document, &[]);
        }
        let task = of_system(&document.read()?, is_machine, &document)?;
        Ok(if is_machine { task } else { task.filled() })
    }
}

/// What tasks of machines have where a plan does not say it.
fn fill_for_machine(document: &mut Document<'_>, task: &[&str]) {
    document.fill(&[task, &["map"]].concat(), "seed", Value::Unsigned(1));
    document.fill(&[task, &["diagram"]].concat(), "show", Value::Text("speed".to_owned()));
}

/// The task with the names of an oscillator, or of a machine. An error has the position of the name.
fn of_system(task: &Task, is_machine: bool, document: &Document<'_>) -> Result<Task, PlanError> {
    if is_machine {
        let path = |name: &Variable| Ok(Variable::Path(name.text().to_owned()));
        return task.named(&path, &|quantity: &String| Ok(quantity.clone()));
    }
    let placed = |name: &str, error: PlanError| match error {
        PlanError::Name(why) => document.wrong_text(name, &why).into(),
        other => other,
    };
    // the other tasks name no coordinate of a start
    let names_starts =
        matches!(task, Task::Basin(_) | Task::Map(_) | Task::Lyapunov(_) | Task::SettleMany(_) | Task::Edge(_));
    let coordinate = |name: &Variable| {
        let name = name.text();
        let found = if names_starts { Coordinate::of(name) } else { Parameter::of(name).map(Coordinate::Parameter) };
        found.map(Variable::Coordinate).map_err(|error| placed(name, error))
    };
    let quantity = |name: &String| {
        let found = Quantity::of(name).map(|quantity| quantity.name().to_owned());
        found.map_err(|error| placed(name, error))
    };
    task.named(&coordinate, &quantity)
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
    /// [`PlanError::Text`] has the path of the part, the line and the column, and what is expected there;
    /// [`PlanError::Missing`] and others name a number that the system lacks.
    pub fn from_text(text: &str) -> Result<Self, PlanError> {
        Self::from_text_and_files(text, no_files)
    }

    /// Reads a plan written as TOML or, where it begins with a brace, as JSON. `files` returns the text of a file that a
    /// machine names, or says why not.
    ///
    /// # Errors
    /// As for [`Self::from_text`], and [`PlanError::Machine`] for a file that cannot be read.
    pub fn from_text_and_files(
        text: &str,
        files: impl FnOnce(&str) -> Result<String, String>,
    ) -> Result<Self, PlanError> {
        Self::of_document(Document::parse(text)?, files)
    }

    /// Reads a plan written as JSON.
    ///
    /// # Errors
    /// As for [`Self::from_text`].
    pub fn from_json(text: &str) -> Result<Self, PlanError> {
        Self::of_document(Document::json(text)?, no_files)
    }

    fn of_document(
        mut document: Document<'_>,
        files: impl FnOnce(&str) -> Result<String, String>,
    ) -> Result<Self, PlanError> {
        let is_machine = document.has_machine();
        if is_machine {
            fill_for_machine(&mut document, &["task"]);
        }
        let mut text = document.read::<PlanText>()?;
        if is_machine {
            document.refuse(&OF_OSCILLATORS, "belongs to an oscillator, and this plan has a table `machine`")?;
        } else {
            document.refuse(&OF_MACHINES, "belongs to a machine, and this plan has no table `machine`")?;
        }
        text.task = of_system(&text.task, is_machine, &document)?;
        text.plan(files)
    }

    /// The plan as TOML. Numbers have all their digits.
    #[must_use]
    pub fn to_toml(&self) -> String {
        match self.system {
            // numbers, texts and lists of them can always be written as TOML
            System::Oscillator(_) => toml::to_string_pretty(self).unwrap_or_default(),
            System::Machine(_) => headed_toml(self),
        }
    }

    /// The JSON schema of plans, for editors and other programs.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        let mut schema = schemars::schema_for!(PlanText).to_value();
        schema["title"] = "a plan of vibroimpact".into();
        schema
    }

    /// The same question in the form in which it is stored: parameters on an axis have their first value in the system.
    ///
    /// # Errors
    /// [`PlanError::NoSecondStop`] for a parameter of a second stop if there is none.
    pub fn canonical(&self) -> Result<Self, PlanError> {
        let System::Oscillator(system) = &self.system else { return Ok(self.clone()) };
        let system = system.with_all(self.task.varied()?)?;
        let own = |units: UnitsPlan| {
            UnitsPlan::of_system(&system).map_or(units, |own| UnitsPlan { hertz: units.hertz, ..own })
        };
        let (task, units) = (self.task.clone().filled(), self.units.map(own));
        Ok(Self { system: system.into(), task, units, ..*self })
    }
}

/// A plan as it is written by this program. Stores have the bytes of these forms, so the order of the names stays.
#[derive(Serialize)]
#[serde(untagged)]
enum Written<'a> {
    Oscillator {
        version: u32,
        system: &'a SystemPlan,
        task: &'a Task,
        #[serde(skip_serializing_if = "Option::is_none")]
        tile: Option<u32>,
        #[serde(skip_serializing_if = "Option::is_none")]
        shard: Option<u32>,
        #[serde(skip_serializing_if = "Option::is_none")]
        units: Option<UnitsPlan>,
    },
    Machine {
        version: u32,
        #[serde(skip_serializing_if = "Option::is_none")]
        tile: Option<u32>,
        #[serde(skip_serializing_if = "Option::is_none")]
        shard: Option<u32>,
        #[serde(flatten)]
        machine: &'a MachineSource,
        task: &'a Task,
    },
}

impl Serialize for Plan {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { version, system, task, tile, shard, units } = self;
        let (version, tile, shard, units) = (*version, *tile, *shard, *units);
        let written = match system {
            System::Oscillator(system) => Written::Oscillator { version, system, task, tile, shard, units },
            System::Machine(machine) => Written::Machine { version, tile, shard, machine, task },
        };
        written.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Plan {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Self::of_document(Document::of(Value::deserialize(from)?), no_files).map_err(D::Error::custom)
    }
}

impl OscillatorText {
    /// The system of a body; `None` if none is given. The numbers of a body that vary have their first values.
    fn of_body(&self, varied: &[(Parameter, f64)]) -> Result<Option<SystemPlan>, PlanError> {
        let Some(mut body) = self.body else { return Ok(None) };
        for (parameter, value) in varied {
            match parameter {
                Parameter::Body(number) => body.set(*number, *value),
                Parameter::Restitution => body.restitution = Some(*value),
                Parameter::SecondRestitution => body.second_restitution = Some(*value),
                Parameter::Damping => body.set(BodyNumber::DampingRatio, *value),
                _ => {}
            }
        }
        let system = SystemPlan::of_body(&body)?;
        // printed plans have the numbers of the oscillator too, which must be those of the body
        let given = if varied.is_empty() { self.given() } else { [(Parameter::Beta, None); 4] };
        for (parameter, given) in given {
            let own = system.value(parameter).unwrap_or(f64::NAN);
            if let Some(given) = given.filter(|given| *given != own) {
                return Err(PlanError::not_of_body(parameter.name(), given, own));
            }
        }
        Ok(Some(system))
    }

    /// The system in nondimensional numbers.
    fn nondimensional(&self, varied: &[(Parameter, f64)]) -> Result<SystemPlan, PlanError> {
        let varies = |parameter| varied.iter().any(|(other, _)| *other == parameter);
        let needed = [(Parameter::Gap, self.gap), (Parameter::Restitution, self.restitution)];
        let mut missing: Vec<&str> = (needed.iter())
            .filter(|(parameter, value)| value.is_none() && !varies(*parameter))
            .map(|(parameter, _)| parameter.name())
            .collect();
        let frequency = self.beta.or(self.inverse_beta).is_some();
        if !missing.is_empty() && !frequency && !varied.iter().any(|(parameter, _)| parameter.is_frequency()) {
            missing.insert(0, "beta or inverse_beta");
        }
        if !missing.is_empty() {
            return Err(PlanError::Missing(missing));
        }
        Ok(SystemPlan {
            beta: self.beta,
            inverse_beta: self.inverse_beta,
            // a parameter that is not given varies; its value is replaced by the first one of the axis
            gap: self.gap.unwrap_or(0.0),
            restitution: self.restitution.unwrap_or(0.0),
            damping: self.damping,
            second_stop: self.second_stop,
            body: None,
        })
    }

    /// The nondimensional numbers that are given.
    fn given(&self) -> [(Parameter, Option<f64>); 4] {
        [
            (Parameter::Beta, self.beta),
            (Parameter::Gap, self.gap),
            (Parameter::Restitution, self.restitution),
            (Parameter::SecondGap, self.second_stop.map(|stop| stop.gap)),
        ]
    }
}

impl PlanText {
    /// The plan. `files` returns the text of a file that a machine names.
    fn plan(self, files: impl FnOnce(&str) -> Result<String, String>) -> Result<Plan, PlanError> {
        let Self { version, task, tile, shard, mut units, .. } = self;
        let Self { title, source, summary, parameters, set, start, .. } = self;
        if let Some(machine) = self.machine {
            let mut machine = MachineSource { title, source, summary, parameters, set, start, machine };
            machine.read_modes(files)?;
            return Ok(Plan { version, system: machine.into(), task, tile, shard, units: None });
        }
        let varied = task.varied()?;
        let written = self.system.unwrap_or_default();
        let system = match written.of_body(&varied)? {
            Some(system) => {
                // the units are those of the body at the first values of what varies
                let hertz = units.is_none_or(|units| units.hertz);
                units = UnitsPlan::of_system(&system).map(|units| UnitsPlan { hertz, ..units });
                system
            }
            None => written.nondimensional(&varied)?,
        };
        Plan { version, system: system.into(), task, tile, shard, units }.canonical()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SimulatePlan;
    use crate::machine::CATALOGUE;
    use vibroimpact::events::Start;

    /// Cases found by `cargo xtask fuzz`: error messages contained type names of this program.
    #[test]
    fn fz1_a_text_that_is_no_plan_is_refused_in_plain_words() {
        let long = format!("version = 1\ntask = {}", "[".repeat(5000));
        for (text, sentence) in [
            (
                r#"{"version":-1}"#,
                "version: invalid value: integer `-1`, expected a whole number, 0 or more (line 1, column 12)\n  |\n1 | {\"version\":-1}\n  |            ^^",
            ),
            (r#"{"version":1,"system":5}"#, "system: invalid type: integer `5`, expected a table (line 1, column 23)"),
            (r#"{"version":1,"task":{"settle":{"start":{"x":"a"}}}}"#, "invalid type: string \"a\", expected a number"),
            (r#"{"version":1,"task":{"settle":3}}"#, "expected a table"),
            (r#"{"version":1,"task":"settle"}"#, "expected a table"),
            (r#"{"version":1,"task":{"curve":{"kind":{"fold":1}}}}"#, ""),
            ("version = 1\n[task.settle]\nstart = { x = \"a\" }\n", "expected a number"),
            (&long, "line 2, column "),
        ] {
            let told = Plan::from_text(text).unwrap_err().to_string();
            assert!(told.contains(sentence), "{told}");
            for inside in ["f64", "u32", "struct", "variant", "enum", "Task", "System"] {
                assert!(!told.contains(inside), "{told}");
            }
            assert!(told.lines().all(|line| line.chars().count() <= 140), "{told}");
        }
    }

    #[test]
    fn what_varies_need_not_be_given_twice() {
        let text = r#"{"version":1,"system":{"restitution":0.5},"task":{"map":{"starts":4,"axes":[
            {"vary":"inverse_beta","over":"0.4:2:9"},{"vary":"gap","over":[0.5,1.5]}]}}}"#;
        let plan: Plan = serde_json::from_str(text).unwrap();
        let system = plan.oscillator().unwrap();
        assert_eq!((system.inverse_beta, system.gap), (Some(0.4), 0.5));
        assert_eq!(plan.check(), Ok(()));
        // the printed plan is complete, and reads as the same plan
        let full = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&full).unwrap(), plan);
        // a value in the system that differs from the first one on the axis is ignored
        let other = text.replace("\"system\":{", "\"system\":{\"gap\":7.0,\"beta\":3.0,");
        assert_eq!(serde_json::from_str::<Plan>(&other).unwrap(), plan);
        for (gone, sentence) in [
            ("\"restitution\":0.5", "neither in the system nor on an axis: restitution"),
            ("{\"vary\":\"inverse_beta\",\"over\":\"0.4:2:9\"},", ""),
        ] {
            let read = serde_json::from_str::<Plan>(&text.replace(gone, ""));
            let message = read.map_err(|e| e.to_string()).and_then(|p| p.check().map_err(|e| e.to_string()));
            assert!(message.as_ref().is_err_and(|m| m.contains(sentence)), "{message:?}");
        }
        let swept = r#"{"version":1,"system":{"inverse_beta":1.3,"restitution":0.5},"task":{"response":{"vary":"gap","over":"0.5:1:3"}}}"#;
        assert_eq!(Plan::from_text(swept).unwrap().oscillator().unwrap().gap, 0.5);
        let misspelt = text.replace("restitution", "restituton");
        assert!(serde_json::from_str::<Plan>(&misspelt).unwrap_err().to_string().contains("restituton"));
    }

    /// Every machine of the catalogue, in both languages, with changed numbers and another start.
    #[test]
    fn plans_survive_toml_and_json() {
        for entry in CATALOGUE {
            let source = entry.source().unwrap();
            let (n, path) = (source.parts().unwrap().n(), source.paths().unwrap().pop().unwrap());
            let changed = source.with(&path, source.number(&path).unwrap() * 1.25).unwrap();
            let task = Task::Simulate(SimulatePlan { periods: Some(2.5), ..SimulatePlan::default() });
            let start = Start { q: vec![0.1 + 0.2; n], qdot: vec![-1e-300; n], phase: 1.0, ..Start::default() };
            let plan = Plan::new(changed.starting(&start), task);
            let (toml, json) = (plan.to_toml(), serde_json::to_string(&plan).unwrap());
            assert_eq!(Plan::from_text(&toml), Ok(plan.clone()), "{toml}");
            assert_eq!(Plan::from_text(&json), Ok(plan.clone()), "{json}");
            assert_eq!(serde_json::from_str::<Plan>(&json).unwrap(), plan);
            assert!(toml.starts_with("version = 1\n") && toml.contains("[task.simulate]\nperiods = 2.5\n"), "{toml}");
        }
        let source = CATALOGUE[0].source().unwrap();
        let plan = Plan::new(source, Task::Attractors { starts: 1, seed: u64::MAX, impacts: None });
        assert_eq!(Plan::from_text(&plan.to_toml()), Ok(plan));
    }

    #[test]
    fn wrong_plans_are_explained() {
        let good = "version = 1\n[machine]\nbodies = { a = 1 }\n[task.simulate]\nimpacts = 5\n";
        assert!(Plan::from_text(good).is_ok());
        for (from, to, said) in [
            (
                "impacts",
                "impact",
                "task.simulate.impact: unknown field `impact`, expected one of `start`, `impacts`, `periods`, `time` (line 5, column 1)",
            ),
            ("[task.simulate]", "[task.settel]", "task.settel: unknown"),
            ("version = 1", "version = 2", "the plan has version 2"),
            ("impacts = 5", "impacts = 0", "impacts = 0 lies outside"),
            ("impacts = 5", "periods = 3", "no forcing"),
            ("bodies", "bodis", "unknown field `bodis`"),
            ("bodies = { a = 1 }", "modes = \"m.csv\"", "the file `m.csv` cannot be read here"),
            ("[machine]", "[start]\nq = [1, 2]\n[machine]", "start.q: has 2 numbers, and 1 are needed"),
            (
                "[machine]",
                "[system]\ngap = 1\n[machine]",
                "system: belongs to an oscillator, and this plan has a table `machine` (line 2, column 2)",
            ),
            (
                "[machine]\nbodies = { a = 1 }",
                "title = \"\"",
                "title: belongs to a machine, and this plan has no table",
            ),
            (
                "task",
                "tusk",
                "unknown field `tusk`, expected one of `version`, `system`, `task`, `tile`, `shard`, `units`",
            ),
        ] {
            let text = good.replace(from, to);
            let told = Plan::from_text(&text).and_then(|plan| plan.check()).unwrap_err().to_string();
            assert!(told.contains(said), "{text}: {told}");
        }
    }
}
