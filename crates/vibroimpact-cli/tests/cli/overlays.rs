//! Tests of `--layers`, `--mark` and `--line`: the figure that the page of the explorer exports, with what lies over the map,
//! is that of the command which the page shows.

use crate::{Folder, has, printed, refuse};
use axum::body::{Body, to_bytes};
use axum::http::{Request, header};
use serde_json::Value;
use tower::ServiceExt;
use vibroimpact_web::{Explorer, app};

const PORT: u16 = 8412;
const MAP: &str = "map --inverse-beta 1:1.5:6 --gap 0.5:2.5:5 --restitution 0.5 --starts 2 --impacts 200";
const PLAIN: &str = r#"{"version":1,"system":{"inverse_beta":1.3,"gap":0.75,"restitution":0.5},"task":{"map":{"axes":[{"vary":"inverse_beta","over":"1:1.5:6"},{"vary":"gap","over":"0.5:2.5:5"}],"starts":2,"seed":1,"impacts":200FIELDS}}}"#;
/// omega_n = 20 rad/s, F/k = 0.005 m.
const MACHINE: &str = r#"{"version":1,"system":{"machine":{"mass_kg":2,"stiffness_n_per_m":800,"force_n":4,"restitution":0.5,"frequency_hz":2.5,"gap_m":0.004}},"task":{"map":{"axes":[{"vary":"frequency_hz","over":"2:3:5"},{"vary":"gap_m","over":"0.002:0.015:5"}],"starts":1,"seed":1,"impacts":200}}}"#;

/// The answer of the page to a plan.
fn ask(path: &str, plan: &str) -> Vec<u8> {
    let request = Request::post(path)
        .header(header::HOST, format!("127.0.0.1:{PORT}"))
        .header(header::CONTENT_TYPE, "application/json")
        .body(Body::from(plan.to_owned()))
        .expect("a request");
    let body = async {
        let response = app(Explorer::new(PORT, 0)).oneshot(request).await.expect("an answer");
        let status = response.status();
        let body = to_bytes(response.into_body(), usize::MAX).await.expect("a body").to_vec();
        assert_eq!(status, 200, "{path}: {}", String::from_utf8_lossy(&body));
        body
    };
    tokio::runtime::Runtime::new().expect("a runtime").block_on(body)
}

fn drawn(folder: &Folder, line: &str) -> String {
    folder.printed(&format!("{line} --force"));
    let file = line.split_whitespace().find(|word| word.ends_with(".svg")).expect("a figure");
    folder.read(file)
}

/// Each overlay alone and all together; the flags of the command, and parts of the figure that are there only with them.
#[test]
fn the_export_of_the_page_is_the_figure_of_its_command() {
    let folder = Folder::new();
    let plain = PLAIN.replace("FIELDS", "");
    let fields = PLAIN.replace("FIELDS", r#","fields":["power"]"#);
    let bare = String::from_utf8(ask("/api/figure", &plain)).expect("a figure");
    for (query, plan, flags, parts) in [
        ("layers=stripes", &plain, "", &[][..]),
        ("layers=", &plain, "--layers none", &[]),
        ("mark=1.3,1", &plain, "--mark 1.3,1", &[]),
        ("layers=stripes&line=1.1,1.5,1.1,2.5", &plain, "--line 1.1,1.5:1.1,2.5", &["#b5221b"]),
        // what cannot be seen is in neither
        ("layers=stripes&mark=1.3,4&line=0.1,1,0.2,3", &plain, "", &[]),
        (
            "layers=paper,stripes,regions,amplitude,boundaries&mark=1.3,1&line=0.5,-1,1.1,2.5",
            &plain,
            "--layers regions,amplitude,paper,stripes,boundaries --mark 1.3,1 --line 0.5,-1:1.1,2.5",
            &[r##"stroke="#ffffff" stroke-width="3.6""##, "#b5221b", "#8c1d18", ">T<"],
        ),
        (
            "layers=paper,stripes&mark=1.3,1&colour=power",
            &fields,
            "--colour power --layers paper --mark 1.3,1",
            &[">T<"],
        ),
        ("layers=stripes&colour=power", &fields, "--colour power", &[]),
        (
            "layers=paper,stripes,regions,amplitude&mark=2.4,0.005&line=2.2,0.003,2.8,0.01",
            &MACHINE.to_owned(),
            "--layers regions,amplitude,paper,stripes --mark 2.4,0.005 --line 2.2,0.003:2.8,0.01",
            &[">S<"],
        ),
    ] {
        let told: Value = serde_json::from_slice(&ask(&format!("/api/command?{query}"), plan)).expect("an object");
        let command = told["figure"].as_str().expect("a command").strip_prefix("vibro ").expect("of vibro");
        let end = format!("{flags} --plot map.svg");
        assert!(command.ends_with(end.trim_start()) && command.matches("--").count() < 20, "{command}");
        assert_eq!(command.contains("--layers"), flags.contains("--layers"), "{command}");
        let figure = String::from_utf8(ask(&format!("/api/figure?{query}"), plan)).expect("a figure");
        assert!(drawn(&folder, command) == figure, "{query}");
        assert!(parts.iter().all(|part| figure.contains(part) && !bare.contains(part)), "{query}");
        if plan == &plain && !flags.is_empty() && query != "layers=" {
            assert!(figure != bare, "{query}");
        }
    }
}

/// A store has the figure of the result in memory.
#[test]
fn a_store_has_the_same_layers() {
    let folder = Folder::new();
    let over = "--layers paper,boundaries,amplitude --mark 1.3,1 --line 1.1,1.5:1.1,2.5";
    let memory = drawn(&folder, &format!("{MAP} {over} --plot map.svg"));
    assert_eq!(drawn(&folder, &format!("{MAP} {over} --plot map.svg --store s.zarr")), memory);
    assert_eq!(drawn(&folder, &format!("plot s.zarr again.svg {over}")), memory);
}

#[test]
fn what_is_refused() {
    let over = |flags: &str| format!("{MAP} --plot a.svg {flags}");
    let quantity = "the layer boundaries shows motions, and the figure shows a quantity";
    let without_gap = "map --beta 0.5:2:3 --restitution 0.4:0.6:3 --gap 1 --starts 1 --plot a.svg --layers amplitude";
    let machine = "map --machine two-mass-hammer --axis frequency=0.9:1.3:4 --starts 2 --plot a.svg --mark 1,1";
    refuse([
        (format!("{MAP} --mark 1.3,1"), "--layers, --mark and --line say what the figure shows\nhint: --plot FILE"),
        (over("--mark 1.3"), "`1.3` is not X,Y with finite numbers"),
        (over("--line 1,2:1,2"), "its two ends are the same point"),
        (over("--layers lines"), "possible values: regions, amplitude, paper, stripes, boundaries"),
        (over("--layers none,paper"), "--layers none stands alone"),
        (over("--colour power --layers boundaries"), quantity),
        (without_gap.to_owned(), "the layer amplitude needs the gap on an axis"),
        (machine.to_owned(), "--layers, --mark and --line are for maps without --machine"),
    ]);
    let layer = "The amplitude of the motion without stops";
    has(&printed("help figure"), &["--layers <LAYER,...>", "--mark <X,Y>", "--line <X0,Y0:X1,Y1>", layer]);
}
