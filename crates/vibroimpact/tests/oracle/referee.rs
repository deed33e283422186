//! The verdict on one answer of `first_contact`.
//!
//! - An impact must be the first contact of the exact flight, on its side, at its time to within
//!   $8\,(2^{-53}\Sigma/|\dot g| + \mathrm{ulp}(s))$.
//! - A grazing answer must be a closest point nearer to the stop than the data determine, $8\cdot2^{-53}\Sigma$, with
//!   nothing before it.
//! - `Never` and `NoneUntil` must not be followed by a contact up to the horizon, or the time they name.
//! - `Contact` must be given exactly where the mass begins on a stop and does not leave it.

use super::case::Case;
use super::exact::{Apex, Exact, Story, Strike};
use super::fixed::Fixed;
use super::sensitivity::spread;
use vibroimpact::Side;
use vibroimpact::flight::{Contact, Horizon, SearchLimits};

/// Units in the last place, times condition, that an answer may be off.
pub(crate) const ALLOWED: f64 = 8.0;
const HALF_ULP: f64 = 0.5 * f64::EPSILON;

/// An answer that stands.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Passed {
    /// An impact, so many units off, at this time.
    Impact {
        units: f64,
        s: f64,
    },
    /// An impact later than the horizon: nothing came before it, and it is one.
    Beyond {
        units: f64,
    },
    /// A grazing contact: its true depth (positive: short of the stop), and time.
    Grazing {
        depth: f64,
        s: f64,
    },
    Never,
    NoneUntil,
    Stays,
}

/// An answer that is wrong.
#[derive(Clone, Debug)]
#[allow(dead_code)] // read through Debug only
pub(crate) enum Fault {
    /// The exact flight strikes, at `s`, and the answer is later or never. The arch it cuts, if it is one.
    Missed {
        answer: Contact,
        s: f64,
        p: f64,
        arch: Option<Arch>,
    },
    /// The answer is a contact where the exact flight has none; the first one it has, and the closest point nearby.
    Invented {
        answer: Contact,
        first: Option<f64>,
        arch: Option<Arch>,
    },
    WrongSide {
        answer: Contact,
        side: Side,
    },
    Inaccurate {
        answer: Contact,
        s: f64,
        error: f64,
        units: f64,
        condition: f64,
    },
    /// Called grazing although the data determine more.
    FalseGrazing {
        answer: Contact,
        s: f64,
        depth: f64,
        open: f64,
    },
    /// A claim about all time that does not hold.
    FalseReason {
        answer: Contact,
    },
}

impl Fault {
    /// What went wrong, in a few words. Within rounding: the arch is nearer to the stop than the data determine.
    pub(crate) fn kind(&self) -> &'static str {
        let open = |arch: &Option<Arch>| arch.is_some_and(|arch| arch.depth.abs() <= arch.open);
        match self {
            Self::Missed { arch, .. } if open(arch) => "missed, within rounding",
            Self::Missed { .. } => "missed",
            Self::Invented { arch, .. } if open(arch) => "invented, within rounding",
            Self::Invented { .. } => "invented",
            Self::WrongSide { .. } => "on the wrong side",
            Self::Inaccurate { .. } => "inaccurate",
            Self::FalseGrazing { .. } => "called grazing",
            Self::FalseReason { .. } => "never, for a reason that does not hold",
        }
    }
}

/// A closest point: its depth (positive: short of the stop) and the depth that the data leave open.
#[derive(Clone, Copy, Debug)]
#[allow(dead_code)] // read through Debug only
pub(crate) struct Arch {
    pub(crate) s: f64,
    pub(crate) depth: f64,
    pub(crate) open: f64,
}

fn arch(case: &Case, exact: &Exact, apex: Option<Apex>) -> Option<Arch> {
    apex.map(|apex| Arch {
        s: apex.s.to_f64(),
        depth: -apex.past,
        open: ALLOWED * open(case, exact, apex.side, apex.s),
    })
}

fn invented(case: &Case, exact: &Exact, answer: Contact, first: Option<f64>, apex: Option<Apex>) -> Fault {
    Fault::Invented { answer, first, arch: arch(case, exact, apex) }
}

/// Half a unit of uncertainty of every datum, as an uncertainty of the distance.
fn open(case: &Case, exact: &Exact, side: Side, s: Fixed) -> f64 {
    HALF_ULP * spread(case, exact, side, s)
}

/// How many units of rounding times condition `time` is away from the root.
fn off(case: &Case, exact: &Exact, strike: &Strike, time: f64) -> (f64, f64, f64) {
    let s = strike.s.to_f64();
    let error = (Fixed::from_f64(time) - strike.s).to_f64();
    let ulp = f64::from_bits(s.to_bits() + 1) - s;
    let condition = open(case, exact, strike.side, strike.s) / strike.p + HALF_ULP * s;
    (error, error.abs() / (condition + ulp), condition)
}

/// Judges the library's answer to `case`, searched up to `horizon`: what a motion gets and, for a third of the cases, also
/// what the careful search says where strides would have sufficed.
pub(crate) fn verdict(case: &Case, limits: SearchLimits, horizon: f64) -> Result<Passed, Fault> {
    let (answer, careful) = (case.answer(limits), case.careful_answer(limits));
    if answer != careful && case.phase.to_bits().is_multiple_of(3) {
        judge(case, careful, horizon)?;
    }
    judge(case, answer, horizon)
}

/// Judges one answer.
pub(crate) fn judge(case: &Case, answer: Contact, horizon: f64) -> Result<Passed, Fault> {
    if case.stays() || matches!(answer, Contact::Contact { .. }) {
        let right = case.stays() && matches!(answer, Contact::Contact { side } if Some(side) == case.begins_on());
        return if right { Ok(Passed::Stays) } else { Err(Fault::Invented { answer, first: None, arch: None }) };
    }
    let exact = Exact::new(case);
    let told_until = match answer {
        Contact::Impact { time, .. } | Contact::Grazing { time, .. } => time + exact.cell_length(),
        Contact::NoneUntil(s) => s,
        _ => f64::INFINITY,
    };
    let story = exact.story(horizon.min(told_until), case.release.is_some());
    match answer {
        Contact::Impact { time, side, .. } => impact(case, &exact, &story, answer, time, side),
        Contact::Grazing { time, side, .. } => grazing(case, &exact, &story, answer, time, side),
        Contact::Never(_) | Contact::NoneUntil(_) => {
            if let Some(strike) = story.strike
                && strike.s.to_f64() < told_until.min(horizon)
            {
                return Err(missed(case, &exact, answer, &strike));
            }
            match answer {
                Contact::Never(reason) if !holds(case, reason) => Err(Fault::FalseReason { answer }),
                Contact::Never(_) => Ok(Passed::Never),
                _ => Ok(Passed::NoneUntil),
            }
        }
        Contact::Contact { .. } => unreachable!("judged above"),
    }
}

fn missed(case: &Case, exact: &Exact, answer: Contact, strike: &Strike) -> Fault {
    let apex = if strike.q < 0.0 { exact.extremum(strike.side, strike.s) } else { None };
    Fault::Missed { answer, s: strike.s.to_f64(), p: strike.p, arch: arch(case, exact, apex) }
}

fn impact(case: &Case, exact: &Exact, story: &Story, answer: Contact, time: f64, side: Side) -> Result<Passed, Fault> {
    let Some(strike) = story.strike else {
        if story.searched < time {
            // later than the horizon: it must at least be a root
            let near = exact.solution.at(Fixed::from_f64(time));
            let strike = exact.polish(side, &near);
            let (error, units, condition) = off(case, exact, &strike, time);
            return if units <= ALLOWED {
                Ok(Passed::Beyond { units })
            } else {
                Err(Fault::Inaccurate { answer, s: strike.s.to_f64(), error, units, condition })
            };
        }
        return Err(invented(case, exact, answer, None, exact.extremum(side, Fixed::from_f64(time))));
    };
    let (error, units, condition) = off(case, exact, &strike, time);
    let s = strike.s.to_f64();
    if units <= ALLOWED {
        return if strike.side == side {
            Ok(Passed::Impact { units, s })
        } else {
            Err(Fault::WrongSide { answer, side: strike.side })
        };
    }
    // the closest point of the arch, where the root is one side of a shallow arch: within the depth that the data leave
    // open its two roots and their condition mean nothing, and the arch itself is the answer
    if strike.side == side
        && let Some(apex) = exact.extremum(side, strike.s)
        && apex.past.abs() <= ALLOWED * open(case, exact, side, apex.s)
    {
        let width = (2.0 * ALLOWED * open(case, exact, side, apex.s) / strike.q.abs()).sqrt();
        if error.abs() <= 2.0 * width {
            return Ok(Passed::Impact { units: 0.0, s });
        }
    }
    if error > 0.0 && error > 1e-6 * s {
        Err(missed(case, exact, answer, &strike))
    } else if error < -1e-6 * s {
        Err(invented(case, exact, answer, Some(s), exact.extremum(side, Fixed::from_f64(time))))
    } else {
        Err(Fault::Inaccurate { answer, s, error, units, condition })
    }
}

fn grazing(case: &Case, exact: &Exact, story: &Story, answer: Contact, time: f64, side: Side) -> Result<Passed, Fault> {
    let first = story.strike.map(|strike| strike.s.to_f64());
    let Some(apex) = exact.extremum(side, Fixed::from_f64(time)) else {
        return Err(invented(case, exact, answer, first, None));
    };
    let (s, open) = (apex.s.to_f64(), open(case, exact, side, apex.s));
    let curvature = exact.bend(side, apex.s).abs();
    let width = 2.0 * (2.0 * ALLOWED * open / curvature).sqrt() + 1e-15 * s;
    if (s - time).abs() > width {
        return Err(invented(case, exact, answer, first, Some(apex)));
    }
    if let Some(strike) = story.strike
        && strike.s.to_f64() < s - width
    {
        return Err(missed(case, exact, answer, &strike));
    }
    if apex.past.abs() > ALLOWED * open {
        return Err(Fault::FalseGrazing { answer, s, depth: -apex.past, open });
    }
    Ok(Passed::Grazing { depth: -apex.past, s })
}

/// A reason for never holds by the textbook amplitudes, or by the fraction itself.
fn holds(case: &Case, reason: Horizon) -> bool {
    match reason {
        // decided by the search up to the horizon; the amplitude of the steady motion must be short of every stop
        Horizon::Amplitude => {
            let z = ((1.0 - case.beta) * (1.0 + case.beta)).hypot(2.0 * case.zeta * case.beta);
            case.gap * z > 1.0 - 1e-9 && case.second.is_none_or(|gap| gap * z > 1.0 - 1e-9)
        }
        Horizon::CommonPeriod { p, q } => {
            case.zeta == 0.0
                && p != q
                && (case.beta - f64::from(p) / f64::from(q)).abs() <= 4.0 * f64::EPSILON * case.beta
        }
    }
}
