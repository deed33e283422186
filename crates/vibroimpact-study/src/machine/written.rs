//! The numbers of a machine file by path, as they are written there.
//!
//! | path | number |
//! |---|---|
//! | `body.B.mass` | mass of a body |
//! | `link.L.stiffness`, `.damping` | of a link |
//! | `mode.K.frequency`, `.frequency_hz`, `.damping_ratio`, `.modal_mass`, `.shape.P` | of a mode, counted from 1 |
//! | `modal_damping.K` | damping ratio of a mode of the matrices |
//! | `frequency_hz` | frequency of the forcing |
//! | `force.H.cos.P`, `force.H.sin.P` | amplitude at a body or point |
//! | `stop.S.direction.P`, `friction.J.direction.P` | of a direction that is a table |
//! | all paths of [`vibroimpact::machine`] | where the file has the number |

use super::number::NumberText;
use super::places::name_of_mode;
use super::shapes::{MatrixText, VectorText};
use super::structure::name_of_link;
use super::text::WrittenMachine;

/// Each number that is written, with its path. A number in two places of a symmetric matrix is there twice.
pub(super) fn numbers(text: &mut WrittenMachine) -> Vec<(String, &mut NumberText)> {
    let coordinates = coordinates(text);
    let mut all = Vec::new();
    let bodies = text.bodies.0.iter_mut();
    all.extend(bodies.map(|(name, mass)| (format!("body.{name}.mass"), mass)));
    for (k, mode) in text.mode.iter_mut().enumerate() {
        let fields = [
            ("frequency", &mut mode.frequency),
            ("frequency_hz", &mut mode.frequency_hz),
            ("damping_ratio", &mut mode.damping_ratio),
            ("modal_mass", &mut mode.modal_mass),
        ];
        given(&mut all, &format!("mode.{}", k + 1), fields);
        let shape = mode.shape.0.iter_mut();
        all.extend(shape.map(|(point, value)| (format!("mode.{}.shape.{point}", k + 1), value)));
    }
    for (kind, matrix) in [("mass", &mut text.mass), ("damping", &mut text.damping), ("stiffness", &mut text.stiffness)]
    {
        of_matrix(&mut all, kind, matrix, &coordinates);
    }
    for (k, ratio) in text.modal_damping.iter_mut().flatten().enumerate() {
        all.push((format!("modal_damping.{}", k + 1), ratio));
    }
    for link in &mut text.link {
        let path = format!("link.{}", name_of_link(link));
        given(&mut all, &path, [("stiffness", &mut link.stiffness), ("damping", &mut link.damping)]);
    }
    of_vector(&mut all, "constant", &mut text.constant, &coordinates);
    let frequencies = [("frequency", &mut text.frequency), ("frequency_hz", &mut text.frequency_hz)];
    all.extend(frequencies.into_iter().filter_map(|(name, number)| Some((name.to_owned(), number.as_mut()?))));
    for force in &mut text.force {
        for (side, amplitude) in [("cos", &mut force.cos), ("sin", &mut force.sin)] {
            let path = format!("force.{}.{side}", force.order.unwrap_or(1));
            match (amplitude, &force.at) {
                (Some(VectorText::One(number)), Some(at)) => all.push((format!("{path}.{at}"), number)),
                (amplitude, _) => of_vector(&mut all, &path, amplitude, &coordinates),
            }
        }
    }
    for stop in &mut text.stop {
        let path = format!("stop.{}", stop.name);
        all.push((format!("{path}.gap"), &mut stop.gap));
        let fields = [
            ("restitution", &mut stop.restitution),
            ("stiffness", &mut stop.stiffness),
            ("damping", &mut stop.damping),
            ("preload", &mut stop.preload),
        ];
        given(&mut all, &path, fields);
        of_vector(&mut all, &format!("{path}.direction"), &mut stop.direction, &coordinates);
        for motion in &mut stop.motion {
            let path = format!("{path}.motion.{}", motion.order.unwrap_or(1));
            given(&mut all, &path, [("cos", &mut motion.cos), ("sin", &mut motion.sin)]);
        }
    }
    for joint in &mut text.friction {
        let path = format!("friction.{}", joint.name);
        all.push((format!("{path}.sliding"), &mut joint.sliding));
        given(&mut all, &path, [("static", &mut joint.limit), ("belt", &mut joint.belt)]);
        of_vector(&mut all, &format!("{path}.direction"), &mut joint.direction, &coordinates);
    }
    all
}

/// The names of the coordinates, as far as they are known without an expansion.
fn coordinates(text: &WrittenMachine) -> Vec<String> {
    text.coordinates.clone().unwrap_or_else(|| {
        let bodies = text.bodies.names().into_iter().map(str::to_owned);
        (1..=text.mode.len()).map(name_of_mode).chain(bodies).collect()
    })
}

type Found<'a> = Vec<(String, &'a mut NumberText)>;

fn given<'a, const N: usize>(all: &mut Found<'a>, path: &str, fields: [(&str, &'a mut Option<NumberText>); N]) {
    let fields = fields.into_iter();
    all.extend(fields.filter_map(|(name, number)| Some((format!("{path}.{name}"), number.as_mut()?))));
}

fn of_vector<'a>(all: &mut Found<'a>, path: &str, vector: &'a mut Option<VectorText>, names: &[String]) {
    match vector {
        Some(VectorText::List(list)) => {
            all.extend(names.iter().zip(list).map(|(name, number)| (format!("{path}.{name}"), number)));
        }
        Some(VectorText::Named(table)) => {
            all.extend(table.0.iter_mut().map(|(name, number)| (format!("{path}.{name}"), number)));
        }
        _ => {}
    }
}

fn of_matrix<'a>(all: &mut Found<'a>, path: &str, matrix: &'a mut Option<MatrixText>, names: &[String]) {
    match matrix {
        Some(MatrixText::Diagonal(list)) => {
            all.extend(names.iter().zip(list).map(|(name, number)| (format!("{path}.{name}"), number)));
        }
        Some(MatrixText::Rows(rows)) => {
            for (i, (row, one)) in rows.iter_mut().zip(names).enumerate() {
                for (j, (number, other)) in row.iter_mut().zip(names).enumerate() {
                    // one path for the two places of a number, in the order of the coordinates
                    let path = match i.cmp(&j) {
                        core::cmp::Ordering::Equal => format!("{path}.{one}"),
                        core::cmp::Ordering::Less => format!("{path}.{one}.{other}"),
                        core::cmp::Ordering::Greater => format!("{path}.{other}.{one}"),
                    };
                    all.push((path, number));
                }
            }
        }
        None => {}
    }
}

/// The path under which a number is listed: `mass.b.a` is `mass.a.b`, and `mass.a.a` is `mass.a`.
pub(super) fn listed_path(text: &WrittenMachine, path: &str) -> String {
    let words: Vec<&str> = path.split('.').collect();
    if let [kind @ ("mass" | "damping" | "stiffness"), one, other] = words.as_slice() {
        let names = coordinates(text);
        let place = |name: &str| names.iter().position(|known| known == name);
        return match (place(one), place(other)) {
            (Some(i), Some(j)) if i == j => format!("{kind}.{one}"),
            (Some(i), Some(j)) if i > j => format!("{kind}.{other}.{one}"),
            _ => path.to_owned(),
        };
    }
    path.to_owned()
}
