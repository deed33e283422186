//! A settled motion, and the verdict of the rule of the 1971 paper.

use crate::json::motion::{ChaosObject, MotionObject};
use crate::json::quantities;
use crate::number::short;
use crate::text::Teller;
use crate::text::words::seconds;
use crate::{AnswerOf, Told, Units};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use vibroimpact::quantities::{Harmonic, harmonics, of_transient};
use vibroimpact::verdict::{PaperRule, PaperVerdict, Settled, Verdict};
use vibroimpact::{Oscillator, Start};
use vibroimpact_study::{SystemPlan, counted};

/// The answer to `vibro settle`.
#[derive(Default, JsonSchema, Serialize)]
pub struct SettleAnswer<'a> {
    /// The motion.
    motion: MotionObject<'a>,
    /// The number of events, of an oscillator impacts, that were followed.
    events_followed: u64,
    /// The time that was followed.
    time_followed: f64,
    /// Chaos before the motion settled.
    #[serde(skip_serializing_if = "Option::is_none")]
    chaotic_transient: Option<ChaosObject>,
    /// The spectrum of the position of a cycle of an oscillator.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    harmonics: Vec<HarmonicObject>,
    /// The way of an oscillator from the start until it had settled.
    #[serde(skip_serializing_if = "Option::is_none")]
    transient: Option<TransientObject>,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper_rule: Option<PaperAnswer>,
}

/// A harmonic of the positions of a motion with the period of n forcing periods.
#[derive(JsonSchema, Serialize)]
struct HarmonicObject {
    /// Its frequency is this number over n, times that of the force.
    order: u32,
    amplitude: f64,
    phase: f64,
}

/// The largest values on the way, and means over it.
#[derive(JsonSchema, Serialize)]
struct TransientObject {
    events: u64,
    time: f64,
    quantities: Map<String, Value>,
}

/// Harmonics up to this multiple of the frequency of the force, and at most this number of them.
const HARMONICS: u32 = 8;
const MOST_HARMONICS: u32 = 64;
/// A longer way is not measured: it takes about a second.
const LONGEST_WAY: u64 = 20_000;

fn harmonics_of(verdict: &Verdict, osc: &Oscillator, units: &Units) -> Vec<HarmonicObject> {
    let Verdict::Periodic(cycle) = verdict else { return Vec::new() };
    let highest = HARMONICS.saturating_mul(cycle.label.periods).min(MOST_HARMONICS);
    let all = harmonics(osc, cycle, highest).unwrap_or_default();
    let object =
        |of: Harmonic| HarmonicObject { order: of.order, amplitude: of.amplitude * units.length(), phase: of.phase };
    all.into_iter().map(object).collect()
}

fn transient_of(settled: &Settled, osc: &Oscillator, start: &Start, units: &Units) -> Option<TransientObject> {
    let ends = !matches!(settled.verdict, Verdict::Chaotic(_) | Verdict::Undecided(_));
    (ends && settled.impacts <= LONGEST_WAY).then(|| TransientObject {
        events: settled.impacts,
        time: settled.time * units.time(),
        quantities: quantities::of_oscillator(&of_transient(osc, *start, settled.impacts), units),
    })
}

#[derive(JsonSchema, Serialize)]
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

impl<'a> SettleAnswer<'a> {
    /// Without what takes ten times as long as the motion of an oscillator itself: its harmonics and its transient.
    pub(crate) fn brief<D: Told>(of: &'a AnswerOf<D>, settled: &'a Settled<D::System>) -> Self {
        let chaos = settled.transient.as_ref();
        Self {
            motion: D::motion(of, &settled.verdict),
            events_followed: settled.impacts,
            time_followed: settled.time * of.units.time(),
            chaotic_transient: chaos.map(|chaos| ChaosObject::new(chaos, D::machine(of), &of.units)),
            ..Self::default()
        }
    }

    /// The same with these, and with the verdict of the rule of the paper.
    pub(crate) fn of_oscillator(of: &'a AnswerOf<SystemPlan>, settled: &'a Settled) -> Self {
        Self {
            harmonics: harmonics_of(&settled.verdict, &of.system, &of.units),
            transient: transient_of(settled, &of.system, &of.start, &of.units),
            paper_rule: of.paper_rule.map(|(rule, verdict)| PaperAnswer::new(rule, verdict)),
            ..Self::brief(of, settled)
        }
    }
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

/// The motion, how long it was followed, and what is told beside it.
pub(crate) fn text<D: Teller>(of: &AnswerOf<D>, settled: &Settled<D::System>) -> String {
    let (event, more) = D::followed(of, settled);
    let open = if matches!(settled.verdict, Verdict::Undecided(_)) { "; not settled by then" } else { "" };
    let (events, time) = (counted(settled.impacts, event), seconds(settled.time, &of.units));
    format!("{}  followed for {events}, until time {time}{open}\n{more}", D::told(of, &settled.verdict))
}

/// The verdict of the rule of the paper.
pub(crate) fn of_paper(rule: PaperRule, verdict: PaperVerdict) -> String {
    let PaperRule { percent, limit, .. } = rule;
    format!("\nthe paper's rule ({percent} %, at most {limit} impacts): {}\n", said(verdict))
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
