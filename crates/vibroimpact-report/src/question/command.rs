//! A plan as the words of a `vibro` command.

use super::body::numbers_of;
use super::number;
use crate::Units;
use crate::units::{given, shown_span};
use vibroimpact_study::diagram::{DEFAULT_KEEP, DEFAULT_TRANSIENT, Show, SweepDirection};
use vibroimpact_study::{
    Axis, BasinPlan, Body, BodyNumber, BranchPlan, Coordinate, CurvePlan, DEFAULT_BRANCH_POINTS, DEFAULT_GRID,
    DiagramPlan, EdgePlan, LyapunovPlan, MapPlan, MarginsPlan, Name, Parameter, PlacePlan, Plan, Quantity, RegionPlan,
    ResponsePlan, StartPlan, Stretch, SystemPlan, Target, Task, Values, Variable,
};

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
    if units.si != system.body.is_some() || (units.si && !varied(&plan.task).all(of_body)) {
        return None;
    }
    let mut line = match &plan.task {
        Task::Simulate { start, impacts, periods } => {
            let line = Line::new("simulate").system(system, &[]).start(&start.unwrap_or_default(), units);
            line.given("impacts", *impacts).given("periods", periods.map(number))
        }
        Task::Settle { start, impacts } => {
            Line::new("settle").system(system, &[]).start(&start.unwrap_or_default(), units).given("impacts", *impacts)
        }
        Task::Attractors { starts, seed, impacts } => {
            let line = Line::new("attractors").system(system, &[]).flag("starts", starts);
            line.unless("seed", *seed, 1).given("impacts", *impacts)
        }
        Task::Orbit { label } => Line::new("orbit").system(system, &[]).flag("label", label),
        Task::Basin(task) => basin(system, &task.typed().ok()?, units)?,
        Task::Map(task) => map(system, &task.typed().ok()?)?,
        Task::Diagram(task) => diagram(system, &task.typed().ok()?)?,
        Task::Lyapunov(task) => lyapunov(system, &task.typed().ok()?, units)?,
        Task::Branch(task) => branch(system, &task.typed().ok()?),
        Task::Curve(task) => curve(system, &task.typed().ok()?),
        Task::Region(task) => region(system, &task.typed().ok()?),
        Task::Response(task) => {
            let task: ResponsePlan = task.typed().ok()?;
            let line = Line::new("response").system(system, &[(task.vary, Some(values(&task.over)?))]);
            line.unless_amplitude(task.quantity()).given("impacts", task.impacts)
        }
        Task::Margins(task) => margins(system, &task.typed().ok()?, units),
        Task::Edge(task) => {
            let task: EdgePlan = task.typed().ok()?;
            let place = |one: &PlacePlan| {
                let unit = match one.coordinate {
                    Coordinate::X => units.length(),
                    Coordinate::V => units.velocity(),
                    _ => 1.0,
                };
                format!("{}={}", one.coordinate.name(), number(one.value * unit))
            };
            let other: Vec<String> = task.other.iter().map(place).collect();
            let line = Line::new("edge").system(system, &[]).start(&task.start.unwrap_or_default(), units);
            line.flag("other", other.join(",")).given("laps", task.laps).given("impacts", task.impacts)
        }
        Task::SettleMany(_) => return None,
    };
    let (refine, name) = match &plan.task {
        Task::Map(task) => (task.refine, "map.zarr"),
        Task::Basin(task) => (task.refine, "basin.zarr"),
        Task::Attractors { .. } => (None, "attractors.zarr"),
        Task::Diagram(_) => (None, "diagram.zarr"),
        Task::Lyapunov(task) if !task.axes.is_empty() => (None, "lyapunov.zarr"),
        // the other tasks have no store
        _ => return plan.tile.is_none().then_some(line.words),
    };
    if refine.is_some() || plan.tile.is_some() {
        line = line.flag("store", name).given("tile", plan.tile).given("refine", refine);
    }
    Some(line.words)
}

/// The parameters that vary.
fn varied(task: &Task) -> impl Iterator<Item = Parameter> {
    let on = |axes: &[Axis<Variable>]| axes.iter().map(|axis| axis.vary.clone()).collect();
    let names: Vec<Variable> = match task {
        Task::Map(map) => on(&map.axes),
        Task::Diagram(diagram) => {
            let also = diagram.also.as_ref().map(|also| also.parameter.clone());
            core::iter::once(diagram.vary.clone()).chain(also).collect()
        }
        Task::Branch(branch) => {
            let also = branch.also.as_ref().map(|also| also.parameter.clone());
            core::iter::once(branch.vary.clone()).chain(also).collect()
        }
        Task::Curve(curve) => vec![curve.vary.parameter.clone(), curve.and.parameter.clone()],
        Task::Region(region) => [&region.across, &region.up].map(|side| side.parameter.clone()).to_vec(),
        Task::Response(response) => vec![response.vary.clone()],
        Task::Margins(margins) => margins.vary.iter().map(|one| one.parameter.clone()).collect(),
        _ => Vec::new(),
    };
    names.into_iter().filter_map(|name| Parameter::of(name.text()).ok())
}

const fn parameter(vary: Coordinate) -> Option<Parameter> {
    if let Coordinate::Parameter(parameter) = vary { Some(parameter) } else { None }
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

    /// Adds a flag unless its value is the default.
    fn unless<T: Copy + PartialEq + ToString>(self, name: &str, value: T, usual: T) -> Self {
        if value == usual { self } else { self.flag(name, value) }
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
        let second = system.second_stop;
        let values = [
            (Parameter::Beta, system.beta),
            (Parameter::InverseBeta, system.inverse_beta),
            (Parameter::Gap, Some(system.gap)),
            (Parameter::Restitution, Some(system.restitution)),
            (Parameter::Damping, Some(system.damping).filter(|damping| damping.to_bits() != 0)),
            (Parameter::SecondGap, second.map(|stop| stop.gap)),
            (Parameter::SecondRestitution, second.map(|stop| stop.restitution)),
        ];
        for (parameter, value) in values {
            self = match varied.iter().find(|(other, _)| *other == parameter) {
                Some((_, words)) => self.given(parameter.name(), words.clone()),
                None => self.given(parameter.name(), value.map(number)),
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
            self = match varies(name) {
                Some(one) => {
                    left.retain(|other| *other != one);
                    self.given(name, one.1.clone())
                }
                None => self.given(name, value.map(number)),
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

    /// Adds the quantities of a plan.
    fn fields(self, fields: &[Quantity]) -> Self {
        let names: Vec<String> = fields.iter().map(|field| field.name().replace('_', "-")).collect();
        self.given("fields", (!names.is_empty()).then(|| names.join(",")))
    }

    /// Adds the quantity of a response unless it is the default.
    fn unless_amplitude(self, quantity: Quantity) -> Self {
        let named = (quantity != Quantity::DisplacementAmplitude).then(|| quantity.name().replace('_', "-"));
        self.given("quantity", named)
    }

    fn start(self, start: &StartPlan, units: &Units) -> Self {
        let x = start.x.map(|x| number(given(x, units.length())));
        self.given("x", x).zero("v", given(start.v, units.velocity())).zero("phase", start.phase)
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
    Some(line.given("impacts", task.impacts).fields(&task.fields))
}

fn map(system: &SystemPlan, task: &MapPlan) -> Option<Line> {
    let words = |axis: &Axis| Some((parameter(axis.vary)?, Some(values(&axis.over)?)));
    let varied = task.axes.iter().map(words).collect::<Option<Vec<_>>>()?;
    let line = Line::new("map").system(system, &varied).given("axes", order(&varied));
    let line = line.flag("starts", task.starts).unless("seed", task.seed, 1);
    Some(line.given("impacts", task.impacts).fields(&task.fields))
}

/// The values of an axis. A list of one value has no form of its own.
fn values(of: &Values) -> Option<String> {
    match of {
        Values::Span(span) => Some(span.to_string()),
        Values::Listed(list) if list.len() > 1 => Some(list.iter().map(|x| number(*x)).collect::<Vec<_>>().join(",")),
        Values::Listed(_) => None,
    }
}

/// The name of the flag of a parameter, without the dashes.
fn flag(parameter: Parameter) -> String {
    parameter.name().replace('_', "-")
}

/// The order of the axes, if it differs from the order of the flags.
fn order<T>(varied: &[(Parameter, T)]) -> Option<String> {
    // flags of a body come first
    let all = || BodyNumber::ALL.into_iter().map(Parameter::Body).chain(Parameter::ALL);
    let place = |(parameter, _): &(Parameter, T)| all().position(|other| other == *parameter);
    let names = || varied.iter().map(|(parameter, _)| flag(*parameter)).collect::<Vec<_>>();
    (!varied.is_sorted_by_key(place)).then(|| names().join(","))
}

fn diagram(system: &SystemPlan, task: &DiagramPlan) -> Option<Line> {
    let varied: Vec<_> = task.cut().names().map(|parameter| (*parameter, None)).collect();
    let line = Line::new("diagram").system(system, &varied);
    let line = line.flag("vary", flag(task.vary)).flag("over", values(&task.over)?);
    let line = line.given("also", task.also.as_ref().map(over));
    let line = match task.direction {
        SweepDirection::Both => line,
        SweepDirection::Up => line.flag("direction", "up"),
        SweepDirection::Down => line.flag("direction", "down"),
        SweepDirection::Scatter { starts, seed } => {
            line.flag("direction", "scatter").flag("starts", starts).flag("seed", seed)
        }
    };
    let line = match task.show {
        Show::Velocity => line,
        Show::Strobe => line.flag("show", "strobe"),
        Show::Quantity(quantity) => line.flag("show", quantity.name().replace('_', "-")),
    };
    Some(line.unless("transient", task.transient, DEFAULT_TRANSIENT).unless("keep", task.keep, DEFAULT_KEEP))
}

fn lyapunov(system: &SystemPlan, task: &LyapunovPlan, units: &Units) -> Option<Line> {
    let usual: LyapunovPlan = LyapunovPlan::default();
    let mut line = Line::new("lyapunov").system(system, &[]).start(&task.start(), units);
    // the command takes these nondimensional only
    let measured = |axis: &Axis| matches!(axis.vary, Coordinate::X | Coordinate::V);
    if units.plan().is_some() && task.axes.iter().any(measured) {
        return None;
    }
    for axis in &task.axes {
        line = line.flag("axis", format!("{}={}", axis.vary.name().replace('_', "-"), values(&axis.over)?));
    }
    let line = line.unless("impacts", task.lengths().0, usual.lengths().0).unless(
        "transient",
        task.lengths().1,
        usual.lengths().1,
    );
    Some(match task.points {
        Some(points) => line.flag("points", points).flag("plot", "attractor.svg"),
        None => line,
    })
}

fn margins(system: &SystemPlan, task: &MarginsPlan, units: &Units) -> Line {
    let usual: MarginsPlan = MarginsPlan::default();
    let line = Line::new("margins").system(system, &[]).given("label", task.label.as_ref()).start(&task.start(), units);
    let names: Vec<String> = task.vary.iter().map(|one| flag(one.parameter)).collect();
    let line = line.given("vary", (!names.is_empty()).then(|| names.join(",")));
    let scales = task.vary.iter().filter_map(|one| Some((one.parameter, one.scale?)));
    let line = scales.fold(line, |line, (of, scale)| line.flag("scale", format!("{}={}", flag(of), number(scale))));
    let line = if task.within == usual.within { line } else { line.flag("within", number(task.within)) };
    line.unless("lines", task.lines(), usual.lines())
}

fn branch(system: &SystemPlan, task: &BranchPlan) -> Line {
    let line = Line::new("branch").system(system, &[]).given("label", task.label.as_ref());
    let ends = task.back.map_or_else(String::new, |back| number(back) + ",") + &number(task.to);
    let line = line.flag("vary", flag(task.vary)).flag("to", ends);
    let also = |also: Target| format!("{}={}", flag(also.parameter), number(also.to));
    let line = line.given("also", task.also.map(also));
    let line = line.given("orbit", task.orbit).unless("follow", task.follow, 0);
    line.unless("points", task.points, DEFAULT_BRANCH_POINTS)
}

fn range(stretch: &Stretch) -> String {
    format!("{}:{}", number(stretch.from), number(stretch.to))
}

/// The text of a range, such as `gap=0:3`.
fn over(stretch: &Stretch) -> String {
    format!("{}={}", flag(stretch.parameter), range(stretch))
}

fn curve(system: &SystemPlan, task: &CurvePlan) -> Line {
    let line =
        Line::new("curve").system(system, &[]).given("label", task.label.as_ref()).flag("kind", task.kind.name());
    let line = line.flag("vary", over(&task.vary)).flag("and", over(&task.and));
    line.given("orbit", task.orbit).given("event", task.event).given("points", task.points)
}

fn region(system: &SystemPlan, task: &RegionPlan) -> Line {
    let varied = [&task.across, &task.up].map(|stretch| (stretch.parameter, Some(range(stretch))));
    let line = Line::new("region").flag("label", &task.label).system(system, &varied);
    line.given("axes", order(&varied)).unless("grid", task.grid, DEFAULT_GRID)
}
