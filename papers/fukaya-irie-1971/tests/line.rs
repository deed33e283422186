//! Computes the table of `docs/orbits.md` again.

use fukaya_irie_1971::line;
use std::path::Path;

#[test]
fn the_document_says_what_is_computed() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/orbits.md");
    let document = std::fs::read_to_string(page).expect("the document is part of the repository");
    let anew = line::table_in(&document).expect("the branches are followed");
    let differ: Vec<_> = document.lines().zip(anew.lines()).filter(|(old, new)| old != new).collect();
    assert!(document == anew, "run `cargo xtask line`; these lines differ: {differ:#?}");
    // the main results of the study, as rows of the table
    for row in [
        "1.829006189684 | flip | 1/1, 2/2 ",
        "1.831961666269 | grazing | 1/2, 2/2 ",
        "2.881420240512 | flip | 1/2, 2/4 ",
    ] {
        assert!(anew.contains(row), "{row}");
    }
    assert!(!anew.contains("| no |"), "simulation contradicts an event");
}

#[test]
fn a_document_without_the_markers_is_refused() {
    assert!(line::table_in("# Orbits").is_err());
}
