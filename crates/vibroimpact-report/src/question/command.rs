//! A plan as the words of a `vibro` command.

use super::arguments::{Argument, arguments, ends, numbers_of, plain};
use super::number;
use crate::Units;
use crate::units::shown_span;
use serde_json::Value;
use vibroimpact_study::{BasinPlan, Body, BodyNumber, Coordinate, Name, Parameter, Plan, SystemPlan, Task, Values};

/// The words of the `vibro` command for a plan, beginning with `vibro`. Its flags give exactly this plan: in nondimensional
/// units, or those of its body.
///
/// Refinement and the size of tiles need a store, so a plan with these has the flag for a store, such as `map.zarr`.
/// Points of the sections of an attractor need a figure, so a plan with these has the flag for `attractor.svg`. Returns
/// `None` for plans that no flags can express: a basin over anything but position and velocity or over a list of
/// values, exponents over axes, a map over a list of one value, units without a body, and parameters of the oscillator that
/// vary in a body.
#[must_use]
pub fn command(plan: &Plan) -> Option<Vec<String>> {
    let plan = plan.complete().ok()?;
    let system = plan.oscillator()?;
    let units = &Units::of_plan(&plan);
    let (verb, arguments) = arguments(&plan, units)?;
    if units.si != system.body.is_some() || (units.si && !varied(&arguments).all(of_body)) {
        return None;
    }
    let verb = verb.as_str();
    let mut line = if let Task::Basin(task) = &plan.task {
        basin(system, &task.typed().ok()?, units)?
    } else {
        let over = ranges(verb, &arguments)?;
        let line = Line::new(verb).system(system, &over);
        let line = line.given("axes", order(&over).filter(|_| ["map", "region"].contains(&verb)));
        // what varies stands in the place of its value in the system; a store has the refinement
        let elsewhere: &[&str] = match verb {
            "map" => &["axes", "refine"],
            "region" => &["across", "up"],
            "response" => &["vary", "over"],
            _ => &[],
        };
        let flags = arguments.iter().filter(|argument| !elsewhere.contains(&argument.name.as_str()));
        flags.into_iter().try_fold(line, |line, argument| line.argument(argument))?
    };
    let (refine, name) = match &plan.task {
        Task::Map(task) => (task.refine, "map.zarr"),
        Task::Basin(task) => (task.refine, "basin.zarr"),
        Task::Attractors { .. } => (None, "attractors.zarr"),
        Task::Diagram(_) => (None, "diagram.zarr"),
        Task::Lyapunov(task) if !task.axes.is_empty() => {
            // the command takes these nondimensional only
            let measured = |name: &str| matches!(Coordinate::of(name), Ok(Coordinate::X | Coordinate::V));
            if units.plan().is_some() && task.axes.iter().any(|axis| measured(axis.vary.text())) {
                return None;
            }
            (None, "lyapunov.zarr")
        }
        Task::Lyapunov(task) if task.points.is_some() => {
            return plan.tile.is_none().then(|| line.flag("plot", "attractor.svg").words);
        }
        // the other tasks have no store
        _ => return plan.tile.is_none().then_some(line.words),
    };
    if refine.is_some() || plan.tile.is_some() {
        line = line.flag("store", name).given("tile", plan.tile).given("refine", refine);
    }
    Some(line.words)
}

/// The parameters that are named in arguments.
fn varied(arguments: &[Argument]) -> impl Iterator<Item = Parameter> + '_ {
    let names = arguments.iter().flat_map(|argument| {
        let pairs = argument.pairs().into_iter().flat_map(|pairs| pairs.keys().map(String::as_str));
        let list = argument.value.as_array().into_iter().flatten().filter_map(Value::as_str);
        pairs.chain(list).chain(argument.value.as_str())
    });
    names.filter_map(|name| Parameter::of(name).ok())
}

/// The parameters that are no single numbers of the system, and the texts of their ranges where the flags of the system have them.
fn ranges(verb: &str, arguments: &[Argument]) -> Option<Vec<(Parameter, Option<String>)>> {
    let named = |name: &str| arguments.iter().find(|argument| argument.name == name);
    let of = |name: &str| Parameter::of(name).ok();
    match verb {
        "map" | "region" => {
            let sides = ["axes", "across", "up"].into_iter().filter_map(|name| named(name)?.pairs()).flatten();
            sides.map(|(name, over)| Some((of(name)?, Some(text(over)?)))).collect()
        }
        "response" => Some(vec![(of(named("vary")?.value.as_str()?)?, Some(text(&named("over")?.value)?))]),
        "diagram" => Some(varied(arguments).map(|parameter| (parameter, None)).collect()),
        _ => Some(Vec::new()),
    }
}

/// A value as a flag has it. A list of one number has no form of its own.
fn text(value: &Value) -> Option<String> {
    match value {
        Value::Array(all) if all.len() == 1 && all[0].is_number() => None,
        Value::Array(all) => Some(all.iter().map(text).collect::<Option<Vec<_>>>()?.join(",")),
        Value::String(name) => Some(name.replace('_', "-")),
        other => Some(ends(other).map_or_else(|| plain(other), |ends| ends.join(":"))),
    }
}

/// Whether a parameter has a flag for a body.
const fn of_body(parameter: Parameter) -> bool {
    matches!(parameter, Parameter::Body(_) | Parameter::Restitution | Parameter::SecondRestitution)
}

/// A command line under construction.
struct Line {
    words: Vec<String>,
}

impl Line {
    fn new(command: &str) -> Self {
        Self { words: vec!["vibro".to_owned(), command.to_owned()] }
    }

    #[allow(clippy::needless_pass_by_value)] // a number or a word
    fn flag(mut self, name: &str, value: impl ToString) -> Self {
        self.words.extend([format!("--{}", name.replace('_', "-")), value.to_string()]);
        self
    }

    fn given(self, name: &str, value: Option<impl ToString>) -> Self {
        match value {
            Some(value) => self.flag(name, value),
            None => self,
        }
    }

    /// Adds the flag of an argument, or one for each of its numbers.
    fn argument(self, Argument { name, value, .. }: &Argument) -> Option<Self> {
        let name = if name == "axes" { "axis" } else { name };
        match value.as_object().filter(|_| ends(value).is_none()) {
            Some(pairs) => pairs.iter().try_fold(self, |line, (of, value)| {
                Some(line.flag(name, format!("{}={}", of.replace('_', "-"), text(value)?)))
            }),
            None => Some(self.flag(name, text(value)?)),
        }
    }

    /// Adds a flag for a number whose default is 0.
    fn zero(self, name: &str, value: f64) -> Self {
        // minus zero is a different value and is written
        if value.to_bits() == 0 { self } else { self.flag(name, number(value)) }
    }

    /// Adds the parameters of a system. Those that vary are replaced by the given texts, or left out.
    fn system(mut self, system: &SystemPlan, varied: &[(Parameter, Option<String>)]) -> Self {
        if let Some(body) = &system.body {
            return self.body(body, varied);
        }
        for (name, value) in super::numbers(system) {
            self = match varied.iter().find(|(parameter, _)| parameter.name() == name) {
                Some((_, words)) => self.given(name, words.clone()),
                None => self.given(name, value.map(number)),
            };
        }
        self
    }

    /// Adds the numbers of a body; those that vary as by [`Self::system`]. A number that varies replaces another form
    /// of it.
    fn body(mut self, body: &Body, varied: &[(Parameter, Option<String>)]) -> Self {
        let varies = |name: &str| varied.iter().find(|(parameter, _)| parameter.name() == name);
        let mut left: Vec<&(Parameter, Option<String>)> = varied.iter().collect();
        for (name, value) in numbers_of(body) {
            self = match varies(&name) {
                Some(one) => {
                    left.retain(|other| *other != one);
                    self.given(&name, one.1.clone())
                }
                None => self.flag(&name, number(value)),
            };
        }
        // a number that has no flag of its own in the body, such as both gaps together
        self = left.into_iter().fold(self, |line, (parameter, words)| line.given(parameter.name(), words.clone()));
        if body.stop_in_space {
            self.words.push("--stop-in-space".to_owned());
        }
        // maps and responses of a body are always in its units
        if ["map", "response"].contains(&self.words[1].as_str()) { self } else { self.flag("units", "si") }
    }
}

fn basin(system: &SystemPlan, task: &BasinPlan, units: &Units) -> Option<Line> {
    if task.points.is_some() || task.transient {
        return None;
    }
    let [x, v] = task.axes.as_slice() else { return None };
    let plane = x.vary == Coordinate::X && v.vary == Coordinate::V;
    let (Values::Span(x), Values::Span(v)) = (&x.over, &v.over) else { return None };
    // a fixed value of a quantity on an axis is ignored in computations, but makes the plan a different one
    let start = task.start();
    if !plane || start.x.is_some() || start.v.to_bits() != 0 {
        return None;
    }
    let (x, v) = (shown_span(x, units.length()).ok()?, shown_span(v, units.velocity()).ok()?);
    let line = Line::new("basin").system(system, &[]).flag("x", x).flag("v", v).zero("phase", start.phase);
    let names: Vec<String> = task.fields.iter().map(|field| field.name().replace('_', "-")).collect();
    Some(line.given("impacts", task.impacts).given("fields", (!names.is_empty()).then(|| names.join(","))))
}

/// The order of the axes, if it differs from the order of the flags.
fn order(varied: &[(Parameter, Option<String>)]) -> Option<String> {
    // flags of a body come first
    let all = || BodyNumber::ALL.into_iter().map(Parameter::Body).chain(Parameter::ALL);
    let place = |(parameter, _): &(Parameter, Option<String>)| all().position(|other| other == *parameter);
    let names = || varied.iter().map(|(parameter, _)| parameter.name().replace('_', "-")).collect::<Vec<_>>();
    (!varied.is_sorted_by_key(place)).then(|| names().join(","))
}
