//! A system in physical units whose quantities may be ranges.

use super::parameter_flag::ParameterFlag;
use super::system::{Convention, MachineArgs, SystemArgs};
use super::{Place, Ranged, number};
use crate::failure::Failure;
use clap::Args;
use vibroimpact_report::{Asked, Units};
use vibroimpact_study::{Axis, Parameter, Values};

/// The quantities of a machine, single values and ranges. Results are in SI units.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "System in physical units (instead of beta, gap and damping); results are in SI units")]
pub(crate) struct MachineRangesArgs {
    /// Mass in kg, positive
    #[arg(long, value_parser = number, value_name = "M", allow_hyphen_values = true)]
    mass_kg: Option<f64>,

    /// Stiffness in N/m, positive
    #[arg(long, value_parser = number, value_name = "K", allow_hyphen_values = true)]
    stiffness_n_per_m: Option<f64>,

    /// Amplitude of the force in N, positive
    #[arg(long, value_parser = number, value_name = "F", allow_hyphen_values = true)]
    force_n: Option<f64>,

    /// Viscous damping in N s/m, 0 or more [default: 0]
    #[arg(long, value_parser = number, value_name = "C", allow_hyphen_values = true, conflicts_with = "damping_ratio")]
    damping_ns_per_m: Option<f64>,

    /// Damping ratio c / (2 sqrt(k m)) instead
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    damping_ratio: Option<Ranged>,

    /// Frequency of the force in Hz, positive
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    frequency_hz: Option<Ranged>,

    /// Distance of the stop from the rest position in m
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    gap_m: Option<Ranged>,

    /// A second stop on the other side, its distance in m
    #[arg(long, value_name = "VALUES", allow_hyphen_values = true)]
    second_gap_m: Option<Ranged>,
}

impl MachineRangesArgs {
    /// Whether any quantity is given.
    pub(crate) const fn given(&self) -> bool {
        self.mass_kg.is_some()
            || self.stiffness_n_per_m.is_some()
            || self.force_n.is_some()
            || self.damping_ns_per_m.is_some()
            || self.damping_ratio.is_some()
            || self.frequency_hz.is_some()
            || self.gap_m.is_some()
            || self.second_gap_m.is_some()
    }

    /// Whether there is a second stop.
    pub(crate) const fn has_second_stop(&self) -> bool {
        self.second_gap_m.is_some()
    }

    /// The quantities that may be ranges.
    fn ranges(&self) -> [(Parameter, Option<&Ranged>); 4] {
        [
            (Parameter::Beta, self.frequency_hz.as_ref()),
            (Parameter::Gap, self.gap_m.as_ref()),
            (Parameter::Damping, self.damping_ratio.as_ref()),
            (Parameter::SecondGap, self.second_gap_m.as_ref()),
        ]
    }

    /// The system with the first value of each range, and SI units. `restitutions` are those of both stops.
    pub(crate) fn first(&self, restitutions: (f64, Option<f64>)) -> Result<Asked, Failure> {
        let place = |ranged: &Option<Ranged>| ranged.as_ref().map(|ranged| Place::At(ranged.first()));
        let machine = MachineArgs {
            mass_kg: self.mass_kg,
            damping_ns_per_m: self.damping_ns_per_m,
            damping_ratio: self.damping_ratio.as_ref().map(Ranged::first),
            stiffness_n_per_m: self.stiffness_n_per_m,
            force_n: self.force_n,
            frequency_hz: place(&self.frequency_hz),
            omega_rad_per_s: None,
            gap_m: place(&self.gap_m),
            second_gap_m: place(&self.second_gap_m),
        };
        let values = [(Parameter::Restitution, Some(restitutions.0)), (Parameter::SecondRestitution, restitutions.1)];
        let asked = SystemArgs::of(&values, machine, Convention::Si).asked()?;
        Ok(Asked { units: Units { hertz: true, ..asked.units }, ..asked })
    }

    /// The axes of its ranges, in nondimensional values.
    pub(crate) fn axes(&self, units: &Units) -> Result<Vec<(Parameter, Axis)>, Failure> {
        let mut axes = Vec::new();
        for (parameter, ranged) in self.ranges() {
            let Some(Ranged::Over(values)) = ranged else { continue };
            let unit = units.of(parameter);
            let over = match values {
                Values::Span(span) => Values::Span(span.scaled(unit)?),
                Values::Listed(list) => Values::Listed(list.iter().map(|value| value / unit).collect()),
            };
            axes.push((parameter, Axis::parameter(parameter, over)));
        }
        Ok(axes)
    }

    /// The parameters whose flag in nondimensional units would give a quantity twice.
    pub(crate) fn nondimensional_twins() -> [ParameterFlag; 5] {
        [Parameter::Beta, Parameter::InverseBeta, Parameter::Gap, Parameter::Damping, Parameter::SecondGap]
            .map(|parameter| ParameterFlag { parameter, si: false })
    }
}
