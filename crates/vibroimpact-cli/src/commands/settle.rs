//! `vibro settle`: what the motion from one start settles into.

use crate::args::{Asked, StartArgs, SystemArgs};
use crate::exit::Failure;
use crate::plot::{self, Picture, waveform};
use crate::report::json::{Document, Motion as MotionObject};
use crate::report::text::{self, short};
use crate::session::Session;
use crate::signal;
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::path::PathBuf;
use vibroimpact::motion::{EventKind, ImpactState, Motion};
use vibroimpact::verdict::{PaperRule, PaperVerdict, SettleOptions, Settled, Verdict, paper_rule, settle};
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{Plan, Task};

/// What the motion from a start settles into, and why that is so
///
/// The answer is a label m/n (m impacts in n forcing periods), inf/n (with a complete chatter), 0 (no more impacts),
/// chaotic, stuck or undecided. A periodic motion is confirmed by Newton's method to rounding and comes with its
/// impacts and Floquet multipliers.
#[derive(Clone, Debug, Args)]
#[command(
    override_usage = "vibro settle --beta B --gap D --restitution E [--x X --v V --phase P] [OPTIONS]",
    after_help = "Examples:\n  \
        vibro settle --inverse-beta 1.8 --gap 0.25 --restitution 0.5\n  \
        vibro settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --v 1 --plot steady.svg\n  \
        vibro settle --mass-kg 2 --damping-ns-per-m 1 --stiffness-n-per-m 800 --force-n 4 --frequency-hz 4 \\\n    \
        --gap-m 0.01 --restitution 0.5 --units si"
)]
pub(crate) struct Settle {
    #[command(flatten)]
    system: SystemArgs,
    #[command(flatten)]
    start: StartArgs,

    /// By which rule
    #[arg(long, value_enum, value_name = "RULE", default_value_t = Rule::Proved, help_heading = "Rule")]
    rule: Rule,

    /// Tolerance of the paper's rule in per cent, positive [default: 0.1]
    #[arg(long, value_name = "P", allow_hyphen_values = true, help_heading = "Rule")]
    percent: Option<f64>,

    /// Impacts after which the paper's rule calls a motion unstable, 2 to 100000 [default: 100]
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = "Rule")]
    limit: Option<u32>,

    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    json: bool,

    /// Draw the steady motion into this file, .svg or .png
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Rule {
    /// Recurrence, confirmed by Newton's method
    Proved,
    /// Also the 1971 paper's own rule (11), which cannot tell a slow transient from a period
    Paper,
}

#[derive(Serialize)]
struct Answer {
    motion: MotionObject,
    impacts_followed: u64,
    time_followed: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper_rule: Option<PaperAnswer>,
}

#[derive(Serialize)]
struct PaperAnswer {
    percent: f64,
    limit: u32,
    verdict: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    label: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    impacts: Option<u32>,
}

pub(super) fn run(args: &Settle, session: &Session) -> Result<(), Failure> {
    let asked = args.system.asked()?;
    let start = args.start.plan(&asked.units);
    let plan = Plan::new(asked.system, Task::Settle { start });
    plan.check()?;
    let osc = asked.system.oscillator()?;
    let start = start.start(&osc)?;
    let rule = args.paper_rule()?;
    let picture = args.plot.as_deref().map(|path| Picture::reserve(path, session.force)).transpose()?;

    let (settled, paper) = signal::interruptible("settling", move || {
        let settled = settle(&osc, start, &SettleOptions::default());
        (settled, rule.map(|rule| (rule, paper_rule(&osc, start, rule))))
    })?;
    if let Some(picture) = picture {
        picture.write(&steady(&osc, start, &settled, &asked))?;
    }
    if args.json {
        let answer = Answer {
            motion: MotionObject::new(&settled.verdict, &osc, &asked.units),
            impacts_followed: settled.impacts,
            time_followed: settled.time * asked.units.time(),
            paper_rule: paper.map(|(rule, verdict)| PaperAnswer::new(rule, verdict)),
        };
        let document = Document::new(&asked, &osc, &plan, answer);
        return session.print_json(&document.start(&start, &asked.units));
    }
    let mut text = text::system(&asked, &osc) + &text::start(&start, &asked.units) + "\n";
    text.push_str(&text::motion(&settled.verdict, &osc, &asked.units));
    text.push_str(&format!(
        "  followed for {} impacts, until time {}\n",
        settled.impacts,
        short(settled.time * asked.units.time())
    ));
    if let Some((rule, verdict)) = paper {
        text.push_str(&format!(
            "\nthe paper's rule ({} %, at most {} impacts): {}\n",
            rule.percent,
            rule.limit,
            said(verdict)
        ));
    }
    session.print(&text)?;
    session.note("hint: `vibro attractors` shows what other starts lead to");
    Ok(())
}

impl Settle {
    fn paper_rule(&self) -> Result<Option<PaperRule>, Failure> {
        if self.rule == Rule::Proved {
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

/// Forcing periods shown of a steady motion.
const SHOWN: f64 = 6.0;

/// The motion once it has settled.
fn steady(osc: &Oscillator, start: Start, settled: &Settled, asked: &Asked) -> vibroimpact_plot::Figure {
    let (from, time) = last_event(osc, start, settled.time);
    let periods = match &settled.verdict {
        Verdict::Periodic(cycle) => {
            let n = f64::from(cycle.label.periods);
            n * (SHOWN / n).ceil().max(2.0)
        }
        Verdict::Chaotic(_) | Verdict::Undecided(_) => 4.0 * SHOWN,
        _ => SHOWN,
    };
    let label = plot::label(&settled.verdict.label());
    let title = format!("{}: {label}", plot::title(&asked.system));
    let span = (time, periods * osc.period());
    waveform::figure(osc, from, span, &asked.units, title)
}

/// The state after the last event up to a time, and the time of that event.
fn last_event(osc: &Oscillator, start: Start, until: f64) -> (Start, f64) {
    let (mut state, mut time) = (start, 0.0);
    for event in Motion::new(osc, start).take_while(|event| event.time <= until) {
        let at_stop = ImpactState { phase: event.phase, velocity: 0.0, side: event.side };
        let at_stop = match event.kind {
            EventKind::Impact { velocity_before, .. } => ImpactState { velocity: velocity_before, ..at_stop },
            EventKind::Stick { .. } | EventKind::Release => at_stop,
            EventKind::Graze { .. } => continue,
        };
        (state, time) = (at_stop.rebound(osc), event.time);
    }
    (state, time)
}

impl PaperAnswer {
    fn new(rule: PaperRule, verdict: PaperVerdict) -> Self {
        let bare =
            Self { percent: rule.percent, limit: rule.limit, verdict: "unstable", label: None, n: None, impacts: None };
        match verdict {
            PaperVerdict::Settled { m, n, impacts } => Self {
                verdict: "settled",
                label: Some(format!("{m}/{}", n.round())),
                n: Some(n),
                impacts: Some(impacts),
                ..bare
            },
            PaperVerdict::Unstable => bare,
            PaperVerdict::NoMoreImpacts => Self { verdict: "no_more_impacts", ..bare },
            PaperVerdict::Sticks => Self { verdict: "sticks", ..bare },
        }
    }
}

fn said(verdict: PaperVerdict) -> String {
    match verdict {
        PaperVerdict::Settled { m, n, impacts } => {
            format!("settled into {m}/{} (n = {}) after {impacts} impacts", n.round(), short(n))
        }
        PaperVerdict::Unstable => "unstable, not settled within the limit".into(),
        PaperVerdict::NoMoreImpacts => "the impacts ceased".into(),
        PaperVerdict::Sticks => "the mass came to rest on the stop".into(),
    }
}
