//! The statements of the paper on figure 4, and the results.

use super::{Plane, free_amplitude};
use crate::claims::{Agreement, Section};
use crate::grid::{Grid, Point};
use crate::{figure03, looks, search};
use vibroimpact::math::sort_by;
use vibroimpact::scenario;

pub(super) fn add(section: &mut Section, grid: &Grid, plane: &Plane) {
    points(section);
    coverage(section, grid);
    theory(section, grid, plane);
    orders(section, plane);
    high_orders(section, plane);
    right(section, grid, plane);
    lower_left(section, grid, plane);
    below(section, grid);
    above(section, grid);
}

fn points(section: &mut Section) {
    let above: Vec<String> =
        scenario::PAPER.iter().filter(|p| p.gap > free_amplitude(p.inverse_beta)).map(|p| p.name.to_owned()).collect();
    section.claim(
        "4",
        "P, Q and R lie above the dashed curve |f|; S and U, and so N and T, lie below it",
        format!("above it lie {}", looks::list(&above, 7)),
        Agreement::of(above == ["P", "Q", "R"], false),
    );
}

fn coverage(section: &mut Section, grid: &Grid) {
    let labels = grid.labels();
    let undecided: usize = grid.points.iter().flat_map(|p| &p.starts).filter(|(label, _)| label == "undecided").count();
    let starts: usize = grid.points.iter().map(|p| p.starts.len()).sum();
    let periodic = labels.iter().filter(|(label, _)| label.contains('/')).count();
    section.claim(
        "4",
        "motions from several starts at each point in steps of 0.05 and 0.125; what stayed blank might be filled with more \
         starts",
        format!(
            "{} x {} points, {starts} starts: none of the points is blank, {periodic} different m/n; {} undecided",
            grid.x.count(),
            grid.gap.count(),
            if undecided == 0 { "no start stayed".into() } else { format!("{} stayed", looks::count(undecided, "start")) }
        ),
        Agreement::of(undecided * 1000 < starts, undecided * 100 < starts),
    );
}

/// Compares theory with simulation from starts, where both give results.
fn theory(section: &mut Section, grid: &Grid, plane: &Plane) {
    let mut parts = Vec::new();
    let (mut all, mut most) = (true, true);
    for (m, n) in [(1, 1), (2, 1), (1, 2)] {
        let Some(region) = plane.region(m, n) else {
            continue;
        };
        let label = region.label.to_string();
        let stable: Vec<&Point> = grid.points.iter().filter(|p| region.holds(p.inverse_beta, p.gap)).collect();
        let reached = stable.iter().filter(|p| p.motions.iter().any(|found| found.verdict.label() == label)).count();
        let outside = grid.with(&label).filter(|(p, _)| !region.holds(p.inverse_beta, p.gap)).count();
        let part = looks::ratio(reached, stable.len());
        all &= outside == 0 && part > 0.9;
        most &= outside <= 2 && part > 0.7;
        parts.push(format!(
            "{label} is stable at {} points of the grid, some start reaches it at {reached} of them and at {outside} others",
            stable.len()
        ));
    }
    let open: usize = plane.regions.iter().map(|region| region.stable.unresolved.len()).sum();
    if open > 0 {
        parts.push(format!("the regions are uncertain about {}", looks::count(open, "point")));
    }
    all &= open == 0;
    section.claim(
        "4",
        "the motions found from starts lie in the regions where theory has 1/1, 2/1 and 1/2 stable",
        parts.join("; "),
        Agreement::of(all, most),
    );
}

fn orders(section: &mut Section, plane: &Plane) {
    let of: Vec<_> = (1..=3).filter_map(|m| plane.region(m, 1)).collect();
    let falling = of.windows(2).all(|w| w[1].mean_gap < w[0].mean_gap && w[1].area < w[0].area);
    let told: Vec<String> = of
        .iter()
        .map(|r| {
            format!("{} fills {} of the plane at a mean delta of {:.2}", r.label, looks::percent(r.area), r.mean_gap)
        })
        .collect();
    section.claim(
        "4",
        "with rising order, 1/1, 2/1, 3/1, the motions move to smaller delta",
        told.join("; "),
        Agreement::of(of.len() == 3 && falling, of.len() > 1),
    );
}

fn high_orders(section: &mut Section, plane: &Plane) {
    let of: Vec<_> = (4..=6).filter_map(|m| plane.region(m, 1)).filter(|r| r.area > 0.0).collect();
    let area: f64 = of.iter().map(|r| r.area).sum();
    let small = of.iter().all(|r| r.gaps.1 < 1.0);
    let told: Vec<String> = of
        .iter()
        .map(|r| {
            format!(
                "{} fills {}, mean delta {:.2}, highest {:.2}",
                r.label,
                looks::percent(r.area),
                r.mean_gap,
                r.gaps.1
            )
        })
        .collect();
    section.claim(
        "4",
        "orders of four and more occur, in very narrow areas at still smaller delta",
        told.join("; "),
        Agreement::of(!of.is_empty() && area < 0.03 && small, !of.is_empty()),
    );
}

/// Motions with m > n > 1 at large 1/beta.
fn right(section: &mut Section, grid: &Grid, plane: &Plane) {
    let mut places: Vec<(f64, f64)> = Vec::new();
    let mut kinds: Vec<String> = Vec::new();
    for (label, _) in grid.labels() {
        let Some((m, n)) = looks::numbers(&label) else {
            continue;
        };
        if m > n && n > 1 {
            places.extend(grid.with(&label).map(|(p, _)| (p.inverse_beta, p.gap)));
            kinds.push(label);
        }
    }
    let inside = places.iter().filter(|(x, gap)| *x >= 1.5 && *gap >= 1.0).count();
    let named: Vec<Option<String>> =
        ["3/2", "4/3"].iter().map(|label| search::told(&plane.right.grid, label)).collect();
    let on_grid = search::told(grid, "4/3").map_or_else(
        || {
            let rule = ruled(grid, "4/3");
            format!("4/3 is not on the grid (the paper's rule names it at {})", looks::list(&rule, 4))
        },
        |found| format!("on the grid, {found}"),
    );
    let finer = named.iter().flatten().cloned().collect::<Vec<_>>();
    section.claim(
        "4",
        "at large 1/beta and large delta, the upper right, super-sub motions such as 3/2 and 4/3",
        format!(
            "motions m/n with m > n > 1 ({}) at {} points, {inside} of them with 1/beta >= 1.5 and delta >= 1, most of \
             those below delta = {:.2}; {on_grid}; with finer steps ({}): {}",
            looks::list(&kinds, 12),
            places.len(),
            upper_end(&places),
            plane.right.window,
            looks::list(&finer, 4),
        ),
        Agreement::of(named.iter().all(Option::is_some) && 2 * inside > places.len(), named[0].is_some() || inside > 0),
    );
}

/// The gap below which three quarters of the points with 1/beta >= 1.5 and delta >= 1 lie, rounded to the grid.
fn upper_end(places: &[(f64, f64)]) -> f64 {
    let mut gaps: Vec<f64> = places.iter().filter(|(x, gap)| *x >= 1.5 && *gap >= 1.0).map(|(_, gap)| *gap).collect();
    sort_by(&mut gaps, f64::total_cmp);
    gaps.get(gaps.len() * 3 / 4).map_or(0.0, |gap| gap + 0.125)
}

/// The motions 5/8, 4/6 and 3/4 between 1/1 and 1/2.
fn lower_left(section: &mut Section, grid: &Grid, plane: &Plane) {
    let named = ["5/8", "4/6", "3/4"];
    let corner: Vec<String> = named
        .iter()
        .map(|label| {
            let here: Vec<String> = grid
                .with(label)
                .filter(|(p, _)| p.inverse_beta <= 0.7 && p.gap <= 1.5)
                .map(|(p, share)| format!("{} ({})", looks::place(p.inverse_beta, p.gap), looks::percent(share)))
                .collect();
            format!("{label}: {}", looks::list(&here, 4))
        })
        .collect();
    let finer: Vec<Option<String>> = named.iter().map(|label| search::told(&plane.lower_left.grid, label)).collect();
    let missing: Vec<String> =
        named.iter().zip(&finer).filter(|(_, found)| found.is_none()).map(|(label, _)| (*label).to_owned()).collect();
    section.claim(
        "4",
        "at small 1/beta and small delta, between the areas of 1/1 and 1/2: 5/8, 4/6 and 3/4",
        format!(
            "on the grid {}; with finer steps ({}) {}{}",
            corner.join(", "),
            plane.lower_left.window,
            looks::list(&finer.iter().flatten().cloned().collect::<Vec<_>>(), 4),
            if missing.is_empty() { String::new() } else { format!("; not found: {}", looks::list(&missing, 4)) }
        ),
        Agreement::of(missing.is_empty(), missing.len() < 3),
    );
}

fn below(section: &mut Section, grid: &Grid) {
    let of: Vec<&Point> = grid.points.iter().filter(|p| p.gap < p.free).collect();
    let odd: Vec<&&Point> = of.iter().filter(|p| p.kinds().1).collect();
    let starts: usize = of.iter().map(|p| p.starts.len()).sum();
    let on_two = odd.iter().all(|p| (p.inverse_beta - 2.0).abs() < 1e-9);
    let lowest = odd.iter().map(|p| p.gap).fold(f64::INFINITY, f64::min);
    let exception = if odd.is_empty() {
        "no exception".to_owned()
    } else if on_two {
        format!(
            "the only exceptions are the {} with 1/beta = 2 exactly and delta >= {lowest}: there the free motion has twice \
             the frequency of the force, joins it for ever, and lowers the peak |f| to as little as |f|/sqrt(2) = {:.3}",
            looks::count(odd.len(), "point"),
            free_amplitude(2.0) / 2.0_f64.sqrt()
        )
    } else {
        let places: Vec<String> = odd.iter().map(|p| looks::place(p.inverse_beta, p.gap)).collect();
        format!("exceptions at {}", looks::list(&places, 6))
    };
    section.claim(
        "4",
        "wherever delta < |f|, some motion with impacts follows from every start",
        format!(
            "true for {} of {starts} starts at {} points; {exception}",
            starts - odd.iter().flat_map(|p| &p.starts).filter(|(label, _)| label == "0").count(),
            of.len(),
        ),
        Agreement::of(odd.is_empty(), on_two),
    );
}

fn above(section: &mut Section, grid: &Grid) {
    let of: Vec<&Point> = grid.points.iter().filter(|p| p.gap > p.free).collect();
    let count = |kind: (bool, bool)| of.iter().filter(|p| p.kinds() == kind).count();
    let (both, with, without) = (count((true, true)), count((true, false)), count((false, true)));
    section.claim(
        "4",
        "where delta > |f|, it depends on the start whether impacts last; often they do not",
        format!(
            "of {} points, {both} have starts of both kinds, {without} only starts that end without impacts, {with} only \
             starts that end with them (others exist there too: those within delta - |f| of the free motion never strike)",
            of.len()
        ),
        Agreement::of(both > 0 && both + without > with, both > 0),
    );
}

/// Points of the grid where the rule of the paper gives a label.
fn ruled(grid: &Grid, label: &str) -> Vec<String> {
    grid.points
        .iter()
        .filter(|p| p.starts.iter().any(|(_, rule)| figure03::in_words(rule) == label))
        .map(|p| looks::place(p.inverse_beta, p.gap))
        .collect()
}
