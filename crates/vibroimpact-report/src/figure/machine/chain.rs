//! Bodies in a row. Positive displacement is to the right. What joins bodies that are not neighbours has an arm below.

use super::glyphs::{Sketch, Way};
use super::model::{Item, Kind, Model, Place};
use crate::number::short;
use vibroimpact::math::sort_by_key;
use vibroimpact_plot::{Anchor, Colour};

const BODY: f64 = 2.0;
/// The smallest width of a space with items; long labels widen it.
const SLOT: f64 = 3.0;
const LANE: f64 = 1.75;

/// An item in the space on one side of a body.
struct Placed<'a> {
    item: &'a Item,
    /// The body to which it is fixed, and whether it is on its right.
    body: usize,
    right: bool,
    /// What is at its other end.
    far: Far,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Far {
    Neighbour,
    Ground,
    /// An arm of a body.
    Arm(usize),
}

fn placed(item: &Item, n: usize) -> Option<Placed<'_>> {
    let beside = |body: usize, other: usize| if other == body + 1 { Far::Neighbour } else { Far::Arm(other) };
    Some(match item.ends {
        [Place::Body(a), Place::Body(b)] => match item.kind {
            Kind::Link { .. } | Kind::Slider => {
                let (a, b) = (a.min(b), a.max(b));
                Placed { item, body: a, right: true, far: beside(a, b) }
            }
            _ => Placed { item, body: a, right: true, far: beside(a, b) },
        },
        [Place::Body(body), Place::Ground] | [Place::Ground, Place::Body(body)] => {
            let right = match item.kind {
                Kind::Slider => return None,
                Kind::Link { .. } => n > 1 && body == n - 1,
                _ => item.ends[1] == Place::Ground,
            };
            Placed { item, body, right, far: Far::Ground }
        }
        _ => return None,
    })
}

pub(super) fn draw(model: &Model) -> Sketch {
    let n = model.bodies.len();
    let mut slots: Vec<Vec<Placed<'_>>> = (0..=n).map(|_| Vec::new()).collect();
    for one in model.items.iter().filter_map(|item| placed(item, n)) {
        slots[one.body + usize::from(one.right)].push(one);
    }
    for slot in &mut slots {
        // arms come from below
        sort_by_key(slot, |one| one.far);
    }
    let lanes = slots.iter().map(Vec::len).max().unwrap_or(0).max(1) as f64;
    let high = 1.5 + (lanes - 1.0) * LANE;
    // left ends of the slots and of the bodies
    let wide = |slot: &Vec<Placed<'_>>| {
        let letters = slot.iter().flat_map(|one| &one.item.label).map(|text| text.chars().count()).max();
        letters.map_or(0.8, |letters| SLOT.max(0.19 * letters as f64 + 1.0))
    };
    let (mut x, mut starts, mut bodies) = (0.0, Vec::new(), Vec::new());
    for (k, slot) in slots.iter().enumerate() {
        starts.push(x);
        x += wide(slot);
        if k < n {
            bodies.push(x);
            x += BODY;
        }
    }
    let mut sketch = Sketch::default();
    floors(&mut sketch, model, &bodies, high);
    for (k, (name, mass)) in model.bodies.iter().enumerate() {
        sketch.body((bodies[k] + BODY / 2.0, 0.0), (BODY, high), name, &format!("m {}", short(*mass)));
    }
    let friction = model.items.iter().any(|item| item.kind == Kind::Slider);
    let mut arms = if friction { high / 2.0 + 1.3 } else { high / 2.0 + 0.5 };
    for (slot, start) in slots.iter().zip(&starts) {
        let end = start + wide(slot);
        for (lane, one) in slot.iter().enumerate() {
            let y = ((slot.len() as f64 - 1.0) / 2.0 - lane as f64) * LANE + 0.25;
            let (near, far) = if one.right { (*start, end) } else { (end, *start) };
            let inside = near + (far - near) * 0.86;
            let way = Way { from: (near, y), to: (if one.far == Far::Neighbour { far } else { inside }, y) };
            sketch.item(way, one.item);
            match one.far {
                Far::Neighbour => {}
                Far::Ground => sketch.ground(way, 0.38),
                Far::Arm(body) => {
                    let foot = bodies[body] + BODY * if body < one.body { 0.35 } else { 0.65 };
                    let corners = [(foot, -high / 2.0), (foot, -arms), (inside, -arms), (inside, y)];
                    sketch.line(&corners, Colour::BLACK, 4.0);
                    arms += 0.35;
                }
            }
            let middle = (start + end) / 2.0;
            let both =
                matches!(one.item.kind, Kind::Link { spring: true, damper: true } | Kind::Compliant { damper: true });
            let mut line = y - if both { 0.73 } else { 0.5 };
            for label in one.item.label.iter().filter(|label| !label.is_empty()) {
                sketch.text((middle, line), label, Anchor::Middle);
                line -= 0.31;
            }
        }
    }
    arrows(&mut sketch, model, &bodies, high);
    sketch
}

/// Friction on the ground, below the bodies.
fn floors(sketch: &mut Sketch, model: &Model, bodies: &[f64], high: f64) {
    for item in model.items.iter().filter(|item| item.kind == Kind::Slider) {
        if let [Place::Body(body), Place::Ground] | [Place::Ground, Place::Body(body)] = item.ends {
            let (x, y) = (bodies[body] + BODY / 2.0, -high / 2.0);
            sketch.ground(Way { from: (x, y), to: (x, y - 0.07) }, BODY / 2.0 + 0.3);
            sketch.text((x, y - 0.55), &item.label[0], Anchor::Middle);
            sketch.text((x, y - 0.87), &item.label[1], Anchor::Middle);
        }
    }
}

/// Forces, above the bodies.
fn arrows(sketch: &mut Sketch, model: &Model, bodies: &[f64], high: f64) {
    let mut raised = vec![high / 2.0 + 0.35; bodies.len()];
    let mut arrow = |body: usize, positive: bool, label: &str| {
        let (x, y) = (bodies[body] + BODY / 2.0, raised[body]);
        let (from, to) = if positive { (x - 0.6, x + 0.6) } else { (x + 0.6, x - 0.6) };
        sketch.arrow(Way { from: (from, y), to: (to, y) });
        sketch.text((x, y + 0.32), label, Anchor::Middle);
        raised[body] += 0.85;
    };
    for place in &model.driven {
        if let Place::Body(body) = place {
            arrow(*body, true, "force");
        }
    }
    for (place, positive) in &model.loaded {
        if let Place::Body(body) = place {
            arrow(*body, *positive, "constant");
        }
    }
}
