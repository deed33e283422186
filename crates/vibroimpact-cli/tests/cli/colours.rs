//! Tests of `--colour`: maps and basins in the colours of a quantity, and of maps over one axis.

use crate::{Folder, has, refuse};

const MAP: &str = "map --inverse-beta 1.2:1.4:5 --gap 0.5:1:4 --restitution 0.5 --starts 8";
const LINE: &str = "map --inverse-beta 1.3 --gap 0.5:3:11 --restitution 0.5 --starts 8";
const BASIN: &str = "basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -2:0.75:12 --v -2:2:9";
/// A system in physical units: omega_n = 20 rad/s, F/k = 0.005 m.
const MACHINE: &str = "--mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --gap-m 0.001:0.004:4 --restitution 0.6";

/// A store gives the figure of the result in memory, and says what it lacks.
#[test]
fn a_store_has_the_same_figure() {
    let folder = Folder::new();
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
        let memory = folder.drawn(line, "a.svg");
        assert_eq!(folder.drawn(&format!("{line} --store s{k}.zarr"), "a.svg"), memory, "{line}");
        let colour = &line[line.find(" --colo").expect("colours")..];
        folder.printed(&format!("plot s{k}.zarr again.svg --force {colour}"));
        assert_eq!(folder.read("again.svg"), memory, "{line}");
    }
    folder.printed("diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0:1:3 --store d.zarr");
    let none = "there are no values of `power`: the plan asks for impact-speed-max";
    folder.refuse([
        ("plot s3.zarr b.svg --colour power", none),
        ("plot d.zarr d.svg --colour power", "only maps and basins have colours by a quantity"),
    ]);
}

#[test]
fn the_bar_says_what_is_shown_in_which_unit() {
    let folder = Folder::new();
    let of = |line: &str| folder.drawn(line, "a.svg");
    let svg = of(&format!("{MAP} --colour impact-speed-max"));
    has(&svg, &["largest impact speed<", "<linearGradient", "where motions coexist: the largest value<"]);
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
    let folder = Folder::new();
    let shares = folder.drawn(LINE, "a.svg");
    has(&shares, &["share of starts<", "1/1<", "2/1<"]);
    assert_eq!(folder.drawn(&format!("{LINE} --store line.zarr"), "a.svg"), shares);
    let dots = folder.drawn(&format!("{LINE} --colour impact-speed-max"), "a.svg");
    assert!(dots.contains("largest impact speed<") && !dots.contains("<linearGradient"), "{dots}");
}

#[test]
fn what_is_refused() {
    let falling = "--colour-range 2:1 is not LOW:HIGH with LOW < HIGH";
    let map = |flags: &str| format!("{MAP} {flags} --plot a.svg");
    let three = "map --inverse-beta 1:2:2 --gap 1:2:2 --restitution 0.5:0.6:2 --starts 1 --plot a.svg";
    refuse([
        (map("--colour speed"), "`speed` is no quantity; there are impact-speed-max"),
        (format!("{MAP} --colour power"), "--colour says what the figure shows\nhint: --plot FILE"),
        (map("--colour-range 0:1"), "--colour-range says which values the colours have"),
        (map("--colour power --colour-range 2:1"), falling),
        (map("--of worst"), "--of says which motion has the colour"),
        (format!("{LINE} --gap 1:2:2 --plot a.svg"), "cannot be used multiple times"),
        (three.to_owned(), "two axes, not 3"),
    ]);
}
