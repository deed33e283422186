//! The numbers of a body in the text of a question.

use vibroimpact_study::Body;

/// The numbers of a body with their names in plans, which are those of the flags too; `None` for a number in another form.
pub(super) fn numbers_of(body: &Body) -> Vec<(&'static str, Option<f64>)> {
    let nonzero = |value: f64| Some(value).filter(|value| value.to_bits() != 0);
    vec![
        ("mass_kg", body.mass_kg),
        ("stiffness_n_per_m", body.stiffness_n_per_m),
        ("damping_ns_per_m", body.damping_ns_per_m.and_then(nonzero)),
        ("damping_ratio", body.damping_ratio.and_then(nonzero)),
        ("log_decrement", body.log_decrement),
        ("force_n", body.force_n),
        ("frequency_hz", body.frequency_hz),
        ("omega_rad_per_s", body.omega_rad_per_s),
        ("gap_m", body.gap_m),
        ("second_gap_m", body.second_gap_m),
        ("base_displacement_m", body.base_displacement_m),
        ("base_velocity_m_per_s", body.base_velocity_m_per_s),
        ("base_acceleration_m_per_s2", body.base_acceleration_m_per_s2),
        ("base_phase", nonzero(body.base_phase)),
        ("stop_displacement_m", body.stop_displacement_m),
        ("stop_phase", nonzero(body.stop_phase)),
        ("unbalance_kg_m", body.unbalance_kg_m),
        ("constant_force_n", body.constant_force_n),
        ("gravity_m_per_s2", body.gravity_m_per_s2),
        ("restitution", body.restitution),
        ("second_restitution", body.second_restitution),
    ]
}

/// The units at the ends of names, longer ones before those at their ends.
const UNITS: [&str; 10] =
    ["_kg_m", "_kg", "_ns_per_m", "_n_per_m", "_m_per_s2", "_m_per_s", "_rad_per_s", "_n", "_hz", "_m"];

/// A name without its unit, as Python has it; the angular frequency is `omega`.
pub(super) fn without_unit(name: &str) -> &str {
    UNITS.iter().find_map(|unit| name.strip_suffix(unit)).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_without_units() {
        for (name, short) in [
            ("mass_kg", "mass"),
            ("stiffness_n_per_m", "stiffness"),
            ("damping_ns_per_m", "damping"),
            ("damping_ratio", "damping_ratio"),
            ("force_n", "force"),
            ("frequency_hz", "frequency"),
            ("omega_rad_per_s", "omega"),
            ("base_velocity_m_per_s", "base_velocity"),
            ("base_acceleration_m_per_s2", "base_acceleration"),
            ("unbalance_kg_m", "unbalance"),
            ("restitution", "restitution"),
        ] {
            assert_eq!(without_unit(name), short);
        }
    }
}
