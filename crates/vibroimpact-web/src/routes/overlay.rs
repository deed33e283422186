//! What lies over a map on the page, in its exported figure: layers, the points of the paper, the chosen point, the line.

use super::layer::{Plane, amplitude, regions};
use crate::refusal::Refusal;
use vibroimpact::scenario::PAPER;
use vibroimpact_plot::{Anchor, Colour, Dash, Figure, Line, Panel, Points, Shape, Text};
use vibroimpact_study::{Control, Coordinate, MapPlan, Parameter, Plan, SystemPlan, Task};

const RED: Colour = Colour::hex(0x8c_1d18);
const LINE: Colour = Colour::hex(0xb5_221b);

/// The layers by name, the position of the chosen point, and the ends of the line.
pub(super) struct Overlay {
    pub(super) layers: Vec<String>,
    pub(super) chosen: Option<[f64; 2]>,
    pub(super) line: Option<[f64; 4]>,
}

impl Overlay {
    fn has(&self, name: &str) -> bool {
        self.layers.iter().any(|layer| layer == name)
    }

    /// Adds everything to the figure of a map; figures of other plans stay as they are.
    pub(super) fn add(&self, figure: &mut Figure, plan: &Plan, control: &Control<'_>) -> Result<(), Refusal> {
        let (Task::Map(map), Some(panel)) = (&plan.task, figure.panels.first_mut()) else { return Ok(()) };
        if self.has("regions") {
            for (_, rings) in regions(&Plane::new(plan.system, map)?, control)? {
                rings.iter().for_each(|ring| curve(panel, ring, (Colour::BLACK, 1.6), Dash::Solid));
            }
        }
        if self.has("amplitude") {
            for points in amplitude(&Plane::new(plan.system, map)?) {
                curve(panel, &points, (RED, 2.4), Dash::Dashed);
            }
        }
        if self.has("paper") {
            for (name, at) in named(map, &plan.system) {
                panel.add(Points::new([at[0]], [at[1]], Colour::BLACK).size(8.0).rim(Colour::WHITE));
                panel.add(Text::new(at[0], at[1], format!("*{name}*")).shift(7.0, 6.0).anchor(Anchor::Start));
            }
        }
        if let Some([x0, y0, x1, y1]) = self.line {
            curve(panel, &[(x0, y0), (x1, y1)], (LINE, 3.0), Dash::Solid);
        }
        if let Some([x, y]) = self.chosen {
            for (size, colour) in
                [(16.0, Colour::WHITE), (13.0, Colour::BLACK), (8.0, Colour::WHITE), (4.0, Colour::BLACK)]
            {
                panel.add(Points::new([x], [y], colour).shape(Shape::Circle).size(size));
            }
        }
        Ok(())
    }
}

/// A curve with a white edge, so that it is seen over dark colours.
fn curve(panel: &mut Panel, points: &[(f64, f64)], (colour, width): (Colour, f64), dash: Dash) {
    let (xs, ys): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
    panel.add(Line::new(xs.clone(), ys.clone(), Colour::WHITE).width(width + 2.0));
    panel.add(Line::new(xs, ys, colour).width(width).dash(dash));
}

/// The points of the 1971 paper that lie in a map, with their positions in it.
fn named(map: &MapPlan, system: &SystemPlan) -> Vec<(&'static str, [f64; 2])> {
    let varied: Vec<Coordinate> = map.axes.iter().map(|axis| axis.vary).collect();
    let varies = |parameter: Parameter| varied.contains(&Coordinate::Parameter(parameter));
    let frequency = varies(Parameter::InverseBeta) || varies(Parameter::Beta);
    let mut found = Vec::new();
    for point in PAPER {
        let value = |parameter: Parameter| match parameter {
            Parameter::InverseBeta => Some(point.inverse_beta),
            Parameter::Beta => Some(1.0 / point.inverse_beta),
            Parameter::Gap => Some(point.gap),
            Parameter::Restitution => Some(point.oscillator().restitution()),
            Parameter::Damping => Some(0.0),
            _ => None,
        };
        let same = |parameter: Parameter, given: f64| {
            varies(parameter) || value(parameter).is_some_and(|value| (value - given).abs() < 1e-9)
        };
        let inverse_beta = system.inverse_beta.or(system.beta.map(|beta| 1.0 / beta)).unwrap_or(f64::NAN);
        let here = (frequency || same(Parameter::InverseBeta, inverse_beta))
            && same(Parameter::Gap, system.gap)
            && same(Parameter::Restitution, system.restitution)
            && same(Parameter::Damping, system.damping)
            && system.second_stop.is_none();
        let place =
            |axis: &Coordinate| if let Coordinate::Parameter(parameter) = axis { value(*parameter) } else { None };
        if let (true, [Some(x), Some(y)]) = (here, varied.iter().map(place).collect::<Vec<_>>().as_slice()) {
            found.push((point.name, [*x, *y]));
        }
    }
    found
}
