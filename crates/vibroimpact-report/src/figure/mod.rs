//! Figures. Each file draws one kind of figure; this file has their common texts and colours.

pub mod bars;
pub mod basin;
pub mod branch;
pub mod cells;
pub mod coloured;
pub mod curve;
pub mod diagram;
pub mod machine;
pub mod machine_waveform;
pub mod map;
pub mod overlay;
pub mod plane;
pub mod point_motion;
pub mod region;
pub mod response;
pub mod scattered;
pub mod section;
pub mod shares;
pub mod stored;
pub mod styles;
pub(crate) mod tracks;
pub mod waveform;

use crate::number::short;
use crate::{Asked, Units, Varied};
use vibroimpact_plot::{Colour, SERIES, plain};
use vibroimpact_study::{BodyNumber, Cut, Parameter};

/// The title of a figure: the parameters, with the frequency in the form in which it was given, in the units of the
/// results.
#[must_use]
pub fn title(asked: &Asked) -> String {
    title_without(asked, &[])
}

/// The title without the parameters that vary in the figure.
pub(crate) fn title_without(Asked { system, units }: &Asked, varied: &[Parameter]) -> String {
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
    given.retain(|(parameter, _)| !varied.iter().any(|other| same_in_title(*other, *parameter)));
    // the frequency of a body is in Hz, whatever varies
    let units = &Units { hertz: units.hertz || units.body.is_some(), ..*units };
    let part = |(parameter, value): &(Parameter, f64)| {
        let (unit, number) = (units.unit_of(*parameter), short(value * units.of(*parameter)));
        match unit {
            "" => format!("{} = {number}", symbol(*parameter)),
            "Hz" => format!("*f* = {number} Hz"),
            unit if *parameter == Parameter::SecondGap => format!("*d*_2 = {number} {unit}"),
            unit => format!("*d* = {number} {unit}"),
        }
    };
    let parts: Vec<String> = given.iter().map(part).collect();
    parts.join(", ").replace('-', "−")
}

/// Whether a parameter that varies determines a number of the title.
fn same_in_title(varied: Parameter, number: Parameter) -> bool {
    let Parameter::Body(varied) = varied else { return varied.same_number(number) };
    match varied {
        BodyNumber::Frequency => number.is_frequency(),
        BodyNumber::Gap => number == Parameter::Gap,
        BodyNumber::SecondGap => number == Parameter::SecondGap,
        BodyNumber::Gaps => matches!(number, Parameter::Gap | Parameter::SecondGap),
        BodyNumber::Restitutions => matches!(number, Parameter::Restitution | Parameter::SecondRestitution),
        // the damping ratio of a given coefficient changes with the mass and the stiffness
        BodyNumber::Mass | BodyNumber::Stiffness | BodyNumber::DampingRatio | BodyNumber::DampingCoefficient => {
            number == Parameter::Damping
        }
        _ => false,
    }
}

/// The name of an axis along a line: the first number, and the range of the second one.
pub(crate) fn along<V: Varied>(cut: &Cut<V>, units: &Units) -> String {
    let name = cut.vary.axis(units);
    let Some(also) = &cut.also else { return name };
    // the axis rises, in whichever direction the line is followed
    let (from, to) = if cut.ends.0 <= cut.ends.1 { (also.from, also.to) } else { (also.to, also.from) };
    let value = |value: f64| short(value * also.parameter.unit(units)).replace('-', "−");
    format!("{name}, with {} from {} to {}", also.parameter.axis(units), value(from), value(to))
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
        Parameter::Body(number) => number.description(),
    }
}

/// The text of a label in a figure.
pub(crate) fn label(label: &str) -> String {
    match label {
        "0" => "no impact".into(),
        label => plain(label).replace("inf", "∞"),
    }
}

/// A title of a figure with the first `shown` of so many coordinates.
pub(crate) fn first_of(title: String, shown: usize, all: usize) -> String {
    if all > shown { format!("{title}: the first {shown} of {all} coordinates") } else { title }
}

/// The smallest and the largest of some values.
pub(crate) fn extremes(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

/// Colour number `k` of a series: without black, which is used for marks, and yellow, which is too light for thin lines and dots.
pub(crate) fn series(k: usize) -> Colour {
    const USABLE: usize = 6;
    variant(SERIES[k % USABLE], k / USABLE)
}

/// Variant number `k` of a colour, for the motions of one class: the colour itself, darker, lighter, darker still, and
/// so on.
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
