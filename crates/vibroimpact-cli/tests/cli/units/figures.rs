//! Figures in metres and seconds: their marks are where those of the nondimensional figures are.

use super::{COMMANDS, Command, Machine};
use crate::Folder;

/// A figure between its axes: curves and marks in parts of the frame, and images as they are.
#[derive(Debug, Default)]
struct Marks {
    places: Vec<(f64, f64)>,
    images: Vec<String>,
}

/// The value of an attribute of an element.
fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let at = element.find(&format!(" {name}=\""))? + name.len() + 3;
    element[at..].split('"').next()
}

/// The numbers of a part of a path, such as `12.5 -3`.
fn numbers(text: &str) -> Vec<f64> {
    text.split([' ', ',']).filter_map(|word| word.parse().ok()).collect()
}

/// The marks of a figure. Circles begin at their left end: `M x y a r r ...`.
fn marks(svg: &str) -> Marks {
    let elements: Vec<&str> = svg.split('<').collect();
    let is_frame =
        |element: &&&str| element.starts_with("rect") && element.contains("fill=\"none\" stroke=\"#000000\"");
    let frame = elements.iter().position(|element| is_frame(&element)).expect("a frame");
    let side = |name: &str| attribute(elements[frame], name).and_then(|text| text.parse::<f64>().ok()).unwrap();
    let (left, top, width, height) = (side("x"), side("y"), side("width"), side("height"));
    let mut found = Marks::default();
    // hatches of areas are defined before
    let begin = elements.iter().position(|element| element.starts_with("/defs")).unwrap_or(0);
    for element in &elements[begin..frame] {
        if element.starts_with("image") {
            found.images.push(attribute(element, "href").unwrap().to_owned());
        }
        let path = attribute(element, "d").into_iter().flat_map(|path| path.split(['M', 'L']));
        for part in path.filter(|part| !part.is_empty()) {
            // of a rectangle the first corner
            let at = numbers(part.split(|sign: char| sign.is_ascii_alphabetic()).next().unwrap());
            let radius = part.split_once('a').map_or(0.0, |(_, arc)| numbers(arc)[0]);
            let &[x, y] = at.as_slice() else { panic!("{part}") };
            found.places.push(((x + radius - left) / width, (y - top) / height));
        }
    }
    found
}

/// The distance of a place from the line through others.
fn distance((x, y): (f64, f64), line: &[(f64, f64)]) -> f64 {
    let to = |pair: &[(f64, f64)]| {
        let ((a, b), (dx, dy)) = (pair[0], (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1));
        let square = dx * dx + dy * dy;
        let part = if square > 0.0 { (((x - a) * dx + (y - b) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
        (x - a - part * dx).hypot(y - b - part * dy)
    };
    line.windows(2).map(to).fold(f64::INFINITY, f64::min)
}

/// Random machines: dots, curves and images stand at the same places between the axes as in the nondimensional figure.
#[test]
fn random_machines_have_the_figures_of_the_oscillator() {
    let folder = Folder::new();
    let mut compared = 0;
    let drawn = ["simulate", "settle", "basin"];
    for machine in Machine::random().take(6) {
        for Command { name, flags, without, .. } in COMMANDS.iter().filter(|command| drawn.contains(&command.name)) {
            let (si, plain) = machine.lines(name, flags, without);
            let [plain, si] = [plain, si].map(|line| marks(&folder.drawn(&line, "a.svg")));
            assert!(plain.images == si.images, "{name}: {machine:?}");
            // curves have fewer points where they are nearly straight, and which ones depends on the size of the frame
            for (one, other) in [(&plain, &si), (&si, &plain)] {
                let off = one.places.iter().map(|at| distance(*at, &other.places)).fold(0.0, f64::max);
                assert!(off < 1e-3, "{name}: {off} {machine:?}");
            }
            compared += plain.places.len() + plain.images.len();
        }
    }
    assert!(compared > 500, "{compared} marks");
}
