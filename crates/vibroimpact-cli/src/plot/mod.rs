//! Figures: each file one kind of picture; here their files.

pub(crate) mod basin;
pub(crate) mod branch;
pub(crate) mod curve;
pub(crate) mod diagram;
pub(crate) mod map;
pub(crate) mod plane;
pub(crate) mod region;
pub(crate) mod section;
pub(crate) mod stored;
pub(crate) mod tracks;
pub(crate) mod waveform;

use crate::args::Units;
use crate::exit::Failure;
use crate::files::Target;
use crate::report::text::short;
use std::path::Path;
use vibroimpact_plot::{Colour, DPI_300, Figure, plain};
use vibroimpact_study::{Parameter, SystemPlan, is_length};

/// A place for a figure, known to be writable and of a known format.
#[derive(Debug)]
pub(crate) struct Picture {
    target: Target,
    png: bool,
}

impl Picture {
    /// Reserves a file that ends in .svg or .png.
    pub(crate) fn reserve(path: &Path, force: bool) -> Result<Self, Failure> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let png = match ending.as_deref() {
            Some("svg") => false,
            Some("png") => true,
            _ => {
                return Err(Failure::bad(format!("the figure `{}` ends in neither .svg nor .png", path.display())));
            }
        };
        let target = Target::reserve(path, force)?;
        Ok(Self { target, png })
    }

    pub(crate) fn write(self, figure: &Figure) -> Result<(), Failure> {
        let bytes = if self.png { figure.to_png(DPI_300)? } else { figure.to_svg().into_bytes() };
        self.target.write(|out| out.write_all(&bytes))
    }
}

/// The parameters as a title, the frequency as it was given.
pub(crate) fn title(system: &SystemPlan) -> String {
    title_without(system, &[])
}

/// The same without the parameters that vary in the figure.
pub(crate) fn title_without(system: &SystemPlan, varied: &[Parameter]) -> String {
    let frequency = match (system.inverse_beta, system.beta) {
        (Some(inverse), _) => (Parameter::InverseBeta, inverse),
        (None, beta) => (Parameter::Beta, beta.unwrap_or(f64::NAN)),
    };
    let mut given = vec![frequency, (Parameter::Gap, system.gap), (Parameter::Restitution, system.restitution)];
    if system.damping > 0.0 {
        given.push((Parameter::Damping, system.damping));
    }
    if let Some(stop) = system.second_stop {
        given.push((Parameter::SecondGap, stop.gap));
        if stop.restitution != system.restitution || varied.contains(&Parameter::Restitution) {
            given.push((Parameter::SecondRestitution, stop.restitution));
        }
    }
    let is_frequency = |parameter: &Parameter| matches!(parameter, Parameter::Beta | Parameter::InverseBeta);
    let tuned = varied.iter().any(is_frequency);
    given.retain(|(parameter, _)| !(varied.contains(parameter) || tuned && is_frequency(parameter)));
    let parts: Vec<String> =
        given.iter().map(|(parameter, value)| format!("{} = {}", symbol(*parameter), short(*value))).collect();
    parts.join(", ").replace('-', "−")
}

/// The symbol of a parameter, as markup.
pub(crate) const fn symbol(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Beta => "*β*",
        Parameter::InverseBeta => "1/*β*",
        Parameter::Gap => "*δ*",
        Parameter::Restitution => "*ε*",
        Parameter::Damping => "*ζ*",
        Parameter::SecondGap => "*δ*_2",
        Parameter::SecondRestitution => "*ε*_2",
    }
}

/// The same with its unit, for an axis.
pub(crate) fn named(parameter: Parameter, units: &Units) -> String {
    if is_length(parameter) { units.named(symbol(parameter), "m") } else { symbol(parameter).into() }
}

/// A label as a figure shows it.
pub(crate) fn label(label: &str) -> String {
    match label {
        "0" => "no impact".into(),
        label => plain(label).replace("inf", "∞"),
    }
}

/// Variant number `k` of a colour: itself, darker, lighter, darker still ... for motions of one class.
pub(crate) fn variant(colour: Colour, k: usize) -> Colour {
    let towards = if k % 2 == 1 { 0.0 } else { 255.0 };
    #[allow(clippy::cast_precision_loss)] // a handful
    let part = if k == 0 { 0.0 } else { 1.0 - 0.6_f64.powi(i32::try_from(k.div_ceil(2)).unwrap_or(9)) };
    let mix = |channel: u8| {
        let mixed = f64::from(channel) + (towards - f64::from(channel)) * part;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 255
        {
            mixed.round() as u8
        }
    };
    Colour { r: mix(colour.r), g: mix(colour.g), b: mix(colour.b), ..colour }
}
