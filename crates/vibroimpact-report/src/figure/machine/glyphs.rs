//! The parts of a schematic: springs, dampers, stops, sliders, bodies, arrows, the ground.

use super::model::{Item, Kind};
use crate::figure::extremes;
use vibroimpact_plot::{Anchor, Colour, FilledRegion, Hatch, Line, Mark, Pattern, SERIES, Stroke, Text, plain};

pub(super) type Point = (f64, f64);

const INK: Colour = Colour::BLACK;
const BODY: Colour = Colour::hex(0xdd_e6f0);
const STOP: Colour = SERIES[1];
const TEXT: f64 = 20.0;

/// A drawing under construction.
#[derive(Default)]
pub(super) struct Sketch {
    pub(super) marks: Vec<Mark>,
    seen: Vec<Point>,
}

/// A straight way from one point to another: `s` along it, `n` to its left.
#[derive(Clone, Copy)]
pub(super) struct Way {
    pub(super) from: Point,
    pub(super) to: Point,
}

impl Way {
    fn length(self) -> f64 {
        ((self.to.0 - self.from.0).powi(2) + (self.to.1 - self.from.1).powi(2)).sqrt()
    }

    fn at(self, s: f64, n: f64) -> Point {
        let length = self.length();
        let (dx, dy) = ((self.to.0 - self.from.0) / length, (self.to.1 - self.from.1) / length);
        (self.from.0 + s * dx - n * dy, self.from.1 + s * dy + n * dx)
    }

    fn part(self, from: f64, to: f64, n: f64) -> Self {
        Self { from: self.at(from, n), to: self.at(to, n) }
    }
}

impl Sketch {
    /// Left, right, low and high ends.
    pub(super) fn extent(&self) -> (f64, f64, f64, f64) {
        let ends = |of: fn(&Point) -> f64| extremes(self.seen.iter().map(of));
        let ((left, right), (low, high)) = (ends(|p| p.0), ends(|p| p.1));
        (left, right, low, high)
    }

    pub(super) fn line(&mut self, points: &[Point], colour: Colour, width: f64) {
        self.seen.extend(points);
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        self.marks.push(Line::new(xs, ys, colour).width(width).into());
    }

    fn area(&mut self, ring: [Point; 4], fill: Option<Colour>, hatch: bool, outline: bool) {
        self.seen.extend(ring);
        let mut area = FilledRegion::polygon(ring);
        area.fill = fill;
        area.hatch = hatch.then(|| Hatch::new(Pattern::Rising, INK));
        area.outline = outline.then(|| Stroke::new(INK).width(2.5));
        self.marks.push(area.into());
    }

    /// Text; it is seen with the space it takes.
    pub(super) fn text(&mut self, (x, y): Point, text: &str, anchor: Anchor) {
        if text.is_empty() {
            return;
        }
        let wide = text.chars().count() as f64 * 0.2;
        let left = match anchor {
            Anchor::Start => x,
            Anchor::Middle => x - wide / 2.0,
            Anchor::End => x - wide,
        };
        self.seen.extend([(left, y - 0.15), (left + wide, y + 0.15)]);
        let text = Text::new(x, y, plain(text)).anchor(anchor).size(TEXT);
        self.marks.push(Text { halo: false, ..text }.into());
    }

    /// A body with its name and mass.
    pub(super) fn body(&mut self, (x, y): Point, (wide, high): Point, name: &str, mass: &str) {
        let (w, h) = (wide / 2.0, high / 2.0);
        self.area([(x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h)], Some(BODY), false, true);
        self.text((x, y + 0.2), name, Anchor::Middle);
        self.text((x, y - 0.2), mass, Anchor::Middle);
    }

    /// The ground at the end of a way, hatched on its far side.
    pub(super) fn ground(&mut self, way: Way, half: f64) {
        let length = way.length();
        let (a, b) = (way.at(length, half), way.at(length, -half));
        let (c, d) = (way.at(length + 0.22, -half), way.at(length + 0.22, half));
        self.area([a, b, c, d], None, true, false);
        self.line(&[a, b], INK, 3.0);
    }

    fn spring(&mut self, way: Way, colour: Colour) {
        let length = way.length();
        let lead = 0.14 * length;
        let coils = 6;
        let mut points = vec![way.at(0.0, 0.0), way.at(lead, 0.0)];
        for k in 0..coils {
            let s = lead + (length - 2.0 * lead) * (f64::from(k) + 0.5) / f64::from(coils);
            points.push(way.at(s, if k % 2 == 0 { 0.17 } else { -0.17 }));
        }
        points.extend([way.at(length - lead, 0.0), way.at(length, 0.0)]);
        self.line(&points, colour, 2.5);
    }

    fn damper(&mut self, way: Way, colour: Colour) {
        let length = way.length();
        let (start, end) = (0.32 * length, 0.68 * length);
        self.line(&[way.at(0.0, 0.0), way.at(start, 0.0)], colour, 2.5);
        self.line(&[way.at(end, 0.17), way.at(start, 0.17), way.at(start, -0.17), way.at(end, -0.17)], colour, 2.5);
        let piston = 0.56 * length;
        self.line(&[way.at(piston, 0.12), way.at(piston, -0.12)], colour, 3.5);
        self.line(&[way.at(piston, 0.0), way.at(length, 0.0)], colour, 2.5);
    }

    fn spring_and_damper(&mut self, way: Way, spring: bool, damper: bool, colour: Colour) {
        let length = way.length();
        match (spring, damper) {
            (true, false) => self.spring(way, colour),
            (false, true) => self.damper(way, colour),
            (false, false) => self.line(&[way.from, way.to], colour, 2.5),
            (true, true) => {
                let (a, b) = (0.1 * length, 0.9 * length);
                self.line(&[way.from, way.at(a, 0.0)], colour, 2.5);
                self.line(&[way.at(a, 0.27), way.at(a, -0.27)], colour, 2.5);
                self.spring(way.part(a, b, 0.27), colour);
                self.damper(way.part(a, b, -0.27), colour);
                self.line(&[way.at(b, 0.27), way.at(b, -0.27)], colour, 2.5);
                self.line(&[way.at(b, 0.0), way.to], colour, 2.5);
            }
        }
    }

    /// A spring, a damper, a stop or a slider, without its label.
    pub(super) fn item(&mut self, way: Way, item: &Item) {
        let length = way.length();
        let plate = |sketch: &mut Self, s: f64, colour: Colour| {
            sketch.line(&[way.at(s, 0.24), way.at(s, -0.24)], colour, 5.0);
        };
        match item.kind {
            Kind::Link { spring, damper } => self.spring_and_damper(way, spring, damper, INK),
            Kind::Rigid | Kind::Compliant { .. } => {
                let (tip, face) = (0.3 * length, 0.48 * length);
                self.line(&[way.from, way.at(tip, 0.0)], INK, 2.5);
                plate(self, tip, INK);
                plate(self, face, STOP);
                match item.kind {
                    Kind::Compliant { damper } => {
                        self.spring_and_damper(way.part(face, length, 0.0), true, damper, STOP);
                    }
                    _ => self.line(&[way.at(face, 0.0), way.to], STOP, 5.0),
                }
            }
            Kind::Slider => {
                let (a, b) = (0.25 * length, 0.75 * length);
                self.line(&[way.from, way.at(a, 0.06), way.at(b, 0.06)], INK, 4.0);
                self.line(&[way.at(a, -0.06), way.at(b, -0.06), way.to], INK, 4.0);
            }
        }
    }

    /// An arrow.
    pub(super) fn arrow(&mut self, way: Way) {
        let length = way.length();
        self.line(&[way.from, way.to], SERIES[0], 3.0);
        self.line(&[way.at(length - 0.2, 0.12), way.to, way.at(length - 0.2, -0.12)], SERIES[0], 3.0);
    }
}
