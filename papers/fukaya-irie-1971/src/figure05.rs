//! Figure 5: the motion 4/1 at N.

use crate::claims::{Agreement, Section};
use crate::folder::Csv;
use crate::{Error, Run, looks};
use vibroimpact::motion::sample;
use vibroimpact::orbit::Cycle;
use vibroimpact::verdict::{SettleOptions, Verdict, settle};
use vibroimpact::{Oscillator, Start, scenario};
use vibroimpact_plot::{Colour, FigureAxis, Legend, Line, Panel, Points, SERIES, Text, TextSide, VLine, Wall};
use vibroimpact_plot::{Dash, Stroke};

/// One impact of the motion and the flight after it.
struct Hop {
    time: f64,
    interval: f64,
    speed: f64,
    depth: f64,
}

pub(crate) fn run(run: &mut Run<'_>) -> Result<(), Error> {
    run.stage("figure 5: order four at N", 0)?;
    let point = scenario::N;
    let osc = point.oscillator();
    let settled = settle(&osc, Start::at_rest(&osc), &SettleOptions::default());
    let Verdict::Periodic(cycle) = &settled.verdict else {
        return Err(Error::Unexpected("the motion at N did not settle into a cycle"));
    };
    let hops = hops(&osc, cycle);
    let period = osc.period() * f64::from(cycle.label.periods);
    let begin = cycle.points[0].state.rebound(&osc);
    let wave = sample(&osc, begin, 2.0 * period, 0.01, 100_000);
    let mut csv = Csv::new(
        "Figure 5: two periods of the steady motion at N, 1/beta = 1.8, delta = 0.25, restitution 0.5",
        "tau,xi,xi_dot",
    );
    for p in &wave {
        csv.row(&[&p.time, &p.x, &p.v]);
    }
    run.folder.write("figure-05.csv", csv.bytes())?;

    let (ts, xs): (Vec<f64>, Vec<f64>) = wave.iter().map(|p| (p.time, p.x)).unzip();
    let line = Line::new(ts, xs, SERIES[0]);
    let times: Vec<f64> = [0.0, period]
        .iter()
        .flat_map(|turn| hops.iter().map(move |hop| hop.time + turn))
        .chain([2.0 * period])
        .collect();
    let hits = Points::new(times.clone(), vec![point.gap; times.len()], SERIES[1]).rim(Colour::WHITE);
    let deepest = hops.iter().map(|hop| hop.depth).fold(0.0, f64::max);
    let mut panel = Panel::new(
        FigureAxis::new("time *τ*").range(-0.4, 2.0 * period + 0.4),
        FigureAxis::new("displacement *ξ*").range(point.gap - 1.12 * deepest, point.gap + 0.25 * deepest),
    )
    .with(VLine::new(period, Stroke::new(Colour::GREY).width(1.2).dash(Dash::Dashed)))
    .with(Wall::new(point.gap, TextSide::Above))
    .with(line.clone())
    .with(hits.clone());
    for turn in [0.0, period] {
        for (k, hop) in hops.iter().enumerate() {
            panel.add(Text::new(turn + hop.time, point.gap, format!("{}", k + 1)).shift(0.0, 20.0));
        }
    }
    panel.add(Text::new(2.0 * period, point.gap, "1").shift(0.0, 20.0));
    let legend = Legend::below()
        .line(line.stroke, "displacement *ξ*(*τ*)")
        .points(&hits, "impact")
        .line(Stroke::new(Colour::GREY).width(1.2).dash(Dash::Dashed), "one period");
    let figure = looks::column(panel, 400.0).legend(legend);
    let svg = run.folder.figure("figure-05", figure)?;

    let mut section = Section::new(
        "Figure 5. A motion of order four",
        "The steady motion at N, 1/beta = 1.8, delta = 0.25, over two of its periods.",
    )
    .svg("figure-05", svg, &[]);
    claim(&mut section, cycle, &hops);
    run.report.sections.push(section);
    Ok(())
}

/// The impacts of a cycle, each with the depth of the following flight.
fn hops(osc: &Oscillator, cycle: &Cycle) -> Vec<Hop> {
    let mut time = 0.0;
    cycle
        .points
        .iter()
        .map(|p| {
            let wave = sample(osc, p.state.rebound(osc), p.interval, p.interval / 4000.0, 10_000);
            let lowest = wave.iter().map(|s| s.x).fold(f64::INFINITY, f64::min);
            let hop = Hop { time, interval: p.interval, speed: p.state.velocity, depth: osc.gap() - lowest };
            time += p.interval;
            hop
        })
        .collect()
}

fn claim(section: &mut Section, cycle: &Cycle, hops: &[Hop]) {
    let told = |value: &dyn Fn(&Hop) -> f64| {
        let list: Vec<String> = hops.iter().map(|hop| format!("{:.4}", value(hop))).collect();
        looks::list(&list, 12)
    };
    let spread = |value: &dyn Fn(&Hop) -> f64| {
        let most = hops.iter().map(value).fold(0.0, f64::max);
        most / hops.iter().map(value).fold(f64::INFINITY, f64::min)
    };
    let depths = spread(&|hop| hop.depth);
    let intervals = spread(&|hop| hop.interval);
    section.claim(
        "5",
        "N (1/beta = 1.8, delta = 0.25) has a steady motion of order four, 4/1",
        format!(
            "from rest it settles into {}, largest multiplier {:.3} in modulus; impact speeds {}",
            cycle.label,
            cycle.multipliers[0].modulus(),
            told(&|hop| hop.speed)
        ),
        Agreement::of(cycle.label.to_string() == "4/1" && cycle.stable(), false),
    );
    section.claim(
        "5",
        "the four displacements and intervals within one period are quite unequal",
        format!(
            "after impacts 1 to {} the mass leaves the wall by {}, for {}: the largest displacement is {depths:.1} times \
             the smallest, the longest interval {intervals:.1} times the shortest",
            hops.len(),
            told(&|hop| hop.depth),
            told(&|hop| hop.interval),
        ),
        Agreement::of(depths > 2.0 && intervals > 1.5, depths > 1.2),
    );
}
