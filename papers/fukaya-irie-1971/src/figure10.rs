//! Figure 10: a motion that starts exactly on the unstable orbit 1/1 at T; rounding errors lead it to 1/2.

mod windows;

use crate::claims::{Agreement, Section};
use crate::folder::Csv;
use crate::waves::{Impact, impacts};
use crate::{Error, Run, looks};
use vibroimpact::motion::ImpactState;
use vibroimpact::orbit::{Cycle, FindOptions, Orbit, find};
use vibroimpact::system::phase;
use vibroimpact::verdict::{SettleOptions, settle};
use vibroimpact::{Label, Oscillator, scenario};
use vibroimpact_plot::{Colour, Dash, Figure, FigureAxis, HLine, Legend, Line, Panel, Points, SERIES, Stroke, Text};

/// Number of impacts followed.
const FOLLOWED: usize = 400;
/// Relative errors that a machine with fewer digits might start with.
const COARSER: [f64; 3] = [1e-4, 1e-6, 1e-8];
/// A motion has left 1/1 when an interval differs from that of 1/1 by this relative amount.
const LEFT: f64 = 0.01;

/// A motion that begins near the unstable orbit.
struct Escape {
    impacts: Vec<Impact>,
    /// Distance from the orbit at each impact: the larger one of the differences in phase and in relative speed.
    distance: Vec<f64>,
    leaves: Option<usize>,
    settles: Option<usize>,
}

pub(crate) fn run(run: &mut Run<'_>) -> Result<(), Error> {
    run.stage("figure 10: from 1/1 to 1/2 at T", 0)?;
    let osc = scenario::T.oscillator();
    let orbits = find(&osc, Label::new(1, 1), FindOptions::default());
    let orbit = orbits.iter().find(|orbit| orbit.physical).ok_or(Error::Unexpected("T has no fundamental orbit"))?;
    let exact = escape(&osc, &orbit.cycle, 0.0);
    let (ulps, seen) = least(&osc, &orbit.cycle);
    let coarser = COARSER.map(|error| escape(&osc, &orbit.cycle, error));
    let mut csv = Csv::new(
        "Figure 10: impacts at T, 1/beta = 1.11, delta = 2, from the unstable 1/1 orbit, a few units in the last place off; distance from it",
        "impact,interval,speed,distance",
    );
    for (k, (impact, distance)) in seen.impacts.iter().zip(&seen.distance).enumerate() {
        csv.row(&[&(k + 1), &impact.interval, &impact.speed, distance]);
    }
    run.folder.write("figure-10.csv", csv.bytes())?;
    let multiplier = orbit.cycle.multipliers[0].modulus();
    let figure = draw(&osc, [&exact, &seen], &coarser, multiplier);
    let svg = run.folder.figure("figure-10", figure)?;

    let mut section = Section::new(
        "Figure 10. From an unstable motion to a stable one",
        "T, 1/beta = 1.11, delta = 2, started on the unstable 1/1 orbit, its speed off by a few units in the last place. Above: \
         the interval before each impact; dashed lines at one and two forcing periods. Below: the distance from the orbit, also \
         for the start as exact as 64-bit numbers allow and for larger errors, as on a machine of fewer digits.",
    )
    .svg("figure-10", svg, &[]);
    claims(&mut section, &osc, &orbit.cycle, (&exact, ulps, &seen), &coarser);
    windows::add(&mut section)?;
    run.report.sections.push(section);
    Ok(())
}

/// The motion from the orbit with its speed multiplied by `1 + error`.
fn escape(osc: &Oscillator, cycle: &Cycle, error: f64) -> Escape {
    let on = cycle.points[0].state;
    let start = ImpactState { velocity: on.velocity * (1.0 + error), ..on };
    let impacts = impacts(osc, start.rebound(osc), FOLLOWED);
    let distance: Vec<f64> = impacts
        .iter()
        .map(|i| {
            let turned = phase::difference(i.phase, on.phase).abs();
            turned.max((i.speed / on.velocity - 1.0).abs())
        })
        .collect();
    let period = osc.period();
    let leaves = impacts.iter().position(|i| (i.interval / period - 1.0).abs() > LEFT).map(|k| k + 1);
    let settles = impacts
        .iter()
        .rposition(|i| (i.interval / (2.0 * period) - 1.0).abs() > 1e-3)
        .map(|k| k + 2)
        .filter(|k| *k < FOLLOWED);
    Escape { impacts, distance, leaves, settles }
}

/// The smallest error of the speed, in powers of two of its last place, that is not lost by rounding; and the motion
/// from it.
fn least(osc: &Oscillator, cycle: &Cycle) -> (u32, Escape) {
    let mut ulps = 1;
    loop {
        let speed = cycle.points[0].state.velocity;
        let off = f64::from_bits(speed.to_bits() + u64::from(ulps)) / speed - 1.0;
        let seen = escape(osc, cycle, off);
        if seen.leaves.is_some() || ulps >= 1 << 20 {
            return (ulps, seen);
        }
        ulps *= 2;
    }
}

/// The growth per impact, by linear regression of the logarithms of the distances that are small but well above
/// rounding.
#[allow(clippy::cast_precision_loss)] // hundreds
fn growth(escape: &Escape) -> (f64, usize) {
    let small: Vec<(f64, f64)> = escape
        .distance
        .iter()
        .take(escape.leaves.unwrap_or(FOLLOWED))
        .enumerate()
        .filter(|(_, d)| (1e-13..1e-3).contains(*d))
        .map(|(k, d)| (k as f64, d.ln()))
        .collect();
    let n = small.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| small.iter().map(f).sum::<f64>() / n;
    let (mx, my) = (mean(&|p| p.0), mean(&|p| p.1));
    let slope = mean(&|p| (p.0 - mx) * (p.1 - my)) / mean(&|p| (p.0 - mx).powi(2));
    (slope.exp(), small.len())
}

#[allow(clippy::cast_precision_loss)] // hundreds
fn numbers(list: &[Impact]) -> Vec<f64> {
    (1..=list.len()).map(|k| k as f64).collect()
}

fn draw(osc: &Oscillator, [exact, seen]: [&Escape; 2], coarser: &[Escape; 3], multiplier: f64) -> Figure {
    let period = osc.period();
    let ks = numbers(&seen.impacts);
    let guide = Stroke::new(Colour::GREY).width(1.5).dash(Dash::Dashed);
    let dots =
        Points::new(ks.clone(), seen.impacts.iter().map(|i| i.interval).collect::<Vec<_>>(), SERIES[0]).size(6.0);
    let until = FOLLOWED as f64;
    let mut upper = Panel::new(
        FigureAxis { numbers: false, ..FigureAxis::new("").range(0.0, until) },
        FigureAxis::new("interval *z*").range(0.0, 2.3 * period),
    )
    .with(HLine::new(period, guide))
    .with(HLine::new(2.0 * period, guide))
    .with(dots.clone());
    for (place, name) in [(1.0, "1/1"), (2.0, "1/2")] {
        let text = Text::new(until, place * period, name);
        upper.add(text.anchor(vibroimpact_plot::Anchor::End).shift(-8.0, -17.0));
    }
    let floor = |e: &Escape| e.distance.iter().map(|d| d.max(1e-17)).collect::<Vec<_>>();
    let begin = seen.distance.iter().position(|d| *d > 1e-13).unwrap_or(0);
    let theory: Vec<f64> = ks
        .iter()
        .map(|k| seen.distance[begin] * multiplier.powf(k - 1.0 - begin as f64))
        .take_while(|d| *d < 1.0)
        .collect();
    let theory = Line::new(ks.clone(), theory, Colour::BLACK).dash(Dash::Dashed).width(2.0);
    let own = Line::new(ks.clone(), floor(seen), SERIES[0]).width(2.4);
    let locked = Line::new(ks.clone(), floor(exact), SERIES[3]).width(1.6);
    let mut lower = Panel::new(
        FigureAxis::new("impact number").range(0.0, until),
        FigureAxis::new("distance from 1/1").range(1e-17, 10.0).log10(),
    )
    .with(locked.clone())
    .with(own.clone());
    let mut legend = Legend::below().line(own.stroke, "off by a few last places").line(locked.stroke, "64-bit start");
    for (k, (escape, name)) in coarser.iter().zip(["10^{−4}", "10^{−6}", "10^{−8}"]).enumerate() {
        let line = Line::new(ks.clone(), floor(escape), SERIES[[1, 4, 2][k]]).width(1.6);
        legend = legend.line(line.stroke, format!("start off by {name}"));
        lower.add(line);
    }
    lower.add(theory.clone());
    let legend = legend.line(theory.stroke, "growth by the multiplier");
    Figure::grid(1, vec![upper, lower]).size(vibroimpact_plot::COLUMN, 660.0).legend(legend)
}

fn claims(
    section: &mut Section,
    osc: &Oscillator,
    cycle: &Cycle,
    (exact, ulps, seen): (&Escape, u32, &Escape),
    coarser: &[Escape; 3],
) {
    let state = cycle.points[0].state;
    let [large, small] = cycle.multipliers;
    let halves: Vec<Orbit> = find(osc, Label::new(1, 2), FindOptions::default())
        .into_iter()
        .filter(|o| o.physical && o.cycle.stable())
        .collect();
    section.claim(
        "10",
        "at T (1.11, 2.0) the fundamental motion 1/1 is unstable and 1/2 is stable",
        format!(
            "1/1 strikes with U = {:.16} at phase {:.16}; its multipliers are {:.6} and {:.6}; 1/2 {}",
            state.velocity,
            state.phase,
            large.re,
            small.re,
            halves.first().map_or_else(
                || "is not stable".to_owned(),
                |o| {
                    let [one, _] = o.cycle.multipliers;
                    format!("is stable, {:.6} +- {:.6}i, {:.6} in modulus", one.re, one.im.abs(), one.modulus())
                }
            )
        ),
        Agreement::of(!cycle.stable() && !halves.is_empty(), !cycle.stable()),
    );
    let (rate, points) = growth(seen);
    let stays = exact.distance.iter().copied().fold(0.0, f64::max);
    let rounding = if exact.leaves.is_none() {
        format!(
            "from the orbit as 64-bit numbers hold it nothing grows: rounding undoes what a flight adds, and all {FOLLOWED} impacts \
             stay within {stays:.0e}. From {ulps} units in the last place of the speed away, "
        )
    } else {
        String::new()
    };
    let off = (rate / large.modulus() - 1.0).abs();
    section.claim(
        "10",
        "started on 1/1 the motion stays there while small errors, those of the computation, grow from impact to impact",
        format!(
            "{rounding}the distance grows by {rate:.4} an impact (fit over {points} impacts, 1e-13 to 1e-3); the multiplier is {:.4} \
             in modulus, {} away",
            large.modulus(),
            looks::percent(off)
        ),
        Agreement::of(off < 0.02 && exact.leaves.is_some(), off < 0.2),
    );
    let end =
        seen.impacts.last().map(|i| ImpactState { phase: i.phase, velocity: i.speed, side: vibroimpact::Side::Upper });
    let verdict = end.map(|state| settle(osc, state.rebound(osc), &SettleOptions::default()).verdict);
    let to_half = verdict.is_some_and(|v| v.label() == "1/2");
    let at = |k: Option<usize>| k.map_or("never".to_owned(), |k| format!("impact {k}"));
    let gone: Vec<String> =
        coarser.iter().zip(["1e-4", "1e-6", "1e-8"]).map(|(e, error)| format!("{error} by {}", at(e.leaves))).collect();
    section.claim(
        "10",
        "when the disturbance is large enough the motion goes over to 1/2, suddenly, and stays there",
        format!(
            "it leaves at {} (interval off by 1 %) and is within 0.1 % of 1/2 from {} on; it {} 1/2. On the paper's machine, \
             with fewer digits, it must have left earlier: an error at the start of {} takes it away",
            at(seen.leaves),
            at(seen.settles),
            if to_half { "settles into" } else { "does not settle into" },
            gone.join(", "),
        ),
        Agreement::of(seen.leaves.is_some() && seen.settles.is_some() && to_half, seen.leaves.is_some()),
    );
}
