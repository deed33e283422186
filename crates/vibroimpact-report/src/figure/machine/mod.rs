//! The schematic of a machine: bodies, springs, dampers, stops and friction joints. It is not to scale.
//!
//! | idea | file |
//! |---|---|
//! | what is drawn: bodies, points, and the items between them | `model` |
//! | springs, dampers, stops, sliders, the ground | `glyphs` |
//! | bodies in a row | `chain` |
//! | a structure with modes, as a beam | `beam` |

mod beam;
mod chain;
mod glyphs;
mod model;

use vibroimpact_plot::{Figure, FigureAxis, Panel, plain};
use vibroimpact_study::machine::{MachineFileError, MachineSource};

/// Figure units of a unit of the drawing.
const UNIT: f64 = 60.0;
/// The space around the drawing, in units of the drawing.
const AIR: f64 = 0.4;

/// The schematic.
///
/// # Errors
/// [`MachineFileError`] if the file describes no machine.
pub fn figure(source: &MachineSource) -> Result<Figure, MachineFileError> {
    let model = model::of(source)?;
    let sketch = if model.points.is_empty() { chain::draw(&model) } else { beam::draw(&model) };
    let (left, right, low, high) = sketch.extent();
    let (width, height) = (right - left + 2.0 * AIR, high - low + 2.0 * AIR);
    let x = FigureAxis::new("").range(left - AIR, right + AIR);
    let y = FigureAxis::new("").range(low - AIR, high + AIR);
    let panel = Panel { marks: sketch.marks, bare: true, ..Panel::new(x, y) };
    let title = source.title.as_deref().filter(|title| title.chars().count() as f64 * 14.0 < width * UNIT);
    let head = if title.is_some() { 60.0 } else { 20.0 };
    let figure = Figure::new(panel).size(width * UNIT, height * UNIT + head);
    Ok(match title {
        Some(title) => figure.title(plain(title)),
        None => figure,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::machine::CATALOGUE;

    /// Every stop, joint and body of the catalogue is named in its drawing.
    #[test]
    fn every_part_is_named() {
        for entry in CATALOGUE {
            let source = entry.source().unwrap();
            let svg = figure(&source).unwrap().to_svg();
            let machine = source.machine().unwrap();
            let stops = machine.stops().iter().map(|stop| stop.name.clone());
            let joints = machine.joints().iter().map(|joint| joint.name.clone());
            let bodies = source.machine.bodies.names().into_iter().map(str::to_owned);
            for name in stops.chain(joints).chain(bodies) {
                assert!(svg.contains(&format!(">{name}<")), "{}: {name}", entry.name);
            }
            assert!(!svg.contains("NaN"), "{}", entry.name);
            // the expansion has the same parts
            let expanded = figure(&source.expansion().unwrap()).unwrap().to_svg();
            for stop in machine.stops() {
                assert!(expanded.contains(&format!(">{}<", stop.name)), "{}: {}", entry.name, stop.name);
            }
        }
    }
}
