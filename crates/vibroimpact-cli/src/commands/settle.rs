//! `vibro settle`: the motion from one start after its transient.

use crate::args::{OutputArgs, StartedArgs, Words, number, whole, word};
use crate::commands::outputs::Outputs;
use crate::commands::respond;
use crate::failure::Failure;
use crate::session::Session;
use clap::{Args, ValueEnum};
use vibroimpact::verdict::{PaperRule, paper_rule};
use vibroimpact_report::scene::View;
use vibroimpact_report::{Answer, Shown};
use vibroimpact_study::Task;

/// What the motion from a start settles into, and on what grounds
///
/// The result is a label: m/n (m impacts in n forcing periods), inf/n (with a complete chatter), 0 (no more impacts),
/// chaotic, stuck or undecided. A periodic motion is confirmed by Newton's method to rounding and is printed with its
/// impacts and Floquet multipliers.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro settle --beta B --gap D --restitution E [--x X --v V --phase P] [OPTIONS]\n       \
        vibro settle --machine NAME|FILE [--set PATH=VALUE] [--q A,B --qdot A,B --phase P] [OPTIONS]",
    after_help = "Examples:\n  \
        vibro settle --inverse-beta 1.8 --gap 0.25 --restitution 0.5\n  \
        vibro settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --v 1 \\\n    \
        --plot steady.svg\n  \
        vibro settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --show phase \\\n    \
        --plot portrait.svg\n  \
        vibro settle --mass-kg 2 --damping-ns-per-m 1 --stiffness-n-per-m 800 \\\n    \
        --force-n 4 --frequency-hz 4 --gap-m 0.01 --restitution 0.5 --units si",
    mut_arg("csv", |arg| arg.help(
        "Write the steady motion to this file, one row a point, columns time, x, v, phase unless --show says otherwise; of \
        a machine those of `vibro simulate`; - for stdout"
    )),
    mut_arg("plot", |arg| arg.help("Draw the steady motion into this file, .svg, .png or .pdf"))
)]
pub(crate) struct Settle {
    #[command(flatten)]
    of: StartedArgs,

    /// Budget of impacts for the motion, 1 to 1000000; what is not settled by then is undecided [default: 20000]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Start")]
    impacts: Option<u32>,

    /// By which rule
    #[arg(long, value_enum, value_name = "RULE", default_value_t = Rule::Confirmed, help_heading = "Rule")]
    rule: Rule,

    /// Tolerance of the paper's rule in per cent, positive [default: 0.1]
    #[arg(long, value_parser = number, value_name = "P", allow_hyphen_values = true, help_heading = "Rule")]
    percent: Option<f64>,

    /// Impacts after which the paper's rule calls a motion unstable, 2 to 100000 [default: 100]
    #[arg(long, value_parser = whole::<u32>, value_name = "N", allow_hyphen_values = true, help_heading = "Rule")]
    limit: Option<u32>,

    /// What --plot draws and --csv writes of the steady motion
    #[arg(long, value_parser = word(&VIEWS), value_name = "VIEW", help_heading = "Output")]
    show: Option<View>,

    #[command(flatten)]
    output: OutputArgs,
}

const VIEWS: Words<View, 4> = [
    ("waveform", View::Waveform, "Position over time"),
    ("phase", View::Phase, "Velocity over position"),
    ("multipliers", View::Multipliers, "Floquet multipliers in the complex plane; columns re, im"),
    (
        "sections",
        View::Sections,
        "Phase and speed of its impacts, and its states at phase 0; columns section, side, phase, x, v. Of a machine: `vibro lyapunov \
         --points N`",
    ),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Rule {
    /// Recurrence, confirmed by Newton's method
    #[value(alias = "proved")]
    Confirmed,
    /// Also the 1971 paper's own rule (11), which cannot tell a slow transient from a period
    Paper,
}

pub(super) fn run(args: &Settle, session: &Session) -> Result<(), Failure> {
    let (system, start) = args.of.asked()?;
    if system.is_machine() && args.rule == Rule::Paper {
        return Err(Failure::bad("--rule paper is for oscillators: the paper has no machines"));
    }
    let question = system.question(Task::Settle { start, impacts: args.impacts })?;
    let rule = args.paper_rule()?;
    let shown = args.look()?;
    let outputs = Outputs::reserve(args.output.files(), session)?;
    let mut answer = respond::compute(&question, session)?;
    if let (Some(rule), Answer::Oscillator(answer)) = (rule, &mut answer) {
        answer.paper_rule = Some((rule, paper_rule(&answer.system, answer.start, rule)));
    }
    respond::tell(&answer, (outputs, shown), session)
}

impl Settle {
    /// The look of the table and the figure.
    fn look(&self) -> Result<Shown, Failure> {
        if self.show.is_some() && !self.output.any_file() {
            return Err(Failure::bad("--show says what is drawn or written: it belongs to --plot and --csv"));
        }
        Ok(Shown { view: self.show, ..Shown::default() })
    }

    fn paper_rule(&self) -> Result<Option<PaperRule>, Failure> {
        if self.rule == Rule::Confirmed {
            return match (self.percent, self.limit) {
                (None, None) => Ok(None),
                _ => Err(Failure::bad("--percent and --limit belong to --rule paper")),
            };
        }
        let usual = PaperRule::default();
        let rule =
            PaperRule { percent: self.percent.unwrap_or(usual.percent), limit: self.limit.unwrap_or(usual.limit) };
        if !(rule.percent > 0.0 && rule.percent.is_finite()) {
            return Err(Failure::bad(format!("percent = {} lies outside 0 < percent < infinity", rule.percent)));
        }
        if !(2..=100_000).contains(&rule.limit) {
            return Err(Failure::bad(format!("limit = {} lies outside 2 <= limit <= 100000", rule.limit)));
        }
        Ok(Some(rule))
    }
}
