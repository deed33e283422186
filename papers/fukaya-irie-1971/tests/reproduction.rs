//! Tests of a quick reproduction: all files, all rows, the same bytes for any number of threads, and stopping.

use fukaya_irie_1971::{Report, ReproductionOptions, reproduce};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use vibroimpact_study::Control;

const QUICK: ReproductionOptions = ReproductionOptions { quick: true, force: false };

fn run(out: &Path, threads: usize) -> Report {
    let control = Control { threads, ..Control::default() };
    reproduce(out, &QUICK, &control, &|_, _| {}).expect("a quick reproduction succeeds")
}

/// Name and bytes of every file.
fn files(dir: &Path) -> BTreeMap<String, Vec<u8>> {
    std::fs::read_dir(dir)
        .expect("the folder was made")
        .map(|entry| {
            let path = entry.expect("it can be read").path();
            let name = path.file_name().expect("files have names").to_string_lossy().into_owned();
            (name, std::fs::read(&path).expect("it can be read"))
        })
        .collect()
}

#[test]
fn files_and_rows_are_complete_for_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let report = run(&out, 1);
    let written = files(&out);
    // a second run into the same folder, whose files it has to write again
    for name in written.keys().filter(|name| name.starts_with("figure-")) {
        std::fs::remove_file(out.join(name)).unwrap();
    }
    assert_eq!(report, run(&out, 2));
    assert_eq!(files(&out), written);

    for figure in ["02", "04", "04-below-zero", "05", "06", "07", "08", "09", "10", "11"] {
        for end in ["svg", "png", "csv"] {
            let name = format!("figure-{figure}.{end}");
            assert!(written.get(&name).is_some_and(|bytes| bytes.len() > 300), "{name}");
        }
    }
    for name in ["figure-04-curves.csv", "figure-04-points.csv", "figure-04-search.csv", "report.html"] {
        assert!(written.contains_key(name), "{name}");
    }
    for figure in ["1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "(1)", "(2)", "(3)", "(4)"] {
        assert!(report.claims().any(|claim| claim.figure == figure), "{figure}");
    }
    for claim in report.claims() {
        let text = format!("{} {}", claim.says, claim.found);
        assert!(!text.contains("NaN") && !text.contains("inf "), "{text}");
    }

    let page = String::from_utf8(written["report.html"].clone()).unwrap();
    assert_eq!(page.matches("<svg").count(), 10);
    assert_eq!(page.matches("class=\"says\"").count(), report.claims().count());
    for outside in ["src=\"http", "href=\"http", "url(http", "@import", "<script"] {
        let allowed = page.matches("href=\"https://hdl.handle.net/2115/41063\"").count();
        let expected = if outside == "href=\"http" { allowed } else { 0 };
        assert_eq!(page.matches(outside).count(), expected, "{outside}");
    }
    for claim in report.claims() {
        if ["1", "2", "5", "6", "7", "8", "9"].contains(&claim.figure) {
            assert_eq!(claim.verdict.word(), "agrees", "{claim:?}");
        }
    }
    let [agree, _, differ] = report.counts();
    assert!(agree > 3 * differ, "{}", report.table());
    let table = report.table();
    assert!(table.lines().all(|line| line.chars().count() <= 110));
}

#[test]
fn a_stop_stops_and_foreign_folders_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let stop = AtomicBool::new(true);
    let control = Control { stop: &stop, ..Control::default() };
    let out = dir.path().join("out");
    let stopped = reproduce(&out, &QUICK, &control, &|_, _| {}).unwrap_err();
    assert!(stopped.is_stopped() && !stopped.is_bad_question());
    std::fs::write(dir.path().join("notes.txt"), "mine").unwrap();
    let refused = reproduce(dir.path(), &QUICK, &control, &|_, _| {}).unwrap_err();
    assert!(refused.is_bad_question() && refused.to_string().contains("hint:"));
}
