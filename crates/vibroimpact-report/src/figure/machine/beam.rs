//! A structure with modes, as a beam with its points in the order of the file. Positive displacement is upwards.

use super::glyphs::{Sketch, Way};
use super::model::{Item, Kind, Model, Place};
use crate::number::short;
use vibroimpact_plot::{Anchor, Colour};

/// Distance of the points, and of what stands at one point on one side.
const STEP: f64 = 3.6;
/// Half of the height of the beam.
const HALF: f64 = 0.13;
/// Length of what stands at a point.
const LONG: f64 = 2.2;

pub(super) fn draw(model: &Model) -> Sketch {
    let mut sketch = Sketch::default();
    let most = (0..model.points.len()).map(|point| side_by_side(model, point)).max().unwrap_or(1).max(1) as f64;
    let length = most * STEP * model.points.len() as f64;
    let at = |point: usize| most * STEP * (point as f64 + 1.0) - 0.15;
    if model.held {
        sketch.ground(Way { from: (0.3, 0.0), to: (0.0, 0.0) }, 0.9);
    }
    sketch.line(&[(0.0, HALF), (length, HALF), (length, -HALF), (0.0, -HALF), (0.0, HALF)], Colour::BLACK, 2.5);
    // what stands at each point, above and below it
    let mut taken = vec![[0.0_f64; 2]; model.points.len()];
    let mut bodies: Vec<Option<(f64, f64)>> = vec![None; model.bodies.len()];
    for item in &model.items {
        let Some((point, far, above)) = stands(item) else { continue };
        let side = usize::from(!above);
        let x = at(point) - taken[point][side];
        taken[point][side] += STEP;
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
        let middle = up * (HALF + 0.62 * LONG);
        sketch.text((x + 0.5, middle + 0.17), &item.label[0], Anchor::Start);
        sketch.text((x + 0.5, middle - 0.17), &item.label[1], Anchor::Start);
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
    let below = taken.iter().any(|[_, below]| *below > 0.0);
    sketch.text((0.25, -HALF - if below { LONG + 0.7 } else { 0.8 }), &model.modes, Anchor::Start);
    loose(&mut sketch, model);
    sketch
}

/// The point at which an item stands, what is at its other end, and whether it stands above.
fn stands(item: &Item) -> Option<(usize, Place, bool)> {
    let to_ground = matches!(item.kind, Kind::Link { .. }) && item.ends[1] == Place::Ground;
    match item.ends {
        [Place::Point(point), far] => Some((point, far, item.kind != Kind::Slider && !to_ground)),
        [far, Place::Point(point)] => Some((point, far, false)),
        _ => None,
    }
}

/// The largest number of items at a point on one side.
fn side_by_side(model: &Model, point: usize) -> usize {
    let count = |above: bool| {
        let here = |found: &(usize, Place, bool)| found.0 == point && found.2 == above;
        model.items.iter().filter_map(stands).filter(here).count()
    };
    count(true).max(count(false))
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
