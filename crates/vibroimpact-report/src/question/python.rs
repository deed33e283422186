//! A plan as a call of the Python package.

use super::body::{numbers_of, without_unit};
use super::number;
use crate::scene::{SECTION_POINTS, View};
use vibroimpact_study::diagram::{DEFAULT_KEEP, DEFAULT_TRANSIENT, Show, SweepDirection};
use vibroimpact_study::{
    Axis, BasinPlan, Body, BranchPlan, Coordinate, CurvePlan, DEFAULT_BRANCH_POINTS, DEFAULT_GRID, DiagramPlan,
    EdgePlan, LyapunovPlan, MapPlan, MarginsPlan, Plan, Quantity, RegionPlan, ResponsePlan, StartPlan, Stretch,
    SystemPlan, Target, Task, Values,
};

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
    let (name, call) = match &plan.task {
        Task::Simulate { start, impacts, periods } => {
            let call = Call::new("simulate").start(&start.unwrap_or_default());
            ("motion", call.given("impacts", *impacts).given("periods", periods.map(number)))
        }
        Task::Settle { start, impacts } => {
            ("motion", Call::new("settle").start(&start.unwrap_or_default()).given("impacts", *impacts))
        }
        Task::Attractors { starts, seed, impacts } => {
            let call = Call::new("attractors").named("starts", starts).unless("seed", *seed, 1);
            ("motions", call.given("impacts", *impacts))
        }
        Task::Orbit { label } => ("orbits", Call::new("orbits").then(text(label))),
        Task::Basin(task) => ("basin", basin(&task.typed().ok()?)),
        Task::Map(task) => {
            let task: MapPlan = task.typed().ok()?;
            let call = Call::new("region_map").then(axes(&task.axes)).named("starts", task.starts);
            let call = call.unless("seed", task.seed, 1).given("refine", task.refine);
            ("motions", call.given("impacts", task.impacts).given("fields", names(&task.fields)))
        }
        Task::Diagram(task) => ("diagram", diagram(&task.typed().ok()?)),
        Task::Lyapunov(task) => ("exponents", lyapunov(&task.typed().ok()?)),
        Task::Branch(task) => {
            let task: BranchPlan = task.typed().ok()?;
            let to = number(task.to);
            let to = task.back.map_or_else(|| to.clone(), |back| format!("({}, {to})", number(back)));
            let call = Call::new("branch").then(text(task.vary.name())).then(to);
            let call = call.given("label", task.label.as_deref().map(text));
            let also = |also: Target| mapping(core::iter::once((also.parameter.name(), number(also.to))));
            let call = call.given("also", task.also.map(also));
            let call = call.given("orbit", task.orbit).unless("follow", task.follow, 0);
            ("branch", call.unless("points", task.points, DEFAULT_BRANCH_POINTS))
        }
        Task::Curve(task) => {
            let task: CurvePlan = task.typed().ok()?;
            let call = Call::new("curve").then(text(task.kind.name())).then(plane(&task.vary, &task.and));
            let call = call.given("label", task.label.as_deref().map(text));
            ("curve", call.given("orbit", task.orbit).given("event", task.event).given("points", task.points))
        }
        Task::Region(task) => {
            let task: RegionPlan = task.typed().ok()?;
            let call = Call::new("region").then(text(&task.label)).then(plane(&task.across, &task.up));
            ("region", call.unless("grid", task.grid, DEFAULT_GRID))
        }
        Task::Response(task) => {
            let task: ResponsePlan = task.typed().ok()?;
            let call = Call::new("response").then(text(task.vary.name())).then(values(&task.over));
            let usual = task.quantity() == Quantity::DisplacementAmplitude;
            let call = call.given("quantity", (!usual).then(|| text(task.quantity().name())));
            ("found", call.given("impacts", task.impacts))
        }
        Task::Margins(task) => ("margins", margins(&task.typed().ok()?)),
        Task::Edge(task) => {
            let task: EdgePlan = task.typed().ok()?;
            let other = mapping(task.other.iter().map(|one| (one.coordinate.name(), number(one.value))));
            let call = Call::new("edge").then(other).start(&task.start.unwrap_or_default());
            ("border", call.given("laps", task.laps).given("impacts", task.impacts))
        }
        Task::SettleMany(_) => return None,
    };
    let told = match &plan.task {
        Task::Lyapunov(task) if !task.axes.is_empty() => {
            format!("plan = {}\nvi.run(plan, \"lyapunov.zarr\")\n{name} = vi.open(\"lyapunov.zarr\")\n", call.text())
        }
        _ => format!("{name} = {}\n", call.text()),
    };
    Some(format!("import vibroimpact as vi\n\nosc = {}\n{told}", oscillator(plan.oscillator()?)))
}

/// The same lines, and one view of the motion into which a start settles. For other tasks as [`python`].
#[must_use]
pub fn python_showing(plan: &Plan, view: View) -> Option<String> {
    let text = python(plan)?;
    let Task::Settle { start, .. } = &plan.task else { return Some(text) };
    let shown = match view {
        View::Waveform => "motion.plot()".to_owned(),
        View::Phase => "t, x, v = motion.waveform()  # of a periodic motion, v over x".to_owned(),
        View::Multipliers => "motion.multipliers".to_owned(),
        View::Sections => {
            format!(
                "{}.plot_sections()",
                Call::new("lyapunov").start(&start.unwrap_or_default()).named("points", SECTION_POINTS).text()
            )
        }
    };
    Some(format!("{text}{shown}\n"))
}

/// A list of quantities; `None` for an empty one.
fn names(fields: &[Quantity]) -> Option<String> {
    let all: Vec<String> = fields.iter().map(|field| text(field.name())).collect();
    (!all.is_empty()).then(|| format!("[{}]", all.join(", ")))
}

/// A call under construction; its first argument is the oscillator.
struct Call {
    function: &'static str,
    arguments: Vec<String>,
}

impl Call {
    fn new(function: &'static str) -> Self {
        Self { function, arguments: vec!["osc".to_owned()] }
    }

    fn then(mut self, argument: String) -> Self {
        self.arguments.push(argument);
        self
    }

    #[allow(clippy::needless_pass_by_value)] // a number or a word
    fn named(self, name: &str, value: impl ToString) -> Self {
        self.then(format!("{name}={}", value.to_string()))
    }

    fn given(self, name: &str, value: Option<impl ToString>) -> Self {
        match value {
            Some(value) => self.named(name, value),
            None => self,
        }
    }

    /// Adds an argument unless its value is the default.
    fn unless<T: Copy + PartialEq + ToString>(self, name: &str, value: T, usual: T) -> Self {
        if value == usual { self } else { self.named(name, value) }
    }

    fn zero(self, name: &str, value: f64) -> Self {
        // minus zero is a different value and is written
        if value.to_bits() == 0 { self } else { self.named(name, number(value)) }
    }

    fn start(self, start: &StartPlan) -> Self {
        self.given("x", start.x.map(number)).zero("v", start.v).zero("phase", start.phase)
    }

    fn text(&self) -> String {
        format!("vi.{}({})", self.function, self.arguments.join(", "))
    }
}

/// A body in SI units.
fn in_si(body: &Body) -> String {
    let given = numbers_of(body)
        .into_iter()
        .filter_map(|(name, value)| Some(format!("{}={}", without_unit(name), number(value?))));
    let space = body.stop_in_space.then(|| "stop_in_space=True".to_owned());
    format!("vi.Oscillator.from_units({})", given.chain(space).collect::<Vec<_>>().join(", "))
}

fn oscillator(system: &SystemPlan) -> String {
    if let Some(body) = &system.body {
        return in_si(body);
    }
    let second = system.second_stop;
    let parts = [
        ("beta", system.beta),
        ("inverse_beta", system.inverse_beta),
        ("gap", Some(system.gap)),
        ("restitution", Some(system.restitution)),
        ("damping", Some(system.damping).filter(|damping| damping.to_bits() != 0)),
        ("second_gap", second.map(|stop| stop.gap)),
        ("second_restitution", second.map(|stop| stop.restitution)),
    ];
    let given = parts.into_iter().filter_map(|(name, value)| Some(format!("{name}={}", number(value?))));
    format!("vi.Oscillator({})", given.collect::<Vec<_>>().join(", "))
}

/// A quoted text. Its JSON form is valid in Python.
fn text(of: &str) -> String {
    serde_json::Value::from(of).to_string()
}

fn values(of: &Values) -> String {
    match of {
        Values::Span(span) => text(&span.to_string()),
        Values::Listed(list) => format!("[{}]", list.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ")),
    }
}

fn mapping(entries: impl Iterator<Item = (&'static str, String)>) -> String {
    let entries: Vec<String> = entries.map(|(name, value)| format!("{}: {value}", text(name))).collect();
    format!("{{{}}}", entries.join(", "))
}

fn axes(of: &[Axis]) -> String {
    mapping(of.iter().map(|axis| (axis.vary.name(), values(&axis.over))))
}

fn range(of: &Stretch) -> (&'static str, String) {
    (of.parameter.name(), format!("({}, {})", number(of.from), number(of.to)))
}

fn plane(one: &Stretch, two: &Stretch) -> String {
    mapping([range(one), range(two)].into_iter())
}

/// Coordinates of the start are named arguments if they come first and in the order of the function.
fn basin(task: &BasinPlan) -> Call {
    let place = |axis: &Axis| [Coordinate::X, Coordinate::V, Coordinate::Phase].iter().position(|c| *c == axis.vary);
    let by_name = task.axes.iter().take_while(|axis| place(axis).is_some()).count();
    let (named, others) = task.axes.split_at(by_name);
    let orderly = named.is_sorted_by_key(&place) && others.iter().all(|axis| place(axis).is_none());
    let mut call = Call::new("basin");
    if !orderly {
        call = call.then(axes(&task.axes));
    } else if !others.is_empty() {
        call = call.then(axes(others));
    }
    for axis in named.iter().filter(|_| orderly) {
        call = call.named(axis.vary.name(), values(&axis.over));
    }
    let varies = |coordinate| task.axes.iter().any(|axis| axis.vary == coordinate);
    let start = &task.start();
    // a fixed value of a quantity on an axis is ignored
    let call = call.given("x", start.x.filter(|_| !varies(Coordinate::X)).map(number));
    let call = if varies(Coordinate::V) { call } else { call.zero("v", start.v) };
    let call = if varies(Coordinate::Phase) { call } else { call.zero("phase", start.phase) };
    call.given("refine", task.refine).given("impacts", task.impacts).given("fields", names(&task.fields))
}

fn diagram(task: &DiagramPlan) -> Call {
    let call = Call::new("orbit_diagram").then(text(task.vary.name())).then(values(&task.over));
    let call = call.given("also", task.also.as_ref().map(|also| mapping(core::iter::once(range(also)))));
    let call = match task.direction {
        SweepDirection::Both => call,
        SweepDirection::Up => call.named("direction", text("up")),
        SweepDirection::Down => call.named("direction", text("down")),
        SweepDirection::Scatter { starts, seed } => {
            call.named("direction", text("scatter")).named("starts", starts).named("seed", seed)
        }
    };
    let call = match task.show {
        Show::Velocity => call,
        Show::Strobe => call.named("show", text("strobe")),
        Show::Quantity(quantity) => call.named("show", text(quantity.name())),
    };
    call.unless("transient", task.transient, DEFAULT_TRANSIENT).unless("keep", task.keep, DEFAULT_KEEP)
}

fn margins(task: &MarginsPlan) -> Call {
    let usual: MarginsPlan = MarginsPlan::default();
    let call = Call::new("margins").start(&task.start()).given("label", task.label.as_deref().map(text));
    let names: Vec<String> = task.vary.iter().map(|one| text(one.parameter.name())).collect();
    let call = call.given("vary", (!names.is_empty()).then(|| format!("[{}]", names.join(", "))));
    let scales: Vec<_> = task.vary.iter().filter_map(|one| Some((one.parameter.name(), number(one.scale?)))).collect();
    let call = call.given("scale", (!scales.is_empty()).then(|| mapping(scales.into_iter())));
    let call = if task.within == usual.within { call } else { call.named("within", number(task.within)) };
    call.unless("lines", task.lines(), usual.lines())
}

fn lyapunov(task: &LyapunovPlan) -> Call {
    let usual: LyapunovPlan = LyapunovPlan::default();
    let call = if task.axes.is_empty() {
        Call::new("lyapunov").start(&task.start())
    } else {
        Call::new("Plan.lyapunov").then(axes(&task.axes)).start(&task.start())
    };
    let call = call.unless("impacts", task.lengths().0, usual.lengths().0).unless(
        "transient",
        task.lengths().1,
        usual.lengths().1,
    );
    if task.axes.is_empty() { call.given("points", task.points) } else { call }
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
                "diagram = vi.orbit_diagram(osc, \"damping\", \"0:0.1:3\", direction=\"scatter\", starts=3, seed=0, show=\"strobe\")\n",
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
