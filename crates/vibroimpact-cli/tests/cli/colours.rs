//! Tests of `--colour`: maps and basins in the colours of a quantity, and of maps over one axis.

use crate::{printed_in, refused, refused_in};
use std::path::Path;

const MAP: &str = "map --inverse-beta 1.2:1.4:5 --gap 0.5:1:4 --restitution 0.5 --starts 8";
const LINE: &str = "map --inverse-beta 1.3 --gap 0.5:3:11 --restitution 0.5 --starts 8";
const BASIN: &str = "basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -2:0.75:12 --v -2:2:9";
/// A system in physical units: omega_n = 20 rad/s, F/k = 0.005 m.
const MACHINE: &str = "--mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --gap-m 0.001:0.004:4 --restitution 0.6";

fn drawn(folder: &Path, line: &str) -> String {
    printed_in(folder, &format!("{line} --force --plot figure.svg"));
    std::fs::read_to_string(folder.join("figure.svg")).expect("the figure")
}

/// A store gives the figure of the result in memory, and says what it lacks.
#[test]
fn a_store_has_the_same_figure() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for (k, line) in [
        format!("{MAP} --colour impact-speed-max"),
        format!("{MAP} --fields power,impact-speed-max --colour impact_speed_max --of smallest"),
        format!("{LINE} --colour impact-power"),
        format!("{BASIN} --colour impact-speed-max --colour-range 0:2"),
        format!("map {MACHINE} --frequency-hz 2.5:3:3 --starts 4 --color impulse-max --of worst"),
        format!("map {MACHINE} --frequency-hz 2.7 --starts 4 --colour impact-loss-per-period"),
        "map --machine two-mass-hammer --axis frequency=0.9:1.3:4 --axis stop.anvil.gap=0.5:1:3 --starts 2 --colour stop.anvil.impact-speed-max".to_owned(),
        "map --machine two-mass-hammer --axis frequency=0.9:1.3:4 --starts 2 --fields power --colour power".to_owned(),
    ]
    .iter()
    .enumerate()
    {
        let memory = drawn(folder, line);
        assert_eq!(drawn(folder, &format!("{line} --store s{k}.zarr")), memory, "{line}");
        let colour = &line[line.find(" --colo").expect("colours")..];
        printed_in(folder, &format!("plot s{k}.zarr again.svg --force {colour}"));
        assert_eq!(std::fs::read_to_string(folder.join("again.svg")).expect("the figure"), memory, "{line}");
    }
    let said = refused_in(folder, "plot s3.zarr b.svg --colour power");
    assert!(said.contains("there are no values of `power`: the plan asks for impact-speed-max"), "{said}");
    printed_in(folder, "diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0:1:3 --store d.zarr");
    let said = refused_in(folder, "plot d.zarr d.svg --colour power");
    assert!(said.contains("only maps and basins have colours by a quantity"), "{said}");
}

#[test]
fn the_bar_says_what_is_shown_in_which_unit() {
    let folder = tempfile::tempdir().expect("a folder");
    let of = |line: &str| drawn(folder.path(), line);
    let svg = of(&format!("{MAP} --colour impact-speed-max"));
    for text in ["largest impact speed<", "<linearGradient", "where motions coexist: the largest value<"] {
        assert!(svg.contains(text), "{text}: {svg}");
    }
    let given = of(&format!("{MAP} --colour impact-speed-max --colour-range -3:7"));
    // the ends of the bar are ticks
    assert!(given.contains(">6<") && !svg.contains(">6<"), "{given}");
    let smallest = of(&format!("{MAP} --colour impact-speed-max --of least"));
    assert!(smallest.contains("the smallest value<") && smallest != svg);
    let likeliest = of(&format!("{MAP} --colour impact-speed-max --of likeliest"));
    assert!(likeliest.contains("the most frequent motion<"));
    let si = of(&format!("map {MACHINE} --frequency-hz 2.5:3:3 --starts 4 --colour impact-speed-max"));
    assert!(si.contains("largest impact speed (m/s)<"), "{si}");
    let pure = of(&format!("map {MACHINE} --frequency-hz 2.5:3:3 --starts 4 --colour sticking-fraction"));
    assert!(pure.contains("part of the time on a stop<"), "{pure}");
    // one impact is not enough to settle anything
    let none = of(&format!("{MAP} --impacts 1 --colour impact-speed-max"));
    assert!(none.contains("undecided<") && !none.contains("<linearGradient"), "{none}");
    let log = of("map --beta 0.5:2:3:log --gap 0,0.5,2 --restitution 0.5 --starts 2 --colour displacement-max");
    assert!(log.contains("<linearGradient") && !log.contains("<image"));
}

#[test]
fn a_map_over_one_axis_has_shares_or_dots() {
    let folder = tempfile::tempdir().expect("a folder");
    let shares = drawn(folder.path(), LINE);
    for text in ["share of starts<", "1/1<", "2/1<"] {
        assert!(shares.contains(text), "{text}: {shares}");
    }
    assert_eq!(drawn(folder.path(), &format!("{LINE} --store line.zarr")), shares);
    let dots = drawn(folder.path(), &format!("{LINE} --colour impact-speed-max"));
    assert!(dots.contains("largest impact speed<") && !dots.contains("<linearGradient"), "{dots}");
}

#[test]
fn what_is_refused() {
    for (line, sentence) in [
        (format!("{MAP} --colour speed --plot a.svg"), "`speed` is no quantity; there are impact-speed-max"),
        (format!("{MAP} --colour power"), "--colour says what the figure shows\nhint: --plot FILE"),
        (format!("{MAP} --colour-range 0:1 --plot a.svg"), "--colour-range says which values the colours have"),
        (
            format!("{MAP} --colour power --colour-range 2:1 --plot a.svg"),
            "--colour-range 2:1 is not LOW:HIGH with LOW < HIGH",
        ),
        (format!("{MAP} --of worst --plot a.svg"), "--of says which motion has the colour"),
        (format!("{LINE} --gap 1:2:2 --plot a.svg"), "cannot be used multiple times"),
        (
            "map --inverse-beta 1:2:2 --gap 1:2:2 --restitution 0.5:0.6:2 --starts 1 --plot a.svg".into(),
            "two axes, not 3",
        ),
    ] {
        let said = refused(&line);
        assert!(said.contains(sentence), "{line}: {said}");
    }
}
