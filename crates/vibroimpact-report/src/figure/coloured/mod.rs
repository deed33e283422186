//! Figures of a quantity of motions: planes in the colours of its values, with a colour bar, and its values over one axis.

mod dots;
mod plane;
mod value;

pub use dots::draw as draw_dots;
pub use plane::draw as draw_plane;
pub use value::{Coloured, Of, Value};

use crate::figure::plane::{Plane, varied};
use crate::figure::point_motion::{PointMotion, group, points};
use crate::figure::{title, title_without};
use crate::{Asked, ReportError, Units};
use vibroimpact::Oscillator;
use vibroimpact::quantities::{Quantity, of_verdict_only};
use vibroimpact_plot::Figure;
use vibroimpact_study::{Basin, RegionMap};

/// The figure of `vibro map --colour`: a plane, or dots over one axis.
///
/// # Errors
/// [`ReportError::NoField`] if the plan does not ask for the quantity, and the errors of [`figure::map`](crate::figure::map).
pub fn of_map(found: &RegionMap, coloured: Coloured, asked: &Asked) -> Result<Figure, ReportError> {
    let (axes, units) = (&found.plan.axes, &asked.units);
    has_field(&found.plan.fields, coloured.quantity)?;
    let title = title_without(asked, &varied(axes));
    let points = points(found, Some(coloured.quantity), units);
    if let [axis] = axes.as_slice() {
        return dots::draw(axis, &points, coloured.quantity, units, title);
    }
    of_points(&Plane::of(axes, units)?, &points, coloured, (units, title))
}

/// Draws the plane of the points of a map.
///
/// # Errors
/// As [`draw_plane`].
pub fn of_points(
    plane: &Plane,
    points: &[Vec<PointMotion>],
    coloured: Coloured,
    (units, title): (&Units, String),
) -> Result<Figure, ReportError> {
    let several = points.iter().any(|motions| motions.len() > 1);
    let cell = |motions: &Vec<PointMotion>| coloured.of.among(motions.iter().map(|motion| motion.value));
    let cells: Vec<Value> = points.iter().map(cell).collect();
    let figure = draw_plane(plane, &cells, coloured.quantity, units, several.then(|| coloured.of.sentence()))?;
    Ok(figure.title(title))
}

/// The figure of `vibro basin --colour`: each start in the colour of the quantity of the motion to which it leads, or dots
/// over one axis.
///
/// # Errors
/// As [`of_map`].
pub fn of_basin(found: &Basin, quantity: Quantity, osc: &Oscillator, asked: &Asked) -> Result<Figure, ReportError> {
    has_field(&found.plan.fields, quantity)?;
    let value = |motion: &vibroimpact::verdict::CountedMotion| {
        let of = of_verdict_only(osc, &motion.verdict, &[quantity]);
        let number = of.map(|of| asked.units.value_of(&of, quantity));
        Value::of(&motion.verdict.label(), number)
    };
    let values: Vec<Value> = found.motions.iter().map(value).collect();
    if let [axis] = found.plan.axes.as_slice() {
        let motion = |cell: &u16| {
            let (verdict, value) = (&found.motions[usize::from(*cell)].verdict, values[usize::from(*cell)]);
            vec![PointMotion { group: group(&verdict.label()), share: 1.0, value }]
        };
        let points: Vec<_> = found.cells.iter().map(motion).collect();
        return draw_dots(axis, &points, quantity, &asked.units, title(asked));
    }
    let plane = Plane::of(&found.plan.axes, &asked.units)?;
    let cells: Vec<Value> =
        found.cells.iter().map(|cell| values.get(usize::from(*cell)).copied().unwrap_or(Value::NotComputed)).collect();
    Ok(draw_plane(&plane, &cells, quantity, &asked.units, None)?.title(title(asked)))
}

/// Checks that a plan asks for the quantity.
///
/// # Errors
/// [`ReportError::NoField`] if it does not.
pub fn has_field(fields: &[Quantity], quantity: Quantity) -> Result<(), ReportError> {
    if fields.contains(&quantity) { Ok(()) } else { Err(ReportError::NoField { quantity, there: fields.to_vec() }) }
}
