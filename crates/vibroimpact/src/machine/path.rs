//! The numbers of a machine by path.
//!
//! | path | number |
//! |---|---|
//! | `mass.A`, `mass.A.B` (also `damping`, `stiffness`) | on the diagonal; in both places of a symmetric matrix |
//! | `constant.A` | constant force on a coordinate |
//! | `frequency` | frequency of the forcing |
//! | `force.H.cos.A`, `force.H.sin.A` | amplitude of the harmonic of order H on a coordinate |
//! | `stop.S.gap`, `.restitution`, `.stiffness`, `.damping`, `.preload` | of a stop |
//! | `stop.S.direction.A`, `stop.S.motion.H.cos`, `.sin` | of a stop |
//! | `friction.J.sliding`, `.static`, `.belt`, `.direction.A` | of a friction joint |

use super::parts::{FrictionJoint, HarmonicForce, HarmonicMotion, MachineParts, Stop, StopLaw};
use super::{Fault, MachineError};
use crate::math::Matrix;

impl MachineParts {
    /// The number at a path, as `stop.wall.gap`. Vectors and matrices must have the sizes of the coordinates.
    ///
    /// # Errors
    /// [`MachineError`] if the path leads to no number.
    pub fn number(&self, path: &str) -> Result<f64, MachineError> {
        // the same places serve reading and writing
        let mut copy = self.clone();
        places(&mut copy, path).map(|found| match found {
            Places::One(place) => *place,
            Places::Matrix(matrix, i, j) => matrix[(i, j)],
        })
    }

    /// Sets the number at a path. A number of a symmetric matrix changes in both places.
    ///
    /// # Errors
    /// [`MachineError`] if the path leads to no number.
    pub fn set(&mut self, path: &str, value: f64) -> Result<(), MachineError> {
        match places(self, path)? {
            Places::One(place) => *place = value,
            Places::Matrix(matrix, i, j) => (matrix[(i, j)], matrix[(j, i)]) = (value, value),
        }
        Ok(())
    }
}

/// Where a number stands.
enum Places<'a> {
    One(&'a mut f64),
    Matrix(&'a mut Matrix, usize, usize),
}

fn places<'a>(parts: &'a mut MachineParts, path: &str) -> Result<Places<'a>, MachineError> {
    let unknown = |hint: String| MachineError::new(path, Fault::NoNumber(hint));
    let words: Vec<&str> = path.split('.').collect();
    let names = parts.coordinates.clone();
    let coordinate = |name: &str| {
        let place = names.iter().position(|known| known == name);
        place.ok_or_else(|| unknown(format!("the coordinates are {}", names.join(", "))))
    };
    match words.as_slice() {
        [kind @ ("mass" | "damping" | "stiffness"), rest @ ..] if (1..=2).contains(&rest.len()) => {
            let (i, j) = (coordinate(rest[0])?, coordinate(rest[rest.len() - 1])?);
            let matrix = match *kind {
                "mass" => &mut parts.mass,
                "damping" => &mut parts.damping,
                _ => &mut parts.stiffness,
            };
            Ok(Places::Matrix(matrix, i, j))
        }
        ["constant", name] => Ok(Places::One(&mut parts.constant[coordinate(name)?])),
        ["frequency"] => {
            parts.frequency.as_mut().map(Places::One).ok_or_else(|| unknown("this machine has no forcing".to_owned()))
        }
        ["force", order, side, name] => {
            let place = coordinate(name)?;
            let orders = listed(parts.forces.iter().map(|force| force.order.to_string()));
            let force = parts.forces.iter_mut().find(|force| force.order.to_string() == *order);
            let force = force.ok_or_else(|| unknown(format!("the orders of the force are {orders}")))?;
            let amplitude = match *side {
                "cos" => &mut force.cos,
                "sin" => &mut force.sin,
                _ => return Err(unknown(format!("force.{order}.cos.{name} or force.{order}.sin.{name}"))),
            };
            Ok(Places::One(&mut amplitude[place]))
        }
        ["stop", name, rest @ ..] => {
            let all = listed(parts.stops.iter().map(|stop| stop.name.clone()));
            let stop = parts.stops.iter_mut().find(|stop| stop.name == *name);
            let stop = stop.ok_or_else(|| unknown(format!("the stops are {all}")))?;
            let numbers = listed(numbers_of_stop(stop).into_iter());
            if let ["direction", name] = rest {
                return Ok(Places::One(&mut stop.direction[coordinate(name)?]));
            }
            in_stop(stop, rest).map(Places::One).ok_or_else(|| unknown(format!("the numbers of {name} are {numbers}")))
        }
        ["friction", name, rest @ ..] => {
            let all = listed(parts.joints.iter().map(|joint| joint.name.clone()));
            let joint = parts.joints.iter_mut().find(|joint| joint.name == *name);
            let joint = joint.ok_or_else(|| unknown(format!("the friction joints are {all}")))?;
            match rest {
                ["sliding"] => {
                    // a static limit that was not given follows the sliding force
                    Ok(Places::One(&mut joint.sliding))
                }
                ["static"] => Ok(Places::One(&mut joint.limit)),
                ["belt"] => Ok(Places::One(&mut joint.belt)),
                ["direction", name] => Ok(Places::One(&mut joint.direction[coordinate(name)?])),
                _ => Err(unknown(format!("the numbers of {name} are sliding, static, belt, direction.COORDINATE"))),
            }
        }
        _ => Err(unknown(
            "paths begin with mass, damping, stiffness, constant, frequency, force, stop or friction".to_owned(),
        )),
    }
}

fn in_stop<'a>(stop: &'a mut Stop, rest: &[&str]) -> Option<&'a mut f64> {
    match (rest, &mut stop.law) {
        (["gap"], _) => Some(&mut stop.gap),
        (["restitution"], StopLaw::Rigid { restitution }) => Some(restitution),
        (["stiffness"], StopLaw::Compliant { stiffness, .. }) => Some(stiffness),
        (["damping"], StopLaw::Compliant { damping, .. }) => Some(damping),
        (["preload"], StopLaw::Compliant { preload, .. }) => Some(preload),
        (["motion", order, side], _) => {
            let motion = stop.motion.iter_mut().find(|motion| motion.order.to_string() == *order)?;
            match *side {
                "cos" => Some(&mut motion.cos),
                "sin" => Some(&mut motion.sin),
                _ => None,
            }
        }
        _ => None,
    }
}

fn listed(all: impl Iterator<Item = String>) -> String {
    let all: Vec<String> = all.collect();
    if all.is_empty() { "none".to_owned() } else { all.join(", ") }
}

fn numbers_of_stop(stop: &Stop) -> Vec<String> {
    let law: &[&str] = match stop.law {
        StopLaw::Rigid { .. } => &["gap", "restitution"],
        StopLaw::Compliant { .. } => &["gap", "stiffness", "damping", "preload"],
    };
    let motion =
        |HarmonicMotion { order, .. }: &HarmonicMotion| [format!("motion.{order}.cos"), format!("motion.{order}.sin")];
    law.iter().map(|&name| name.to_owned()).chain(stop.motion.iter().flat_map(motion)).collect()
}

/// All numbers that are not zero, and those that every stop, joint and diagonal has, with their paths.
pub(super) fn all(parts: &MachineParts) -> Vec<(String, f64)> {
    let names = &parts.coordinates;
    let mut all = Vec::new();
    for (kind, matrix) in [("mass", &parts.mass), ("damping", &parts.damping), ("stiffness", &parts.stiffness)] {
        for (i, one) in names.iter().enumerate() {
            let row = matrix.row(i);
            all.push((format!("{kind}.{one}"), row[i]));
            // symmetric, so each pair once
            let others = names.iter().zip(row).skip(i + 1).filter(|(_, value)| **value != 0.0);
            all.extend(others.map(|(other, value)| (format!("{kind}.{one}.{other}"), *value)));
        }
    }
    let of = |path: &str, values: &[f64]| -> Vec<(String, f64)> {
        let values = names.iter().zip(values).filter(|(_, value)| **value != 0.0);
        values.map(|(name, value)| (format!("{path}.{name}"), *value)).collect()
    };
    all.extend(of("constant", &parts.constant));
    all.extend(parts.frequency.map(|frequency| ("frequency".to_owned(), frequency)));
    for HarmonicForce { order, cos, sin } in &parts.forces {
        all.extend(of(&format!("force.{order}.cos"), cos));
        all.extend(of(&format!("force.{order}.sin"), sin));
    }
    for stop in &parts.stops {
        // found as for a change, so that the listed paths are those that can be changed; that takes a stop of its own
        let mut copy = stop.clone();
        let numbers = numbers_of_stop(stop).into_iter().filter_map(|number| {
            let words: Vec<&str> = number.split('.').collect();
            let value = *in_stop(&mut copy, &words)?;
            Some((format!("stop.{}.{number}", stop.name), value))
        });
        all.extend(numbers.collect::<Vec<_>>());
    }
    for FrictionJoint { name, sliding, limit, belt, .. } in &parts.joints {
        let numbers = [("sliding", sliding), ("static", limit), ("belt", belt)];
        all.extend(numbers.map(|(number, value)| (format!("friction.{name}.{number}"), *value)));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Machine, Opening};

    fn machine() -> Machine {
        let mut parts = MachineParts::new(["a", "b"])
            .with_mass(0, 1.0)
            .with_mass(1, 2.0)
            .with_link(&[1.0, -1.0], 3.0, 0.1)
            .with_constant(1, -9.81)
            .with_frequency(0.7)
            .with_force(0, 1, 0.0, 1.0)
            .with_force(0, 3, 0.5, 0.0)
            .with_rigid_stop("wall", &[1.0, 0.0], 1.0, 0.8)
            .with_stop(
                "pad",
                &[0.0, -1.0],
                0.5,
                StopLaw::Compliant { stiffness: 100.0, damping: 1.0, preload: 2.0, opening: Opening::Force },
            )
            .with_joint("floor", &[0.0, 1.0], 0.2, 0.3, 0.0);
        parts.stops[0].motion.push(HarmonicMotion { order: 2, cos: 0.1, sin: 0.0 });
        Machine::new(parts).unwrap()
    }

    /// Each path leads to one number, which can be changed alone and back.
    #[test]
    fn every_path_reads_and_writes_one_number() {
        let machine = machine();
        let paths = machine.paths();
        assert_eq!(paths.len(), 23, "{paths:?}");
        for path in &paths {
            let before = machine.number(path).unwrap();
            // smaller masses, larger springs and limits stay allowed
            let wanted = if path == "stop.wall.restitution" || path.ends_with("sliding") { 0.1 } else { before + 1e-3 };
            if path.matches('.').count() == 2 && (path.starts_with("stiffness") || path.starts_with("damping")) {
                continue; // alone it would make the matrix indefinite
            }
            let other = machine.with(path, wanted).unwrap();
            assert_eq!(other.number(path).unwrap(), wanted, "{path}");
            assert_ne!(other, machine, "{path}");
            assert_eq!(other.with(path, before).unwrap(), machine, "{path}");
        }
    }

    #[test]
    fn wrong_paths_and_numbers_are_explained() {
        let machine = machine();
        let said = |path: &str| machine.number(path).unwrap_err().to_string();
        assert!(said("stop.wal.gap").contains("the stops are wall, pad"), "{}", said("stop.wal.gap"));
        assert!(said("stop.wall.stiffness").contains("gap, restitution, motion.2.cos"));
        assert!(said("mass.c").contains("the coordinates are a, b"));
        assert!(said("force.2.cos.a").contains("orders of the force are 1, 3"));
        assert!(said("gap").contains("paths begin with"));
        let refused = |path: &str, value: f64| machine.with(path, value).unwrap_err().to_string();
        assert!(refused("mass.a", 0.0).contains("mass: the mass matrix is not positive definite"));
        assert!(refused("stiffness.a", 0.0).contains("stiffness: the matrix has a negative eigenvalue"));
        assert!(
            refused("stop.wall.restitution", 1.5)
                .contains("stop.wall.restitution: 1.5 lies outside 0 <= restitution <= 1")
        );
        assert!(refused("friction.floor.static", 0.1).contains("static >= sliding"));
        assert!(refused("stop.wall.gap", f64::NAN).contains("not a finite number"));
        assert!(refused("frequency", 0.0).contains("frequency"));
    }
}
