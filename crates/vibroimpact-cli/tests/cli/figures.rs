//! Tests of the look of figures: title, size, resolution, limits and greys, the same for every command.

use crate::{Folder, S, has};

/// Width, height, and pixels in a metre, from the header of a PNG file.
fn sizes(png: &[u8]) -> (u32, u32, u32) {
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
    assert_eq!(&png[37..41], b"pHYs");
    (number(16), number(20), number(41))
}

#[test]
fn every_command_with_a_figure_has_the_options() {
    let folder = Folder::new();
    let machine = "--restitution 0.5 --inverse-beta 1.3";
    for line in [
        format!("simulate {S} --periods 4"),
        format!("settle {S}"),
        format!("lyapunov {S} --impacts 1000"),
        format!("branch {S} --label 1/1 --vary gap --to 1 --no-diagram"),
        "curve --inverse-beta 0.7 --gap 2 --restitution 0.5 --label 1/1 --kind fold --vary gap=0:4 --and inverse-beta=0.45:0.8".into(),
        "region --label 1/1 --inverse-beta 1.05:1.2 --gap 1:2.5 --restitution 0.5 --grid 4".into(),
        format!("response {machine} --gap 0.5:1:6"),
        format!("basin {S} --x -2:0.75:8 --v -2:2:8"),
        format!("map {machine} --gap 0.5:1:4 --starts 2"),
        format!("diagram {machine} --vary gap --over 0:1:5 --keep 8 --transient 50"),
    ] {
        let svg = folder.drawn(&format!("{line} --size 90x80mm --greyscale --title named"), "a.svg");
        has(&svg, &["width=\"90mm\" height=\"80mm\" viewBox=\"0 0 720 640\"", "<title>named</title>"]);
        let colours = svg.split("=\"#").skip(1).filter_map(|part| part.get(..6));
        let colours = colours.filter(|text| text.chars().all(|c| c.is_ascii_hexdigit()));
        for colour in colours {
            assert!(colour[..2] == colour[2..4] && colour[..2] == colour[4..], "{line}: #{colour}");
        }
    }
}

#[test]
fn titles_and_limits() {
    let folder = Folder::new();
    let line = format!("simulate {S} --periods 4");
    let of = |options: &str| folder.drawn(&format!("{line} {options}"), "a.svg");
    let usual = of("");
    has(&usual, &["<title>1/β = 1.3"]);
    has(&of("--title 5*3_a<b"), &["<title>5*3_a&lt;b</title>"]);
    let numbers = |svg: &str, value: &str| svg.contains(&format!(">{value}</text>"));
    let limited = of("--x-limits 100:200 --y-limits -7:7");
    assert!(numbers(&limited, "150") && numbers(&limited, "−5") && !numbers(&usual, "150"), "{limited}");
    assert_ne!(of("--greyscale"), usual);
    assert_eq!(of("--grayscale"), of("--greyscale"));
}

#[test]
fn a_picture_has_the_size_and_the_resolution_that_are_asked_for() {
    let folder = Folder::new();
    let line = format!("settle {S}");
    let of = |options: &str| {
        folder.printed(&format!("{line} {options} --force --plot a.png"));
        sizes(&folder.bytes("a.png"))
    };
    assert_eq!(of("--size 84x60mm --dpi 200"), (661, 472, 7874));
    assert_eq!(of("--size 3x2in"), (900, 600, 11_811));
    let (width, _, per_metre) = of("--dpi 600");
    // the figure is 125 mm wide
    assert_eq!((width, per_metre), (2953, 23_622));
}

#[test]
fn looks_that_are_refused() {
    let folder = Folder::new();
    for (options, sentence) in [
        ("--plot a.svg --size 84x60", "`84x60` is no size WxH with a unit"),
        ("--plot a.svg --size 84x10mm", "has no room for its axes and its legend"),
        ("--plot a.svg --dpi 300", "--dpi is for a figure with pixels"),
        ("--plot a.png --dpi 7", "dpi = 7 lies outside 50 <= dpi <= 2400"),
        ("--plot a.png --size 2000x2000mm --dpi 2400", "lies outside 1..=16384 on a side"),
        ("--plot a.svg --x-limits 3:3", "the two limits are equal"),
        ("--plot a.svg --x-limits 3", "`3` is not A:B with finite numbers"),
        ("--title words", "say how the figure looks\nhint: --plot FILE"),
    ] {
        let (code, _, said) = folder.ran(&format!("settle {S} {options}"));
        assert!(code.is_some_and(|code| code > 0), "{options}: {said}");
        has(&said, &[sentence]);
    }
    let log = "map --beta 0.5:2:3:log --gap 1 --restitution 0.5 --starts 1 --plot a.svg --x-limits 0:2";
    folder.refuse([(log, "--x-limits: 0 lies on no logarithmic axis")]);
    assert_eq!(folder.count(), 0, "nothing is left behind");
}
