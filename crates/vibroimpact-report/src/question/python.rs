//! A plan as a call of the Python package.

use super::arguments::{Argument, arguments, ends, numbers_of, plain, without_unit};
use super::number;
use crate::Units;
use crate::scene::{SECTION_POINTS, View};
use serde_json::Value;
use vibroimpact_study::{Body, Plan, SystemPlan, Task};

/// A few lines of Python for a plan, whose numbers are nondimensional unless their names end in a unit; `None` for an invalid plan, and for a study of points.
///
/// Grids are computed in memory, with refinement if the plan has it. The size of tiles is left out, because no result
/// depends on it. Exponents over axes are a study in the store `lyapunov.zarr`.
#[must_use]
pub fn python(plan: &Plan) -> Option<String> {
    let plan = plan.complete().ok()?;
    if let Task::Basin(task) = &plan.task
        && (task.points.is_some() || task.transient)
    {
        return None;
    }
    let system = oscillator(plan.oscillator()?);
    let (verb, arguments) = arguments(&plan, &Units::default())?;
    let study = arguments.iter().any(|argument| argument.name == "axes") && verb == "lyapunov";
    let (function, name) = match verb.as_str() {
        "simulate" | "settle" => (verb.as_str(), "motion"),
        "attractors" => ("attractors", "motions"),
        "orbit" => ("orbits", "orbits"),
        "map" => ("region_map", "motions"),
        "diagram" => ("orbit_diagram", "diagram"),
        "lyapunov" if study => ("Plan.lyapunov", "exponents"),
        "lyapunov" => ("lyapunov", "exponents"),
        "response" => ("response", "found"),
        "edge" => ("edge", "border"),
        other => (other, other),
    };
    let call = call(function, &arguments);
    let told = if study {
        format!("plan = {call}\nvi.run(plan, \"lyapunov.zarr\")\n{name} = vi.open(\"lyapunov.zarr\")\n")
    } else {
        format!("{name} = {call}\n")
    };
    Some(format!("import vibroimpact as vi\n\nosc = {system}\n{told}"))
}

/// The same lines, and one view of the motion into which a start settles. For other tasks as [`python`].
#[must_use]
pub fn python_showing(plan: &Plan, view: View) -> Option<String> {
    let text = python(plan)?;
    let Task::Settle { .. } = &plan.task else { return Some(text) };
    let shown = match view {
        View::Waveform => "motion.plot()".to_owned(),
        View::Phase => "t, x, v = motion.waveform()  # of a periodic motion, v over x".to_owned(),
        View::Multipliers => "motion.multipliers".to_owned(),
        View::Sections => {
            let (_, mut arguments) = arguments(plan, &Units::default())?;
            arguments.retain(|argument| argument.name != "impacts");
            arguments.push(Argument { name: "points".to_owned(), value: SECTION_POINTS.into(), required: false });
            format!("{}.plot_sections()", call("lyapunov", &arguments))
        }
    };
    Some(format!("{text}{shown}\n"))
}

/// The call of a function. What a plan needs stands first without names; its numbers with ranges are one mapping.
fn call(function: &str, arguments: &[Argument]) -> String {
    let basin = function == "basin";
    let first = |argument: &&Argument| {
        argument.name == "axes" || argument.name == "other" || argument.required && argument.name != "starts"
    };
    let (mut words, mut mapping) = (vec!["osc".to_owned()], Vec::new());
    for argument in arguments.iter().filter(first) {
        match argument.pairs() {
            Some(pairs) => mapping.extend(pairs.iter().map(|(name, value)| (name.as_str(), value))),
            None => words.push(text(&argument.name, &argument.value)),
        }
    }
    // coordinates of the start are named arguments if they come first and in the order of the function
    let place = |(name, _): &(&str, &Value)| ["x", "v", "phase"].iter().position(|known| known == name);
    let by_name = mapping.iter().take_while(|one| basin && place(one).is_some()).count();
    let (named, others) = mapping.split_at(by_name);
    let orderly = named.is_sorted_by_key(place) && others.iter().all(|one| !basin || place(one).is_none());
    let (named, others) = if orderly { (named, others) } else { (&[][..], mapping.as_slice()) };
    if !others.is_empty() {
        let entries: Vec<String> = others.iter().map(|(name, value)| pair(name, value)).collect();
        words.push(format!("{{{}}}", entries.join(", ")));
    }
    words.extend(named.iter().map(|(name, value)| format!("{name}={}", text(name, value))));
    // a fixed value of a quantity on an axis is ignored
    let varies = |name: &str| mapping.iter().any(|(other, _)| *other == name);
    for Argument { name, value, .. } in arguments.iter().filter(|argument| !first(argument) && !varies(&argument.name))
    {
        words.push(format!("{name}={}", text(name, value)));
    }
    format!("vi.{function}({})", words.join(", "))
}

/// A value, as an argument of this name.
fn text(name: &str, value: &Value) -> String {
    let all = |of: &[Value]| of.iter().map(|value| text("", value)).collect::<Vec<_>>().join(", ");
    match value {
        // its JSON form is valid in Python
        Value::String(_) => value.to_string(),
        Value::Array(ends) if name == "to" => format!("({})", all(ends)),
        Value::Array(list) => format!("[{}]", all(list)),
        Value::Object(pairs) => ends(value).map_or_else(
            || {
                let entries: Vec<String> = pairs.iter().map(|(name, value)| pair(name, value)).collect();
                format!("{{{}}}", entries.join(", "))
            },
            |[from, to]| format!("({from}, {to})"),
        ),
        other => plain(other),
    }
}

fn pair(name: &str, value: &Value) -> String {
    format!("{}: {}", Value::from(name), text("", value))
}

/// A body in SI units.
fn in_si(body: &Body) -> String {
    let given = numbers_of(body).into_iter();
    let given = given.map(|(name, value)| format!("{}={}", without_unit(&name), number(value)));
    let space = body.stop_in_space.then(|| "stop_in_space=True".to_owned());
    format!("vi.Oscillator.from_units({})", given.chain(space).collect::<Vec<_>>().join(", "))
}

fn oscillator(system: &SystemPlan) -> String {
    if let Some(body) = &system.body {
        return in_si(body);
    }
    let given =
        super::numbers(system).into_iter().filter_map(|(name, value)| Some(format!("{name}={}", number(value?))));
    format!("vi.Oscillator({})", given.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines after the import, for a task with the system at S.
    fn lines(task: &str) -> String {
        let system = r#"{"inverse_beta":1.3,"gap":0.75,"restitution":0.5,"second_stop":{"gap":2.0,"restitution":0.4}}"#;
        let plan: Plan = serde_json::from_str(&format!(r#"{{"version":1,"system":{system},"task":{task}}}"#)).unwrap();
        plan.check().unwrap();
        let said = python(&plan).unwrap();
        let body = said.strip_prefix("import vibroimpact as vi\n\n").unwrap();
        let osc =
            "osc = vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5, second_gap=2, second_restitution=0.4)\n";
        body.strip_prefix(osc).unwrap_or(body).to_owned()
    }

    #[test]
    fn every_task_has_its_call() {
        for (task, said) in [
            (r#"{"simulate":{"start":{"v":1}}}"#, "motion = vi.simulate(osc, v=1, impacts=100)\n"),
            (r#"{"settle":{"start":{"x":-1.5,"phase":1e-7}}}"#, "motion = vi.settle(osc, x=-1.5, phase=1e-7)\n"),
            (r#"{"settle":{"start":{},"impacts":70}}"#, "motion = vi.settle(osc, impacts=70)\n"),
            (r#"{"attractors":{"starts":9,"seed":2}}"#, "motions = vi.attractors(osc, starts=9, seed=2)\n"),
            (
                r#"{"attractors":{"starts":9,"seed":1,"impacts":70}}"#,
                "motions = vi.attractors(osc, starts=9, impacts=70)\n",
            ),
            (r#"{"orbit":{"label":"2/1"}}"#, "orbits = vi.orbits(osc, \"2/1\")\n"),
            (
                r#"{"basin":{"axes":[{"vary":"x","over":"-1:0.75:4"},{"vary":"v","over":[0,1.5]}],"start":{"phase":1},"refine":2}}"#,
                "basin = vi.basin(osc, x=\"-1:0.75:4\", v=[0, 1.5], phase=1, refine=2)\n",
            ),
            (
                r#"{"basin":{"axes":[{"vary":"v","over":"0:1:2"},{"vary":"x","over":"0:0.7:2"}],"start":{"v":1}}}"#,
                "basin = vi.basin(osc, {\"v\": \"0:1:2\", \"x\": \"0:0.7:2\"})\n",
            ),
            (
                r#"{"diagram":{"vary":"damping","over":"0:0.1:3","direction":{"scatter":{"starts":3,"seed":0}},"show":"strobe"}}"#,
                "diagram = vi.orbit_diagram(osc, \"damping\", \"0:0.1:3\", show=\"strobe\", direction=\"scatter\", starts=3, seed=0)\n",
            ),
            (
                r#"{"diagram":{"vary":"damping","over":[0,0.02,0.1],"direction":"up"}}"#,
                "diagram = vi.orbit_diagram(osc, \"damping\", [0, 0.02, 0.1], direction=\"up\")\n",
            ),
            (r#"{"lyapunov":{"impacts":2000,"points":50}}"#, "exponents = vi.lyapunov(osc, impacts=2000, points=50)\n"),
            (
                r#"{"lyapunov":{"axes":[{"vary":"x","over":"0:0.5:2"}]}}"#,
                "plan = vi.Plan.lyapunov(osc, {\"x\": \"0:0.5:2\"})\nvi.run(plan, \"lyapunov.zarr\")\nexponents = vi.open(\"lyapunov.zarr\")\n",
            ),
            (
                r#"{"branch":{"label":"1/1","vary":"second_gap","to":3,"orbit":2}}"#,
                "branch = vi.branch(osc, \"second_gap\", 3, label=\"1/1\", orbit=2)\n",
            ),
            (
                r#"{"branch":{"label":"1/1","vary":"gap","to":3,"back":0}}"#,
                "branch = vi.branch(osc, \"gap\", (0, 3), label=\"1/1\")\n",
            ),
            (
                r#"{"curve":{"label":"1/1","kind":"flip","vary":{"parameter":"gap","from":0,"to":3},"and":{"parameter":"damping","from":0,"to":0.1}}}"#,
                "curve = vi.curve(osc, \"flip\", {\"gap\": (0, 3), \"damping\": (0, 0.1)}, label=\"1/1\")\n",
            ),
            (
                r#"{"margins":{"label":"1/1","vary":[{"parameter":"gap","scale":0.1},{"parameter":"damping"}],"within":1.5,"lines":7}}"#,
                "margins = vi.margins(osc, label=\"1/1\", vary=[\"gap\", \"damping\"], scale={\"gap\": 0.1}, within=1.5, lines=7)\n",
            ),
            (r#"{"margins":{"start":{"v":1}}}"#, "margins = vi.margins(osc, v=1)\n"),
        ] {
            assert_eq!(lines(task), said);
        }
        let map = r#"{"map":{"axes":[{"vary":"restitution","over":"0.2:0.9:3"}],"starts":4,"seed":1,"impacts":200}}"#;
        assert!(
            lines(map)
                .ends_with("motions = vi.region_map(osc, {\"restitution\": \"0.2:0.9:3\"}, starts=4, impacts=200)\n")
        );
        let region = r#"{"region":{"label":"1/1","across":{"parameter":"gap","from":1,"to":2},"up":{"parameter":"beta","from":0.5,"to":0.6}}}"#;
        assert!(lines(region).starts_with("osc = vi.Oscillator(beta=0.5, gap=1, "), "{}", lines(region));
        assert!(lines(region).ends_with("region = vi.region(osc, \"1/1\", {\"gap\": (1, 2), \"beta\": (0.5, 0.6)})\n"));
    }
}
