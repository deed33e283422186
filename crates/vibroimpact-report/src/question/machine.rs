//! The numbers of a machine in the text of a question.

use vibroimpact::DrivenOscillator;
use vibroimpact_study::PhysicalPlan;

/// The numbers of a machine with their names in plans, which are those of the flags too; `None` for a number in another form.
pub(super) fn numbers_of(machine: &DrivenOscillator) -> Vec<(&'static str, Option<f64>)> {
    let plan = PhysicalPlan::from(machine);
    let nonzero = |value: f64| Some(value).filter(|value| value.to_bits() != 0);
    vec![
        ("mass_kg", plan.mass_kg),
        ("stiffness_n_per_m", plan.stiffness_n_per_m),
        ("damping_ns_per_m", plan.damping_ns_per_m.and_then(nonzero)),
        ("damping_ratio", plan.damping_ratio.and_then(nonzero)),
        ("log_decrement", plan.log_decrement),
        ("force_n", plan.force_n),
        ("frequency_hz", plan.frequency_hz),
        ("omega_rad_per_s", plan.omega_rad_per_s),
        ("gap_m", plan.gap_m),
        ("second_gap_m", plan.second_gap_m),
        ("base_displacement_m", plan.base_displacement_m),
        ("base_velocity_m_per_s", plan.base_velocity_m_per_s),
        ("base_acceleration_m_per_s2", plan.base_acceleration_m_per_s2),
        ("base_phase", nonzero(plan.base_phase)),
        ("stop_displacement_m", plan.stop_displacement_m),
        ("stop_phase", nonzero(plan.stop_phase)),
        ("unbalance_kg_m", plan.unbalance_kg_m),
        ("constant_force_n", plan.constant_force_n),
        ("gravity_m_per_s2", plan.gravity_m_per_s2),
        ("restitution", plan.restitution),
        ("second_restitution", plan.second_restitution),
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
