//! OVERLAY: what lies over the figure of a map of two parameters: layers, a marked point, a line.

use super::numbers::shown;
use super::{Words, word};
use crate::failure::Failure;
use clap::Args;
use vibroimpact_report::figure::overlay::{Layer, Overlay};
use vibroimpact_study::typed::decimal;

/// What lies over the figure of a map.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Figure")]
pub(crate) struct OverlayArgs {
    /// Layers of a map of two parameters, separated by commas, or none [default: stripes; with --colour: none]
    #[arg(long, value_parser = word(&LAYERS), value_delimiter = ',', value_name = "LAYER,...")]
    layers: Option<Vec<Option<Layer>>>,

    /// Mark this point of a map of two parameters, in the units of the axes
    #[arg(long, value_parser = point, value_name = "X,Y", allow_hyphen_values = true)]
    mark: Option<[f64; 2]>,

    /// Draw a line in a map of two parameters, in the units of the axes; it may leave the figure
    #[arg(long, value_parser = line, value_name = "X0,Y0:X1,Y1", allow_hyphen_values = true)]
    line: Option<[f64; 4]>,
}

const LAYERS: Words<Option<Layer>, 6> = [
    (
        "regions",
        Some(Layer::Regions),
        "Boundaries of the regions in which 1/1, 2/1, 3/1, 4/1, 1/2, 1/3, 2/2, 3/2 and 2/4 are stable",
    ),
    ("amplitude", Some(Layer::Amplitude), "The amplitude of the motion without stops; the gap is on an axis"),
    ("paper", Some(Layer::Paper), "The points of the 1971 paper"),
    ("stripes", Some(Layer::Stripes), "Stripes where motions coexist"),
    ("boundaries", Some(Layer::Boundaries), "Lines where the motion changes"),
    ("none", None, "No layer"),
];

impl OverlayArgs {
    /// Whether any option is given.
    pub(crate) const fn any(&self) -> bool {
        self.layers.is_some() || self.mark.is_some() || self.line.is_some()
    }

    /// The requested overlay of a figure, which is in the colours of a quantity or not.
    pub(crate) fn overlay(&self, drawn: bool, coloured: bool) -> Result<Overlay, Failure> {
        if self.any() && !drawn {
            return Err(Failure::bad("--layers, --mark and --line say what the figure shows\nhint: --plot FILE"));
        }
        let layers = match &self.layers {
            None if coloured => Vec::new(),
            None => Overlay::default().layers,
            Some(names) if names.len() > 1 && names.contains(&None) => {
                return Err(Failure::bad("--layers none stands alone\nhint: leave out none, or the others"));
            }
            Some(names) => {
                let mut layers: Vec<Layer> = names.iter().copied().flatten().collect();
                layers.sort_unstable();
                layers.dedup();
                layers
            }
        };
        Ok(Overlay { layers, mark: self.mark, line: self.line })
    }
}

/// Reads `X,Y`: a point of a figure.
fn point(text: &str) -> Result<[f64; 2], String> {
    let bad = || format!("`{}` is not X,Y with finite numbers, such as 1.3,0.75", shown(text));
    let number = |part: &str| decimal(part).filter(|x| x.is_finite()).ok_or_else(bad);
    let (x, y) = text.split_once(',').ok_or_else(bad)?;
    Ok([number(x)?, number(y)?])
}

/// Reads `X0,Y0:X1,Y1`: a line in a figure.
fn line(text: &str) -> Result<[f64; 4], String> {
    let bad = || format!("`{}` is not X0,Y0:X1,Y1 with finite numbers, such as 1.1,0.5:1.1,2.5", shown(text));
    let (from, to) = text.split_once(':').ok_or_else(bad)?;
    let ([x0, y0], [x1, y1]) = (point(from).map_err(|_| bad())?, point(to).map_err(|_| bad())?);
    if (x0, y0) == (x1, y1) {
        return Err(format!("`{}` is no line: its two ends are the same point", shown(text)));
    }
    Ok([x0, y0, x1, y1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_lines_and_what_is_none() {
        assert_eq!(point("1.3,0.75"), Ok([1.3, 0.75]));
        assert_eq!(point(" -1e-3, 2 "), Ok([-1e-3, 2.0]));
        assert_eq!(line("1,2:3,-4"), Ok([1.0, 2.0, 3.0, -4.0]));
        for bad in ["", "1", "1,", ",1", "1,2,3", "1:2", "1,nan", "inf,1", "a,b"] {
            assert!(point(bad).is_err_and(|why| why.contains("is not X,Y")), "{bad}");
        }
        for bad in ["", "1,2", "1,2:3", "1:2,3:4", "1,2:3,4:5,6", "1,2:3,inf"] {
            assert!(line(bad).is_err_and(|why| why.contains("is not X0,Y0:X1,Y1")), "{bad}");
        }
        assert!(line("1,2:1,2.0").is_err_and(|why| why.contains("the same point")));
    }

    #[test]
    fn every_layer_has_its_name() {
        let named = LAYERS.iter().filter_map(|(name, layer, _)| Some((*name, (*layer)?)));
        assert!(named.eq(Layer::ALL.map(|layer| (layer.name(), layer))));
    }
}
