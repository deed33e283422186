//! FIGURE: how the figure of `--plot` looks: title, size, resolution, limits of its axes, greys.

use super::{Ends, number};
use crate::failure::Failure;
use clap::Args;
use vibroimpact_plot::{Figure, FigureAxis, Scale, plain};

/// The format of a figure, by the ending of its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Svg,
    Png,
    Pdf,
}

/// The look of a figure.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Figure")]
pub(crate) struct FigureArgs {
    /// Title of the figure instead of the parameters; empty for none
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,

    /// Size of the whole figure on paper, as 85x60mm, 8.5x6cm or 3.35x2.4in; text, lines and marks keep their sizes
    #[arg(long, value_parser = paper, value_name = "WxH")]
    size: Option<(f64, f64)>,

    /// Pixels in an inch of a .png figure, 50 to 2400 [default: 300]
    #[arg(long, value_parser = number, value_name = "N", allow_hyphen_values = true)]
    dpi: Option<f64>,

    /// Limits of the horizontal axis, in its units; A > B turns it round
    #[arg(long, value_name = "A:B", allow_hyphen_values = true)]
    x_limits: Option<Ends>,

    /// Limits of the vertical axis, in its units
    #[arg(long, value_name = "A:B", allow_hyphen_values = true)]
    y_limits: Option<Ends>,

    /// Greys of equal luminance instead of colours
    #[arg(long, alias = "grayscale")]
    greyscale: bool,
}

/// Allowed resolutions, in pixels in an inch.
const RESOLUTIONS: core::ops::RangeInclusive<f64> = 50.0..=2400.0;

impl FigureArgs {
    /// Whether any option is given.
    pub(crate) const fn any(&self) -> bool {
        self.title.is_some()
            || self.size.is_some()
            || self.dpi.is_some()
            || self.x_limits.is_some()
            || self.y_limits.is_some()
            || self.greyscale
    }

    /// Checks what can be checked before the figure exists.
    pub(crate) fn check(&self, format: Format) -> Result<(), Failure> {
        for (name, limits) in [("x", self.x_limits), ("y", self.y_limits)] {
            if let Some(Ends(a, _)) = limits.filter(|Ends(a, b)| a == b) {
                return Err(Failure::bad(format!("--{name}-limits {a}:{a} is no range: the two limits are equal")));
            }
        }
        match self.dpi {
            Some(dpi) if !RESOLUTIONS.contains(&dpi) => {
                let (least, most) = (RESOLUTIONS.start(), RESOLUTIONS.end());
                Err(Failure::bad(format!("dpi = {dpi} lies outside {least} <= dpi <= {most}")))
            }
            Some(_) if format != Format::Png => Err(Failure::bad(
                "--dpi is for a figure with pixels\nhint: a file that ends in .png; .svg and .pdf have none",
            )),
            _ => Ok(()),
        }
    }

    /// The resolution, if the size on paper matters.
    pub(crate) fn resolution(&self) -> Option<f64> {
        self.dpi.or_else(|| self.size.map(|_| 300.0))
    }

    /// The figure with this look.
    pub(crate) fn apply(&self, mut figure: Figure) -> Result<Figure, Failure> {
        for panel in &mut figure.panels {
            limit(&mut panel.x, self.x_limits, "x")?;
            limit(&mut panel.y, self.y_limits, "y")?;
        }
        match self.title.as_deref().map(str::trim) {
            Some("") => figure.title = None,
            Some(text) => figure.title = Some(plain(text)),
            None => {}
        }
        figure.grey |= self.greyscale;
        Ok(match self.size {
            Some((width, height)) => figure.fit(width, height)?,
            None => figure,
        })
    }
}

/// Sets the limits of an axis.
fn limit(axis: &mut FigureAxis, limits: Option<Ends>, name: &str) -> Result<(), Failure> {
    let Some(Ends(a, b)) = limits else { return Ok(()) };
    if axis.scale == Scale::Log10 && a.min(b) <= 0.0 {
        let wrong = a.min(b);
        return Err(Failure::bad(format!("--{name}-limits: {wrong} lies on no logarithmic axis: limits are positive")));
    }
    axis.range = Some((a, b));
    Ok(())
}

/// Units of sizes, in millimetres.
const UNITS: [(&str, f64); 3] = [("mm", 1.0), ("cm", 10.0), ("in", 25.4)];
/// Largest side of a figure, in millimetres: that of a poster.
const LARGEST: f64 = 2000.0;

/// Reads `WxH` with a unit: a size on paper, in millimetres.
fn paper(text: &str) -> Result<(f64, f64), String> {
    let said = text.chars().take(60).collect::<String>();
    let bad = || format!("`{said}` is no size WxH with a unit, such as 85x60mm or 3.35x2.4in");
    let found = UNITS.iter().find_map(|(unit, mm)| Some((text.trim().strip_suffix(unit)?, *mm)));
    let (sides, mm) = found.ok_or_else(bad)?;
    let (width, height) = sides.split_once(['x', '×']).ok_or_else(bad)?;
    let side = |part: &str| part.trim().parse::<f64>().ok().map(|side| side * mm).ok_or_else(bad);
    let (width, height) = (side(width)?, side(height)?);
    for side in [width, height] {
        if !(side > 0.0 && side <= LARGEST) {
            return Err(format!("`{said}`: a side of {side} mm lies outside 0 < side <= {LARGEST} mm"));
        }
    }
    Ok((width, height))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_on_paper_and_what_is_none() {
        for (text, width, height) in
            [("84x60mm", 84.0, 60.0), ("3.5x2in", 88.9, 50.8), (" 8.4 × 6 cm ", 84.0, 60.0), ("1e2x50mm", 100.0, 50.0)]
        {
            let (w, h) = paper(text).expect(text);
            assert!((w - width).abs() < 1e-9 && (h - height).abs() < 1e-9, "{text}: {w} {h}");
        }
        for text in ["84x60", "84mm", "x60mm", "axbmm", "-84x60mm", "0x60mm", "84x9000mm", "infx60mm", "NaNx3mm", ""] {
            assert!(paper(text).is_err(), "{text}");
        }
    }
}
