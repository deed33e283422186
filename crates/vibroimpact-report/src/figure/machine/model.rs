//! What a schematic shows, from the description of a machine and its expansion.

use crate::number::short;
use vibroimpact::machine::{MachineParts, StopLaw};
use vibroimpact::math::Matrix;
use vibroimpact_study::machine::{MachineFileError, MachineSource, Named, NumberText, VectorText, WrittenMachine};

/// Bodies, the points of a structure with modes, and what is between them.
pub(super) struct Model {
    /// Names and masses of bodies.
    pub(super) bodies: Vec<(String, f64)>,
    /// Names of the points of a structure with modes.
    pub(super) points: Vec<String>,
    /// A sentence about the modes.
    pub(super) modes: String,
    /// Whether the structure is held: it has no rigid-body mode.
    pub(super) held: bool,
    /// Springs, dampers, stops and sliders.
    pub(super) items: Vec<Item>,
    /// Places with harmonic forces, and with constant ones and their signs.
    pub(super) driven: Vec<Place>,
    pub(super) loaded: Vec<(Place, bool)>,
}

/// Where an end of an item is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Body(usize),
    Point(usize),
    Ground,
}

/// Something between two places. A stop closes when the first moves towards the second in positive direction.
pub(super) struct Item {
    pub(super) ends: [Place; 2],
    pub(super) kind: Kind,
    /// Its name, and its numbers.
    pub(super) label: [String; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Link { spring: bool, damper: bool },
    Rigid,
    Compliant { damper: bool },
    Slider,
}

pub(super) fn of(source: &MachineSource) -> Result<Model, MachineFileError> {
    let (text, parts) = (&source.machine, source.machine()?.parts().clone());
    let modes = text.mode.len();
    let points: Vec<String> =
        text.mode.first().map(|mode| mode.shape.names().into_iter().map(str::to_owned).collect()).unwrap_or_default();
    let names = &parts.coordinates[modes..];
    let bodies = names.iter().enumerate().map(|(k, name)| (name.clone(), parts.mass[(modes + k, modes + k)])).collect();
    let frequency = |k: usize| (parts.stiffness[(k, k)] / parts.mass[(k, k)]).max(0.0).sqrt();
    let mut model = Model {
        bodies,
        modes: match modes {
            0 => String::new(),
            1 => format!("1 mode, frequency {}", short(frequency(0))),
            n => format!("{n} modes, frequencies {} to {}", short(frequency(0)), short(frequency(n - 1))),
        },
        held: (0..modes).all(|k| parts.stiffness[(k, k)] > 0.0),
        points,
        items: Vec::new(),
        driven: Vec::new(),
        loaded: Vec::new(),
    };
    links(&mut model, source, &parts);
    stops(&mut model, text, &parts);
    forces(&mut model, text, &parts);
    Ok(model)
}

impl Model {
    /// What a name stands for; `modes` coordinates come before those of the bodies.
    fn place(&self, name: &str) -> Place {
        let body = self.bodies.iter().position(|(known, _)| known == name).map(Place::Body);
        let point = || self.points.iter().position(|known| known == name).map(Place::Point);
        body.or_else(point).unwrap_or(Place::Ground)
    }

    /// The two places that a direction joins: the largest positive and the largest negative part.
    fn ends(
        &self,
        forms: (Option<&VectorText>, Option<&[String; 2]>, Option<&String>),
        direction: &[f64],
        names: &[String],
    ) -> [Place; 2] {
        match forms {
            (_, Some(names), _) => [self.place(&names[0]), self.place(&names[1])],
            (_, _, Some(name)) => [self.place(name), Place::Ground],
            (vector, _, _) => {
                let named: Vec<(&str, f64)> = match vector {
                    // values that are expressions count by their sign in the expansion only
                    Some(VectorText::Named(table)) => {
                        let value = |number: &NumberText| number.value(&Named::default()).unwrap_or(1.0);
                        table.0.iter().map(|(name, number)| (name.as_str(), value(number))).collect()
                    }
                    _ => names.iter().map(String::as_str).zip(direction.iter().copied()).collect(),
                };
                let most = |sign: f64| {
                    let all = named.iter().filter(|(_, value)| value * sign > 0.0);
                    let best = all.max_by(|a, b| (a.1 * sign).total_cmp(&(b.1 * sign)));
                    best.map_or(Place::Ground, |(name, _)| self.place(name))
                };
                [most(1.0), most(-1.0)]
            }
        }
    }
}

/// Links by name where the file has them; else those that the matrices amount to.
fn links(model: &mut Model, source: &MachineSource, parts: &MachineParts) {
    let text = &source.machine;
    let label = |stiffness: f64, damping: f64| {
        let one = |name: &str, value: f64| if value == 0.0 { None } else { Some(format!("{name} {}", short(value))) };
        [one("k", stiffness), one("c", damping)].into_iter().flatten().collect::<Vec<_>>().join(", ")
    };
    let mut add = |ends: [Place; 2], name: String, stiffness: f64, damping: f64| {
        let kind = Kind::Link { spring: stiffness != 0.0, damper: damping != 0.0 };
        model.items.push(Item { ends, kind, label: [name, label(stiffness, damping)] });
    };
    if !text.link.is_empty() {
        for link in &source.machine.link {
            let name = link.name.clone().unwrap_or_else(|| link.between.join("-"));
            // a number that is absent is 0
            let number = |field: &str| source.number(&format!("link.{name}.{field}")).unwrap_or(0.0);
            let ends = link.between.each_ref().map(|name| place_of(&parts.coordinates, text, name));
            add(ends, link.name.clone().unwrap_or_default(), number("stiffness"), number("damping"));
        }
        return;
    }
    let modes = text.mode.len();
    let n = parts.coordinates.len() - modes;
    let at = |matrix: &Matrix, i: usize, j: usize| matrix[(modes + i, modes + j)];
    for i in 0..n {
        let rest = |matrix| (0..n).map(|j| at(matrix, i, j)).sum::<f64>();
        let near = |value: f64, scale: f64| if value.abs() < 1e-9 * scale { 0.0 } else { value };
        let k = near(rest(&parts.stiffness), at(&parts.stiffness, i, i));
        let c = near(rest(&parts.damping), at(&parts.damping, i, i));
        if k != 0.0 || c != 0.0 {
            add([Place::Body(i), Place::Ground], String::new(), k, c);
        }
        for j in i + 1..n {
            let (k, c) = (-at(&parts.stiffness, i, j), -at(&parts.damping, i, j));
            if k != 0.0 || c != 0.0 {
                add([Place::Body(i), Place::Body(j)], String::new(), k + 0.0, c + 0.0);
            }
        }
    }
}

/// The place of a name of the file.
fn place_of(coordinates: &[String], text: &WrittenMachine, name: &str) -> Place {
    let modes = text.mode.len();
    let named = text.bodies.names().iter().position(|known| *known == name);
    let body = named.or_else(|| coordinates.iter().skip(modes).position(|known| known == name)).map(Place::Body);
    let points = text.mode.first().map(|mode| mode.shape.names()).unwrap_or_default();
    body.or_else(|| points.iter().position(|known| *known == name).map(Place::Point)).unwrap_or(Place::Ground)
}

fn stops(model: &mut Model, text: &WrittenMachine, parts: &MachineParts) {
    let names = &parts.coordinates;
    for (stop, written) in parts.stops.iter().zip(&text.stop) {
        let forms = (written.direction.as_ref(), written.between.as_ref(), written.at.as_ref());
        let (kind, law) = match stop.law {
            StopLaw::Rigid { restitution } => (Kind::Rigid, format!("e {}", short(restitution))),
            StopLaw::Compliant { stiffness, damping, .. } => {
                (Kind::Compliant { damper: damping != 0.0 }, format!("k {}", short(stiffness)))
            }
        };
        let moves = if stop.motion.is_empty() { "" } else { ", moves" };
        let label = [stop.name.clone(), format!("gap {}, {law}{moves}", short(stop.gap))];
        let ends = model.ends(forms, &stop.direction, names);
        model.items.push(Item { ends, kind, label });
    }
    for (joint, written) in parts.joints.iter().zip(&text.friction) {
        let forms = (written.direction.as_ref(), written.between.as_ref(), written.at.as_ref());
        let mut numbers = short(joint.sliding);
        if joint.limit != joint.sliding {
            numbers += &format!(" to {}", short(joint.limit));
        }
        if joint.belt != 0.0 {
            numbers += ", belt";
        }
        let label = [joint.name.clone(), format!("friction {numbers}")];
        let ends = model.ends(forms, &joint.direction, names);
        model.items.push(Item { ends, kind: Kind::Slider, label });
    }
}

fn forces(model: &mut Model, text: &WrittenMachine, parts: &MachineParts) {
    let modes = text.mode.len();
    let mut named: Vec<&str> = Vec::new();
    for force in &text.force {
        named.extend(force.at.as_deref());
        for table in [&force.cos, &force.sin].into_iter().flatten() {
            if let VectorText::Named(table) = table {
                named.extend(table.names());
            }
        }
    }
    let mut places: Vec<Place> = named.iter().map(|name| model.place(name)).collect();
    let on = |k: usize| parts.forces.iter().any(|force| force.cos[k] != 0.0 || force.sin[k] != 0.0);
    places.extend((modes..parts.n()).filter(|k| on(*k)).map(|k| Place::Body(k - modes)));
    for place in places {
        if place != Place::Ground && !model.driven.contains(&place) {
            model.driven.push(place);
        }
    }
    if let Some(VectorText::Named(table)) = &text.constant {
        let points = table.names().into_iter().map(|name| (model.place(name), true));
        model.loaded.extend(points.filter(|(place, _)| matches!(place, Place::Point(_))).collect::<Vec<_>>());
    }
    let bodies = (modes..parts.n()).filter(|k| parts.constant[*k] != 0.0);
    model.loaded.extend(bodies.map(|k| (Place::Body(k - modes), parts.constant[k] > 0.0)));
}
