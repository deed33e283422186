//! The four conclusions in section 4 of the paper.

use crate::Run;
use crate::basins::Shares;
use crate::claims::{Agreement, Section};
use crate::figure04::Plane;
use crate::grid::Grid;
use crate::looks;

pub(crate) fn run(run: &mut Run<'_>, grid: &Grid, plane: &Plane, shares: &Shares) {
    let mut section = Section::new(
        "The paper's conclusions",
        "The four conclusions of section 4, with what all figures together say of them.",
    );
    existence(&mut section, grid);
    orders(&mut section, plane);
    choice(&mut section, grid, shares);
    amplitude(&mut section, grid);
    run.report.sections.push(section);
}

fn existence(section: &mut Section, grid: &Grid) {
    let kind = |test: &dyn Fn(u32, u32) -> bool| {
        let labels: Vec<String> = grid
            .labels()
            .into_iter()
            .filter(|(label, _)| looks::numbers(label).is_some_and(|(m, n)| test(m, n)))
            .map(|(label, _)| label)
            .collect();
        labels.len()
    };
    let (higher, fractional) = (kind(&|m, n| m > 1 && n == 1), kind(&|m, n| m == 1 && n > 1));
    let super_sub = kind(&|m, n| m > 1 && n > 1);
    section.claim(
        "(1)",
        "simulation shows that motions of higher order, fractional and super-sub motions exist, and depend on the start",
        format!(
            "on the grid of figure 4: {} m/1 with m > 1, {} 1/n with n > 1 and {} m/n with both above 1, each confirmed \
             by Newton's method and its multipliers",
            looks::count(higher, "label"),
            looks::count(fractional, "label"),
            looks::count(super_sub, "label"),
        ),
        Agreement::of(higher > 0 && fractional > 0 && super_sub > 0, higher > 0),
    );
}

fn orders(section: &mut Section, plane: &Plane) {
    let of: Vec<_> = (4..=6).filter_map(|m| plane.region(m, 1)).filter(|r| r.area > 0.0).collect();
    let falling = of.windows(2).all(|w| w[1].area < w[0].area && w[1].mean_gap < w[0].mean_gap);
    let told: Vec<String> = of
        .iter()
        .map(|r| format!("{}: {} at a mean delta of {:.3}", r.label, looks::percent(r.area), r.mean_gap))
        .collect();
    section.claim(
        "(2)",
        "steady motions of order four and more exist, the higher the order in the narrower a range of small delta",
        told.join("; "),
        Agreement::of(of.len() > 1 && falling, !of.is_empty()),
    );
}

fn choice(section: &mut Section, grid: &Grid, shares: &Shares) {
    let several =
        grid.points.iter().filter(|p| p.motions.iter().filter(|f| f.verdict.label() != "0").count() > 1).count();
    let told: Vec<String> =
        shares.at_s.iter().map(|(label, share)| format!("{label} from {}", looks::percent(*share))).collect();
    section.claim(
        "(3)",
        "where several stable motions with impacts are possible, the start alone decides which of them arises",
        format!(
            "{several} of {} points of the grid have two or more motions with impacts, among the starts tried; at S {}",
            grid.points.len(),
            looks::list(&told, 4)
        ),
        Agreement::of(several > 0 && shares.at_s.len() == 2, several > 0),
    );
}

fn amplitude(section: &mut Section, grid: &Grid) {
    let part = |below: bool| {
        let of = grid.points.iter().filter(|p| (p.gap < p.free) == below);
        let starts: Vec<_> = of.flat_map(|p| &p.starts).collect();
        let quiet = starts.iter().filter(|(label, _)| label == "0").count();
        (quiet, starts.len())
    };
    let (below, above) = (part(true), part(false));
    let elsewhere = grid.points.iter().any(|p| p.gap < p.free && p.kinds().1 && (p.inverse_beta - 2.0).abs() > 1e-9);
    section.claim(
        "(4)",
        "below the free amplitude |f| impacts follow from every start, in a steady motion that theory predicts or in some \
         other; above it they may not",
        format!(
            "below |f|, {} of {} starts end without impacts{}; above, {} of {}",
            below.0,
            below.1,
            match (below.0 > 0, elsewhere) {
                (true, false) => ", all of them on the line 1/beta = 2",
                (true, true) => ", not only on the line 1/beta = 2",
                (false, _) => "",
            },
            above.0,
            above.1
        ),
        Agreement::of(below.0 == 0 && above.0 > 0, !elsewhere),
    );
}
