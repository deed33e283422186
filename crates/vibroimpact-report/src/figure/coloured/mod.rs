//! Figures of a quantity of motions: planes in the colours of its values, with a colour bar, and its values over one axis.

mod dots;
mod plane;
mod value;

pub use dots::draw as draw_dots;
pub use plane::draw as draw_plane;
pub use value::{Coloured, Of, Value};

use crate::figure::plane::Sides;
use crate::figure::point_motion::{PointMotion, group, points};
use crate::figure::{quantity_name, title};
use crate::{Asked, FieldName, ReportError, Units, Varied};
use vibroimpact::Oscillator;
use vibroimpact::quantities::{Quantity, of_verdict_only};
use vibroimpact_plot::{Figure, plain};
use vibroimpact_study::{Basin, MachineBasin, Name, RegionMap};

/// The figure of `vibro map --colour`: a plane, or dots over one axis.
///
/// # Errors
/// [`ReportError::NoField`] if the plan does not ask for the quantity, and the errors of [`figure::map`](crate::figure::map).
pub fn of_map<V: Varied, F: FieldName>(
    found: &RegionMap<V, F>,
    coloured: &Coloured,
    units: &Units,
    title: String,
) -> Result<Figure, ReportError> {
    let field = place(&found.fields, &coloured.field)?;
    let points = points(found, Some(field), units);
    of_points(&Sides::of(&found.axes, units)?, &points, coloured, (found.fields[field].axis(units), title))
}

/// Draws the points of a map; given are the name of the quantity and the title.
///
/// # Errors
/// As [`draw_plane`].
pub fn of_points(
    sides: &Sides,
    points: &[Vec<PointMotion>],
    coloured: &Coloured,
    (name, title): (String, String),
) -> Result<Figure, ReportError> {
    let plane = match sides {
        Sides::Line(side) => return Ok(draw_dots(side, points, name, title)),
        Sides::Plane(plane) => plane,
    };
    let several = points.iter().any(|motions| motions.len() > 1);
    let cell = |motions: &Vec<PointMotion>| coloured.of.among(motions.iter().map(|motion| motion.value));
    let cells: Vec<Value> = points.iter().map(cell).collect();
    let names = (name, several.then(|| coloured.of.sentence()));
    let figure = draw_plane(plane, &cells, names, coloured.range)?;
    Ok(figure.title(title))
}

/// The figure of `vibro basin --colour`: each start in the colour of the quantity of the motion to which it leads, or dots
/// over one axis.
///
/// # Errors
/// As [`of_map`].
pub fn of_basin(found: &Basin, coloured: &Coloured, osc: &Oscillator, asked: &Asked) -> Result<Figure, ReportError> {
    let quantity = asked_for(&found.plan.fields, &coloured.field)?;
    let motion = |motion: &vibroimpact::verdict::CountedMotion| {
        let of = of_verdict_only(osc, &motion.verdict, &[quantity]);
        let number = of.map(|of| asked.units.value_of(&of, quantity));
        motion_of(&motion.verdict.label(), number)
    };
    let motions: Vec<PointMotion> = found.motions.iter().map(motion).collect();
    let points = found.cells.iter().map(|cell| motions.get(usize::from(*cell)).copied());
    let sides = Sides::of(&found.plan.axes, &asked.units)?;
    of_starts(&sides, points, coloured, (quantity_name(quantity, &asked.units), title(asked)))
}

/// The figure of `vibro basin --machine --colour`.
///
/// # Errors
/// As [`of_map`].
pub fn of_machine_basin(found: &MachineBasin, coloured: &Coloured, title: String) -> Result<Figure, ReportError> {
    let field = place(&found.fields, &coloured.field)?;
    let values = found.quantities.iter().map(|values| values.get(field).copied());
    let motions: Vec<PointMotion> =
        found.motions.iter().zip(values).map(|(verdict, value)| motion_of(&verdict.label(), value)).collect();
    let points = found.cells.iter().map(|cell| cell.and_then(|cell| motions.get(cell).copied()));
    of_starts(&Sides::of(&found.axes, &Units::default())?, points, coloured, (plain(&coloured.field), title))
}

/// The one motion to which a start leads.
fn motion_of(label: &str, number: Option<f64>) -> PointMotion {
    PointMotion { group: group(label), share: 1.0, value: Value::of(label, number) }
}

/// Draws the motions to which starts lead.
fn of_starts(
    sides: &Sides,
    motions: impl Iterator<Item = Option<PointMotion>>,
    coloured: &Coloured,
    names: (String, String),
) -> Result<Figure, ReportError> {
    let points: Vec<Vec<PointMotion>> = motions.map(|motion| motion.into_iter().collect()).collect();
    of_points(sides, &points, coloured, names)
}

/// The quantity of an oscillator with this name, if a plan asks for it.
///
/// # Errors
/// [`ReportError::NoField`] if it does not.
pub fn asked_for(fields: &[Quantity], name: &str) -> Result<Quantity, ReportError> {
    Ok(fields[place(fields, name)?])
}

/// The place of a field among those of a plan.
///
/// # Errors
/// [`ReportError::NoField`] if it is not there.
pub fn place<F: Name>(fields: &[F], name: &str) -> Result<usize, ReportError> {
    let no_field = || {
        let there = fields.iter().map(|field| field.text().to_owned()).collect();
        ReportError::NoField { field: name.to_owned(), there }
    };
    fields.iter().position(|field| field.text() == name).ok_or_else(no_field)
}
