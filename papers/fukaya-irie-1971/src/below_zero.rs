//! Figure 4 continued to delta = -1, where the mass sticks and the method of the paper does not apply.

use crate::claims::{Agreement, Section};
use crate::figure04::cells;
use crate::grid::{Grid, settle_grid};
use crate::{Error, Run, looks, search};
use vibroimpact::math::sort_by;
use vibroimpact_plot::{FigureAxis, Panel};
use vibroimpact_study::Span;

pub(crate) fn run(run: &mut Run<'_>) -> Result<(), Error> {
    let x = Span::new(0.4, 2.0, run.size(33, 17))?;
    let gap = Span::new(-1.0, 0.0, run.size(9, 5))?;
    let grid = settle_grid(run, "figure 4 below zero", (x, gap, run.size(12, 4)))?;
    let about =
        "Figure 4 continued below delta = 0: motions and the share of starts that lead to them, restitution 0.5";
    run.folder.write("figure-04-below-zero.csv", search::table(about, &[&grid]).bytes())?;
    let labels = grid.labels();
    let panel =
        Panel::new(FigureAxis::new("1/*β*").range(0.375, 2.025), FigureAxis::new("gap *δ*").range(-1.0625, 0.0625))
            .with(cells(&grid));
    let legend = looks::legend(labels.iter().map(|(label, _)| label.as_str()));
    let figure = looks::column(panel, 380.0).legend(legend);
    let svg = run.folder.figure("figure-04-below-zero", figure)?;

    let mut section = Section::new(
        "Figure 4 below zero. The mass is pressed against the wall",
        "The same plane for -1 <= delta <= 0, where the wall presses the mass already at rest. At delta <= -1 the force never \
         lifts it. The paper stops at delta = 0; this figure is ours. inf/n: infinitely many impacts in n forcing periods, \
         a complete chatter that ends at rest on the wall.",
    )
    .svg("figure-04-below-zero", svg, &[]);
    claim(&mut section, &grid);
    run.report.sections.push(section);
    Ok(())
}

fn claim(section: &mut Section, grid: &Grid) {
    let inside: Vec<_> = grid.points.iter().filter(|p| p.gap < 0.0 && p.gap > -1.0).collect();
    let sticking = inside.iter().filter(|p| p.motions.iter().any(|f| f.verdict.label().starts_with("inf/"))).count();
    let starts: usize = grid.points.iter().map(|p| p.starts.len()).sum();
    let undecided = grid.points.iter().flat_map(|p| &p.starts).filter(|(label, _)| label == "undecided").count();
    let mut labels = grid.labels();
    sort_by(&mut labels, |a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
    let told: Vec<String> = labels.iter().map(|(label, points)| format!("{label} at {points}")).collect();
    section.claim(
        "4",
        "at delta < 0 the mass tends to stay on the wall; simulation is difficult and steady motions are hard to tell apart",
        format!(
            "it does: at {sticking} of the {} points with -1 < delta < 0 a motion chatters to rest in every period. But \
             chatter can be summed and a release fixes all that follows, so {} of {starts} starts stayed undecided. \
             Points by motion: {}",
            inside.len(),
            if undecided == 0 { "none".into() } else { undecided.to_string() },
            looks::list(&told, 10)
        ),
        Agreement::of(2 * sticking > inside.len(), sticking > 0),
    );
}
