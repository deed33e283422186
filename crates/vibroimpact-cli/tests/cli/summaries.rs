//! Tests of summaries as text: what is told apart, grouped and named.

use crate::{Folder, has, json, list};

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
    let folder = Folder::new();
    let line = "map --inverse-beta 0.4:1.2:40 --gap 0:1:10 --restitution 0.8 --starts 4";
    let answer = json(line);
    let all = list(&answer["labels"]);
    assert!(all.len() > 16, "{}", all.len());
    let undecided = all.iter().filter(|label| label["label"] == "undecided").count();
    for line in [line.to_owned(), format!("{line} --store map.zarr")] {
        let said = folder.printed(&line);
        let rows: Vec<&str> = said.lines().filter(|row| row.ends_with(" %")).collect();
        assert!((13..=14).contains(&rows.len()), "{said}");
        let shown = rows.len() - 1;
        let others = rows.last().unwrap();
        assert!(others.contains(&format!("others ({} labels)", all.len() - shown)), "{said}");
        assert!(undecided == 0 || said.contains("  undecided "), "{said}");
        assert!((shares(&rows) - 100.0).abs() < 1.0, "{said}");
    }
    // a basin has a row for each motion
    let said = folder.printed("basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -1:0.5:4 --v 0:1:4");
    assert!(!said.contains("others ("), "{said}");
}

/// Summaries name what varies as the tables do.
#[test]
fn axes_in_si_units_are_named() {
    let folder = Folder::new();
    let said = folder
        .printed(&format!("map {MACHINE} --frequency-hz 15:25:4 --gap-m 0.001:0.002:3 --starts 2 --store si.zarr"));
    has(&said, &["over frequency_hz, gap_m\n12 points: 4 frequency_hz by 3 gap_m\n"]);
    let status = folder.printed("status si.zarr");
    assert!(status.lines().next().unwrap().ends_with("over frequency_hz, gap_m"), "{status}");
}

#[test]
fn what_is_not_settled_is_said() {
    let folder = Folder::new();
    let sweep = |gap: &str| {
        format!("diagram --inverse-beta 1.11 --restitution 0.5 --vary gap --over {gap}:{gap}:1 --direction up")
    };
    let chaotic = folder.printed(&sweep("3"));
    has(&chaotic, &["1 motion did not repeat within the 64 impacts shown, after 500 impacts"]);
    let settled = folder.printed(&sweep("0.25"));
    assert!(!settled.contains("did not repeat"), "{settled}");
    let start = folder.printed(&format!("settle {CHAOTIC} --impacts 50"));
    has(&start, &["followed for 50 impacts", "; not settled by then\n"]);

    folder.printed(&format!("attractors {CHAOTIC} --starts 4 --impacts 50 --store open.zarr"));
    let status = folder.printed("status open.zarr");
    assert!(status.contains("4 points with an undecided motion\n") && !status.contains("not computed"), "{status}");
    assert_eq!(folder.json("status open.zarr")["points_undecided"], 4);
}

/// A refined store says how many of its points were computed themselves.
#[test]
fn points_that_were_not_computed_are_said() {
    let folder = Folder::new();
    let grid = "basin --inverse-beta 1.3 --gap 0.75 --restitution 0.5 --x -1:0.5:33 --v 0:1:33";
    let said = folder.printed(&format!("{grid} --refine 8 --store basin.zarr"));
    let own = said.lines().find_map(|line| line.strip_prefix("computed: ")).unwrap_or_else(|| panic!("{said}"));
    let own: u64 = own.split_whitespace().next().unwrap().parse().unwrap();
    assert!((25..33 * 33).contains(&own), "{said}");
    let table = folder.printed("export basin.zarr --csv -");
    let marked = table.lines().filter(|row| row.ends_with(",computed")).count() as u64;
    assert_eq!(marked, own + u64::from(table.lines().next().unwrap().ends_with(",computed")));
}
