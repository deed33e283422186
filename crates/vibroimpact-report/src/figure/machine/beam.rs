//! A structure with modes, as a beam with its points in the order of the file. Positive displacement is upwards.

use super::glyphs::{Sketch, Way};
use super::model::{Item, Kind, Model, Place};
use crate::number::short;
use vibroimpact_plot::{Anchor, Colour};

/// Distance of the points.
const STEP: f64 = 3.6;
/// Half of the height of the beam.
const HALF: f64 = 0.13;
/// Length of what stands at a point.
const LONG: f64 = 2.2;

pub(super) fn draw(model: &Model) -> Sketch {
    let mut sketch = Sketch::default();
    let length = STEP * model.points.len() as f64;
    let at = |point: usize| STEP * (point as f64 + 1.0) - 0.15;
    if model.held {
        sketch.ground(Way { from: (0.3, 0.0), to: (0.0, 0.0) }, 0.9);
    }
    sketch.line(&[(0.0, HALF), (length, HALF), (length, -HALF), (0.0, -HALF), (0.0, HALF)], Colour::BLACK, 2.5);
    sketch.text((0.25, HALF + 0.32), &model.modes, Anchor::Start);
    // what stands at each point, above and below it
    let mut taken = vec![[0.0_f64; 2]; model.points.len()];
    let mut bodies: Vec<Option<(f64, f64)>> = vec![None; model.bodies.len()];
    for item in &model.items {
        let (point, far, above) = match item.ends {
            [Place::Point(point), far] => (point, far, item.kind != Kind::Slider && !link_to_ground(item)),
            [far, Place::Point(point)] => (point, far, false),
            _ => continue,
        };
        let side = usize::from(!above);
        let x = at(point) - taken[point][side];
        taken[point][side] += 1.6;
        let up = if above { 1.0 } else { -1.0 };
        let way = Way { from: (x, up * HALF), to: (x, up * (HALF + LONG)) };
        sketch.item(way, item);
        match far {
            Place::Body(body) if bodies[body].is_none() => {
                let y = up * (HALF + LONG + 0.6);
                sketch.body((x, y), (2.0, 1.2), &model.bodies[body].0, &format!("m {}", short(model.bodies[body].1)));
                bodies[body] = Some((x, y));
            }
            Place::Body(body) => {
                let (bx, by) = bodies[body].unwrap_or((x, up * (HALF + LONG)));
                sketch.line(&[way.to, (bx, by)], Colour::BLACK, 4.0);
            }
            _ => sketch.ground(way, 0.5),
        }
        sketch.text((x + 0.4, up * (HALF + 0.62 * LONG) + 0.17), &item.label[0], Anchor::Start);
        sketch.text((x + 0.4, up * (HALF + 0.62 * LONG) - 0.17), &item.label[1], Anchor::Start);
    }
    for (k, name) in model.points.iter().enumerate() {
        let used = |place: &Place| *place == Place::Point(k);
        let driven = model.driven.iter().any(used);
        let loaded = model.loaded.iter().any(|(place, _)| used(place));
        sketch.line(&[(at(k), HALF), (at(k), -HALF)], Colour::BLACK, 4.0);
        sketch.text((at(k) - 0.2, -HALF - 0.3), name, Anchor::End);
        if driven || loaded {
            let x = at(k) - 0.6;
            sketch.arrow(Way { from: (x, HALF + 0.1), to: (x, HALF + 1.3) });
            sketch.text((x - 0.2, HALF + 0.9), if driven { "force" } else { "constant" }, Anchor::End);
        }
    }
    // bodies that nothing joins to the structure
    let mut right = length + 2.2;
    for ((name, mass), _) in model.bodies.iter().zip(&bodies).filter(|(_, place)| place.is_none()) {
        sketch.body((right, 0.0), (2.0, 1.2), name, &format!("m {}", short(*mass)));
        right += 2.6;
    }
    loose(&mut sketch, model);
    sketch
}

fn link_to_ground(item: &Item) -> bool {
    matches!(item.kind, Kind::Link { .. }) && item.ends[1] == Place::Ground
}

/// Items that no point has are listed below.
fn loose(sketch: &mut Sketch, model: &Model) {
    let at_point = |item: &&Item| item.ends.iter().any(|place| matches!(place, Place::Point(_)));
    let mut y = -3.6;
    for item in model.items.iter().filter(|item| !at_point(item)) {
        sketch.text((0.25, y), &item.label[0], Anchor::Start);
        sketch.text((3.0, y), &item.label[1], Anchor::Start);
        y -= 0.4;
    }
}
