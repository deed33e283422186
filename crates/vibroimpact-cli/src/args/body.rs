//! BODY: the system in SI units, and what drives it.

use super::parameter_flag::flag;
use super::ranged::{Ranged, with_unit};
use super::unit_text::UnitKind;
use crate::failure::Failure;
use clap::Args;
use vibroimpact_report::{Asked, Units};
use vibroimpact_study::{Axis, Body, BodyNumber, Parameter, SystemPlan, UnitsPlan, Values};

/// The system as a body: mass, stiffness, force, frequency, gap and restitution, instead of --beta, --gap and --damping.
#[derive(Clone, Debug, Default, Args)]
#[command(
    next_help_heading = "System in physical units (instead of beta, gap and damping); units may be written: 1.5mm, 900rpm"
)]
pub(crate) struct BodyArgs {
    /// Mass in kg, positive
    #[arg(long, visible_alias = "mass", value_parser = with_unit(UnitKind::Mass), value_name = "M", allow_hyphen_values = true)]
    mass_kg: Option<Ranged>,

    /// Stiffness in N/m, positive
    #[arg(long, visible_alias = "stiffness", value_parser = with_unit(UnitKind::Stiffness), value_name = "K", allow_hyphen_values = true)]
    stiffness_n_per_m: Option<Ranged>,

    /// Viscous damping in N s/m, 0 or more [default: 0]
    #[arg(long, value_parser = with_unit(UnitKind::DampingCoefficient), value_name = "C", allow_hyphen_values = true, group = "damper")]
    damping_ns_per_m: Option<Ranged>,

    /// Damping ratio c / (2 sqrt(k m)) instead
    #[arg(long, value_parser = with_unit(UnitKind::Ratio), value_name = "Z", allow_hyphen_values = true, group = "damper")]
    damping_ratio: Option<Ranged>,

    /// Logarithmic decrement of free vibrations instead
    #[arg(long, value_parser = with_unit(UnitKind::Ratio), value_name = "L", allow_hyphen_values = true, group = "damper")]
    log_decrement: Option<Ranged>,

    /// Amplitude of the force in N, positive
    #[arg(long, value_parser = with_unit(UnitKind::Force), value_name = "F", allow_hyphen_values = true)]
    force_n: Option<Ranged>,

    /// Frequency of the force in Hz, positive
    #[arg(long, visible_alias = "frequency", value_parser = with_unit(UnitKind::Frequency), value_name = "HZ", allow_hyphen_values = true, conflicts_with = "omega_rad_per_s")]
    frequency_hz: Option<Ranged>,

    /// Frequency of the force in rad/s instead
    #[arg(long, visible_alias = "omega", value_parser = with_unit(UnitKind::AngularFrequency), value_name = "W", allow_hyphen_values = true)]
    omega_rad_per_s: Option<Ranged>,

    /// Distance of the stop from the rest position in m
    #[arg(long, value_parser = with_unit(UnitKind::Length), value_name = "D", allow_hyphen_values = true)]
    gap_m: Option<Ranged>,

    /// A second stop on the other side, its distance in m
    #[arg(long, value_parser = with_unit(UnitKind::Length), value_name = "D2", allow_hyphen_values = true)]
    second_gap_m: Option<Ranged>,

    /// Two stops at this distance in m on both sides, instead of --gap-m and --second-gap-m
    #[arg(long, value_parser = with_unit(UnitKind::Length), value_name = "D", allow_hyphen_values = true, conflicts_with_all = ["gap_m", "second_gap_m"])]
    gaps_m: Option<Ranged>,

    /// Amplitude of the displacement of the base in m; the stop is on the base
    #[arg(long, value_parser = with_unit(UnitKind::Length), value_name = "Y", group = "base", help_heading = EXCITATION)]
    base_displacement_m: Option<Ranged>,

    /// Amplitude of the velocity of the base instead, in m/s
    #[arg(long, value_parser = with_unit(UnitKind::Velocity), value_name = "V", group = "base", help_heading = EXCITATION)]
    base_velocity_m_per_s: Option<Ranged>,

    /// Amplitude of the acceleration of the base instead, in m/s^2
    #[arg(long, value_parser = with_unit(UnitKind::Acceleration), value_name = "A", group = "base", help_heading = EXCITATION)]
    base_acceleration_m_per_s2: Option<Ranged>,

    /// Phase of the base relative to the force, in radians
    #[arg(long, value_parser = super::number, value_name = "P", default_value_t = 0.0, allow_hyphen_values = true, requires = "base", help_heading = EXCITATION)]
    base_phase: f64,

    /// The stop is fixed in space and does not move with the base
    #[arg(long, requires = "base", help_heading = EXCITATION)]
    stop_in_space: bool,

    /// Amplitude of the displacement of the stop in m, of a base at rest
    #[arg(long, value_parser = with_unit(UnitKind::Length), value_name = "R", conflicts_with = "base", help_heading = EXCITATION)]
    stop_displacement_m: Option<Ranged>,

    /// Phase of the stop relative to the force, in radians
    #[arg(long, value_parser = super::number, value_name = "P", default_value_t = 0.0, allow_hyphen_values = true, requires = "stop_displacement_m", help_heading = EXCITATION)]
    stop_phase: f64,

    /// Rotating unbalance in kg m, whose force grows as the square of the frequency
    #[arg(long, value_parser = with_unit(UnitKind::Unbalance), value_name = "ME", help_heading = EXCITATION)]
    unbalance_kg_m: Option<Ranged>,

    /// Constant force in N towards the stop; negative away from it
    #[arg(long, value_parser = with_unit(UnitKind::Force), value_name = "F0", allow_hyphen_values = true, help_heading = EXCITATION)]
    constant_force_n: Option<Ranged>,

    /// Acceleration of gravity in m/s^2 towards the stop, negative away from it, such as -1g; its force follows the mass
    #[arg(long, visible_alias = "gravity", value_parser = with_unit(UnitKind::Acceleration), value_name = "G", allow_hyphen_values = true, help_heading = EXCITATION)]
    gravity_m_per_s2: Option<Ranged>,
}

const EXCITATION: &str = "Excitation of a system in physical units, besides the force or instead of it";

/// A number of the body and the ends of its range.
pub(crate) type Ends = (Parameter, (f64, f64));

impl BodyArgs {
    /// The numbers that are given, in the order of the flags. The damping ratio stands for the logarithmic decrement too,
    /// and the frequency in Hz for that in rad/s; those two forms cannot vary.
    fn given(&self) -> impl Iterator<Item = (BodyNumber, &Ranged)> {
        use BodyNumber as P;
        let all = [
            (P::Mass, &self.mass_kg),
            (P::Stiffness, &self.stiffness_n_per_m),
            (P::DampingCoefficient, &self.damping_ns_per_m),
            (P::DampingRatio, &self.damping_ratio),
            (P::Force, &self.force_n),
            (P::Frequency, &self.frequency_hz),
            (P::Gap, &self.gap_m),
            (P::SecondGap, &self.second_gap_m),
            (P::Gaps, &self.gaps_m),
            (P::BaseDisplacement, &self.base_displacement_m),
            (P::BaseVelocity, &self.base_velocity_m_per_s),
            (P::BaseAcceleration, &self.base_acceleration_m_per_s2),
            (P::StopDisplacement, &self.stop_displacement_m),
            (P::Unbalance, &self.unbalance_kg_m),
            (P::ConstantForce, &self.constant_force_n),
            (P::Gravity, &self.gravity_m_per_s2),
        ];
        all.into_iter().filter_map(|(parameter, given)| Some((parameter, given.as_ref()?)))
    }

    /// Whether anything is given.
    pub(crate) fn any(&self) -> bool {
        self.given().next().is_some() || self.log_decrement.is_some() || self.omega_rad_per_s.is_some()
    }

    /// Whether a second stop is given.
    pub(super) const fn has_second_stop(&self) -> bool {
        self.second_gap_m.is_some() || self.gaps_m.is_some()
    }

    /// A gap that was written with its unit under its nondimensional name.
    pub(super) fn put(&mut self, parameter: BodyNumber, value: Ranged) {
        match parameter {
            BodyNumber::Gap => self.gap_m = Some(value),
            BodyNumber::SecondGap => self.second_gap_m = Some(value),
            BodyNumber::DampingCoefficient => self.damping_ns_per_m = Some(value),
            _ => {}
        }
    }

    /// The numbers with several values.
    pub(crate) fn ranges(&self) -> impl Iterator<Item = (BodyNumber, &Ranged)> {
        self.given().filter(|(_, ranged)| !ranged.is_one())
    }

    /// Refuses several values of a number.
    pub(super) fn one_value(&self, hint: &str) -> Result<(), Failure> {
        let numbers = self.ranges().map(|(number, given)| (flag(Parameter::Body(number)), given));
        let others = [("log-decrement", &self.log_decrement), ("omega-rad-per-s", &self.omega_rad_per_s)];
        let others = others.into_iter().filter_map(|(flag, given)| Some((flag, given.as_ref()?)));
        let Some((flag, given)) = numbers.chain(others).find(|(_, given)| !given.is_one()) else {
            return Ok(());
        };
        let hint = hint.replace("FLAG", flag);
        Err(Failure::bad(match given {
            Ranged::Over(Values::Listed(values)) => {
                let point = "of one number the decimal sign is a point";
                format!("--{flag} has {} values, and here it has one\nhint: {point}; {hint}", values.len())
            }
            _ => format!("--{flag} is a range, and here it has one value\nhint: {hint}"),
        }))
    }

    /// The numbers with several values, which are ranges A:B.
    pub(crate) fn ends(&self) -> Result<Vec<Ends>, Failure> {
        let ends = |(number, ranged): (BodyNumber, &Ranged)| {
            let parameter = Parameter::Body(number);
            let ends = ranged.ends().filter(|(from, to)| from < to);
            ends.map(|ends| (parameter, ends))
                .ok_or_else(|| Failure::bad(format!("--{} is not A:B with finite A < B", flag(parameter))))
        };
        self.ranges().map(ends).collect()
    }

    /// The axes over the numbers with several values.
    pub(super) fn axes(&self) -> Result<Vec<(Parameter, Axis)>, Failure> {
        let axis = |(number, ranged): (BodyNumber, &Ranged)| {
            let parameter = Parameter::Body(number);
            ranged.axis(parameter).map(|axis| (parameter, axis)).ok_or_else(|| {
                let ((from, to), flag) = (ranged.ends().unwrap_or_default(), flag(parameter));
                Failure::bad(format!(
                    "--{flag} {from}:{to} has no number of values\nhint: --{flag} {from}:{to}:41 has 41 values"
                ))
            })
        };
        self.ranges().map(axis).collect()
    }

    /// The body with the first value of each range; `set` gives numbers that vary their first values. An error names all
    /// that is missing.
    pub(super) fn plan(
        &self,
        (restitution, second_restitution): (Option<f64>, Option<f64>),
        set: &[(BodyNumber, f64)],
    ) -> Result<Body, Failure> {
        let first = |given: &Option<Ranged>| given.as_ref().map(Ranged::first);
        let mut plan = Body {
            log_decrement: first(&self.log_decrement),
            omega_rad_per_s: first(&self.omega_rad_per_s),
            restitution,
            base_phase: self.base_phase,
            stop_in_space: self.stop_in_space,
            stop_phase: self.stop_phase,
            ..Body::default()
        };
        let given = self.given().map(|(parameter, ranged)| (parameter, ranged.first()));
        given.chain(set.iter().copied()).for_each(|(parameter, value)| plan.set(parameter, value));
        plan.second_restitution = plan.second_gap_m.and(second_restitution);
        let missing = [
            ("--mass-kg", plan.mass_kg.is_none()),
            ("--stiffness-n-per-m", plan.stiffness_n_per_m.is_none()),
            ("--force-n", plan.force_n.is_none() && !plan.is_shaken()),
            ("--frequency-hz", plan.frequency_hz.or(plan.omega_rad_per_s).is_none()),
            ("--gap-m", plan.gap_m.is_none()),
            ("--restitution", plan.restitution.is_none()),
        ];
        let missing: Vec<&str> = missing.iter().filter(|(_, missing)| *missing).map(|(flag, _)| *flag).collect();
        if missing.is_empty() {
            return Ok(plan);
        }
        Err(Failure::bad(format!(
            "a system in physical units needs all of its quantities; missing: {}",
            missing.join(", ")
        )))
    }
}

/// The system of a body: in SI units, or nondimensional with the units of the body beside it.
pub(super) fn asked(plan: &Body, si: bool) -> Result<Asked, Failure> {
    let system = SystemPlan::of_body(plan)?;
    let units = UnitsPlan::of_system(&system).as_ref().map(Units::from).unwrap_or_default();
    // without --units si the body only gives the scales
    let body = system.body.filter(|_| si);
    Ok(Asked { system: SystemPlan { body, ..system }, units: Units { si, hertz: false, body, ..units } })
}

/// The parameter of the oscillator that a number of a body is, apart from its unit; `None` if other numbers of the
/// oscillator change with it.
pub(crate) fn alone(number: BodyNumber, body: &Body) -> Option<Parameter> {
    let plain_force =
        body.unbalance_kg_m.is_none() && body.base_displacement() == 0.0 && body.stop_displacement() == 0.0;
    let plain_rest = body.constant_force_n.is_none() && body.gravity_m_per_s2.is_none();
    match number {
        BodyNumber::Frequency => plain_force.then_some(Parameter::Beta),
        BodyNumber::DampingRatio => (!body.stop_apart()).then_some(Parameter::Damping),
        BodyNumber::Gap => plain_rest.then_some(Parameter::Gap),
        BodyNumber::SecondGap => plain_rest.then_some(Parameter::SecondGap),
        _ => None,
    }
}
