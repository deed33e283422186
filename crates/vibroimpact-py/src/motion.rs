//! A verdict as the fields of `Motion`. They are the fields of the JSON of the command, with arrays for lists.

use crate::columns::{Impacts, column, complex, named};
use numpy::{Complex64, PyArray1};
use pyo3::prelude::*;
use vibroimpact::Oscillator;
use vibroimpact::chaos::Measured;
use vibroimpact::flight::Horizon;
use vibroimpact::orbit::Cycle;
use vibroimpact::quantities::{errors_of_verdict, of_verdict};
use vibroimpact::verdict::{Chaos, Count, NoImpact, Stability, Undecided, Verdict};
use vibroimpact_study::ImpactsByStop;

/// The fields of a motion.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    kind: &'static str,
    label: String,
    impacts: Option<u32>,
    /// Whether the numbers of impacts on each stop are known.
    by_stop: bool,
    impacts_upper: Option<u32>,
    impacts_lower: Option<u32>,
    periods: Option<u32>,
    sticks: Option<usize>,
    stable: Option<bool>,
    stability: Option<&'static str>,
    multipliers: Option<Bound<'py, PyArray1<Complex64>>>,
    cycle: Impacts<'py>,
    rests: Vec<Rest>,
    residual: Option<f64>,
    /// Value and error.
    lyapunov: Option<(f64, f64)>,
    seen_impacts: Option<u64>,
    /// Number of impacts; value and error of the exponent.
    chaotic_transient: Option<(u64, (f64, f64))>,
    horizon: Option<HorizonFields>,
    side: Option<&'static str>,
    tried: Option<Tried>,
    quantities: Option<Vec<(&'static str, f64)>>,
    /// Three standard errors of the means of a chaotic motion.
    quantities_error: Option<Vec<(&'static str, f64)>>,
    /// The object of the motion in the JSON of the command.
    told: String,
}

/// One phase of sticking.
#[derive(IntoPyObject)]
pub(crate) struct Rest {
    side: &'static str,
    chatter: bool,
    begin: f64,
    release: f64,
}

#[derive(IntoPyObject)]
struct Tried {
    impacts: Option<u64>,
    periods: Option<f64>,
    lyapunov: Option<(f64, f64)>,
}

/// Why there are no more impacts, and for how many periods.
#[derive(IntoPyObject)]
pub(crate) struct HorizonFields {
    kind: &'static str,
    periods: Option<f64>,
    why: &'static str,
    /// Number of forcing periods and of natural periods.
    common_period: Option<(u32, u32)>,
}

impl HorizonFields {
    pub(crate) const fn new(no_impact: &NoImpact) -> Self {
        let (why, common_period) = match no_impact {
            NoImpact::Flight(Horizon::Amplitude) => ("amplitude", None),
            NoImpact::Flight(Horizon::CommonPeriod { p, q }) => ("common_period", Some((*p, *q))),
            NoImpact::GrazeLimit { .. } => ("graze_limit", None),
            NoImpact::Landing { .. } => ("landing", None),
            NoImpact::Grazing { .. } => ("grazing", None),
            NoImpact::ForPeriods(n) => {
                return Self { kind: "periods", periods: Some(*n), why: "search", common_period: None };
            }
        };
        Self { kind: "forever", periods: None, why, common_period }
    }
}

/// The phases of sticking of a cycle.
pub(crate) fn rests(cycle: &Cycle) -> Vec<Rest> {
    let rests = cycle.rests.iter();
    rests
        .map(|rest| Rest { side: named(rest.side), chatter: rest.chatter, begin: rest.begin, release: rest.release })
        .collect()
}

const fn pair(of: Measured) -> (f64, f64) {
    (of.value, of.error)
}

impl<'py> Fields<'py> {
    pub(crate) fn new(py: Python<'py>, verdict: &Verdict, osc: &Oscillator) -> Self {
        let by_stop = ImpactsByStop::of(osc, verdict);
        let stability = verdict.stability(osc);
        let bare = Self {
            kind: "undecided",
            label: verdict.label().into_owned(),
            impacts: None,
            by_stop: by_stop.is_some(),
            impacts_upper: by_stop.and_then(|by| by.upper),
            impacts_lower: by_stop.and_then(|by| by.lower),
            periods: None,
            sticks: None,
            stable: stability.map(Stability::is_stable),
            stability: stability.map(Stability::name),
            multipliers: verdict.multipliers(osc).map(|both| column(py, complex(both).into_iter())),
            cycle: Impacts::new(py, &core::iter::empty()),
            rests: Vec::new(),
            residual: None,
            lyapunov: None,
            seen_impacts: None,
            chaotic_transient: None,
            horizon: None,
            side: None,
            tried: None,
            quantities: of_verdict(osc, verdict)
                .map(|of| of.iter().map(|(quantity, value)| (quantity.name(), value)).collect()),
            quantities_error: errors_of_verdict(osc, verdict).map(|of| {
                let known = of.iter().filter(|(_, error)| error.is_finite());
                known.map(|(quantity, error)| (quantity.name(), error)).collect()
            }),
            told: vibroimpact_report::json::motion::text(verdict, osc),
        };
        let tried = |impacts, periods, lyapunov| Some(Tried { impacts, periods, lyapunov });
        match verdict {
            Verdict::Periodic(cycle) => Self::periodic(py, cycle, bare),
            Verdict::NoImpact(no_impact) => {
                let bare = bare.of_one_period(0);
                let bare = match no_impact {
                    NoImpact::Landing { periods, .. } => Self { periods: Some(*periods), sticks: Some(1), ..bare },
                    _ => bare,
                };
                Self { kind: "no_impact", horizon: Some(HorizonFields::new(no_impact)), ..bare }
            }
            Verdict::Chaotic(chaos) => Self {
                kind: "chaotic",
                lyapunov: Some(pair(chaos.spectrum.exponents[0])),
                seen_impacts: Some(chaos.impacts),
                ..bare
            },
            Verdict::Stuck(at) => Self { kind: "stuck", side: Some(named(*at)), ..bare.of_one_period(1) },
            Verdict::Undecided(Undecided::Impacts { impacts, spectrum }) => {
                Self { tried: tried(Some(*impacts), None, spectrum.map(|s| pair(s.exponents[0]))), ..bare }
            }
            Verdict::Undecided(Undecided::Search { periods }) => {
                Self { tried: tried(None, Some(*periods), None), ..bare }
            }
        }
    }

    /// The same fields with the chaos that preceded the motion.
    pub(crate) fn after(self, transient: Option<Chaos>) -> Self {
        let chaotic_transient = transient.map(|chaos| (chaos.impacts, pair(chaos.spectrum.exponents[0])));
        Self { chaotic_transient, ..self }
    }

    fn of_one_period(self, sticks: usize) -> Self {
        Self { impacts: Some(0), periods: Some(1), sticks: Some(sticks), ..self }
    }

    fn periodic(py: Python<'py>, cycle: &Cycle, bare: Self) -> Self {
        Self {
            kind: "periodic",
            impacts: match cycle.label.impacts {
                Count::Finite(m) => Some(m),
                Count::Infinite => None,
            },
            periods: Some(cycle.label.periods),
            sticks: Some(cycle.rests.len()),
            cycle: Impacts::new(py, &core::iter::once(cycle)),
            rests: rests(cycle),
            residual: Some(cycle.residual),
            ..bare
        }
    }
}
