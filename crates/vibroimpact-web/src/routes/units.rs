//! The physical units of a body: the units of a plan, and factors for parameters, by the conversion of the core.

use super::asked::Query;
use crate::refusal::Refusal;
use axum::Json;
use serde::{Deserialize, Serialize};
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

#[derive(Serialize)]
pub(super) struct BodyUnits {
    /// The units as a part of a plan: results of a plan with them are in SI units.
    units: UnitsPlan,
    /// One unit of velocity in m/s.
    velocity_m_per_s: f64,
    /// The natural frequency in Hz, one unit of the frequency ratio.
    natural_hz: f64,
    /// One unit of each quantity of a motion in its SI unit.
    quantities: BTreeMap<&'static str, f64>,
}

pub(super) async fn units(Query(numbers): Query<BodyNumbers>) -> Result<Json<BodyUnits>, Refusal> {
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
    Ok(Json(BodyUnits {
        units: plan,
        quantities: Quantity::ALL.into_iter().map(|of| (of.name(), units.of_quantity(of))).collect(),
        velocity_m_per_s: scales.velocity(),
        natural_hz: natural_hertz(&scales),
    }))
}
