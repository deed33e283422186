//! Tests of summaries as text: what is told apart, grouped and named.

use crate::{json, printed_in};

const MACHINE: &str = "--mass-kg 0.8 --stiffness-n-per-m 12000 --force-n 30 --damping-ratio 0.02 --restitution 0.65";
const CHAOTIC: &str = "--inverse-beta 1.11 --gap 3 --restitution 0.5";

/// Sum of the shares of a table of labels, whose last column is a share in per cent.
fn shares(rows: &[&str]) -> f64 {
    let share = |row: &&str| {
        let number = row.trim_end_matches(" %").split_whitespace().last();
        number.and_then(|text| text.parse::<f64>().ok()).expect("a share")
    };
    rows.iter().map(share).sum()
}

#[test]
fn many_labels_are_the_largest_dozen_and_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let line = "map --inverse-beta 0.4:1.2:40 --gap 0:1:10 --restitution 0.8 --starts 4";
    let all = json(line)["labels"].as_array().unwrap().clone();
    assert!(all.len() > 16, "{}", all.len());
    let undecided = all.iter().filter(|label| label["label"] == "undecided").count();
    for line in [line.to_owned(), format!("{line} --store map.zarr")] {
        let said = printed_in(&folder, &line);
        let rows: Vec<&str> = said.lines().filter(|row| row.ends_with(" %")).collect();
        assert!((13..=14).contains(&rows.len()), "{said}");
        let shown = rows.len() - 1;
        let others = rows.last().unwrap();
        assert!(others.contains(&format!("others ({} labels)", all.len() - shown)), "{said}");
        assert!(undecided == 0 || said.contains("  undecided "), "{said}");
        assert!((shares(&rows) - 100.0).abs() < 1.0, "{said}");
    }
    // a basin has a row for each motion
    let said = printed_in(&folder, "basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -1:0.5:4 --v 0:1:4");
    assert!(!said.contains("others ("), "{said}");
}

/// Summaries name what varies as the tables do.
#[test]
fn axes_in_si_units_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let said = printed_in(
        &folder,
        &format!("map {MACHINE} --frequency-hz 15:25:4 --gap-m 0.001:0.002:3 --starts 2 --store si.zarr"),
    );
    assert!(said.contains("over frequency_hz, gap_m\n12 points: 4 frequency_hz by 3 gap_m\n"), "{said}");
    let status = printed_in(&folder, "status si.zarr");
    assert!(status.lines().next().unwrap().ends_with("over frequency_hz, gap_m"), "{status}");
}

#[test]
fn a_typed_frequency_is_printed_as_typed() {
    let folder = tempfile::tempdir().unwrap();
    let line =
        format!("branch {MACHINE} --gap-m 0.0015 --frequency-hz 20 --label 1/1 --vary frequency-hz --to 20.3 --csv -");
    let said = printed_in(&folder, &line);
    let values: Vec<&str> = said.lines().skip(1).filter_map(|row| row.split(',').nth(1)).collect();
    assert_eq!((values[0], *values.last().unwrap()), ("20", "20.3"));
}

#[test]
fn what_is_not_settled_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = |gap: &str| {
        format!("diagram --inverse-beta 1.11 --restitution 0.5 --vary gap --over {gap}:{gap}:1 --direction up")
    };
    let chaotic = printed_in(&folder, &sweep("3"));
    assert!(chaotic.contains("1 motion did not repeat within the 64 impacts shown, after 500 impacts"), "{chaotic}");
    let settled = printed_in(&folder, &sweep("0.25"));
    assert!(!settled.contains("did not repeat"), "{settled}");
    let start = printed_in(&folder, &format!("settle {CHAOTIC} --impacts 50"));
    assert!(start.contains("followed for 50 impacts") && start.contains("; not settled by then\n"), "{start}");

    printed_in(&folder, &format!("attractors {CHAOTIC} --starts 4 --impacts 50 --store open.zarr"));
    let status = printed_in(&folder, "status open.zarr");
    assert!(status.contains("4 points with an undecided motion\n") && !status.contains("not computed"), "{status}");
    let status: serde_json::Value = serde_json::from_str(&printed_in(&folder, "status open.zarr --json")).unwrap();
    assert_eq!(status["points_undecided"], 4);
}

/// A refined store says how many of its points were computed themselves.
#[test]
fn points_that_were_not_computed_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let grid = "basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -1:0.5:33 --v 0:1:33";
    let said = printed_in(&folder, &format!("{grid} --refine 8 --store basin.zarr"));
    let own = said.lines().find_map(|line| line.strip_prefix("computed: ")).unwrap_or_else(|| panic!("{said}"));
    let own: u64 = own.split_whitespace().next().unwrap().parse().unwrap();
    assert!((25..33 * 33).contains(&own), "{said}");
    let table = printed_in(&folder, "export basin.zarr --csv -");
    let marked = table.lines().filter(|row| row.ends_with(",computed")).count() as u64;
    assert_eq!(marked, own + u64::from(table.lines().next().unwrap().ends_with(",computed")));
}
