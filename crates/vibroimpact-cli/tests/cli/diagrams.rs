//! Tests of the table of `vibro diagram`, row by row.

use crate::{Folder, has, json, printed, refuse};

/// The rows of a table, without the header.
fn table(line: &str) -> Vec<Vec<String>> {
    let text = printed(&format!("{line} --csv -"));
    text.lines().skip(1).map(|row| row.split(',').map(str::to_owned).collect()).collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().expect("a number")
}

/// Gaps around S of the 1971 paper: 2/1 in the sweep up, 1/1 in the sweep down, with the velocities of `orbit`.
/// With --branches the table has the rows of the diagram, then those of the branches with their events.
#[test]
fn branches_are_in_the_table_and_the_figure() {
    let line = "diagram --inverse-beta 1.11 --restitution 0.5 --vary gap --over 1.7:1.9:5 --transient 100 --keep 4";
    let (plain, rows) = (table(line), table(&format!("{line} --branches 1/1,2/2")));
    for (row, simulated) in rows.iter().zip(&plain) {
        assert_eq!(row[..6], simulated[..], "{row:?}");
        assert_eq!(row[6..], ["", ""]);
    }
    let branches = &rows[plain.len()..];
    assert!(branches.iter().all(|row| row[1].starts_with("branch ")));
    let flip = branches.iter().find(|row| row[6] == "1/1" && row[7] == "flip").expect("1/1 has a flip");
    assert!((number(&flip[0]) - 1.829).abs() < 1e-3 && flip[2] == "neutral", "{flip:?}");
    // without labels those found on the line are followed; the summary has the events
    has(&printed(&format!("{line} --branches")), &["flip of 1/1 at gap = 1.829"]);
    refuse([
        (format!("{line} --show power --branches"), "--branches has speeds or positions"),
        (format!("{line} --branches --json"), "cannot be used with"),
        (format!("{line} --branches 1/0"), "1/0"),
    ]);
}

#[test]
fn ends_have_a_row() {
    let rows = table("diagram --beta 2 --restitution 0.5 --vary gap --over 5:6:2 --direction down");
    assert_eq!(rows, [["6", "down", "none", "", "", ""], ["5", "down", "none", "", "", ""]]);
    let rows = table("diagram --beta 0.9 --restitution 0.5 --vary gap --over -1.5:-1.5:1 --direction up --transient 0");
    assert_eq!(rows, [["-1.5", "up", "stuck", "", "", ""]]);
    let rows = table("diagram --beta 0.9 --restitution 0.5 --vary gap --over -1.5:-1.5:1 --direction up --show strobe");
    assert_eq!(rows, [["-1.5", "up", "stuck", "-1.5", "0"]]);
    let rows = table("diagram --beta 0.9 --restitution 0.5 --vary gap --over -0.5:-0.5:1 --direction up");
    assert_eq!(rows.iter().filter(|row| row[2] == "chatter" && row[5] == "0").count(), 1);
    let rows = table("diagram --beta 0.5 --damping 0.2 --restitution 0.5 --vary gap --over 2:3:2 --show strobe");
    assert!(rows.len() == 4 && rows.iter().all(|row| row[2] == "none" && number(&row[3]) < 0.0));
}

/// A sweep down begins at the largest value.
#[test]
fn sweeps_and_starts_are_named() {
    let system = "diagram --inverse-beta 1.3 --restitution 0.5 --vary gap";
    let sweeps =
        |line: &str| -> Vec<String> { table(line).into_iter().map(|row| format!("{} {}", row[0], row[1])).collect() };
    assert_eq!(sweeps(&format!("{system} --over 1:1.5:2 --keep 1")), ["1 up", "1.5 up", "1.5 down", "1 down"]);
    assert_eq!(
        sweeps(&format!("{system} --over 1.5:1:2 --keep 1 --direction scatter --starts 2")),
        ["1.5 start 1", "1.5 start 2", "1 start 1", "1 start 2"]
    );
}

#[test]
fn a_summary_that_can_be_run_again() {
    let answer = json("diagram --beta 0.9 --gap 0.5 --restitution 0.5 --vary second-gap --over 0:1:5 --direction up");
    assert_eq!((&answer["vary"], &answer["units"]), (&"second_gap".into(), &"nondimensional".into()));
    assert_eq!((&answer["over"]["to"], &answer["over"]["count"]), (&1.0.into(), &5.into()));
    assert_eq!(answer["columns"][0], "second_gap");
    let sweep = &answer["sweeps"][0];
    assert_eq!((&sweep["sweep"], &sweep["motions"]), (&"up".into(), &5.into()));
    let task = &answer["plan"]["task"]["diagram"];
    assert_eq!((&task["direction"], &task["transient"], &task["keep"]), (&"up".into(), &500.into(), &64.into()));
    let scatter = json("diagram --beta 0.9 --restitution 0.5 --vary gap --over 0:1:3 --direction scatter");
    assert_eq!(scatter["plan"]["task"]["diagram"]["direction"]["scatter"]["starts"], 8);
    assert_eq!(scatter["sweeps"][0]["motions"], 24);
}

/// Values that are listed are those of a range, for oscillators and for machines; sweeps rise and fall through them.
#[test]
fn listed_values() {
    for line in [
        "diagram --inverse-beta 1.3 --restitution 0.5 --vary gap",
        "diagram --machine two-mass-hammer --vary stop.anvil.gap --transient 50",
        "diagram --gap 0 --restitution 0.8 --vary beta --direction scatter --starts 3 --show strobe",
        "diagram --mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --frequency-hz 4 --restitution 0.5 --gap-m 1 --vary gap-m",
    ] {
        let rows = table(&format!("{line} --over 0.5:1.5:5"));
        assert_eq!(table(&format!("{line} --over 0.5,0.75,1,1.25,1.5")), rows, "{line}");
        let answer = json(&format!("{line} --over 1.5,0.75,0.5"));
        let task = &answer["plan"]["task"]["diagram"];
        let list = serde_json::json!([1.5, 0.75, 0.5]);
        assert_eq!((&answer["over"], &task["over"]), (&list, &list), "{line}");
        let neither = "the values of a diagram rise or fall, and those of the list do neither\nhint: sort them";
        refuse([
            (format!("{line} --over 0.5,1.5,0.75"), neither),
            (format!("{line} --over 0.5,0.5"), "none of them twice, not 0.5"),
            (format!("{line} --over 0.5,x"), "`0.5,x` is no list of numbers"),
            (format!("{line} --over 0.5"), "range `0.5` is not A:B:N"),
        ]);
    }
    let rows = table("diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 2,0.6,0.5,0 --keep 1");
    let steps: Vec<String> = rows.iter().map(|row| format!("{} {}", row[0], row[1])).collect();
    assert_eq!(steps, ["0 up", "0.5 up", "0.6 up", "2 up", "2 down", "0.6 down", "0.5 down", "0 down"]);
}

/// The text names both numbers that vary; only branches of oscillators have inadmissible solutions to draw.
#[test]
fn both_numbers_of_a_machine_are_named() {
    let line = "diagram --machine two-mass-hammer --vary frequency --over 0.9:1:2 --also stop.anvil.gap=0.4:0.5 --transient 50";
    let said = printed(line);
    assert!(said.starts_with("2 values of frequency from 0.9 to 1, stop.anvil.gap from 0.4 to 0.5\n"), "{said}");
    let line = "branch --machine two-mass-hammer --vary frequency --to 1.01 --plot a.svg --virtual";
    has(&crate::refused(line), &["--virtual", "--machine"]);
}

/// The figure of a diagram over the gap.
fn drawn(line: &str) -> String {
    Folder::new().drawn(&format!("diagram --restitution 0.5 --vary gap {line}"), "a.svg")
}

/// Where the dots or cells of a figure begin, from left to right.
fn places(figure: &str) -> Vec<f64> {
    let path = figure.lines().find(|line| line.starts_with("<path d=\"M") && line.contains("#0072b2"));
    let path = path.expect("a path").split('"').nth(1).expect("its data");
    let place = |piece: &str| number(piece.split(' ').next().expect("a number"));
    let mut places: Vec<f64> = path.split('M').skip(1).map(place).collect();
    places.sort_by(f64::total_cmp);
    places
}

/// The dots of listed values are at their values.
#[test]
fn listed_values_are_drawn_at_their_places() {
    for over in ["0.2,0.3,1,2", "2,1,0.3,0.2"] {
        let xs = places(&drawn(&format!("--inverse-beta 1.11 --over {over} --direction up --keep 1")));
        let along = |k: usize| (xs[k] - xs[0]) / (xs[3] - xs[0]);
        assert!(xs.len() == 4 && (along(1) - 0.1 / 1.8).abs() < 1e-3 && (along(2) - 0.8 / 1.8).abs() < 1e-3, "{xs:?}");
    }
}

/// With logarithmic values the distances on the page are equal, both for dots and for the cells of a raster.
#[test]
fn a_logarithmic_span_has_a_logarithmic_axis() {
    for over in ["0.02:2:5:log", "2:0.02:5:log"] {
        let xs = places(&drawn(&format!("--inverse-beta 1.11 --over {over} --direction up --keep 1")));
        assert!(
            xs.len() == 5 && xs.windows(2).all(|pair| (pair[1] - pair[0] - (xs[4] - xs[0]) / 4.0).abs() < 0.02),
            "{xs:?}"
        );
    }
    // mostly chaos, with so many dots that a raster is drawn: no column is narrower than another
    let figure = drawn("--inverse-beta 1.11 --over 2.2:4.4:700:log --direction up --keep 900 --transient 100");
    assert!(figure.contains("crispEdges"), "still dots");
    let mut xs = places(&figure);
    xs.dedup();
    let column = (xs[xs.len() - 1] - xs[0]) / 699.0;
    let narrowest = xs.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::MAX, f64::min);
    assert!(column > 0.5 && narrowest > 0.9 * column, "{narrowest} {column}");
}

/// Along a line through two parameters there is a second column.
#[test]
fn a_line_through_two_parameters() {
    let line = "diagram --restitution 0.5 --direction scatter --starts 3 --over 1.2:1.4:3 --vary inverse-beta";
    let rows = table(&format!("{line} --also gap=1:0.5"));
    assert!(rows.iter().all(|row| row.len() == 7));
    for (inverse, gap) in [("1.2", "1"), ("1.3", "0.75"), ("1.4", "0.5")] {
        let here: Vec<_> = rows.iter().filter(|row| row[0] == inverse).collect();
        assert!(!here.is_empty() && here.iter().all(|row| row[1] == gap), "{inverse}: {rows:?}");
    }
    let answer = json(&format!("{line} --also gap=1:0.5"));
    assert_eq!(answer["also"], serde_json::json!({ "parameter": "gap", "from": 1.0, "to": 0.5 }));
    assert_eq!(answer["columns"][1], "gap");
    // the same in metres, by both names
    let machine = "diagram --mass-kg 2 --stiffness-n-per-m 8000 --force-n 40 --frequency-hz 10 --gap-m 0.004 \
                   --restitution 0.7 --units si --vary damping --over 0.01:0.02:2 --also gap-m=0.004:0.005";
    assert_eq!(table(machine), table(&machine.replace("gap-m=", "gap=")));
    refuse([(machine.replace("gap-m=", "gap_m="), "does not begin with PARAMETER=; parameters: beta")]);
    let rows = table(&machine.replace("gap-m=", "gap="));
    let pairs: Vec<(&str, &str)> = rows.iter().map(|row| (row[0].as_str(), row[1].as_str())).collect();
    assert!(pairs.iter().all(|pair| [("0.01", "0.004"), ("0.02", "0.005")].contains(pair)), "{pairs:?}");
}

/// One value of each motion, in the units of the question.
#[test]
fn a_quantity_of_the_settled_motion() {
    let line = "diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 0.5:1:3 --show impact-speed-max";
    let table = printed(&format!("{line} --csv -"));
    let rows = crate::rows(&table);
    assert_eq!(rows[0], ["gap", "sweep", "kind", "impact_speed_max"]);
    assert_eq!(rows.len(), 1 + 2 * 3, "{table}");
    let machine = "diagram --mass-kg 2 --stiffness-n-per-m 800 --force-n 4 --frequency-hz 2.5 --gap-m 0.003 --restitution 0.6 \
                   --units si --vary gap --over 0.001:0.3:4 --show";
    let empty = printed(&format!("{machine} impact_speed_mean --direction down --csv -"));
    assert!(empty.starts_with("gap_m,sweep,kind,impact_speed_mean_m_per_s\n"), "{empty}");
    assert!(empty.lines().any(|row| row == "0.3,down,none,"), "no impacts have no mean speed: {empty}");
    let folder = Folder::new();
    has(&folder.drawn(&format!("{machine} impact-speed-max"), "a.svg"), &["largest impact speed (m/s)"]);
    let no_store = "a diagram of a quantity is computed in memory, and has no store";
    let everything = line.replace("impact-speed-max", "everything");
    folder.refuse([
        (format!("{line} --store a.zarr"), no_store),
        (everything, "`everything` is no quantity; there are impact-speed-max"),
    ]);
    // a plan in a file is refused too
    let plan = r#"{"version":1,"system":{"inverse_beta":1.3,"gap":0,"restitution":0.5},"task":{"diagram":{"vary":"gap","over":"0:1:3","show":{"quantity":"power"}}}}"#;
    folder.write("plan.json", plan);
    folder.refuse([("run plan.json", "has no store")]);
}
