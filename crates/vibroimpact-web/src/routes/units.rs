//! The physical units of a body: the units of a plan, and factors for parameters, by the conversion of the core.

use super::asked::Query;
use crate::refusal::Refusal;
use axum::Json;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use vibroimpact_report::Units;
use vibroimpact_study::{Body, Quantity, UnitsPlan, natural_hertz};

/// The numbers that fix the units.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyNumbers {
    mass_kg: f64,
    stiffness_n_per_m: f64,
    force_n: f64,
}

/// The units as a part of a plan, with which its results are in SI units, one unit of each quantity of a motion in its SI unit, one unit
/// of velocity in m/s, and the natural frequency in Hz, which is one unit of the frequency ratio.
pub(super) async fn units(Query(numbers): Query<BodyNumbers>) -> Result<Json<Value>, Refusal> {
    let BodyNumbers { mass_kg, stiffness_n_per_m, force_n } = numbers;
    // the units do not depend on frequency, damping and stop
    let body = Body {
        mass_kg: Some(mass_kg),
        stiffness_n_per_m: Some(stiffness_n_per_m),
        force_n: Some(force_n),
        frequency_hz: Some(1.0),
        gap_m: Some(0.0),
        restitution: Some(1.0),
        ..Body::default()
    };
    let scales = body.reduction().map_err(|error| Refusal::bad(error.to_string()))?.scales();
    let plan = UnitsPlan::new(&scales, true, None);
    let units = Units::from(&plan);
    let of_quantity = |of: Quantity| (of.name(), units.of_quantity(of));
    Ok(Json(json!({
        "units": plan,
        "velocity_m_per_s": scales.velocity(),
        "natural_hz": natural_hertz(&scales),
        "quantities": Quantity::ALL.into_iter().map(of_quantity).collect::<BTreeMap<_, _>>(),
    })))
}
