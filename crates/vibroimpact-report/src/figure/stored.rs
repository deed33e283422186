//! The figure of a store, equal to that of the command for the same question.

use crate::answer::Told;
use crate::figure::cells::Cells;
use crate::figure::coloured::{self, Coloured, place};
use crate::figure::overlay::Overlay;
use crate::figure::plane::{PlaneAxis, Sides};
use crate::figure::{diagram, map, scattered, shares};
use crate::varied::{FieldName, Varied};
use crate::{AnswerError, ReportError, Units};
use std::borrow::Cow;
use vibroimpact::QuantityKind;
use vibroimpact_plot::{Colour, Figure, FigureAxis, Line, Panel, SERIES};
use vibroimpact_study::study::{StudyArrays, label_of};
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
    let arrays = || Arrays::of::<A, E>(store);
    if let Some(colour) = colour {
        if !matches!(task, Task::Map(_) | Task::Basin(_)) {
            return Err(ReportError::NoColours.into());
        }
        let fields = task.fields().iter().map(|name| D::Quantity::of(name)).collect::<Result<Vec<_>, _>>();
        let fields = fields.map_err(ReportError::from)?;
        let field = &fields[place(&fields, &colour.field)?];
        let unit = |point: usize| field.unit(&units.at_point(&axes, point));
        let values = store.field_number(field.text()).map(|field| store.array(field)).transpose()?;
        let quantity = values.as_ref().map(|values| (values.real(), &unit as &dyn Fn(usize) -> f64));
        let points = arrays()?.cells().points(quantity);
        return Ok(coloured::of_points(&sides()?, &points, colour, (field.axis(units), over_axes()))?);
    }
    match task {
        Task::Map(_) => match sides()? {
            Sides::Line(side) => Ok(shares::draw(&side, &arrays()?.cells().points(None), over_axes())),
            Sides::Plane(plane) => {
                Ok(map::draw_with(&plane, &arrays()?.cells().points(None), over_axes(), overlay.cells())?)
            }
        },
        Task::Basin(BasinPlan { points: Some(points), axes, .. }) if axes.is_empty() => {
            of_points(store, &points.typed::<D::Coordinate>().map_err(ReportError::from)?, units, title)
        }
        Task::SettleMany(plan) => {
            of_points(store, &plan.points.typed::<D::Coordinate>().map_err(ReportError::from)?, units, title)
        }
        Task::Basin(_) => Ok(arrays()?.cells().basin(&sides()?, over_axes())?),
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

/// The arrays of the motions of a study.
struct Arrays {
    labels: Column,
    width: usize,
    shares: Option<Column>,
    cycles: Option<Column>,
    computed: Option<Column>,
}

impl Arrays {
    fn of<A: StudyArrays, E: From<A::Error> + From<ReportError>>(store: &A) -> Result<Self, E> {
        let column = |name: &str| store.field_number(name).map(|field| store.array(field)).transpose();
        let Some(label) = store.field_number("label") else { return Err(ReportError::NoLabels.into()) };
        Ok(Self {
            labels: store.array(label)?,
            width: store.study().fields()[label].width(),
            shares: column("share")?,
            cycles: column("cycle")?,
            computed: column("computed")?,
        })
    }

    fn cells(&self) -> Cells<'_> {
        Cells {
            labels: self.labels.whole(),
            width: self.width,
            shares: self.shares.as_ref().map(Column::real),
            cycles: self.cycles.as_ref().map(Column::whole),
            computed: self.computed.as_ref().map(Column::flags),
        }
    }
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
