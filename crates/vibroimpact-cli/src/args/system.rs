//! SYSTEM: the oscillator, in nondimensional or in physical units.

use super::excitation::ExcitationArgs;
use super::parameter_flag::ParameterFlag;
use super::{Place, number};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use vibroimpact::{Frequency, Machine};
use vibroimpact_report::{Asked, Units};
use vibroimpact_study::{FramePlan, Parameter, SecondStop, SystemPlan};

#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "System")]
pub(crate) struct SystemArgs {
    /// Frequency ratio: forcing over natural frequency, omega/omega_n; positive
    #[arg(long, value_parser = number, value_name = "B", allow_hyphen_values = true, conflicts_with = "inverse_beta")]
    beta: Option<f64>,

    /// Its inverse omega_n/omega instead, the abscissa of the 1971 paper; positive
    #[arg(long, value_parser = number, value_name = "X", allow_hyphen_values = true)]
    inverse_beta: Option<f64>,

    /// Distance of the stop from the rest position in units of F/k; negative presses the mass against it
    #[arg(long, value_parser = number, value_name = "D", allow_hyphen_values = true)]
    gap: Option<f64>,

    /// Restitution: rebound speed over arrival speed, 0 to 1
    #[arg(long, value_parser = number, value_name = "E", allow_hyphen_values = true)]
    restitution: Option<f64>,

    /// Damping ratio zeta = c / (2 sqrt(k m)), 0 or more [default: 0]
    #[arg(long, value_parser = number, value_name = "Z", allow_hyphen_values = true)]
    damping: Option<f64>,

    /// A second stop on the other side, at x = -D2
    #[arg(long, value_parser = number, value_name = "D2", allow_hyphen_values = true)]
    second_gap: Option<f64>,

    /// Restitution of the second stop [default: that of the first]
    #[arg(long, value_parser = number, value_name = "E2", allow_hyphen_values = true)]
    second_restitution: Option<f64>,

    #[command(flatten)]
    pub(super) machine: MachineArgs,

    #[command(flatten)]
    pub(super) excitation: ExcitationArgs,

    /// Units of starts, ranges and results
    #[arg(long, value_enum, value_name = "UNITS", default_value_t = Convention::Nondimensional)]
    units: Convention,
}

/// The oscillator as a machine: all of these (damping may be left out) with --restitution, instead of --beta, --gap and --damping.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "System in physical units (instead of beta, gap and damping)")]
pub(crate) struct MachineArgs {
    /// Mass in kg, positive
    #[arg(long, value_parser = number, value_name = "M", allow_hyphen_values = true)]
    pub(super) mass_kg: Option<f64>,

    /// Viscous damping in N s/m, 0 or more [default: 0]
    #[arg(long, value_parser = number, value_name = "C", allow_hyphen_values = true, conflicts_with = "damping_ratio")]
    pub(super) damping_ns_per_m: Option<f64>,

    /// Damping ratio c / (2 sqrt(k m)) instead
    #[arg(long, value_parser = number, value_name = "Z", allow_hyphen_values = true)]
    pub(super) damping_ratio: Option<f64>,

    /// Stiffness in N/m, positive
    #[arg(long, value_parser = number, value_name = "K", allow_hyphen_values = true)]
    pub(super) stiffness_n_per_m: Option<f64>,

    /// Amplitude of the force in N, positive
    #[arg(long, value_parser = number, value_name = "F", allow_hyphen_values = true)]
    pub(super) force_n: Option<f64>,

    /// Frequency of the force in Hz, positive; a range A:B where this command takes ranges
    #[arg(long, value_name = "HZ", allow_hyphen_values = true, conflicts_with = "omega_rad_per_s")]
    pub(super) frequency_hz: Option<Place>,

    /// Frequency of the force in rad/s instead
    #[arg(long, value_parser = number, value_name = "W", allow_hyphen_values = true)]
    pub(super) omega_rad_per_s: Option<f64>,

    /// Distance of the stop from the rest position in m
    #[arg(long, value_name = "D", allow_hyphen_values = true)]
    pub(super) gap_m: Option<Place>,

    /// A second stop on the other side, its distance in m
    #[arg(long, value_name = "D2", allow_hyphen_values = true)]
    pub(super) second_gap_m: Option<Place>,
}

/// What lengths, velocities and times are measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Convention {
    /// F/k, and 1/omega_n
    Nondimensional,
    /// Metres and seconds; needs the system in physical units
    Si,
}

impl SystemArgs {
    /// The system, in which no quantity is a range.
    pub(crate) fn asked(&self) -> Result<Asked, Failure> {
        if let Some((named, _)) = self.machine.ranges().iter().find(|(_, place)| matches!(place, Some(Place::Over(_))))
        {
            return Err(Failure::bad(format!(
                "--{0} is a range, and here it has one value\nhint: `vibro map`, `vibro region` and `vibro response` take ranges; --vary {0} elsewhere",
                named.flag()
            )));
        }
        self.first()
    }

    /// The system with the first value of each range.
    pub(crate) fn first(&self) -> Result<Asked, Failure> {
        let restitution = self.restitution.unwrap_or(0.0);
        let machine = self.machine.machine(self.restitution, &self.excitation)?;
        let second = self.second_gap.or(self.machine.second_gap_m.map(Place::first));
        let second_stop = |unit: f64, offset: f64| {
            second.map(|gap| SecondStop {
                gap: (gap + offset) / unit,
                restitution: self.second_restitution.unwrap_or(restitution),
            })
        };
        if second.is_none() && self.second_restitution.is_some() {
            return Err(Failure::bad("the second stop has a restitution but no gap\nhint: --second-gap D2"));
        }
        let Some(machine) = machine else {
            if self.units == Convention::Si {
                return Err(Failure::bad(
                    "--units si needs the system in physical units\nhint: --mass-kg, --stiffness-n-per-m, --force-n ...",
                ));
            }
            let gap = self.complete()?;
            let system = SystemPlan {
                beta: self.beta,
                inverse_beta: self.inverse_beta,
                gap,
                restitution,
                damping: self.damping.unwrap_or(0.0),
                second_stop: second_stop(1.0, 0.0),
            };
            return Ok(Asked { system, units: Units::default() });
        };
        let twice = [
            ("--beta", self.beta),
            ("--inverse-beta", self.inverse_beta),
            ("--gap", self.gap),
            ("--damping", self.damping),
            ("--second-gap", self.second_gap),
        ];
        if let Some((flag, _)) = twice.iter().find(|(_, value)| value.is_some()) {
            return Err(Failure::bad(format!("{flag} cannot go together with a system in physical units")));
        }
        let frame = self.excitation.given().then(|| self.excitation.equivalent(&machine)).transpose()?;
        let machine = frame.map_or(machine, |same| same.machine);
        let (osc, scales) = machine.nondimensional()?;
        // the constant force moves the equilibrium away from the second stop
        let offset = frame.map_or(0.0, |same| same.offset_m);
        let system = SystemPlan {
            beta: Some(osc.beta()),
            inverse_beta: None,
            gap: osc.gap(),
            restitution,
            // a given ratio is not rounded by a conversion
            damping: self.machine.damping_ratio.unwrap_or_else(|| osc.damping()),
            second_stop: second_stop(scales.length_m, offset),
        };
        let si = self.units == Convention::Si;
        let frame =
            frame.map(|same| FramePlan { phase: same.phase, offset_m: same.offset_m, apart: self.excitation.apart() });
        let units = Units { scales: Some(scales), si, hertz: false, frame };
        Ok(Asked { system, units })
    }
}

impl SystemArgs {
    /// The gap of a nondimensional system; an error if a required parameter is missing.
    fn complete(&self) -> Result<f64, Failure> {
        let needed = [
            ("the frequency ratio", "--beta B or --inverse-beta X", self.beta.or(self.inverse_beta)),
            ("the gap", "--gap D", self.gap),
            ("the restitution", "--restitution E", self.restitution),
        ];
        let missing = needed.iter().filter(|(.., value)| value.is_none());
        let (names, flags): (Vec<&str>, Vec<&str>) = missing.map(|(name, flag, _)| (*name, *flag)).unzip();
        let said = match names.as_slice() {
            // if only the frequency is missing, the plan reports it with the same message in all interfaces
            [] | ["the frequency ratio"] => return Ok(self.gap.unwrap_or(0.0)),
            [one] => format!("{one} is not given"),
            [first @ .., last] => format!("{} and {last} are not given", first.join(", ")),
        };
        Err(Failure::bad(format!("{said}\nhint: {}", flags.join(", "))))
    }
}

/// Functions for a plane, whose values may be ranges.
impl SystemArgs {
    /// The system with these values.
    pub(crate) fn of(values: &[(Parameter, Option<f64>)], machine: MachineArgs, units: Convention) -> Self {
        let mut args = Self {
            beta: None,
            inverse_beta: None,
            gap: None,
            restitution: None,
            damping: None,
            second_gap: None,
            second_restitution: None,
            machine,
            excitation: ExcitationArgs::default(),
            units,
        };
        for (parameter, value) in values {
            *args.slot(*parameter) = *value;
        }
        args
    }
}

/// Functions for a parameter that varies.
impl SystemArgs {
    pub(super) const fn slot(&mut self, parameter: Parameter) -> &mut Option<f64> {
        match parameter {
            Parameter::Beta => &mut self.beta,
            Parameter::InverseBeta => &mut self.inverse_beta,
            Parameter::Gap => &mut self.gap,
            Parameter::Restitution => &mut self.restitution,
            Parameter::Damping => &mut self.damping,
            Parameter::SecondGap => &mut self.second_gap,
            Parameter::SecondRestitution => &mut self.second_restitution,
        }
    }

    /// Whether there is a second stop with the restitution of the first.
    pub(super) const fn second_stop_follows(&self) -> bool {
        (self.second_gap.is_some() || self.machine.second_gap_m.is_some()) && self.second_restitution.is_none()
    }

    /// Whether it is given in physical units.
    pub(crate) const fn is_machine(&self) -> bool {
        self.machine.mass_kg.is_some()
    }
}

impl MachineArgs {
    /// The ranges among its quantities, in SI units.
    pub(crate) fn ranges(&self) -> [(ParameterFlag, Option<Place>); 3] {
        [(Parameter::Beta, self.frequency_hz), (Parameter::Gap, self.gap_m), (Parameter::SecondGap, self.second_gap_m)]
            .map(|(parameter, place)| (ParameterFlag { parameter, si: true }, place))
    }

    /// Gives a quantity this value if it has none.
    pub(super) fn complete_with(&mut self, named: ParameterFlag, value: f64) {
        let slot = match named.parameter {
            Parameter::Beta if self.omega_rad_per_s.is_none() => &mut self.frequency_hz,
            Parameter::Gap => &mut self.gap_m,
            Parameter::SecondGap => &mut self.second_gap_m,
            _ => return,
        };
        slot.get_or_insert(Place::At(value));
    }

    /// The machine in physical units, if any of its quantities is given; then all are required.
    fn machine(&self, restitution: Option<f64>, excitation: &ExcitationArgs) -> Result<Option<Machine>, Failure> {
        let frequency = match (self.frequency_hz, self.omega_rad_per_s) {
            (Some(hertz), _) => Some(Frequency::Hz(hertz.first())),
            (None, omega) => omega.map(Frequency::RadPerS),
        };
        let given = [
            ("--mass-kg", self.mass_kg),
            ("--stiffness-n-per-m", self.stiffness_n_per_m),
            ("--force-n", self.force_n.or(excitation.drives().then_some(0.0))),
            ("--frequency-hz", frequency.map(Frequency::rad_per_s)),
            ("--gap-m", self.gap_m.map(Place::first)),
        ];
        if given.iter().all(|(_, value)| value.is_none())
            && self.damping_ns_per_m.is_none()
            && self.damping_ratio.is_none()
        {
            return match self.second_gap_m {
                Some(_) => Err(Failure::bad(
                    "--second-gap-m needs the system in physical units\nhint: --second-gap D2 is its nondimensional twin",
                )),
                None => Ok(None),
            };
        }
        let needed = given.iter().copied().chain([("--restitution", restitution)]);
        let missing: Vec<&str> = needed.filter(|(_, value)| value.is_none()).map(|(flag, _)| flag).collect();
        let (Some(mass_kg), Some(stiffness_n_per_m), Some(force_n), Some(frequency), Some(gap_m), Some(restitution)) =
            (self.mass_kg, self.stiffness_n_per_m, given[2].1, frequency, self.gap_m.map(Place::first), restitution)
        else {
            return Err(Failure::bad(format!(
                "a system in physical units needs all of its quantities; missing: {}",
                missing.join(", ")
            )));
        };
        let of_ratio = |ratio: f64| 2.0 * ratio * (stiffness_n_per_m.sqrt() * mass_kg.sqrt());
        let damping_ns_per_m = self.damping_ns_per_m.or(self.damping_ratio.map(of_ratio)).unwrap_or(0.0);
        Ok(Some(Machine { mass_kg, damping_ns_per_m, stiffness_n_per_m, force_n, frequency, gap_m, restitution }))
    }
}
