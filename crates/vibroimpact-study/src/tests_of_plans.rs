//! Tests of the plans of all tasks: what is written reads again, what is left out is filled in, and what makes no sense is refused.

use crate::{Control, Plan, RunError, Task, run};

/// The task that a text describes, written again.
fn again(text: &str) -> String {
    serde_json::to_string(&serde_json::from_str::<Task>(text).unwrap()).unwrap()
}

#[test]
fn tasks_are_written_as_they_are_read() {
    for text in [
        r#"{"branch":{"label":"2/1","vary":"b","to":0.7,"also":{"path":"mu","to":0.6},"orbit":1,"follow":2,"points":500}}"#,
        r#"{"branch":{"label":"1/1","vary":"gap","to":2.5,"back":0.5,"points":5000}}"#,
        r#"{"curve":{"label":"1/1","kind":"flip","vary":{"parameter":"gap","from":0.0,"to":3.0},"and":{"path":"e","from":1.05,"to":1.2},"event":2}}"#,
        r#"{"diagram":{"vary":"gap","over":[0.5,0.7,1.5],"show":"strobe","direction":{"scatter":{"starts":9,"seed":4}},"transient":7,"keep":3}}"#,
        r#"{"lyapunov":{"start":{"x":0.5,"v":-1.0,"phase":2.0},"impacts":2000,"transient":0,"points":7}}"#,
        r#"{"margins":{"label":"1/1","vary":[{"parameter":"gap","scale":0.1}],"within":2.0}}"#,
        r#"{"region":{"label":"1/1","across":{"parameter":"inverse_beta","from":1.05,"to":1.2},"up":{"parameter":"gap","from":1.0,"to":2.5},"grid":5}}"#,
        r#"{"response":{"vary":"gap","over":[0.5,1.5,0.75],"quantity":"power","impacts":70}}"#,
        r#"{"map":{"axes":[{"vary":"gap","over":"0.1:10:5:log"}],"starts":2,"seed":1,"refine":4,"impacts":70,"fields":["power"]}}"#,
        r#"{"basin":{"axes":[{"vary":"v","over":[0.5,0.25]}],"start":{"v":0.0,"phase":0.5},"transient":true}}"#,
        r#"{"basin":{"points":{"listed":[{"vary":"gap","values":[1.0,2.0]},{"vary":"v","values":[0.5,-1.0]}]}}}"#,
        r#"{"settle_many":{"points":{"drawn":{"rule":"lhs","count":5,"seed":2,"over":[{"vary":"q.head","from":0.75,"to":1.5}]}}}}"#,
        // plans without a budget keep their bytes, so stores of such plans are found again
        r#"{"settle":{"start":{"v":1.0,"phase":0.0}}}"#,
        r#"{"attractors":{"starts":3,"seed":1,"impacts":70}}"#,
    ] {
        assert_eq!(again(text), text);
    }
}

#[test]
fn short_tasks_are_filled_in() {
    for (short, full) in [
        (r#""label":"1/1","vary":"gap","to":2.5"#, r#"branch":{"label":"1/1","vary":"gap","to":2.5,"points":5000"#),
        (
            r#""vary":"gap","over":"1:2:3""#,
            r#"diagram":{"vary":"gap","over":"1:2:3","show":"velocity","direction":"both","transient":500,"keep":64"#,
        ),
        ("", r#"lyapunov":{"#),
        ("", r#"margins":{"within":2.0"#),
        (r#""starts":3"#, r#"attractors":{"starts":3,"seed":1"#),
    ] {
        let (name, _) = full.split_once('"').unwrap();
        assert_eq!(again(&format!(r#"{{"{name}":{{{short}}}}}"#)), format!(r#"{{"{full}}}}}"#));
    }
}

/// The reason why a task of an oscillator has no result.
fn refused(system: &str, task: &str) -> String {
    let plan = Plan::from_text(&format!("version = 1\nsystem = {{ {system} }}\ntask.{task}\n"));
    plan.map_err(RunError::from).and_then(|plan| run(&plan, &Control::default()).map(drop)).unwrap_err().to_string()
}

const AT_S: &str = "inverse_beta = 1.3, gap = 0.75, restitution = 0.5";
const AT_T: &str = "inverse_beta = 1.11, gap = 1.5, restitution = 0.5";
const AT_U: &str = "inverse_beta = 1.11, gap = 3, restitution = 0.5";

#[test]
fn nonsense_is_refused() {
    for (task, sentence) in [
        ("orbit = { label = '3/0' }", "label `3/0`"),
        ("simulate = { impacts = 0 }", "impacts = 0"),
        ("simulate = { periods = nan }", "periods = NaN"),
        ("simulate = { time = -1 }", "time = -1 lies outside 0 < time <= 1e10"),
        ("settle = { impacts = 0 }", "impacts = 0 lies outside 1 <= impacts <= 1000000"),
        ("attractors = { starts = 1, impacts = 1000001 }", "impacts = 1000001"),
        ("attractors = { starts = 0 }", "starts = 0 lies outside"),
        ("edge = { other = [] }", "second start"),
        ("edge = { other = [{ coordinate = 'v', value = 1e-9 }] }", "both starts lead to the same motion, 2/1"),
        ("edge = { other = [{ coordinate = 'x', value = 2 }] }", "beyond"),
        ("edge = { other = [{ coordinate = 'gap', value = 2 }] }", "gap"),
        ("edge = { other = [{ coordinate = 'phase', value = 2 }] }", "phases"),
        ("edge = { other = [{ coordinate = 'v', value = 1 }], laps = 0 }", "laps = 0 lies outside"),
        ("response = { vary = 'gap', over = '1:1:1' }", "gap is to go from 1 to 1"),
        ("response = { vary = 'gap', over = '0:nan:3' }", "the plan does not read"),
        ("response = { vary = 'gap', over = [0.5, 0.5] }", "none of them twice, not 0.5"),
    ] {
        let message = refused(AT_S, task);
        assert!(message.contains(sentence), "{task}: {message}");
    }
    let twice = refused(&format!("beta = 1, {AT_S}"), "settle = {}");
    assert!(twice.contains("the frequency is given twice"), "{twice}");
}

#[test]
fn axes_and_points_that_make_no_sense_are_refused() {
    let axis = |name: &str, over: &str| format!("{{ vary = '{name}', over = '{over}' }}");
    let basin = |x: &str, more: &str, rest: &str| {
        refused(AT_S, &format!("basin = {{ axes = [{}, {}{more}]{rest} }}", axis("x", x), axis("v", "-1:1:3")))
    };
    let gap_too = |over: &str| basin("-3:0.75:4", &format!(", {}", axis("gap", over)), "");
    let map = |axes: &[(&str, &str)], rest: &str| {
        let axes: Vec<String> = axes.iter().map(|(name, over)| axis(name, over)).collect();
        refused(AT_S, &format!("map = {{ axes = [{}]{rest} }}", axes.join(", ")))
    };
    let gap = [("gap", "0.75:2:3")];
    let points = |columns: &str, rest: &str| refused(AT_S, &format!("basin = {{ points.listed = [{columns}]{rest} }}"));
    let column = |name: &str, values: &str| format!("{{ vary = '{name}', values = [{values}] }}");
    for (message, sentence) in [
        (basin("-3:0.8:4", "", ""), "start x = 0.8 lies beyond the stop"),
        (basin("-3:0.75:4", "", ", start.phase = nan"), "start phase = NaN"),
        // with the smallest gap the largest position lies beyond the stop
        (gap_too("0.5:2:3"), "start x = 0.75 lies beyond the stop"),
        (basin("-3:0.75:4", &format!(", {}", axis("x", "0:0.5:2")), ""), "x and x do not span a plane"),
        (
            refused(AT_S, "basin = { axes = [{ vary = 'gap', over = '0:1:3' }] }"),
            "a basin needs an axis over x, v or phase",
        ),
        (map(&[], ", starts = 6"), "axes given: 0; a map has 1 to 4"),
        (map(&[("gap", "0:1:3"), ("gap", "0:1:2")], ", starts = 6"), "gap and gap do not span"),
        (map(&[("beta", "1:2:3"), ("inverse_beta", "1:2:2")], ", starts = 6"), "beta and inverse_beta"),
        (map(&[("restitution", "0:1.5:3")], ", starts = 6"), "restitution eps = 1.5 lies outside"),
        (map(&[("second_gap", "0:1.5:3")], ", starts = 6"), "second_gap is to vary, but there is no"),
        (map(&[("x", "0:1:3")], ", starts = 6"), "a map has no axis x; it may have the parameters of the system"),
        (map(&gap, ", starts = 0"), "starts = 0 lies outside"),
        (map(&gap, ", starts = 6, impacts = 0"), "impacts = 0 lies outside 1 <= impacts <= 1000000"),
        (map(&gap, ", starts = 6, refine = 1"), "refine = 1 lies outside 2 <= refine <= 64"),
        (points("", ""), "points = 0 lies outside 1 <= points <= 1000000000"),
        (points(&[column("gap", "1"), column("v", "1, 2")].join(", "), ""), "gap has 1 values and v has 2"),
        (points(&column("v", "0, inf"), ""), "v = inf is not finite (point 1)"),
        (points(&column("x", "0, 0.8"), ""), "start x = 0.8 lies beyond the stop"),
        (points(&[column("gap", "1"), column("gap", "1")].join(", "), ""), "gap and gap do not span a plane"),
        (points(&column("v", "0, 1"), ", refine = 4"), "points have no neighbours"),
        (points(&column("v", "0, 1"), ""), "a basin of one system has no axis point"),
    ] {
        assert!(message.starts_with(sentence), "{message}");
    }
}

#[test]
fn lines_and_orbits_that_make_no_sense_are_refused() {
    let curve = |kind: &str, from: f64, rest: &str| {
        let and = "and = { parameter = 'inverse_beta', from = 1.05, to = 1.2 }";
        let vary = format!("vary = {{ parameter = 'gap', from = {from:?}, to = 3 }}");
        refused(AT_T, &format!("curve = {{ label = '1/1', kind = '{kind}', {vary}, {and}{rest} }}"))
    };
    let region = |label: &str, up: &str, grid: u32| {
        let across = "across = { parameter = 'inverse_beta', from = 1.05, to = 1.2 }";
        let up = format!("up = {{ parameter = '{up}', from = 1, to = 2.5 }}");
        refused(AT_T, &format!("region = {{ label = '{label}', {across}, {up}, grid = {grid} }}"))
    };
    let also = |parameter: &str, from: f64, to: &str| {
        let also = format!("also = {{ parameter = '{parameter}', from = {from:?}, to = {to} }}");
        refused(AT_S, &format!("diagram = {{ vary = 'gap', over = '0.3:2.7:5', {also} }}"))
    };
    for (message, sentence) in [
        (curve("flip", 2.0, ""), "gap = 1.5 lies outside the range from 2 to 3"),
        (curve("flip", 0.0, ", event = 7"), "there is no flip number 7 on the branch of 1/1"),
        (curve("fold", 0.0, ""), "no fold was found on the branch of 1/1"),
        (region("1/1", "gap", 1), "grid = 1 lies outside 2 <= grid <= 400"),
        (region("inf/1", "gap", 5), "a cycle that rests"),
        (region("1/1", "inverse_beta", 5), "inverse_beta and inverse_beta do not span a plane"),
        (also("gap", 0.0, "1"), "gap and gap cannot vary together"),
        (also("restitution", 0.5, "1.5"), "restitution eps = 1.5 lies outside"),
        (also("second_gap", 0.5, "1.5"), "second_gap is to vary, but there is no second stop"),
        (also("damping", 0.5, "nan"), "damping ratio zeta = NaN"),
    ] {
        assert!(message.starts_with(sentence), "{message}");
    }
    for (task, sentence) in [
        ("branch = { label = '1/0', vary = 'gap', to = 2.5 }", "label `1/0` is not m/n"),
        ("branch = { label = '1/1', vary = 'gap', to = 1.5 }", "gap is to go from 1.5 to 1.5"),
        ("branch = { label = '1/1', vary = 'gap', to = nan }", "gap delta = NaN"),
        ("branch = { label = '1/1', vary = 'second_gap', to = 2.5 }", "second_gap is to vary"),
        (
            "branch = { label = '1/1', vary = 'gap', to = 2.5, follow = 101 }",
            "follow = 101 lies outside 0 <= follow <= 100",
        ),
        (
            "branch = { label = '1/1', vary = 'gap', to = 2.5, points = 1 }",
            "points = 1 lies outside 2 <= points <= 100000",
        ),
        ("margins = { label = '1/0' }", "label `1/0` is not m/n"),
        ("margins = { label = '1/1', start.v = 1 }", "the motion is given twice, by its label and by a start"),
        ("margins = { within = 1 }", "within = 1 lies outside 1 < within <= 100"),
        ("margins = { within = nan }", "within = NaN lies outside"),
        ("margins = { lines = 100001 }", "lines = 100001 lies outside 0 <= lines <= 100000"),
        ("margins = { vary = ['beta', 'inverse_beta'] }", "beta and inverse_beta are both to vary"),
        ("margins = { vary = [{ parameter = 'gap', scale = 0 }] }", "the scale of gap is 0"),
        ("margins = { vary = ['second_gap'] }", "second_gap is to vary, but"),
        ("margins = { vary = [{ parameter = 'gap', skale = 1 }] }", "the plan does not read: "),
    ] {
        let message = refused(AT_T, task);
        assert!(message.starts_with(sentence), "{task}: {message}");
    }
}

#[test]
fn lengths_that_make_no_sense_are_refused() {
    for (task, sentence) in [
        ("lyapunov = { impacts = 999 }", "impacts = 999 lies outside 1000 <= impacts <= 10000000"),
        ("lyapunov = { impacts = 10000001 }", "impacts = 10000001 lies outside"),
        ("lyapunov = { transient = 1000001 }", "transient = 1000001 lies outside 0 <= transient"),
        ("lyapunov = { points = 0 }", "points = 0 lies outside 1 <= points <= 100000"),
        ("lyapunov = { start.x = 3.5 }", "start x = 3.5 lies beyond the stop"),
        ("lyapunov = { transeint = 1 }", "the plan does not read: "),
        ("diagram = { vary = 'beta', over = '0:3:601' }", "frequency ratio beta = 0 lies outside"),
        ("diagram = { vary = 'restitution', over = '0:3:601' }", "restitution eps = 3 lies outside"),
        ("diagram = { vary = 'second_gap', over = '0:3:601' }", "second_gap is to vary, but there is no second stop"),
        ("diagram = { vary = 'gup', over = '0:3:601' }", "the plan does not read: "),
        ("diagram = { vary = 'gap', over = '0:3:601', kept = 3 }", "the plan does not read: "),
        (
            "diagram = { vary = 'gap', over = '0:3:601', transient = 2000000 }",
            "transient = 2000000 lies outside 0 <= transient",
        ),
        ("diagram = { vary = 'gap', over = '0:3:601', keep = 0 }", "keep = 0 lies outside 1 <= keep <= 100000"),
        ("diagram = { vary = 'gap', over = '0:3:601', direction.scatter.starts = 0 }", "starts = 0 lies outside"),
        ("diagram = { vary = 'gap', over = '0:3:601', direction.scatter.sed = 0 }", "the plan does not read: "),
        ("diagram = { vary = 'gap', over = '0:3:1000000' }", "128 x 1000000 = 128000000 points; at most 20000000"),
        ("diagram = { vary = 'gap', over = [0.5, 2, 1] }", "the values of a diagram rise or fall"),
        ("diagram = { vary = 'gap', over = [] }", "a list of 0 values was given"),
        ("diagram = { vary = 'gap', over = [0.5, 0.5] }", "a list of 2 values was given"),
        (
            "diagram = { vary = 'gap', over = '0.3:0.3:1', also = { parameter = 'damping', from = 0.1, to = 0.2 } }",
            "gap is to go from 0.3 to 0.3",
        ),
    ] {
        let message = refused(AT_U, task);
        assert!(message.starts_with(sentence), "{task}: {message}");
    }
}
