//! A plan from text in JSON or TOML: checked, and converted to the form in which it is stored.

use crate::error::Trouble;
use crate::oscillator::OscillatorFile;
use crate::simulate::{StartArgument, start_plan};
use pyo3::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::HashMap;
use vibroimpact_study::{
    Axis, BodyNumber, Coordinate, Parameter, Plan, PlanError, StartPlan, SystemPlan, Task, Variable,
};

/// The plan of a text, in the form in which it is stored.
pub(crate) fn read(text: &str) -> Result<Plan, Trouble> {
    let plan = Plan::from_text(text).map_err(|error| match error {
        // JSON is written by this package, so a position in it does not help the user
        PlanError::Text(error) if text.trim_start().starts_with('{') => {
            Trouble::question(error.without_place().to_string())
        }
        other => other.into(),
    })?;
    let plan = plan.canonical()?;
    plan.check()?;
    Ok(plan)
}

/// A value from JSON that this package has written, so a position in it does not help the user.
pub(crate) fn parsed<T: DeserializeOwned>(text: &str) -> Result<T, Trouble> {
    serde_json::from_str(text).map_err(|error| {
        let said = error.to_string();
        Trouble::question(said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said))
    })
}

/// A plan, or another value, as JSON.
pub(crate) fn text(of: &impl Serialize) -> Result<String, Trouble> {
    serde_json::to_string(of).map_err(|_| Trouble::Defect("writing JSON"))
}

/// Number of points of the grid of a plan; 0 for a plan without a grid.
pub(crate) fn points(plan: &Plan) -> u64 {
    let work = match &plan.task {
        Task::Lyapunov(lyapunov) => return lyapunov.axes.iter().map(|axis| axis.over.count() as u64).product(),
        Task::Region(_) => None,
        _ => plan.work(),
    };
    work.map_or(0, |(points, _)| points)
}

/// The schema of the answer to a command, or else that of plans, as JSON: documentation and types of the package are made of them.
#[pyfunction]
#[pyo3(signature = (verb=None))]
pub(crate) fn schema(verb: Option<&str>) -> Result<String, Trouble> {
    text(&verb.and_then(vibroimpact_report::json::schema).unwrap_or_else(Plan::schema))
}

/// A plan in the form in which it is stored, its hash, its title, and the number of points of its grid.
pub(crate) type PlanFields = (String, String, String, u64);

/// Those of a plan.
pub(crate) fn fields(plan: &Plan) -> Result<PlanFields, Trouble> {
    Ok((text(plan)?, plan.hash(), plan.title(), points(plan)))
}

/// Those of a plan that is text.
#[pyfunction]
pub(crate) fn checked_plan(given: &str) -> Result<PlanFields, Trouble> {
    fields(&read(given)?)
}

/// The units of length, time and mass of a body, the system of a plan as JSON, at points: columns of values of some of
/// its parameters. Points that are no machine have not-a-number.
#[pyfunction]
pub(crate) fn scales_of_points(
    system: &str,
    names: Vec<String>,
    values: Vec<Vec<f64>>,
) -> Result<[Vec<f64>; 3], Trouble> {
    let system: SystemPlan = serde_json::from_str(system)
        .map_err(|error| Trouble::question(format!("the system of the Dataset does not read: {error}")))?;
    let parameters = names.iter().map(|name| crate::axis::parameter(name)).collect::<Result<Vec<_>, _>>()?;
    let mut found = [(); 3].map(|()| Vec::new());
    for k in 0..values.first().map_or(0, Vec::len) {
        let there = system.with_all(parameters.iter().copied().zip(values.iter().map(|column| column[k])));
        let of = (there.ok().and_then(|there| there.scales()))
            .map_or([f64::NAN; 3], |scales| [scales.length, scales.time, scales.mass]);
        found.iter_mut().zip(of).for_each(|(column, value)| column.push(value));
    }
    Ok(found)
}

/// The parameters that are numbers of a body, by name: their descriptions with units, for the axes of figures.
#[pyfunction]
pub(crate) fn body_parameters() -> HashMap<&'static str, String> {
    let text = |parameter: BodyNumber| match parameter.unit() {
        "" => parameter.description().to_owned(),
        unit => format!("{} ({unit})", parameter.description()),
    };
    BodyNumber::ALL.into_iter().map(|parameter| (parameter.name(), text(parameter))).collect()
}

/// Name, value, long name, unit and scale of a coordinate.
type Fixed = (&'static str, f64, &'static str, &'static str, &'static str);

/// A coordinate with its value, its long name and its unit.
fn described((of, value): (Coordinate, f64)) -> Fixed {
    let unit = of.unit();
    (of.name(), value, of.long_name(), unit.name, unit.scale)
}

/// The parameters of a system, and the coordinates of a start.
fn all_coordinates(system: &SystemPlan, start: Option<StartPlan>) -> Vec<(Coordinate, f64)> {
    let parameters = Parameter::ALL
        .into_iter()
        .map(|parameter| (Coordinate::Parameter(parameter), system.value(parameter).unwrap_or(f64::NAN)));
    let of_start = |StartPlan { x, v, phase }| {
        [(Coordinate::X, x.unwrap_or(f64::NAN)), (Coordinate::V, v), (Coordinate::Phase, phase)]
    };
    parameters.chain(start.map(of_start).into_iter().flatten()).collect()
}

/// The parameters of a system and the coordinates of a start, described.
#[pyfunction]
pub(crate) fn point_coordinates(osc: OscillatorFile, start: StartArgument) -> Vec<Fixed> {
    all_coordinates(&osc.plan, Some(start_plan(start))).into_iter().map(described).collect()
}

/// The long name, the unit and the scale of a parameter or a coordinate of a start.
#[pyfunction]
pub(crate) fn coordinate_words(name: &str) -> Result<(&'static str, &'static str, &'static str), Trouble> {
    let of = Coordinate::named(name).ok_or_else(|| Trouble::question(format!("`{name}` is no parameter")))?;
    let (_, _, long_name, unit, scale) = described((of, 0.0));
    Ok((long_name, unit, scale))
}

/// The parameters, and the coordinates of a start, that do not vary in a plan. The names are always the same, so that
/// Datasets of several plans can be joined. The parameters of an absent second stop, and the position of a start at
/// rest, are not-a-number.
#[pyfunction]
pub(crate) fn fixed_coordinates(text: &str) -> Result<Vec<Fixed>, Trouble> {
    let plan = read(text)?;
    let Some(system) = plan.oscillator() else { return Ok(Vec::new()) };
    let known = |name: Variable| if let Variable::Coordinate(coordinate) = name { Some(coordinate) } else { None };
    let on = |axes: &[Axis<Variable>]| axes.iter().filter_map(|axis| known(axis.vary.clone())).collect::<Vec<_>>();
    let (varied, start) = match &plan.task {
        Task::Map(map) => (on(&map.axes), None),
        Task::Basin(basin) => {
            let points = basin.points.iter().flat_map(vibroimpact_study::PointsPlan::varied);
            (points.filter_map(known).chain(on(&basin.axes)).collect(), basin.start)
        }
        Task::Lyapunov(lyapunov) => (on(&lyapunov.axes), lyapunov.start),
        Task::Diagram(diagram) => {
            let also = diagram.also.as_ref().map(|also| also.parameter.clone());
            (core::iter::once(diagram.vary.clone()).chain(also).filter_map(known).collect(), None)
        }
        _ => (Vec::new(), None),
    };
    let is_frequency = |of: &Coordinate| matches!(of, Coordinate::Parameter(parameter) if parameter.is_frequency());
    let varies = |of: Coordinate| varied.contains(&of) || (is_frequency(&of) && varied.iter().any(is_frequency));
    let all = all_coordinates(system, start).into_iter();
    Ok(all.filter(|(of, _)| !varies(*of)).map(described).collect())
}
