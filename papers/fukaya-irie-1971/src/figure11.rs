//! Figure 11: impacts of a chaotic motion, at U.

use crate::claims::{Agreement, Section};
use crate::figure03::with_tolerance;
use crate::folder::Csv;
use crate::waves::{Impact, impacts};
use crate::{Error, Run, looks};
use vibroimpact::chaos::lyapunov;
use vibroimpact::motion::ImpactState;
use vibroimpact::orbit::{Cycle, FindOptions, Orbit, find};
use vibroimpact::system::phase;
use vibroimpact::verdict::{PaperVerdict, SettleOptions, StartBox, attractors, paper_rule, scattered_starts};
use vibroimpact::{Label, Oscillator, Side, Start, scenario};
use vibroimpact_plot::{Colour, Dash, FigureAxis, HLine, Legend, Line, Panel, Points, SERIES, Stroke, Text};

/// Number of impacts shown.
const SHOWN: usize = 200;
/// Simple motions that are searched: impacts and periods.
const SIMPLE: [(u32, u32); 5] = [(1, 1), (2, 1), (1, 2), (2, 2), (1, 3)];
/// Number of starts to which the rule of the paper is applied.
const STARTS: u64 = 100;

/// The closest approach of a motion to an orbit.
struct Pass {
    label: String,
    /// Number of the impact, and distance: the larger one of the differences in phase and in relative speed.
    shown: (usize, f64),
    long: (usize, f64),
}

pub(crate) fn run(run: &mut Run<'_>) -> Result<(), Error> {
    let long: u32 = run.size(200_000, 20_000);
    run.stage("figure 11: no end of impacts at U", 0)?;
    let osc = scenario::U.oscillator();
    let list = impacts(&osc, Start::at_rest(&osc), 20_000);
    if list.len() < 20_000 {
        return Err(Error::Unexpected("the impacts at U cease"));
    }
    let orbits: Vec<(Label, Vec<Orbit>)> = SIMPLE
        .iter()
        .map(|(m, n)| Label::new(*m, *n))
        .map(|label| (label, find(&osc, label, FindOptions::default())))
        .collect();
    let passes: Vec<Pass> = orbits
        .iter()
        .filter(|(label, _)| ["1/1", "1/2"].contains(&label.to_string().as_str()))
        .flat_map(|(_, found)| found.iter().filter(|o| o.physical))
        .map(|orbit| pass(&orbit.cycle, &list))
        .collect();
    let mut csv =
        Csv::new("Figure 11: impacts at U, 1/beta = 1.11, delta = 3, from rest", "impact,interval,phase,speed");
    for (k, impact) in list.iter().take(SHOWN).enumerate() {
        csv.row(&[&(k + 1), &impact.interval, &impact.phase, &impact.speed]);
    }
    run.folder.write("figure-11.csv", csv.bytes())?;
    let svg = run.folder.figure("figure-11", draw(&osc, &list[..SHOWN]))?;

    let mut section = Section::new(
        "Figure 11. Impacts that never settle",
        "U, 1/beta = 1.11, delta = 3, from rest: the interval before each of the first 200 impacts. Dashed: one and two \
         forcing periods, the intervals of 1/1 and 1/2.",
    )
    .svg("figure-11", svg, &[]);
    settling(&mut section, &osc, &list, long)?;
    simple(&mut section, &orbits);
    similar(&mut section, osc.period(), &list, &passes);
    rule(&mut section, &osc);
    run.report.sections.push(section);
    Ok(())
}

fn pass(cycle: &Cycle, list: &[Impact]) -> Pass {
    let on = cycle.points[0].state;
    let nearest = |count: usize| {
        list.iter()
            .take(count)
            .enumerate()
            .map(|(k, i)| {
                let turned = phase::difference(i.phase, on.phase).abs();
                let speed = (i.speed - on.velocity).abs() / i.speed.max(on.velocity);
                (k + 1, turned.max(speed))
            })
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0, f64::INFINITY))
    };
    Pass { label: cycle.label.to_string(), shown: nearest(SHOWN), long: nearest(list.len()) }
}

#[allow(clippy::cast_precision_loss)] // 200
fn draw(osc: &Oscillator, list: &[Impact]) -> vibroimpact_plot::Figure {
    let period = osc.period();
    let (ks, zs): (Vec<f64>, Vec<f64>) =
        list.iter().enumerate().map(|(k, impact)| ((k + 1) as f64, impact.interval)).unzip();
    let guide = Stroke::new(Colour::GREY).width(1.5).dash(Dash::Dashed);
    let highest = zs.iter().copied().fold(0.0, f64::max);
    let line = Line::new(ks.clone(), zs.clone(), SERIES[5].alpha(0.55)).width(1.2);
    let dots = Points::new(ks, zs, SERIES[0]).size(6.5);
    let until = SHOWN as f64;
    let mut panel = Panel::new(
        FigureAxis::new("impact number").range(0.0, until + 14.0),
        FigureAxis::new("interval *z*").range(0.0, 1.12 * highest),
    )
    .with(HLine::new(period, guide))
    .with(HLine::new(2.0 * period, guide))
    .with(line)
    .with(dots.clone());
    for (place, name) in [(1.0, "1/1"), (2.0, "1/2")] {
        let text = Text::new(until + 13.0, place * period, name);
        panel.add(text.anchor(vibroimpact_plot::Anchor::End).shift(0.0, -16.0));
    }
    let legend = Legend::below().points(&dots, "interval before the impact").line(guide, "one and two forcing periods");
    looks::column(panel, 400.0).legend(legend)
}

fn settling(section: &mut Section, osc: &Oscillator, list: &[Impact], long: u32) -> Result<(), Error> {
    let free = osc.free_amplitude();
    section.claim(
        "11",
        "at U (1.11, 3.0) delta is below |f|, so impacts never stop",
        format!(
            "|f| = {free:.3} > 3; all of {} impacts from rest happened, the longest interval {:.1} forcing periods",
            list.len(),
            list.iter().map(|i| i.interval).fold(0.0, f64::max) / osc.period()
        ),
        Agreement::of(free > osc.gap(), false),
    );
    let from = &list[list.len() - 1];
    let state = ImpactState { phase: from.phase, velocity: from.speed, side: Side::Upper };
    let spectrum = lyapunov(osc, state, long).ok_or(Error::Unexpected("the motion at U sticks"))?;
    let [one, two] = spectrum.exponents;
    let census = attractors(osc, 40, 1, &SettleOptions::default());
    let chaotic: u64 =
        census.motions().iter().filter(|found| found.verdict.label() == "chaotic").map(|found| found.count).sum();
    section.claim(
        "11",
        "however long it lasts, the motion settles into no steady motion",
        format!(
            "it is chaotic: largest Lyapunov exponent {:.4} +- {:.4} per unit of time ({:.3} per forcing period), the other \
             {:.4} +- {:.4} (3 standard errors, {long} impacts); {chaotic} of {} scattered starts end in chaos",
            one.value,
            one.error,
            one.value * osc.period(),
            two.value,
            two.error,
            census.total()
        ),
        Agreement::of(one.value > one.error && chaotic == census.total(), one.value > 0.0),
    );
    Ok(())
}

fn simple(section: &mut Section, orbits: &[(Label, Vec<Orbit>)]) {
    let told: Vec<String> = orbits
        .iter()
        .map(|(label, found)| {
            let possible: Vec<_> = found.iter().filter(|o| o.physical).collect();
            match possible.as_slice() {
                [] => format!("{label} none"),
                list => {
                    let of = |o: &Orbit| o.cycle.multipliers.map(|m| format!("{:.6}", m.re)).join(" and ");
                    let told: Vec<String> = list.iter().map(|o| of(o)).collect();
                    format!("{label} with multipliers {}", looks::list(&told, 4))
                }
            }
        })
        .collect();
    let stable = orbits.iter().flat_map(|(_, found)| found).any(|o| o.physical && o.cycle.stable());
    section.claim(
        "11",
        "simple steady motions such as 1/1, 2/1, 1/2, 2/2 do not arise there",
        format!("{} of the orbits found is stable: {}", if stable { "one" } else { "none" }, told.join("; ")),
        Agreement::of(!stable, false),
    );
}

/// The text of a distance: three decimals, or a power of ten if these would be zero.
fn distance(d: f64) -> String {
    if d < 1e-3 { format!("{d:.1e}") } else { format!("{d:.3}") }
}

/// How close the motion comes to the two orbits, and how long it resembles them.
fn similar(section: &mut Section, period: f64, list: &[Impact], passes: &[Pass]) {
    let like = |periods: f64| -> (usize, usize) {
        let near = |i: &Impact| (i.interval / (periods * period) - 1.0).abs() < 0.1;
        let shown = &list[..SHOWN];
        let longest = shown.split(|i| !near(i)).map(<[Impact]>::len).max().unwrap_or(0);
        (shown.iter().filter(|i| near(i)).count(), longest)
    };
    let (one, two) = (like(1.0), like(2.0));
    let near: Vec<String> = passes
        .iter()
        .map(|p| {
            format!(
                "it comes to {} as near as {:.3} within {SHOWN} impacts (number {}) and {} within 20000",
                p.label,
                p.shown.1,
                p.shown.0,
                distance(p.long.1)
            )
        })
        .collect();
    section.claim(
        "11",
        "oscillations similar to 1/1 and to 1/2 appear on the way",
        format!(
            "of the first {SHOWN} intervals {} lie within 10 % of one forcing period, up to {} in a row, and {} within 10 % of \
             two, up to {} in a row. The unstable orbits themselves: {} (phase in radians or relative speed, the larger)",
            one.0,
            one.1,
            two.0,
            two.1,
            near.join("; ")
        ),
        Agreement::of(
            passes.len() >= 2 && passes.iter().all(|p| p.shown.1 < 0.1),
            passes.iter().any(|p| p.long.1 < 0.1),
        ),
    );
}

fn rule(section: &mut Section, osc: &Oscillator) {
    let area = StartBox::natural(osc);
    let unstable = |percent: f64| {
        (0..STARTS)
            .filter(|index| {
                let start = scattered_starts(osc, area, 1, *index);
                paper_rule(osc, start, with_tolerance(percent)) == PaperVerdict::Unstable
            })
            .count()
    };
    let rest = paper_rule(osc, Start::at_rest(osc), with_tolerance(0.1));
    let counts = [1.0, 0.1, 0.01, 0.001].map(unstable);
    section.claim(
        "11",
        "after 100 impacts without meeting (11) the motion counts as unstable",
        format!(
            "the paper does not state p; with 1 %, 0.1 %, 0.01 %, 0.001 % the rule says unstable for {}, {}, {} and {} of \
             {STARTS} starts. The others met it by chance, as two of 100 impacts then come within p of each other (from rest \
             with 0.1 %: {}). The last p is finer than the 1e-4 to which the paper found its impacts",
            counts[0],
            counts[1],
            counts[2],
            counts[3],
            crate::figure03::in_words(&rest)
        ),
        Agreement::of(counts[1] > 90, counts[2] > 90),
    );
}
