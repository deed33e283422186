//! The points of the 1971 paper in a map.

use crate::Units;
use vibroimpact::Scales;
use vibroimpact::scenario::PAPER;
use vibroimpact_study::{
    Axis, BodyNumber, Coordinate, Parameter, Plan, System, SystemPlan, Task, natural_hertz, typed_axes,
};

/// The points that lie in the plane of a complete plan, with their positions in the units of the axes.
pub(super) fn named(plan: &Plan) -> Vec<(&'static str, [f64; 2])> {
    let units = Units::of_plan(plan);
    let (System::Oscillator(system), Task::Map(map)) = (&plan.system, &plan.task) else { return Vec::new() };
    let Ok(axes) = typed_axes::<Coordinate>(&map.axes) else { return Vec::new() };
    // other frames have other gaps
    if units.frame.is_some() || system.second_stop.is_some() {
        return Vec::new();
    }
    let Some(varied) = axes.iter().map(|axis| nondimensional(axis, &units)).collect::<Option<Vec<_>>>() else {
        return Vec::new();
    };
    let varies = |parameter: Parameter| varied.iter().any(|(other, _)| *other == parameter);
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
        let here = (frequency || same(Parameter::InverseBeta, inverse_beta(system)))
            && same(Parameter::Gap, system.gap)
            && same(Parameter::Restitution, system.restitution)
            && same(Parameter::Damping, system.damping);
        let place = |(parameter, unit): &(Parameter, f64)| Some(value(*parameter)? * unit);
        if let (true, [Some(x), Some(y)]) = (here, varied.iter().map(place).collect::<Vec<_>>().as_slice()) {
            found.push((point.name, [*x, *y]));
        }
    }
    found
}

fn inverse_beta(system: &SystemPlan) -> f64 {
    system.inverse_beta.or(system.beta.map(|beta| 1.0 / beta)).unwrap_or(f64::NAN)
}

/// The nondimensional parameter on an axis, and its unit there; `None` if there is none.
fn nondimensional(axis: &Axis, units: &Units) -> Option<(Parameter, f64)> {
    let Coordinate::Parameter(parameter) = axis.vary else { return None };
    Some(match parameter {
        Parameter::Body(BodyNumber::Frequency) => {
            (Parameter::Beta, units.scales.as_ref().map_or(1.0, |scales: &Scales| natural_hertz(scales)))
        }
        Parameter::Body(BodyNumber::Gap) => (Parameter::Gap, units.length()),
        Parameter::Body(BodyNumber::DampingRatio) => (Parameter::Damping, 1.0),
        Parameter::Body(_) => return None,
        parameter => (parameter, units.of(parameter)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(system: &str, axes: [(&str, &str); 2]) -> Vec<(&'static str, [f64; 2])> {
        let axis = |(vary, over): (&str, &str)| format!(r#"{{"vary":"{vary}","over":"{over}"}}"#);
        let text = format!(
            r#"{{"version":1,"system":{{{system}}},"task":{{"map":{{"axes":[{}],"starts":1}}}}}}"#,
            axes.map(axis).join(",")
        );
        named(&serde_json::from_str::<Plan>(&text).unwrap().complete().unwrap())
    }

    #[test]
    fn points_are_in_the_units_of_the_axes() {
        let plane = [("inverse_beta", "0.5:2:9"), ("gap", "0:5:9")];
        let plain = points(r#""inverse_beta":1,"gap":1,"restitution":0.5"#, plane);
        assert_eq!((plain.len(), plain[4]), (7, ("S", [1.3, 0.75])));
        assert!(points(r#""inverse_beta":1,"gap":1,"restitution":0.6"#, plane).is_empty());
        // S alone has its gap and frequency ratio
        let damping = [("damping", "0:0.1:3"), ("restitution", "0.4:0.6:3")];
        assert_eq!(points(r#""inverse_beta":1.3,"gap":0.75,"restitution":0.5"#, damping), [("S", [0.0, 0.5])]);
        let machine = points(
            r#""machine":{"mass_kg":2,"stiffness_n_per_m":800,"force_n":4,"restitution":0.5,"frequency_hz":3,"gap_m":0.01}"#,
            [("frequency_hz", "2:5:9"), ("gap_m", "0:0.02:9")],
        );
        let (name, [hertz, gap]) = machine[4];
        assert!(name == "S" && (hertz - 20.0 / core::f64::consts::TAU / 1.3).abs() < 1e-12, "{hertz}");
        assert!((gap - 0.75 * 0.005).abs() < 1e-15, "{gap}");
    }
}
