//! The figure of a store, equal to that of the command for the same question.

use crate::answer::machine_title;
use crate::figure::coloured::{self, Coloured, Value, asked_for, place};
use crate::figure::overlay::Overlay;
use crate::figure::plane::{Plane, PlaneAxis, Sides, varied};
use crate::figure::point_motion::{PointMotion, group};
use crate::figure::{basin, diagram, map, quantity_name, scattered, shares, title_without};
use crate::varied::Varied;
use crate::{AnswerError, Asked, ReportError, Units};
use std::borrow::Cow;
use std::collections::BTreeMap;
use vibroimpact::QuantityKind;
use vibroimpact::math::sort_by_key;
use vibroimpact_plot::{Colour, Figure, FigureAxis, Line, Panel, SERIES, plain};
use vibroimpact_study::machine::MachineSource;
use vibroimpact_study::study::{NOT_COMPUTED, REFUSED, StudyArrays, diagram_of, label_of, machine_diagram_of};
use vibroimpact_study::{
    Axis, BasinPlan, Column, Control, Coordinate, Parameter, Plan, PointsPlan, Quantity, System, SystemPlan, Task,
    typed_axes,
};

/// Draws the figure of a study; that of a map or basin in the colours of a quantity, if one is given, and that of a map
/// with what lies over it.
///
/// # Errors
/// [`ReportError`] for a study without a figure, [`AnswerError`] for layers that cannot be computed, and the error of the
/// store if it cannot be read.
pub fn figure<A: StudyArrays, E: From<A::Error> + From<ReportError> + From<AnswerError>>(
    store: &A,
    colour: Option<&Coloured>,
    overlay: &Overlay,
    control: &Control<'_>,
) -> Result<Figure, E> {
    let whole = store.plan();
    let system = match &whole.system {
        System::Oscillator(system) => system,
        System::Machine(machine) => return of_machine(store, machine, &whole.task, colour),
    };
    let mut figure = of_oscillator::<A, E>(store, (system, whole), colour, overlay.cells())?;
    overlay.add(&mut figure, whole, control)?;
    Ok(figure)
}

/// Draws the figure of a study of the oscillator without what lies over it.
fn of_oscillator<A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    (system, whole): (&SystemPlan, &Plan),
    colour: Option<&Coloured>,
    cells: (bool, bool),
) -> Result<Figure, E> {
    let asked = Asked { system: *system, units: Units::of_plan(whole) };
    let axes: Vec<Axis> = typed_axes(whole.task.axes()).map_err(ReportError::from)?;
    match (&whole.task, colour) {
        (Task::Map(_) | Task::Basin(_), Some(colour)) => {
            let fields: Vec<Quantity> =
                whole.task.fields().iter().filter_map(|name| Quantity::from_name(name)).collect();
            let quantity = asked_for(&fields, &colour.field)?;
            let unit = |point: usize| asked.units.at_point(&axes, point).of_quantity(quantity);
            let points = points::<A, E>(store, Some((quantity.name(), &unit)))?;
            let names = (quantity_name(quantity, &asked.units), title_without(&asked, &varied(&axes)));
            Ok(coloured::of_points(&Sides::of(&axes, &asked.units)?, &points, colour, names)?)
        }
        (_, Some(_)) => Err(ReportError::NoColours.into()),
        (Task::Map(_), None) => {
            let title = title_without(&asked, &varied(&axes));
            match Sides::of(&axes, &asked.units)? {
                Sides::Line(side) => Ok(shares::draw(&side, &points::<A, E>(store, None)?, title)),
                Sides::Plane(plane) => of_map(store, &plane, title, cells),
            }
        }
        (task, None) => of_task(store, task, &axes, &asked),
    }
}

/// Draws the figure of a study that is no map.
fn of_task<A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    task: &Task,
    axes: &[Axis],
    asked: &Asked,
) -> Result<Figure, E> {
    match task {
        Task::Basin(plan) if plan.points.is_some() && axes.is_empty() => {
            let plan: BasinPlan = plan.typed().map_err(ReportError::from)?;
            let points = plan.points.ok_or(ReportError::Scattered)?;
            let number = |varied| if let Coordinate::Parameter(number) = varied { Some(number) } else { None };
            let title = title_without(asked, &points.varied().filter_map(number).collect::<Vec<Parameter>>());
            of_points(store, &points, &asked.units, title)
        }
        Task::Basin(_) => of_basin(store, &Sides::of(axes, &asked.units)?, title_without(asked, &varied(axes))),
        Task::Lyapunov(_) => {
            let [axis] = axes else { return Err(ReportError::Exponents.into()) };
            let unit = |point: usize| asked.units.at_point(axes, point).of_kind(QuantityKind::Rate);
            let in_si = asked.units.named("Lyapunov exponents", QuantityKind::Rate.unit());
            let name = if asked.units.si { in_si.as_str() } else { PER_TIME };
            let side = PlaneAxis::of(axis, &asked.units)?;
            of_exponents(store, &side, (name, &unit), title_without(asked, &varied(axes)))
        }
        Task::Diagram(plan) => {
            let plan = plan.typed().map_err(ReportError::from)?;
            let found = diagram_of(&plan, &columns::<A, E>(store)?);
            let varied: Vec<Parameter> = plan.cut().names().copied().collect();
            Ok(diagram::figure(&found, &asked.units, title_without(asked, &varied))?)
        }
        _ => Err(ReportError::Scattered.into()),
    }
}

/// All arrays of a study.
fn columns<A: StudyArrays, E: From<A::Error>>(store: &A) -> Result<Vec<Column>, E> {
    Ok((0..store.study().fields().len()).map(|k| store.array(k)).collect::<Result<Vec<_>, _>>()?)
}

/// Draws the figure of a study of a machine.
fn of_machine<A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    machine: &MachineSource,
    task: &Task,
    colour: Option<&Coloured>,
) -> Result<Figure, E> {
    let (title, units) = (machine_title(machine, "machine"), Units::default());
    let axes: Vec<Axis<String>> = typed_axes(task.axes()).map_err(ReportError::from)?;
    if let Some(colour) = colour {
        if !matches!(task, Task::Map(_) | Task::Basin(_)) {
            return Err(ReportError::NoColours.into());
        }
        place(task.fields(), &colour.field)?;
        let points = points::<A, E>(store, Some((&colour.field, &|_| 1.0)))?;
        let names = (plain(&colour.field), title);
        return Ok(coloured::of_points(&Sides::of(&axes, &units)?, &points, colour, names)?);
    }
    match task {
        Task::Map(_) => match Sides::of(&axes, &units)? {
            Sides::Line(side) => Ok(shares::draw(&side, &points::<A, E>(store, None)?, title)),
            Sides::Plane(plane) => of_map(store, &plane, title, Overlay::default().cells()),
        },
        Task::Basin(_) => of_basin(store, &Sides::of(&axes, &units)?, title),
        Task::SettleMany(plan) => {
            of_points(store, &plan.typed::<String>().map_err(ReportError::from)?.points, &units, title)
        }
        Task::Diagram(diagram) => {
            let diagram = diagram.typed().map_err(ReportError::from)?;
            Ok(diagram::figure(&machine_diagram_of(&diagram, &columns::<A, E>(store)?), &units, title)?)
        }
        Task::Lyapunov(_) => {
            let [axis] = axes.as_slice() else { return Err(ReportError::Exponents.into()) };
            of_exponents(store, &PlaneAxis::of(axis, &units)?, (PER_TIME, &|_| 1.0), title)
        }
        _ => Err(ReportError::Scattered.into()),
    }
}

/// The field of a quantity, and the size of its unit at each point.
type Drawn<'a> = (&'a str, &'a dyn Fn(usize) -> f64);

/// The motions at each point of a map or basin, with the values of a quantity in the units of the plan. Points that a store
/// has not computed yet, and those that took the label of their neighbours, have no value.
fn points<A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    quantity: Option<Drawn<'_>>,
) -> Result<Vec<Vec<PointMotion>>, E> {
    let fields = store.study().fields();
    let Some(label) = store.field_number("label") else { return Err(ReportError::NoLabels.into()) };
    let column = |name: &str| store.field_number(name).map(|field| store.array(field)).transpose();
    let numbers = match quantity {
        None => None,
        Some((name, unit)) => column(name)?.map(|values| (values, unit)),
    };
    // starts of one system share the quantities of their cycle, so those that took it from their neighbours have values
    let one_system = store.field_number("cycle").is_some();
    let computed = if one_system { None } else { column("computed")? };
    let (labels, shares) = (store.array(label)?, column("share")?);
    let width = fields[label].width();
    let mut known: BTreeMap<i32, (String, usize)> = BTreeMap::new();
    let mut points = Vec::with_capacity(labels.len() / width.max(1));
    for (point, codes) in labels.whole().chunks(width).enumerate() {
        let own = computed.as_ref().is_none_or(|computed| computed.flags().get(point) == Some(&1));
        let mut motions = Vec::new();
        for (k, code) in codes.iter().enumerate().filter(|(_, code)| label_of(**code).is_some()) {
            let (label, group) = known.entry(*code).or_insert_with(|| {
                let label = label_of(*code).unwrap_or_default();
                let number = group(&label);
                (label, number)
            });
            let number = numbers.as_ref().map(|(values, unit)| values.real()[point * width + k] * unit(point));
            let value = match Value::of(label, number) {
                Value::Undefined if !own => Value::NotComputed,
                value => value,
            };
            let share = shares.as_ref().map_or(1.0, |shares| shares.real()[point * width + k]);
            motions.push(PointMotion { group: *group, share, value });
        }
        if motions.is_empty() && codes[0] != NOT_COMPUTED {
            // no valid system: it has no motions
            motions.push(PointMotion { group: group(""), share: 0.0, value: Value::Undefined });
        }
        points.push(motions);
    }
    Ok(points)
}

/// The motions at points that are no grid.
fn of_points<A: StudyArrays, E: From<A::Error> + From<ReportError>, V: Varied + Into<Cow<'static, str>>>(
    store: &A,
    points: &PointsPlan<V>,
    units: &Units,
    title: String,
) -> Result<Figure, E> {
    let Some(label) = store.field_number("label") else { return Err(ReportError::NoLabels.into()) };
    let width = store.study().fields()[label].width();
    let column = store.array(label)?;
    let labels = column.whole().chunks(width).map(|codes| label_of(codes[0]).map(Cow::from));
    Ok(scattered::figure(points, labels, units, title)?)
}

fn of_map<A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    plane: &Plane,
    title: String,
    shown: (bool, bool),
) -> Result<Figure, E> {
    let Some(label) = store.field_number("label") else { return Err(ReportError::NoLabels.into()) };
    let width = store.study().fields()[label].width();
    let column = store.array(label)?;
    let shares = store.field_number("share").map(|share| store.array(share)).transpose()?;
    let mut known: BTreeMap<i32, Option<String>> = BTreeMap::new();
    for code in column.whole() {
        known.entry(*code).or_insert_with(|| label_of(*code));
    }
    let mut cells = map::LabelledCells::default();
    for (point, codes) in column.whole().chunks(width).enumerate() {
        let share = |k: usize| shares.as_ref().map_or(1.0, |shares| shares.real()[point * width + k]);
        let label = |(k, code): (usize, &i32)| Some((known.get(code)?.as_deref()?.into(), share(k)));
        cells.push(codes.iter().enumerate().filter_map(label));
    }
    Ok(map::draw_with(plane, cells, title, shown)?)
}

#[allow(clippy::cast_precision_loss)] // counts below 2^53
fn of_basin<A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    sides: &Sides,
    title: String,
) -> Result<Figure, E> {
    let Some(label) = store.field_number("label") else { return Err(ReportError::NoLabels.into()) };
    let labels = store.array(label)?;
    let cycles = store.field_number("cycle").map(|cycle| store.array(cycle)).transpose()?;
    let key = |k: usize| (labels.whole()[k], cycles.as_ref().map_or(-1, |cycles| cycles.whole()[k]));
    let mut motions: BTreeMap<(i32, i32), (u16, u64)> = BTreeMap::new();
    let mut cells = Vec::with_capacity(labels.len());
    for k in 0..labels.len() {
        let next = u16::try_from(motions.len()).unwrap_or(u16::MAX);
        if label_of(key(k).0).is_none() {
            cells.push(u16::MAX);
            continue;
        }
        let entry = motions.entry(key(k)).or_insert((next, 0));
        entry.1 += 1;
        cells.push(entry.0);
    }
    // starts of a machine beyond a rigid stop have no motion
    let total = labels.whole().iter().filter(|code| **code != REFUSED).count() as f64;
    let mut list: Vec<_> = motions.into_iter().collect();
    sort_by_key(&mut list, |(_, (number, _))| *number);
    let motion = |((code, _), (_, count)): ((i32, i32), (u16, u64))| basin::BasinMotion {
        label: label_of(code).unwrap_or_default(),
        share: count as f64 / total,
    };
    Ok(basin::draw(sides, &list.into_iter().map(motion).collect::<Vec<_>>(), cells, title)?)
}

/// The name of nondimensional exponents, and of those of a machine, which are in its own unit of time.
const PER_TIME: &str = "Lyapunov exponents per unit time";

/// All exponents over one axis, with the line of zero; `unit` is their unit at each point.
fn of_exponents<A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    side: &PlaneAxis,
    (name, unit): (&str, &dyn Fn(usize) -> f64),
    title: String,
) -> Result<Figure, E> {
    let Some(field) = store.field_number("exponent") else { return Err(ReportError::Exponents.into()) };
    let (column, directions) = (store.array(field)?, store.study().fields()[field].width());
    let values: Vec<f64> = (0..side.count()).map(|k| side.at(k)).collect();
    let zero = Line::new(vec![values[0], values[values.len() - 1]], vec![0.0, 0.0], Colour::hex(0x80_8080));
    let mut panel = Panel::new(side.axis(), FigureAxis::new(name)).with(zero);
    for which in 0..directions {
        let all = values.iter().zip(column.real().chunks(directions)).enumerate();
        let points = all.map(|(k, (x, all))| (*x, all[which] * unit(k)));
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.filter(|(_, y)| y.is_finite()).unzip();
        panel = panel.with(Line::new(xs, ys, SERIES[which % SERIES.len()]));
    }
    Ok(Figure::new(panel).title(title))
}
