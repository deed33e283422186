//! Lyapunov exponents as text.

use crate::report::motion::Teller;
use crate::report::words::{meaning, seconds, stop_name, table};
use std::fmt::Write;
use vibroimpact::chaos::{Exponents, Grounds, Measured};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::NoImpact;
use vibroimpact_report::number::short;
use vibroimpact_report::{AnswerOf, Units};
use vibroimpact_study::machine::MachineSource;

/// The text of a measured number: `0.01862 +- 0.00023`, rounded according to its error; `minus infinity`, `none`, or
/// the number alone if it is exact.
fn said(of: Measured) -> String {
    if of.value == f64::NEG_INFINITY {
        "minus infinity".into()
    } else if of.error == 0.0 || !of.value.is_finite() {
        short(of.value)
    } else if of.error < 1e-6 * of.value.abs() {
        // very small errors are printed with an exponent, because they would need too many digits
        format!("{} +- {:.0e}", short(of.value), of.error)
    } else {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 9
        let places = (1.0 - of.error.log10().floor()).clamp(0.0, 9.0) as usize;
        format!("{:.places$} +- {:.places$}", of.value, of.error)
    }
}

/// Exponents of any system, as they are told.
struct Told {
    /// The label and the meaning of the motion.
    motion: String,
    /// The unit of time.
    time: &'static str,
    /// The names of the exponents, and their values per unit of time.
    exponents: Vec<(String, Measured)>,
    /// The forcing period in these units; `None` without forcing.
    period: Option<f64>,
    impacts_per_period: Option<Measured>,
    /// The dimensions of the section and of the flow.
    dimensions: Option<(Measured, Measured)>,
    /// The coordinates of the flow.
    space: &'static str,
    grounds: String,
}

impl Told {
    fn text(self) -> String {
        let mut heads = vec!["<".to_owned(), format!("<per {}", self.time)];
        heads.extend(self.period.map(|_| "<per forcing period".to_owned()));
        let row = |(name, of): &(String, Measured)| {
            let per_period = self.period.map(|period| said(of.scaled(period)));
            [name.clone(), said(*of)].into_iter().chain(per_period).collect()
        };
        let rows: Vec<Vec<String>> = self.exponents.iter().map(row).collect();
        let mut text = format!("{}\n", self.motion);
        text.push_str(&if rows.is_empty() { "  no exponents\n".to_owned() } else { table(&heads, &rows) });
        if let Some(impacts) = self.impacts_per_period {
            let _ = writeln!(text, "  impacts per forcing period {}", said(impacts));
        }
        let _ = match self.dimensions {
            Some((section, flow)) => writeln!(
                text,
                "  Kaplan-Yorke dimension {} of the stroboscopic section, {} of the flow in {}",
                said(section),
                said(flow),
                self.space
            ),
            _ => writeln!(text, "  no Kaplan-Yorke dimension: the larger exponent is not known to differ from 0"),
        };
        let _ = writeln!(text, "  {}", self.grounds);
        text
    }
}

/// The motion, its exponents, and how they were obtained.
pub(crate) fn text(found: &Exponents, period: f64, units: &Units) -> String {
    let per_time = |of: Measured| of.scaled(1.0 / units.time());
    let names = ["larger exponent", "smaller exponent", "their sum"];
    let exponents = names.into_iter().zip(found.exponents.iter().copied().chain([found.sum]));
    let told = Told {
        motion: format!("{}: {}", found.motion.label(), meaning(&found.motion)),
        time: if units.si { "second" } else { "unit of time" },
        exponents: exponents.map(|(name, of)| (name.to_owned(), per_time(of))).collect(),
        period: Some(period * units.time()),
        impacts_per_period: Some(found.impact_rate.scaled(period)),
        dimensions: found.section_dimension.zip(found.flow_dimension),
        space: "x, v and phase",
        grounds: grounds(found, units),
    };
    told.text()
}

/// The same of a machine.
pub(crate) fn of_machine(found: &Exponents<Machine>, of: &AnswerOf<MachineSource>) -> String {
    let machine = &of.system;
    let ended = matches!(found.grounds, Grounds::Undecided { .. });
    let exponents = found.exponents.iter().filter(|_| !ended).enumerate();
    let period = machine.period().filter(|_| !ended);
    let told = Told {
        motion: format!("{}: {}", found.motion.label(), MachineSource::meaning(of, &found.motion)),
        time: "unit of time",
        exponents: exponents.map(|(k, of)| (format!("exponent {}", k + 1), *of)).collect(),
        period: machine.period(),
        impacts_per_period: period.map(|period| found.impact_rate.scaled(period)),
        dimensions: found.section_dimension.zip(found.flow_dimension),
        space: "coordinates, velocities and phase",
        grounds: match found.grounds {
            Grounds::Undecided { .. } => "the motion ended before".to_owned(),
            Grounds::Measured { time, .. } => format!("measured over a time of {}", short(time)),
            _ => "exact: those of a cycle, or of a motion without further events".to_owned(),
        },
    };
    told.text()
}

fn grounds(found: &Exponents, units: &Units) -> String {
    match found.grounds {
        Grounds::Measured { impacts, transient, time, blocks } => {
            let mut text = format!(
                "measured over {impacts} impacts and a time of {}, after {transient} impacts; +- is three standard errors, from {blocks} blocks",
                seconds(time, units)
            );
            if found.identity.is_finite() {
                let _ = write!(
                    text,
                    "\n  the sum is 2 ln(eps) times the rate of impacts less 2 zeta, to within {:.0e}",
                    (found.sum.value - found.identity).abs().max(1e-16)
                );
            }
            text
        }
        Grounds::Flight(NoImpact::ForPeriods(n)) => {
            format!("those of the flight; no impact for at least {} forcing periods", short(n))
        }
        Grounds::Flight(_) => "those of the flight, exact: there are no more impacts".into(),
        Grounds::Sticks(at) => {
            format!("it comes to rest on the {} in every turn, and a release forgets all before it", stop_name(at))
        }
        Grounds::Exact => "exact".into(),
        Grounds::Stuck(at) => format!("it rests on the {} for ever, whatever came before", stop_name(at)),
        Grounds::Touches(_) => "it only touches the stop, and a touch has no derivative".into(),
        Grounds::Undecided { impacts } => format!("the search ran out after {impacts} impacts"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_digits_as_the_error_leaves() {
        for (value, error, text) in [
            (0.018_622_8, 0.000_226, "0.01862 +- 0.00023"),
            (-123.456, 4.2, "-123.5 +- 4.2"),
            (12_345.6, 420.0, "12346 +- 420"),
            (0.5, 5e-14, "0.5 +- 5e-14"),
            (0.25, 0.0, "0.25"),
            (f64::NEG_INFINITY, 0.0, "minus infinity"),
            (f64::INFINITY, 0.0, "infinite"),
            (f64::NAN, 0.0, "none"),
        ] {
            assert_eq!(said(Measured { value, error }), text);
        }
    }
}
