//! Tests of every kind of request, sent as the page sends it.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use axum::body::{Body, to_bytes};
use axum::http::request::Builder;
use axum::http::{Request, StatusCode, header};
use serde_json::Value;
use tower::ServiceExt;
use vibroimpact_report::{Units, answer};
use vibroimpact_study::{Control, Plan};
use vibroimpact_web::{Explorer, app};

const PORT: u16 = 8411;
const SETTLE: &str = r#""settle":{"start":{}}"#;
const SIMULATE: &str = r#""simulate":{"start":{"v":1},"impacts":null,"periods":20}"#;
const LYAPUNOV: &str = r#""lyapunov":{"start":{},"impacts":2000,"transient":200,"points":300}"#;
const DIAGRAM: &str = r#""diagram":{"vary":"gap","over":"0.5:1.5:41","direction":"both","show":"velocity"}"#;
const BASIN: &str = r#""basin":{"axes":[{"vary":"x","over":"-2:0.75:12"},{"vary":"v","over":"-2:2:10"}],"start":{}}"#;
const MAP: &str = r#""map":{"axes":[{"vary":"inverse_beta","over":"1:1.5:9"},{"vary":"gap","over":"0.5:2.5:9"}],"starts":2,"seed":1}"#;

fn plan(task: &str) -> String {
    format!(r#"{{"version":1,"system":{{"inverse_beta":1.3,"gap":0.75,"restitution":0.5}},"task":{{{task}}}}}"#)
}

async fn ask(path: &str, task: &str) -> (StatusCode, String, Vec<u8>) {
    let request = Request::post(path).header(header::CONTENT_TYPE, "application/json");
    send(request, Body::from(plan(task))).await
}

async fn send(request: Builder, body: Body) -> (StatusCode, String, Vec<u8>) {
    let request = request.header(header::HOST, format!("127.0.0.1:{PORT}")).body(body);
    let response = app(Explorer::new(PORT, 0)).oneshot(request.unwrap()).await.unwrap();
    let kind = response.headers().get(header::CONTENT_TYPE).map_or("", |kind| kind.to_str().unwrap()).to_owned();
    (response.status(), kind, to_bytes(response.into_body(), usize::MAX).await.unwrap().to_vec())
}

#[tokio::test]
async fn answers_are_those_of_the_command() {
    for task in [SETTLE, SIMULATE, LYAPUNOV, BASIN, MAP, r#""attractors":{"starts":20,"seed":1}"#] {
        let (status, _, body) = ask("/api/answer", task).await;
        assert_eq!(status, 200);
        let text: Plan = serde_json::from_str(&plan(task)).unwrap();
        let command = answer(&text, Units::default(), &Control::default()).unwrap().json();
        assert_eq!(String::from_utf8(body).unwrap(), command);
    }
}

#[tokio::test]
async fn figures_of_every_kind() {
    for (query, task) in [
        ("?kind=waveform", SETTLE),
        ("?kind=phase&width=500&height=400", SETTLE),
        ("?kind=multipliers", SETTLE),
        ("?kind=sections", SETTLE),
        ("", SIMULATE),
        ("?kind=phase", SIMULATE),
        ("?kind=sections", LYAPUNOV),
        ("", BASIN),
        ("", MAP),
        ("", DIAGRAM),
    ] {
        let (status, kind, body) = ask(&format!("/api/figure{query}"), task).await;
        assert_eq!((status.as_u16(), kind.as_str()), (200, "image/svg+xml"), "{query} {task}");
        let svg = String::from_utf8(body).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("</svg>"), "{query} {task}");
        if query.contains("width=500") {
            assert!(svg.contains(r#"viewBox="0 0 500"#), "{}", &svg[..200]);
        }
    }
    let (status, kind, png) = ask("/api/figure?format=png&kind=phase", SETTLE).await;
    assert_eq!((status.as_u16(), kind.as_str(), &png[1..4]), (200, "image/png", b"PNG".as_slice()));
    let (status, _, body) = ask("/api/figure?kind=multipliers", BASIN).await;
    assert_eq!(status, 404, "{}", String::from_utf8_lossy(&body));
}

/// A diagram with the branches found on its line, and one with the branches of given labels.
#[tokio::test]
async fn a_bifurcation_diagram() {
    for query in ["", "?labels=1/1,2/1&width=900&height=500"] {
        let (status, kind, body) = ask(&format!("/api/bifurcation{query}"), DIAGRAM).await;
        assert_eq!((status.as_u16(), kind.as_str()), (200, "image/svg+xml"));
        assert!(String::from_utf8(body).unwrap().contains("unstable"), "{query}");
    }
    let line =
        DIAGRAM.replace("\"direction\"", r#""also":{"parameter":"inverse_beta","from":1.2,"to":1.3},"direction""#);
    let (status, _, body) = ask("/api/bifurcation", &line).await;
    let svg = String::from_utf8(body).unwrap();
    assert!(status == 200 && svg.contains("unstable") && svg.contains("1.2 to 1.3"), "{status}");
    assert_eq!(ask("/api/bifurcation?labels=3/0", DIAGRAM).await.0, 400);
    assert_eq!(ask("/api/bifurcation", SETTLE).await.0, 400);
}

#[tokio::test]
async fn tables_commands_and_layers() {
    let (status, kind, body) = ask("/api/table", BASIN).await;
    assert_eq!((status.as_u16(), kind.as_str()), (200, "text/csv; charset=utf-8"));
    let text = String::from_utf8(body).unwrap();
    assert!(text.starts_with("x,v,label\n-2,-2,") && text.lines().count() == 121, "{text}");
    let steady = String::from_utf8(ask("/api/table", SETTLE).await.2).unwrap();
    assert!(steady.starts_with("time,x,v,phase\n0,0.75,") && steady.lines().count() > 500, "{steady}");
    let motions = String::from_utf8(ask("/api/table", r#""attractors":{"starts":200,"seed":1}"#).await.2).unwrap();
    assert!(motions.contains("\n2/1,0.64,128,0.4437") && motions.lines().count() == 3, "{motions}");
    let orbits = String::from_utf8(ask("/api/table", r#""orbit":{"label":"1/1"}"#).await.2).unwrap();
    assert!(orbits.starts_with("orbit,label,admissible,stable,") && orbits.lines().count() > 1, "{orbits}");
    let no_points = r#""lyapunov":{"start":{},"impacts":2000,"transient":200,"points":null}"#;
    assert_eq!(ask("/api/table", no_points).await.0, 404);

    let told: Value = serde_json::from_slice(&ask("/api/command", SETTLE).await.2).unwrap();
    assert_eq!(told["vibro"], "vibro settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5");
    assert!(told["python"].as_str().unwrap().contains("settle("), "{told}");

    let layer: Value = serde_json::from_slice(&ask("/api/layer?kind=amplitude", MAP).await.2).unwrap();
    let line = layer["curves"][0].as_array().unwrap();
    for point in line {
        let (x, gap) = (point[0].as_f64().unwrap(), point[1].as_f64().unwrap());
        assert!((gap * (1.0 - 1.0 / (x * x)).abs() - 1.0).abs() < 1e-12, "{x} {gap}");
    }
    let regions: Value = serde_json::from_slice(&ask("/api/layer?kind=regions&labels=1/1", MAP).await.2).unwrap();
    let one = regions["regions"].as_array().unwrap().iter().find(|region| region["name"] == "1/1").unwrap();
    assert!(one["rings"][0].as_array().unwrap().len() > 3 && one["colour"].as_str().unwrap().starts_with('#'));
    assert_eq!(ask("/api/layer?kind=regions", SETTLE).await.0, 400);
    assert_eq!(ask("/api/layer?kind=regions&labels=1/0", MAP).await.0, 400);
}

/// Found by `cargo xtask fuzz`: a query or a path that cannot be parsed was refused with the message of the parser, and
/// not with an object.
#[tokio::test]
async fn fz3_every_refusal_is_an_object() {
    for path in [
        "/api/layer",
        "/api/layer?kind=all",
        "/api/figure?width=x",
        "/api/figure?format=exe",
        "/api/figure?kind=&kind=",
    ] {
        let (status, kind, body) = ask(path, SETTLE).await;
        assert_eq!((status.as_u16(), kind.as_str()), (400, "application/json"), "{path}");
        let refusal: Value = serde_json::from_slice(&body).unwrap();
        let sentence = refusal["error"].as_str().unwrap();
        assert!(sentence.contains("query") && !sentence.contains("deserialize"), "{sentence}");
    }
}

/// The table and the command of a view belong to this view. Positions along a line are drawn as positions.
#[tokio::test]
async fn f10_a_view_has_its_own_table_and_command() {
    let settle = "vibro settle --inverse-beta 1.3 --gap 0.75 --restitution 0.5";
    for (view, head, show, python) in [
        ("waveform", "time,x,v,phase", "", "motion.plot()"),
        ("phase", "time,x,v,phase", " --show phase", "motion.waveform()"),
        ("multipliers", "re,im", " --show multipliers", "motion.multipliers"),
        (
            "sections",
            "section,stop,phase,speed,x,v",
            " --show sections",
            "vi.lyapunov(osc, points=2000).plot_sections()",
        ),
    ] {
        let (status, _, table) = ask(&format!("/api/table?kind={view}"), SETTLE).await;
        assert_eq!((status.as_u16(), String::from_utf8(table).unwrap().lines().next()), (200, Some(head)), "{view}");
        let (_, _, told) = ask(&format!("/api/command?kind={view}"), SETTLE).await;
        let told: Value = serde_json::from_slice(&told).unwrap();
        assert_eq!(told["vibro"], format!("{settle}{show} --plot {view}.svg"));
        assert!(told["python"].as_str().unwrap().contains(python), "{told}");
    }
    let strobes = DIAGRAM.replace("velocity", "strobe");
    let (status, _, body) = ask("/api/bifurcation?labels=1/1,2/1", &strobes).await;
    let svg = String::from_utf8(body).unwrap();
    assert!(status == 200 && svg.contains("at phase 0") && !svg.contains("arrival velocity"), "{status}");
    assert!(svg.contains(">stable<"));
}

/// The colours of quantities are those of figures; a figure in them has the range that is asked for, and its command says so.
#[tokio::test]
async fn quantities_as_colours() {
    let (_, about) = get("/api/about").await;
    let colours = about["colours"].as_array().unwrap();
    assert_eq!((colours.len(), &colours[0], &colours[255]), (256, &"#440154".into(), &"#fde725".into()));
    let names: Vec<_> = about["missing"].as_array().unwrap().iter().map(|look| look["name"].clone()).collect();
    assert_eq!(names, ["infinite", "not defined", "undecided", "not computed"]);
    let map = MAP.replace("\"seed\":1", "\"seed\":1,\"fields\":[\"power\"]");
    let query = "?colour=power&of=smallest&range=-3,7";
    let (status, _, body) = ask(&format!("/api/figure{query}"), &map).await;
    let svg = String::from_utf8(body).unwrap();
    assert!(status == 200 && svg.contains("power of the force<") && svg.contains(">6<"), "{svg}");
    let told: Value = serde_json::from_slice(&ask(&format!("/api/command{query}"), &map).await.2).unwrap();
    let figure = told["figure"].as_str().unwrap();
    assert!(
        figure.ends_with("--fields power --colour power --of smallest --colour-range -3:7 --plot map.svg"),
        "{figure}"
    );
    for (query, sentence) in [
        ("?colour=power&of=best", "of = best is none of"),
        ("?colour=power&range=2,1", "range = 2,1"),
        ("?colour=impact_rate", "no values of `impact-rate`"),
        ("?layers=paper,lines", "layers = lines: there is no such layer"),
        ("?mark=1", "mark = 1 is not 2 numbers"),
    ] {
        let (status, _, body) = ask(&format!("/api/figure{query}"), &map).await;
        let said = String::from_utf8(body).unwrap();
        assert!(status == 400 && said.contains(sentence), "{query}: {said}");
    }
    let (status, kind, table) = ask("/api/bifurcation?labels=1/1&table=true", DIAGRAM).await;
    assert_eq!((status.as_u16(), kind.as_str()), (200, "text/csv; charset=utf-8"));
    let table = String::from_utf8(table).unwrap();
    assert!(table.starts_with("gap,sweep,kind,stop,phase,speed,label,event\n") && table.contains(",1/1,"), "{table}");
}

/// A motion for the page: from the start, and after its transient, in the requested number of periods.
#[tokio::test]
async fn a_motion_as_points_and_events() {
    for (task, begin) in [(SIMULATE, false), (SETTLE, true)] {
        let (status, kind, body) = ask("/api/motion?periods=3", task).await;
        assert_eq!((status.as_u16(), kind.as_str()), (200, "application/json"));
        let track: Value = serde_json::from_slice(&body).unwrap();
        let (time, period) = (track["time"].as_array().unwrap(), track["period"].as_f64().unwrap());
        assert_eq!(time.last().unwrap().as_f64().unwrap(), 3.0 * period);
        assert_eq!(track["begin"].as_f64().unwrap() > 0.0, begin);
        let highest = track["position"].as_array().unwrap().iter().filter_map(Value::as_f64).fold(f64::MIN, f64::max);
        assert!((highest - 0.75).abs() < 1e-14 && track["stops"] == serde_json::json!([0.75]));
        assert!(track["events"].as_array().unwrap().iter().any(|event| event["kind"] == "impact"));
    }
    for (path, task) in [("/api/motion?periods=0", SETTLE), ("/api/motion?periods=1e9", SETTLE), ("/api/motion", BASIN)]
    {
        assert_eq!(ask(path, task).await.0, 400, "{path}");
    }
}

async fn get(path: &str) -> (StatusCode, Value) {
    let (status, _, body) = send(Request::get(path), Body::empty()).await;
    (status, serde_json::from_slice(&body).unwrap())
}

/// the units of the body of docs/units.md. With them in the plan, a motion is in metres and seconds.
#[tokio::test]
async fn a_machine_has_units() {
    let (status, told) = get("/api/units?mass_kg=0.8&stiffness_n_per_m=12000&force_n=30").await;
    assert_eq!(status, 200);
    assert_eq!(told["units"]["length_m"], 0.0025);
    let hertz = told["natural_hz"].as_f64().unwrap();
    assert!((hertz - (12000.0_f64 / 0.8).sqrt() / core::f64::consts::TAU).abs() < 1e-12, "{hertz}");
    let plain: Value = serde_json::from_slice(&ask("/api/motion?periods=3", SIMULATE).await.2).unwrap();
    let task = format!(r#"{SIMULATE}}},"units":{}"#, told["units"]);
    let task = task.strip_suffix('}').unwrap().to_owned();
    let (status, _, body) = ask("/api/motion?periods=3", &task).await;
    assert_eq!(status, 200, "{}", String::from_utf8_lossy(&body));
    let track: Value = serde_json::from_slice(&body).unwrap();
    assert_eq!((&track["units"], &plain["units"]), (&"si".into(), &"nondimensional".into()));
    for (part, unit) in [
        ("position", &told["units"]["length_m"]),
        ("velocity", &told["velocity_m_per_s"]),
        ("time", &told["units"]["time_s"]),
    ] {
        for k in [7, 100, 300] {
            let (si, plain) = (track[part][k].as_f64().unwrap(), plain[part][k].as_f64().unwrap());
            assert!((si - plain * unit.as_f64().unwrap()).abs() < 1e-15 + 1e-12 * si.abs(), "{part} {k}");
        }
    }
    let (status, told) = get("/api/units?mass_kg=0&stiffness_n_per_m=12000&force_n=30").await;
    assert!(status == 400 && told["error"].as_str().unwrap().contains("mass m = 0"), "{told}");
    let (_, about) = get("/api/about").await;
    let power = about["quantities"].as_array().unwrap().iter().find(|one| one["name"] == "impact_power").unwrap();
    assert_eq!(power["unit"], "W");
}
