//! The numbers of a body in the text of a question.

use vibroimpact_study::Body;

/// The numbers of a body with their names in plans, which are those of the flags too. A damper of 0 is none.
pub(super) fn numbers_of(body: &Body) -> Vec<(String, f64)> {
    let text = serde_json::to_value(body).unwrap_or_default();
    let numbers = text.as_object().into_iter().flatten();
    let numbers = numbers.filter_map(|(name, value)| Some((name.clone(), value.as_f64()?)));
    numbers.filter(|(name, value)| !name.starts_with("damping") || value.to_bits() != 0).collect()
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
