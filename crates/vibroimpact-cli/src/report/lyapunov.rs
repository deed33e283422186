//! Lyapunov exponents as text.

use crate::report::motion::Teller;
use crate::report::words::{seconds, stop_name, table};
use std::fmt::Write;
use vibroimpact::chaos::{Exponents, Grounds, Measured};
use vibroimpact::verdict::{NoImpact, System};
use vibroimpact_report::number::short;
use vibroimpact_report::{AnswerOf, Units};

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

/// The motion, its exponents, and how they were obtained. A machine whose motion ended before has none.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, found: &Exponents<D::System>) -> String {
    let (units, machine) = (&of.units, D::machine(of));
    let ended = machine.is_some() && matches!(found.grounds, Grounds::Undecided { .. });
    let named: Vec<(String, Measured)> = match machine {
        None => {
            let names = ["larger exponent", "smaller exponent", "their sum"].map(str::to_owned);
            names.into_iter().zip(found.exponents.iter().copied().chain([found.sum])).collect()
        }
        Some(_) => {
            let all = found.exponents.iter().filter(|_| !ended).enumerate();
            all.map(|(k, of)| (format!("exponent {}", k + 1), *of)).collect()
        }
    };
    let mut heads = vec!["<".to_owned(), format!("<per {}", if units.si { "second" } else { "unit of time" })];
    heads.extend(D::period(of).map(|_| "<per forcing period".to_owned()));
    let row = |(name, measured): (String, Measured)| {
        let per_time = measured.scaled(1.0 / units.time());
        let per_period = D::period(of).map(|period| said(per_time.scaled(period * units.time())));
        [name, said(per_time)].into_iter().chain(per_period).collect()
    };
    let rows: Vec<Vec<String>> = named.into_iter().map(row).collect();
    let mut text = format!("{}: {}\n", found.motion.label(), D::meaning(of, &found.motion));
    text.push_str(&if rows.is_empty() { "  no exponents\n".to_owned() } else { table(&heads, &rows) });
    if let Some(period) = D::period(of).filter(|_| !ended) {
        let _ = writeln!(text, "  impacts per forcing period {}", said(found.impact_rate.scaled(period)));
    }
    let space = machine.map_or("x, v and phase", |_| "coordinates, velocities and phase");
    let _ = match found.section_dimension.zip(found.flow_dimension) {
        Some((section, flow)) => writeln!(
            text,
            "  Kaplan-Yorke dimension {} of the stroboscopic section, {} of the flow in {space}",
            said(section),
            said(flow)
        ),
        _ => writeln!(text, "  no Kaplan-Yorke dimension: the larger exponent is not known to differ from 0"),
    };
    let grounds = machine.map_or_else(|| grounds(found, units), |_| grounds_of_machine(&found.grounds));
    let _ = writeln!(text, "  {grounds}");
    text
}

fn grounds_of_machine(of: &Grounds) -> String {
    match of {
        Grounds::Undecided { .. } => "the motion ended before".to_owned(),
        Grounds::Measured { time, .. } => format!("measured over a time of {}", short(*time)),
        _ => "exact: those of a cycle, or of a motion without further events".to_owned(),
    }
}

fn grounds<S: System>(found: &Exponents<S>, units: &Units) -> String {
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
