//! What lies over the figure of a map of two parameters: layers, a marked point, a line. The command and the page draw it
//! with the same function.

mod layer;
mod layer_plane;
mod paper;

pub use layer::Layer;
pub use layer_plane::{LayerPlane, REGION_LABELS, Rings};

use crate::figure::plane::{Plane, PlaneAxis};
use crate::{AnswerError, ReportError, Units, Varied};
use vibroimpact_plot::{Anchor, Colour, Dash, Figure, Line, Panel, Points, Shape, Text};
use vibroimpact_study::{Axis, Control, Plan, PlanError, typed_axes};

const RED: Colour = Colour::hex(0x8c_1d18);
const LINE: Colour = Colour::hex(0xb5_221b);

/// The layers of the figure of a map, a point and a line in it. Coordinates are in the units of the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay {
    /// The layers.
    pub layers: Vec<Layer>,
    /// Abscissa and ordinate of a point.
    pub mark: Option<[f64; 2]>,
    /// Abscissa and ordinate of the beginning of a line, and those of its end.
    pub line: Option<[f64; 4]>,
}

impl Default for Overlay {
    /// Stripes only.
    fn default() -> Self {
        Self { layers: vec![Layer::Stripes], mark: None, line: None }
    }
}

impl Overlay {
    /// Whether a layer is on.
    pub(crate) fn has(&self, layer: Layer) -> bool {
        self.layers.contains(&layer)
    }

    /// Whether nothing but stripes is asked for.
    #[must_use]
    pub fn plain(&self) -> bool {
        self.mark.is_none() && self.line.is_none() && self.layers.iter().all(|layer| *layer == Layer::Stripes)
    }

    /// Whether coexisting motions are stripes, and whether lines are drawn between cells with different motions.
    pub(crate) fn cells(&self) -> (bool, bool) {
        (self.has(Layer::Stripes), self.has(Layer::Boundaries))
    }

    /// Refuses what the figure of a plan cannot show. `coloured` says whether it has the colours of a quantity.
    ///
    /// # Errors
    /// [`ReportError`] names what is not shown, with the value and its range.
    pub fn check(&self, plan: &Plan, coloured: bool) -> Result<(), ReportError> {
        if self.plain() {
            return Ok(());
        }
        let map = OfMap::new(plan)?.ok_or(ReportError::NoPlane)?;
        self.layers.iter().try_for_each(|layer| map.layer(*layer, coloured))?;
        self.mark.iter().try_for_each(|mark| map.mark(*mark))?;
        self.line.iter().try_for_each(|line| map.line(*line))
    }

    /// The same without what the figure of a plan does not show, with the layers in the order of [`Layer::ALL`].
    pub(crate) fn visible(&self, plan: &Plan, coloured: bool) -> Result<Self, PlanError> {
        let Some(map) = OfMap::new(plan)? else {
            let layers = if coloured { Vec::new() } else { Self::default().layers };
            return Ok(Self { layers, ..Self::default() });
        };
        let paper = !paper::named(&map.plan).iter().all(|(_, at)| map.mark(*at).is_err());
        let shown = |layer: &Layer| {
            self.has(*layer) && map.layer(*layer, coloured).is_ok() && (*layer != Layer::Paper || paper)
        };
        Ok(Self {
            layers: Layer::ALL.into_iter().filter(shown).collect(),
            mark: self.mark.filter(|mark| map.mark(*mark).is_ok()),
            line: self.line.filter(|line| map.line(*line).is_ok()),
        })
    }

    /// Draws everything over the cells into the figure of a map. Figures of other plans stay as they are.
    pub(crate) fn add(&self, figure: &mut Figure, plan: &Plan, control: &Control<'_>) -> Result<(), AnswerError> {
        let over = self.layers.iter().any(|layer| !layer.of_motions()) || self.mark.is_some() || self.line.is_some();
        let (true, Some(panel)) = (over, figure.panels.first_mut()) else { return Ok(()) };
        let Some(map) = OfMap::new(plan)? else { return Ok(()) };
        if self.has(Layer::Regions) {
            for (_, rings) in map.plane.regions(&REGION_LABELS.map(str::to_owned), control)? {
                rings.iter().for_each(|ring| curve(panel, ring, (Colour::BLACK, 1.6), Dash::Solid));
            }
        }
        if self.has(Layer::Amplitude) {
            map.plane.amplitude().iter().for_each(|points| curve(panel, points, (RED, 2.4), Dash::Dashed));
        }
        if self.has(Layer::Paper) {
            for (name, at) in paper::named(&map.plan) {
                panel.add(Points::new([at[0]], [at[1]], Colour::BLACK).size(8.0).rim(Colour::WHITE));
                panel.add(Text::new(at[0], at[1], format!("*{name}*")).shift(7.0, 6.0).anchor(Anchor::Start));
            }
        }
        if let Some(line) = self.line.filter(|line| map.line(*line).is_ok()) {
            let [x0, y0, x1, y1] = line;
            curve(panel, &[(x0, y0), (x1, y1)], (LINE, 3.0), Dash::Solid);
        }
        if let Some([x, y]) = self.mark.filter(|mark| map.mark(*mark).is_ok()) {
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

/// A map over two parameters, and what can be drawn in its figure.
struct OfMap {
    plan: Plan,
    plane: LayerPlane,
    frame: Plane,
}

impl OfMap {
    /// `None` if the plan is no map over two parameters that can be drawn.
    fn new(plan: &Plan) -> Result<Option<Self>, PlanError> {
        let Some(plane) = LayerPlane::of(plan)? else { return Ok(None) };
        let plan = plan.complete()?;
        let frame = Plane::of(&Self::axes(&plan), &Units::of_plan(&plan)).ok();
        Ok(frame.map(|frame| Self { plan, plane, frame }))
    }

    fn axes(plan: &Plan) -> Vec<Axis> {
        typed_axes(plan.task.axes()).unwrap_or_default()
    }

    fn layer(&self, layer: Layer, coloured: bool) -> Result<(), ReportError> {
        match layer {
            Layer::Stripes | Layer::Boundaries if coloured => Err(ReportError::LayerOfMotions(layer.name())),
            Layer::Amplitude if !self.plane.has_gap() => Err(ReportError::NoGapAxis),
            _ => Ok(()),
        }
    }

    /// The two axes with their names.
    fn sides(&self) -> [(String, &PlaneAxis); 2] {
        let units = Units::of_plan(&self.plan);
        let name = |axis: usize| Self::axes(&self.plan)[axis].vary.column(&units).to_owned();
        [(name(0), &self.frame.x), (name(1), &self.frame.y)]
    }

    /// Refuses a point outside the axes.
    fn mark(&self, at: [f64; 2]) -> Result<(), ReportError> {
        for ((name, axis), value) in self.sides().into_iter().zip(at) {
            let (low, high) = axis.range();
            if !(low..=high).contains(&value) {
                return Err(ReportError::Outside { what: "mark", name, value, low, high });
            }
        }
        Ok(())
    }

    /// Refuses a line of which no part can be seen, and one that a logarithmic axis cannot have.
    fn line(&self, [x0, y0, x1, y1]: [f64; 4]) -> Result<(), ReportError> {
        for ((name, axis), (from, to)) in self.sides().into_iter().zip([(x0, x1), (y0, y1)]) {
            let (low, high) = axis.range();
            let (least, most) = (from.min(to), from.max(to));
            let not_positive = axis.logarithmic() && least <= 0.0;
            if not_positive || least > high || most < low {
                let value = if not_positive || least > high { least } else { most };
                return Err(ReportError::Outside { what: "line", name, value, low, high });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(axes: &str) -> Plan {
        let text = format!(
            r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{"map":{{"axes":[{axes}],"starts":1}}}}}}"#
        );
        serde_json::from_str(&text).unwrap()
    }

    const PLANE: &str = r#"{"vary":"inverse_beta","over":"1:1.5:6"},{"vary":"gap","over":"0.5:2.5:5"}"#;
    const LOG: &str = r#"{"vary":"beta","over":"0.1:10:5:log"},{"vary":"restitution","over":"0:1:3"}"#;

    #[test]
    fn what_is_outside_is_refused_or_left_out() {
        let all = Overlay { layers: Layer::ALL.into_iter().rev().collect(), ..Overlay::default() };
        let refused = |overlay: &Overlay, axes: &str| overlay.check(&map(axes), false).unwrap_err().to_string();
        assert!(all.check(&map(PLANE), false).is_ok());
        assert_eq!(all.visible(&map(PLANE), false).unwrap().layers, Layer::ALL);
        assert_eq!(all.visible(&map(PLANE), true).unwrap().layers, [Layer::Regions, Layer::Amplitude, Layer::Paper]);
        assert!(refused(&all, LOG).contains("needs the gap on an axis"));
        assert!(all.check(&map(PLANE), true).is_err());
        assert!(refused(&all, r#"{"vary":"gap","over":"1:2:3"}"#).contains("two parameters"));
        for (mark, line, axes, sentence) in [
            (Some([1.3, 4.0]), None, PLANE, "gap = 4 of the mark lies outside 0.25 <= gap <= 2.75"),
            (Some([f64::NAN, 1.0]), None, PLANE, "inverse_beta = NaN of the mark"),
            (None, Some([0.1, 1.0, 0.2, 1.0]), PLANE, "inverse_beta = 0.2 of the line"),
            (None, Some([-1.0, 0.1, 1.0, 0.1]), LOG, "beta = -1 of the line"),
        ] {
            let overlay = Overlay { mark, line, ..Overlay::default() };
            assert!(refused(&overlay, axes).contains(sentence), "{}", refused(&overlay, axes));
            assert_eq!(overlay.visible(&map(axes), false).unwrap(), Overlay::default());
        }
        // a line may leave the figure
        let overlay = Overlay { mark: Some([1.0, 0.75]), line: Some([0.0, 0.0, 3.0, 3.0]), ..Overlay::default() };
        assert_eq!(overlay.visible(&map(PLANE), false).unwrap(), overlay);
    }

    /// The points of the paper count as a layer only where one of them is in the figure.
    #[test]
    fn a_layer_without_anything_in_it_is_left_out() {
        let overlay = Overlay { layers: vec![Layer::Paper], ..Overlay::default() };
        assert_eq!(overlay.visible(&map(PLANE), false).unwrap(), overlay);
        let far = r#"{"vary":"inverse_beta","over":"3:4:6"},{"vary":"gap","over":"0.5:2.5:5"}"#;
        assert_eq!(overlay.visible(&map(far), false).unwrap().layers, []);
    }
}
