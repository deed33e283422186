//! Figures of a quantity of motions: planes in the colours of its values, with a colour bar, and its values over one axis.

mod dots;
mod plane;
mod value;

pub use dots::draw as draw_dots;
pub use plane::draw as draw_plane;
pub use value::{Coloured, Of, Value};

use crate::figure::plane::Sides;
use crate::figure::point_motion::{PointMotion, PointMotions};
use crate::{FieldName, ReportError, Units, Varied};
use vibroimpact::verdict::{CountedMotion, System};
use vibroimpact_plot::Figure;
use vibroimpact_study::{Basin, Name, RegionMap};

/// The figure of `vibro map --colour`: a plane, or dots over one axis.
pub(crate) fn of_map<V: Varied, F: FieldName>(
    found: &RegionMap<V, F>,
    coloured: &Coloured,
    units: &Units,
    title: String,
) -> Result<Figure, ReportError> {
    let field = place(&found.fields, &coloured.field)?;
    let points = PointMotions::of_map(found, Some(field), units);
    of_points(&Sides::of(&found.axes, units)?, &points, coloured, (found.fields[field].axis(units), title))
}

/// Draws the points of a map; given are the name of the quantity and the title.
///
/// # Errors
/// As [`draw_plane`].
pub fn of_points(
    sides: &Sides,
    motions: &PointMotions,
    coloured: &Coloured,
    (name, title): (String, String),
) -> Result<Figure, ReportError> {
    let plane = match sides {
        Sides::Line(side) => return Ok(draw_dots(side, motions, name, title)),
        Sides::Plane(plane) => plane,
    };
    let several = motions.points.iter().any(|motions| motions.len() > 1);
    let cell = |motions: &Vec<PointMotion>| coloured.of.among(motions.iter().map(|motion| motion.value));
    let cells: Vec<Value> = motions.points.iter().map(cell).collect();
    let names = (name, several.then(|| coloured.of.sentence()));
    let figure = draw_plane(plane, &cells, names, coloured.range)?;
    Ok(figure.title(title))
}

/// The figure of `vibro basin --colour`: each start in the colour of the quantity of the motion to which it leads, or dots
/// over one axis.
pub(crate) fn of_basin<S: System, V: Varied, F: FieldName>(
    found: &Basin<S, V, F>,
    coloured: &Coloured,
    units: &Units,
    title: String,
) -> Result<Figure, ReportError> {
    let fields = &found.plan.fields;
    let field = place(fields, &coloured.field)?;
    let mut all = PointMotions::default();
    let motion = |(motion, values): (&CountedMotion<S>, &Vec<f64>)| {
        let (label, number) =
            (motion.verdict.label(), values.get(field).map(|value| value * fields[field].unit(units)));
        PointMotion { class: all.class(&label), share: 1.0, value: Value::of(&label, number) }
    };
    let motions: Vec<PointMotion> = found.motions.iter().zip(&found.quantities).map(motion).collect();
    let start = |k: usize| found.motion(k).map(|number| motions[number]).into_iter().collect();
    all.points = (0..found.cells.len()).map(start).collect();
    of_points(&Sides::of(&found.plan.axes, units)?, &all, coloured, (fields[field].axis(units), title))
}

/// The place of a field among those of a plan.
pub(crate) fn place<F: Name>(fields: &[F], name: &str) -> Result<usize, ReportError> {
    let no_field = || {
        let there = fields.iter().map(|field| field.text().to_owned()).collect();
        ReportError::NoField { field: name.to_owned(), there }
    };
    fields.iter().position(|field| field.text() == name).ok_or_else(no_field)
}
