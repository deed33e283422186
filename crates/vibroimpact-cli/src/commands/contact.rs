//! `vibro contact`: the contact of a mass with a spring and a damper.

use crate::args::{OutputArgs, UnitKind, Words, word};
use crate::commands::outputs::Outputs;
use crate::failure::Failure;
use crate::session::Session;
use clap::Args;
use vibroimpact_report::{ContactQuestion, Opens};

/// Convert between restitution, stiffness and damping of a contact
///
/// A free mass strikes a spring with a damper beside it and leaves when their force falls to zero (force), or where the spring
/// is relaxed again (position). In closed form: restitution, contact time, largest depth and force, and the depth at which it leaves.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro contact --restitution E --mass-kg M --stiffness-n-per-m K [OPTIONS]\n       \
        vibro contact --damping-ns-per-m C --mass-kg M --frequency-hz F [OPTIONS]",
    after_help = "Examples:\n  \
        vibro contact --restitution 0.6 --mass 0.8kg --stiffness 2e5N/m --speed 0.5\n  \
        vibro contact --restitution 0.6 --mass-kg 0.8 --contact-time-s 0.002 --csv contact.csv\n  \
        vibro contact --damping-ns-per-m 120 --mass-kg 0.8 --frequency-hz 300 --plot contact.svg",
    mut_arg("plot", |arg| arg.help("Draw the force over the depth into this file, .svg, .png or .pdf")),
    mut_arg("csv", |arg| arg.help("Write one row for each way to open to this file; - for stdout"))
)]
pub(crate) struct Contact {
    /// Restitution, above 0 and up to 1
    #[arg(long, value_parser = in_unit(UnitKind::Ratio), value_name = "E", allow_hyphen_values = true, group = "loss", help_heading = "Contact")]
    restitution: Option<f64>,

    /// Damping in N s/m instead, 0 or more
    #[arg(long, value_parser = in_unit(UnitKind::DampingCoefficient), value_name = "C", allow_hyphen_values = true, group = "loss", help_heading = "Contact")]
    damping_ns_per_m: Option<f64>,

    /// Damping ratio c / (2 sqrt(k m)) instead, 0 or more
    #[arg(long, value_parser = in_unit(UnitKind::Ratio), value_name = "Z", allow_hyphen_values = true, group = "loss", help_heading = "Contact")]
    damping_ratio: Option<f64>,

    /// Mass in kg, positive; of two bodies m1 m2 / (m1 + m2)
    #[arg(long, visible_alias = "mass", value_parser = in_unit(UnitKind::Mass), value_name = "M", allow_hyphen_values = true, help_heading = "Contact")]
    mass_kg: Option<f64>,

    /// Stiffness in N/m, positive
    #[arg(long, visible_alias = "stiffness", value_parser = in_unit(UnitKind::Stiffness), value_name = "K", allow_hyphen_values = true, group = "spring", help_heading = "Contact")]
    stiffness_n_per_m: Option<f64>,

    /// Frequency of the mass on the spring in Hz, without the mass or instead of the stiffness
    #[arg(long, visible_alias = "frequency", value_parser = in_unit(UnitKind::Frequency), value_name = "F", allow_hyphen_values = true, help_heading = "Contact")]
    frequency_hz: Option<f64>,

    /// Contact time in s instead of the stiffness
    #[arg(long, value_parser = in_unit(UnitKind::Time), value_name = "T", allow_hyphen_values = true, group = "spring", conflicts_with = "frequency_hz", help_heading = "Contact")]
    contact_time_s: Option<f64>,

    /// Speed of approach in m/s
    #[arg(long, visible_alias = "speed", value_parser = in_unit(UnitKind::Velocity), value_name = "V", allow_hyphen_values = true, default_value = "1", help_heading = "Contact")]
    speed_m_per_s: f64,

    /// When the contact opens [default: both]
    #[arg(long, value_parser = word(&OPENINGS), value_name = "WHEN", help_heading = "Contact")]
    opening: Option<Opens>,

    #[command(flatten)]
    output: OutputArgs,
}

const OPENINGS: Words<Opens, 2> = [
    ("force", Opens::Force, "When its force falls to zero"),
    ("position", Opens::Position, "Where its spring is relaxed again"),
];

/// A number with or without a unit.
fn in_unit(kind: UnitKind) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| kind.parse(text)
}

pub(super) fn run(args: &Contact, session: &Session) -> Result<(), Failure> {
    let question = ContactQuestion {
        mass: args.mass_kg,
        stiffness: args.stiffness_n_per_m,
        frequency: args.frequency_hz,
        contact_time: args.contact_time_s,
        restitution: args.restitution,
        damping: args.damping_ns_per_m,
        damping_ratio: args.damping_ratio,
        speed: args.speed_m_per_s,
        opening: args.opening,
    };
    let answer = question.answer()?;
    let outputs = Outputs::reserve(args.output.files(), session)?;
    let (json, silent) = (outputs.json(), outputs.table_on_stdout());
    outputs.write(session, || Ok(answer.table()), || Ok(answer.figure()))?;
    if json {
        session.print_json(&answer)
    } else if silent {
        Ok(())
    } else {
        session.print(&answer.text())
    }
}
