//! Lyapunov exponents as text.

use crate::report::words::{meaning, seconds, stop_name, table};
use std::fmt::Write;
use vibroimpact::chaos::{Exponents, Grounds, Measured};
use vibroimpact::verdict::NoImpact;
use vibroimpact_report::Units;
use vibroimpact_report::json::lyapunov::scaled;
use vibroimpact_report::number::short;

/// The text of a measured number: `0.01862 +- 0.00023`, rounded according to its error; `minus infinity`, `none`, or
/// the number alone if it is exact.
pub(super) fn said(of: Measured) -> String {
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

/// The motion, its exponents, and how they were obtained.
pub(crate) fn text(found: &Exponents, period: f64, units: &Units) -> String {
    let mut text = format!("{}: {}\n", found.motion.label(), meaning(&found.motion));
    let per_time = |of: Measured| said(scaled(of, 1.0 / units.time()));
    let heads = [
        "<".into(),
        format!("<per {}", if units.si { "second" } else { "unit of time" }),
        "<per forcing period".into(),
    ];
    let row = |name: &str, of: Measured| vec![name.into(), per_time(of), said(scaled(of, period))];
    let names = ["larger exponent", "smaller exponent"].into_iter().zip(&found.exponents);
    let mut rows: Vec<Vec<String>> = names.map(|(name, of)| row(name, *of)).collect();
    rows.push(row("their sum", found.sum));
    text.push_str(&table(&heads, &rows));
    let _ = writeln!(text, "  impacts per forcing period {}", said(scaled(found.impact_rate, period)));
    let _ = match (found.section_dimension, found.flow_dimension) {
        (Some(section), Some(flow)) => writeln!(
            text,
            "  Kaplan-Yorke dimension {} of the stroboscopic section, {} of the flow in x, v and phase",
            said(section),
            said(flow)
        ),
        _ => writeln!(text, "  no Kaplan-Yorke dimension: the larger exponent is not known to differ from 0"),
    };
    let _ = writeln!(text, "  {}", grounds(found, units));
    text
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
