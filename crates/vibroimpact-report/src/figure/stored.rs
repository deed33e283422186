//! The figure of a store, equal to that of the command for the same question.

use crate::answer::Told;
use crate::figure::coloured::{self, Coloured, Value, place};
use crate::figure::overlay::Overlay;
use crate::figure::plane::{Plane, PlaneAxis, Sides};
use crate::figure::point_motion::{PointMotion, group};
use crate::figure::{basin, diagram, map, scattered, shares};
use crate::varied::{FieldName, Varied};
use crate::{AnswerError, ReportError, Units};
use std::borrow::Cow;
use std::collections::BTreeMap;
use vibroimpact::QuantityKind;
use vibroimpact::math::sort_by_key;
use vibroimpact_plot::{Colour, Figure, FigureAxis, Line, Panel, SERIES};
use vibroimpact_study::study::{NOT_COMPUTED, REFUSED, StudyArrays, label_of};
use vibroimpact_study::{Axis, BasinPlan, Column, Control, Name, PointsPlan, System, Task, typed_axes};

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
    let plan = store.plan();
    let mut figure = match &plan.system {
        System::Oscillator(system) => of_system::<_, A, E>(store, system, &Units::of_plan(plan), (colour, overlay)),
        System::Machine(machine) => of_system(store, &**machine, &Units::default(), (colour, overlay)),
    }?;
    overlay.add(&mut figure, plan, control)?;
    Ok(figure)
}

/// Draws the figure of a study of a system without what lies over it.
fn of_system<D: Told, A: StudyArrays, E: From<A::Error> + From<ReportError>>(
    store: &A,
    system: &D,
    units: &Units,
    (colour, overlay): (Option<&Coloured>, &Overlay),
) -> Result<Figure, E> {
    let task = &store.plan().task;
    let axes: Vec<Axis<D::Coordinate>> = typed_axes(task.axes()).map_err(ReportError::from)?;
    let title = |varied: &[&str]| system.title("machine", units, varied);
    let over_axes = || title(&axes.iter().map(|axis| axis.vary.text()).collect::<Vec<_>>());
    let sides = || Sides::of(&axes, units);
    if let Some(colour) = colour {
        if !matches!(task, Task::Map(_) | Task::Basin(_)) {
            return Err(ReportError::NoColours.into());
        }
        let fields = task.fields().iter().map(|name| D::Quantity::of(name)).collect::<Result<Vec<_>, _>>();
        let fields = fields.map_err(ReportError::from)?;
        let field = &fields[place(&fields, &colour.field)?];
        let unit = |point: usize| field.unit(&units.at_point(&axes, point));
        let points = points::<A, E>(store, Some((field.text(), &unit)))?;
        return Ok(coloured::of_points(&sides()?, &points, colour, (field.axis(units), over_axes()))?);
    }
    match task {
        Task::Map(_) => match sides()? {
            Sides::Line(side) => Ok(shares::draw(&side, &points::<A, E>(store, None)?, over_axes())),
            Sides::Plane(plane) => of_map(store, &plane, over_axes(), overlay.cells()),
        },
        Task::Basin(BasinPlan { points: Some(points), axes, .. }) if axes.is_empty() => {
            of_points(store, &points.typed::<D::Coordinate>().map_err(ReportError::from)?, units, title)
        }
        Task::SettleMany(plan) => {
            of_points(store, &plan.points.typed::<D::Coordinate>().map_err(ReportError::from)?, units, title)
        }
        Task::Basin(_) => of_basin(store, &sides()?, over_axes()),
        Task::Lyapunov(_) => {
            let [axis] = axes.as_slice() else { return Err(ReportError::Exponents.into()) };
            let unit = |point: usize| units.at_point(&axes, point).of_kind(QuantityKind::Rate);
            let name =
                if units.si { units.named("Lyapunov exponents", QuantityKind::Rate.unit()) } else { PER_TIME.into() };
            of_exponents(store, &PlaneAxis::of(axis, units)?, (&name, &unit), over_axes())
        }
        Task::Diagram(plan) => {
            let plan = plan.typed().map_err(ReportError::from)?;
            let found = D::diagram_of(&plan, &columns::<A, E>(store)?);
            let cut = plan.cut();
            Ok(diagram::figure(&found, units, title(&cut.names().map(Name::text).collect::<Vec<_>>()))?)
        }
        _ => Err(ReportError::Scattered.into()),
    }
}

/// All arrays of a study.
fn columns<A: StudyArrays, E: From<A::Error>>(store: &A) -> Result<Vec<Column>, E> {
    Ok((0..store.study().fields().len()).map(|k| store.array(k)).collect::<Result<Vec<_>, _>>()?)
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
    title: impl Fn(&[&str]) -> String,
) -> Result<Figure, E> {
    let Some(label) = store.field_number("label") else { return Err(ReportError::NoLabels.into()) };
    let width = store.study().fields()[label].width();
    let column = store.array(label)?;
    let varied: Vec<V> = points.varied().collect();
    let title = title(&varied.iter().map(Name::text).collect::<Vec<_>>());
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
