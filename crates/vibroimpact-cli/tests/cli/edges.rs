//! Special cases of the interface: exact ends of ranges, `-` for stdout, empty places, and counts in texts.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::{Folder, S, has, json, list, number};

/// Exit code, stdout and stderr.
fn ran(line: &str) -> (Option<i32>, String, String) {
    let folder = Folder::new();
    let ended = folder.ran(line);
    assert!(!folder.at("-").exists(), "{line} made a file or folder named -");
    ended
}

fn refused(line: &str, sentence: &str) {
    let (code, out, complaint) = ran(line);
    assert_eq!(code, Some(2), "{line}: {complaint}");
    assert!(complaint.contains(sentence) && out.is_empty(), "{line}: {complaint}");
}

/// The distinct values of the first column of a table.
fn first_column(line: &str) -> Vec<String> {
    let (code, out, complaint) = ran(line);
    assert_eq!(code, Some(0), "{line}: {complaint}");
    let mut cells: Vec<String> = out.lines().skip(1).map(|row| row.split(',').next().unwrap().to_owned()).collect();
    cells.dedup();
    cells
}

#[test]
fn f07_a_range_begins_at_its_first_value() {
    let (code, ..) =
        ran("basin --beta 0.8 --gap 0.7 --second-gap 0.4 --restitution 0.5 --x=-0.4:0.7:13 --v=-1:1:3 --impacts 50");
    assert_eq!(code, Some(0));
}

#[test]
fn f07b_the_same_values_with_and_without_a_store() {
    let map = "map --inverse-beta 0.4:2:13 --gap 0.5 --restitution 0.5 --starts 1 --impacts 50";
    let plain = first_column(&format!("{map} --csv -"));
    assert_eq!((plain.len(), plain[0].as_str(), plain[6].as_str(), plain[12].as_str()), (13, "0.4", "1.2", "2"));
    assert_eq!(first_column(&format!("{map} --store s.zarr --csv -")), plain);
    let diagram = "diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over=-0.1:0.3:5 --direction up --keep 2";
    assert_eq!(first_column(&format!("{diagram} --csv -")), ["-0.1", "0", "0.1", "0.2", "0.3"]);
    assert_eq!(first_column(&format!("{diagram} --store s.zarr --csv -")), ["-0.1", "0", "0.1", "0.2", "0.3"]);
    let decades = "map --beta 0.01:100:5:log --gap 0.5 --restitution 0.5 --starts 1 --impacts 50 --csv -";
    assert_eq!(first_column(decades), ["0.01", "0.1", "1", "10", "100"]);
}

#[test]
fn f10b_a_dash_is_stdout() {
    let (code, out, _) = ran(&format!("simulate {S} --impacts 3 --csv -"));
    assert!(code == Some(0) && out.starts_with("time,x,v,phase\n0,0,0,0\n") && !out.contains("end "), "{out}");
    refused(&format!("simulate {S} --csv - --json"), "both want stdout");
    refused(&format!("simulate {S} --plot -"), "a figure cannot go to stdout");
    for name in ["basin --x -1:0.5:2 --v 0:1:2", "attractors --starts 2"] {
        refused(&format!("{name} {S} --store -"), "a store is a folder");
    }
    refused("status -", "a store is a folder");
    refused("reproduce --quick --out -", "--out names a folder");
}

/// All missing tiles are counted: a store of 2000 tiles of which a part has filled 10.
#[test]
fn f10c_missing_tiles_are_counted() {
    let folder = Folder::new();
    let plan = "version = 1\ntile = 1\nsystem = { inverse_beta = 1.3, gap = 0.75, restitution = 0.5 }\n\
                [task.attractors]\nstarts = 2000\nseed = 1\n";
    folder.write("p.toml", plan);
    folder.printed("run p.toml --store s.zarr --tiles 1/200 --quiet");
    let told = folder.json("status s.zarr");
    assert_eq!((list(&told["missing"]).len(), &told["missing_left_out"]), (1000, &990.into()), "{told}");
    has(&folder.printed("status s.zarr"), &["missing tiles: 1 to 199, 201 to 399,", " more\n"]);
}

#[test]
fn f11_places_that_take_no_files() {
    #[cfg(target_os = "linux")]
    {
        refused(&format!("settle {S} --plot /proc/foo.png"), "the directory `/proc` takes no files");
        let store = format!("basin {S} --x -1:0.5:2 --v 0:1:2 --store /proc/foo.zarr");
        let (code, _, complaint) = ran(&store);
        assert!(code == Some(1) && complaint.contains("the store /proc/foo.zarr cannot be begun"), "{complaint}");
        assert!(!complaint.contains("finished"), "nothing is kept of a store that was never begun: {complaint}");
    }
    refused(&format!("settle {S} --plot nowhere/foo.png"), "there is no directory `nowhere`");
}

#[test]
fn f11b_whole_numbers_with_an_exponent() {
    assert_eq!(json(&format!("attractors {S} --starts 1e2"))["starts"], 100);
    refused(&format!("attractors {S} --starts 1e-2"), "is not a whole number, such as 1000 or 1e3");
    refused(&format!("attractors {S} --starts 2e9"), "starts = 2000000000 lies outside");
    refused(&format!("branch {S} --label 2/1 --vary gap --to 1 --follow 1e3"), "follow = 1000 lies outside");
}

#[test]
fn f11c_all_that_is_missing_is_named() {
    let all = "the frequency ratio, the gap and the restitution are not given";
    let hint = "hint: --beta B or --inverse-beta X, --gap D, --restitution E";
    for (line, sentence) in [
        ("settle", &*format!("{all}\n{hint}")),
        ("settle --beta 1", "the gap and the restitution are not given"),
        ("settle --gap 1 --restitution 0.5", "the frequency is given nowhere"),
        ("map --starts 3 --beta 1 --gap 0:5 --restitution 0.5", "0:5:41 is 41 values from 0 to 5"),
    ] {
        refused(line, sentence);
    }
    Folder::with("p.toml", "version = 1\n[task.attractors]\nstarts = 5\nseed = 1\n")
        .refuse([("run p.toml", "beta or inverse_beta, gap, restitution")]);
}

#[test]
fn f11d_one_of_a_kind_is_no_plural() {
    let folder = Folder::new();
    let (_, _, filled) = folder.ran(&format!("basin {S} --x -1:0.5:4 --v 0:1:4 --store s.zarr"));
    has(&filled, &["1 of 1 tile computed"]);
    // damage one chunk
    assert!(folder.at("s.zarr/label/c/0/0").exists());
    folder.write("s.zarr/label/c/0/0", b"damaged");
    let (code, _, complaint) = folder.ran("verify s.zarr");
    assert_eq!(code, Some(1));
    has(&complaint, &["error: 1 fault in s.zarr"]);
    has(&folder.printed("status s.zarr"), &["1 of 1 tile, 16 of 16 points"]);
    let (_, one, _) = ran("diagram --inverse-beta 1.3 --restitution 0.5 --vary gap --over 1:1:1");
    assert!(one.starts_with("1 value of gap"), "{one}");
}

#[test]
fn f10_phases_that_are_no_angles_are_refused() {
    for phase in ["1e18", "-1e18", "1.1e15", "1e300"] {
        for line in [
            format!("settle {S} --phase={phase}"),
            format!("simulate {S} --phase={phase}"),
            format!("lyapunov {S} --phase={phase}"),
            format!("basin {S} --x -1:0.5:2 --v 0:1:2 --phase={phase}"),
        ] {
            refused(&line, "lies outside -1e15 <= phase <= 1e15");
        }
    }
    let start = number(&json(&format!("simulate {S} --phase 1e15 --impacts 1"))["start"]["phase"]);
    assert!((start - 2.109_698_117_070_112_6).abs() < 1e-15);
}
