//! Figures 1 and 2: the model, and a waveform from its start through several impacts.

use crate::claims::{Agreement, Section};
use crate::folder::Csv;
use crate::waves::{Impact, as_printed, impacts};
use crate::{EPS, Error, Run, looks};
use std::f64::consts::PI;
use vibroimpact::flight::Flight;
use vibroimpact::motion::{Motion, Path, sample};
use vibroimpact::{Oscillator, Start, scenario};
use vibroimpact_plot::{
    Colour, Dash, FigureAxis, HLine, Legend, Line, Panel, Points, SERIES, Stroke, Text, TextSide, Tick, Wall,
};

/// Number of impacts that are shown and numbered.
const SHOWN: usize = 8;

pub(crate) fn run(run: &mut Run<'_>) -> Result<(), Error> {
    run.stage("figures 1 and 2: model, waveform", 0)?;
    let point = scenario::S;
    let osc = point.oscillator();
    let start = Start::at_rest(&osc);
    let list = impacts(&osc, start, SHOWN);
    let until = list.last().map_or(20.0, |impact| impact.time) + 0.35 * osc.period();
    let wave = sample(&osc, start, until, 0.02, 100_000);
    let mut csv =
        Csv::new("Figure 2: a motion from rest, 1/beta = 1.3, delta = 0.75, restitution 0.5, phase 0", "tau,xi,xi_dot");
    for p in &wave {
        csv.row(&[&p.time, &p.x, &p.v]);
    }
    run.folder.write("figure-02.csv", csv.bytes())?;

    let (ts, xs): (Vec<f64>, Vec<f64>) = wave.iter().map(|p| (p.time, p.x)).unzip();
    let lowest = xs.iter().copied().fold(0.0, f64::min);
    let line = Line::new(ts, xs, SERIES[0]);
    let hits =
        Points::new(list.iter().map(|impact| impact.time).collect::<Vec<_>>(), vec![point.gap; list.len()], SERIES[1])
            .rim(Colour::WHITE);
    let legend = Legend::below().line(line.stroke, "displacement *ξ*(*τ*)").points(&hits, "impact and its number");
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few turns
    let turns = (until / (2.0 * PI)).floor() as u32;
    let ticks = (0..=turns).map(|k| {
        let text = match k {
            0 => "0".into(),
            _ => format!("{}π", 2 * k),
        };
        Tick::new(2.0 * PI * f64::from(k), text)
    });
    let mut panel = Panel::new(
        FigureAxis::new("time *τ*").range(0.0, until).ticks(ticks),
        FigureAxis::new("displacement *ξ*").range(1.15 * lowest, point.gap - 0.42 * lowest),
    )
    .with(HLine::new(0.0, Stroke::new(Colour::GREY).width(1.2).dash(Dash::Dotted)))
    .with(Wall::new(point.gap, TextSide::Above))
    .with(line)
    .with(hits);
    for (k, impact) in list.iter().enumerate() {
        panel.add(Text::new(impact.time, point.gap, format!("{}", k + 1)).shift(0.0, 20.0));
    }
    panel.add(Text::new(0.0, point.gap, "stop *ξ* = *δ*").anchor(vibroimpact_plot::Anchor::Start).shift(10.0, 46.0));
    let figure = looks::column(panel, 400.0).legend(legend);
    let svg = run.folder.figure("figure-02", figure)?;

    let mut section = Section::new(
        "Figures 1 and 2. The model and a waveform",
        "A motion from rest at 1/beta = 1.3, delta = 0.75 (the paper's point S) through its first impacts. The paper's \
         figure 2 is a sketch of the same; its figure 1 shows the mass, the spring and the wall.",
    )
    .svg("figure-02", svg, &[]);
    model(&mut section, &osc, &list);
    section.claim(
        "2",
        "a motion that starts at xi0, u0 strikes again and again and, where a stable periodic motion with impacts \
         exists, can settle into it",
        format!(
            "{} impacts at times {}; the intervals approach {} forcing periods",
            list.len(),
            looks::list(&list.iter().map(|i| format!("{:.2}", i.time)).collect::<Vec<_>>(), 9),
            looks::list(
                &list[list.len() - 2..].iter().map(|i| format!("{:.3}", i.interval / osc.period())).collect::<Vec<_>>(),
                2
            )
        ),
        Agreement::of(list.len() == SHOWN, !list.is_empty()),
    );
    run.report.sections.push(section);
    Ok(())
}

/// Equations (3) to (9) as printed, compared with the flights of this program.
fn model(section: &mut Section, osc: &Oscillator, list: &[Impact]) {
    let printed = |osc: &Oscillator, flight: &Flight, s: f64| {
        let (x, v) = as_printed(osc.beta(), (flight.x, flight.v, flight.phase), s);
        let ours = flight.state(s);
        (ours.0 - x).abs().max((ours.1 - v).abs())
    };
    let mut worst = 0.0_f64;
    let mut motion = Motion::new(osc, Start::at_rest(osc));
    for _ in 0..SHOWN {
        let _ = motion.next();
        if let Some(leg) = motion.leg()
            && let Path::Flight(flight) = &leg.path
        {
            for k in 0..=20 {
                worst = worst.max(printed(osc, flight, leg.duration * f64::from(k) / 20.0));
            }
        }
    }
    let mut resonant = 0.0_f64;
    if let Ok(osc) = Oscillator::new(1.0, 0.75, EPS) {
        let flight = Flight::new(&osc, Start { x: 0.75, v: -1.2, phase: 0.7 });
        for k in 0..=100 {
            resonant = resonant.max(printed(&osc, &flight, f64::from(k) / 5.0));
        }
    }
    let law = list.iter().map(|impact| (impact.rebound / impact.speed - EPS).abs()).fold(0.0, f64::max);
    section.claim(
        "1",
        "a mass on a spring under a harmonic force strikes a rigid wall: flights (3)-(8), and (3)'-(8)' at resonance, \
         impacts u+ = -eps u- (9)",
        format!(
            "our flights, which need no separate formula at resonance, differ from the printed (6) and (8) by at most \
             {worst:.0e}, from (3)' and (4)' by {resonant:.0e}; u+/u- is -eps {}",
            if law == 0.0 { "exactly".to_owned() } else { format!("to within {law:.0e}") }
        ),
        Agreement::of(worst < 1e-11 && resonant < 1e-11 && law < 1e-14, worst < 1e-6),
    );
}
