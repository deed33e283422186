//! The structure of a machine: its coordinates and matrices, from matrices, bodies, links and modes.

use super::error::{MachineFileError, MachineProblem};
use super::named::Named;
use super::number::NumberText;
use super::places::{Places, check_name, check_place, name_of_mode, not_negative};
use super::shapes::MatrixText;
use super::text::{LinkText, ModeText, WrittenMachine};
use core::f64::consts::TAU;
use vibroimpact::machine::{Fault, MOST_COORDINATES, MachineParts, modal_damping};
use vibroimpact::math::Matrix;

/// The names, and what they stand for.
pub(super) fn places<'a>(text: &WrittenMachine, parameters: &'a Named<f64>) -> Result<Places<'a>, MachineFileError> {
    if let Some(name) = &text.modes {
        let why = "was not read".to_owned();
        return Err(MachineFileError::new("modes", MachineProblem::File { name: name.clone(), why }));
    }
    let modes = text.mode.len();
    let own: Vec<String> =
        (1..=modes).map(name_of_mode).chain(text.bodies.0.iter().map(|body| body.0.clone())).collect();
    let coordinates = match &text.coordinates {
        Some(names) if own.is_empty() || names.len() == own.len() => names.clone(),
        Some(names) => {
            let given = format!("{} names", names.len());
            let of = format!("the modes and bodies {}", own.join(", "));
            let problem = MachineProblem::Size { given, wanted: own.len(), of };
            return Err(MachineFileError::new("coordinates", problem));
        }
        None if own.is_empty() => {
            let needed = "a list of coordinates, a table of bodies or a list of modes";
            return Err(MachineFileError::new("coordinates", MachineProblem::Missing(needed)));
        }
        None => own,
    };
    // before any matrix is made
    if coordinates.len() > MOST_COORDINATES {
        return Err(MachineFileError::new("coordinates", Fault::TooLarge(coordinates.len())));
    }
    for name in &coordinates {
        check_place("coordinates", name)?;
    }
    let mut places = Places { parameters, coordinates, others: Vec::new() };
    points(&mut places, &text.mode)?;
    for (k, (name, _)) in text.bodies.0.iter().enumerate() {
        check_place("bodies", name)?;
        let mut direction = vec![0.0; places.n()];
        direction[modes + k] = 1.0;
        define(&mut places, &format!("bodies.{name}"), name, direction)?;
    }
    Ok(places)
}

/// The points of the modes: those of the first mode, in each.
fn points(places: &mut Places<'_>, modes: &[ModeText]) -> Result<(), MachineFileError> {
    let Some(first) = modes.first() else { return Ok(()) };
    let names = first.shape.names();
    for (k, mode) in modes.iter().enumerate() {
        if mode.shape.names().iter().any(|name| !names.contains(name)) || mode.shape.0.len() != names.len() {
            let given = format!("the points {}", mode.shape.names().join(", "));
            let of = format!("the points {} of the first mode", names.join(", "));
            let problem = MachineProblem::Size { given, wanted: names.len(), of };
            return Err(MachineFileError::new(format!("mode.{}.shape", k + 1), problem));
        }
    }
    for name in names {
        check_place("mode.1.shape", name)?;
        let mut direction = vec![0.0; places.n()];
        for (k, mode) in modes.iter().enumerate() {
            let path = format!("mode.{}.shape.{name}", k + 1);
            direction[k] = places.value_or(&path, mode.shape.get(name), 0.0)?;
        }
        define(places, &format!("mode.1.shape.{name}"), name, direction)?;
    }
    Ok(())
}

/// A name stands for one direction only.
fn define(places: &mut Places<'_>, path: &str, name: &str, direction: Vec<f64>) -> Result<(), MachineFileError> {
    let other =
        places.others.iter().any(|(known, _)| known == name)
            || places.coordinates.iter().position(|known| known == name).is_some_and(|k| {
                direction.iter().enumerate().any(|(j, value)| *value != if j == k { 1.0 } else { 0.0 })
            });
    if other {
        return Err(MachineFileError::new(path, MachineProblem::Twice));
    }
    places.others.push((name.to_owned(), direction));
    Ok(())
}

/// The matrices.
pub(super) fn structure(text: &WrittenMachine, places: &Places<'_>) -> Result<MachineParts, MachineFileError> {
    let mut parts = MachineParts::new(places.coordinates.clone());
    let own = !text.mode.is_empty() || !text.bodies.is_empty();
    parts.mass = match &text.mass {
        Some(_) if own => {
            let problem = MachineProblem::Foreign("bodies and modes have masses of their own");
            return Err(MachineFileError::new("mass", problem));
        }
        Some(mass) => matrix("mass", mass, places)?,
        None if own => parts.mass,
        None => return Err(MachineFileError::new("mass", MachineProblem::Missing("the mass matrix"))),
    };
    if let Some(stiffness) = &text.stiffness {
        parts.stiffness = matrix("stiffness", stiffness, places)?;
    }
    if let Some(damping) = &text.damping {
        parts.damping = matrix("damping", damping, places)?;
    }
    for (k, mode) in text.mode.iter().enumerate() {
        add_mode(&mut parts, k, mode, places)?;
    }
    for (k, (name, mass)) in text.bodies.0.iter().enumerate() {
        let place = text.mode.len() + k;
        parts.mass[(place, place)] = places.value(&format!("body.{name}.mass"), mass)?;
    }
    let links = links(text, places)?;
    for link in &links {
        add_outer(&mut parts.stiffness, link.stiffness, &link.direction);
    }
    if let Some(ratios) = &text.modal_damping {
        if text.damping.is_some() {
            return Err(MachineFileError::new("modal_damping", MachineProblem::Several("damping and modal_damping")));
        }
        places.check_size("modal_damping", ratios.len())?;
        let ratios = places.values("modal_damping", ratios)?;
        for (k, ratio) in ratios.iter().enumerate() {
            not_negative(format!("modal_damping.{}", k + 1), "damping ratio", *ratio)?;
        }
        // without a positive definite mass matrix there are no modes, and the checks of the machine say so
        if let Some(damping) = modal_damping(&parts.mass, &parts.stiffness, &ratios) {
            for i in 0..places.n() {
                for j in 0..places.n() {
                    parts.damping[(i, j)] += damping[(i, j)];
                }
            }
        }
    }
    for link in &links {
        add_outer(&mut parts.damping, link.damping, &link.direction);
    }
    Ok(parts)
}

fn add_mode(parts: &mut MachineParts, k: usize, mode: &ModeText, places: &Places<'_>) -> Result<(), MachineFileError> {
    let whole = format!("mode.{}", k + 1);
    let path = |field: &str| format!("{whole}.{field}");
    let frequency = frequency(&path(""), mode.frequency.as_ref(), mode.frequency_hz.as_ref(), places)?;
    let needed = || MachineFileError::new(&whole, MachineProblem::Missing("frequency or frequency_hz"));
    let frequency = frequency.ok_or_else(needed)?;
    let ratio = places.value_or(&path("damping_ratio"), mode.damping_ratio.as_ref(), 0.0)?;
    not_negative(path("frequency"), "frequency", frequency)?;
    not_negative(path("damping_ratio"), "damping_ratio", ratio)?;
    let mass = places.value_or(&path("modal_mass"), mode.modal_mass.as_ref(), 1.0)?;
    parts.mass[(k, k)] = mass;
    parts.damping[(k, k)] += 2.0 * ratio * frequency * mass;
    parts.stiffness[(k, k)] += frequency * frequency * mass;
    Ok(())
}

/// An angular frequency that is written in one of two forms; `before` is the path of the part, with its dot.
pub(super) fn frequency(
    before: &str,
    angular: Option<&NumberText>,
    hertz: Option<&NumberText>,
    places: &Places<'_>,
) -> Result<Option<f64>, MachineFileError> {
    match (angular, hertz) {
        (Some(_), Some(_)) => Err(MachineFileError::new(
            format!("{before}frequency_hz"),
            MachineProblem::Several("frequency and frequency_hz"),
        )),
        (Some(angular), None) => places.value(&format!("{before}frequency"), angular).map(Some),
        (None, Some(hertz)) => Ok(Some(TAU * places.value(&format!("{before}frequency_hz"), hertz)?)),
        (None, None) => Ok(None),
    }
}

struct Link {
    direction: Vec<f64>,
    stiffness: f64,
    damping: f64,
}

/// The name of a link, as written or from what it joins.
pub(super) fn name_of_link(link: &LinkText) -> String {
    link.name.clone().unwrap_or_else(|| link.between.join("-"))
}

fn links(text: &WrittenMachine, places: &Places<'_>) -> Result<Vec<Link>, MachineFileError> {
    let mut seen: Vec<String> = Vec::new();
    let mut all = Vec::new();
    for (k, link) in text.link.iter().enumerate() {
        if let Some(name) = &link.name {
            check_name("link", name)?;
        }
        // the name may come from what the link joins
        let place = link.name.clone().unwrap_or_else(|| (k + 1).to_string());
        let direction = places.between(&format!("link.{place}.between"), &link.between)?;
        let name = name_of_link(link);
        let path = format!("link.{name}");
        if direction.iter().all(|value| *value == 0.0) {
            return Err(MachineFileError::text(format!("{path}.between"), "the link joins nothing that moves"));
        }
        if seen.contains(&name) {
            return Err(MachineFileError::new(path, MachineProblem::Twice));
        }
        if link.stiffness.is_none() && link.damping.is_none() {
            return Err(MachineFileError::new(path, MachineProblem::Missing("a stiffness or a damping")));
        }
        let stiffness = places.value_or(&format!("{path}.stiffness"), link.stiffness.as_ref(), 0.0)?;
        let damping = places.value_or(&format!("{path}.damping"), link.damping.as_ref(), 0.0)?;
        for (field, value) in [("stiffness", stiffness), ("damping", damping)] {
            not_negative(format!("{path}.{field}"), field, value)?;
        }
        seen.push(name);
        all.push(Link { direction, stiffness, damping });
    }
    Ok(all)
}

/// Adds `factor * direction * direction^T`, symmetric to the last bit.
fn add_outer(matrix: &mut Matrix, factor: f64, direction: &[f64]) {
    let moved: Vec<(usize, f64)> = direction.iter().copied().enumerate().filter(|(_, value)| *value != 0.0).collect();
    for (i, one) in &moved {
        for (j, other) in &moved {
            matrix[(*i, *j)] += factor * (one * other);
        }
    }
}

fn matrix(path: &str, text: &MatrixText, places: &Places<'_>) -> Result<Matrix, MachineFileError> {
    match text {
        MatrixText::Diagonal(diagonal) => {
            places.check_size(path, diagonal.len())?;
            Ok(Matrix::diagonal(&places.values(path, diagonal)?))
        }
        MatrixText::Rows(rows) => {
            if rows.len() != places.n() {
                let given = format!("{} rows", rows.len());
                let of = format!("the coordinates {}", places.coordinates.join(", "));
                return Err(MachineFileError::new(path, MachineProblem::Size { given, wanted: places.n(), of }));
            }
            let mut matrix = Matrix::zeros(places.n(), places.n());
            for (i, (row, name)) in rows.iter().zip(&places.coordinates).enumerate() {
                let path = format!("{path}.{name}");
                places.check_size(&path, row.len())?;
                matrix.row_mut(i).copy_from_slice(&places.values(&path, row)?);
            }
            Ok(matrix)
        }
    }
}
