//! Wrong files are refused in one sentence that names the path, or the line and the column.

use vibroimpact_study::machine::{MachineSource, no_files};

const BASE: &str = r#"[parameters]
mu = 0.25
[machine]
bodies = { body = 1, shoe = 2 }
link = [{ between = ["body", "ground"], stiffness = 1 }]
[[machine.stop]]
name = "wall"
at = "body"
gap = 1
restitution = 0.5
"#;

fn told(text: &str) -> String {
    let source = MachineSource::from_text(text, no_files).and_then(|source| source.machine());
    source.map_or_else(|error| error.to_string(), |_| String::new())
}

#[test]
fn each_sentence() {
    assert_eq!(told(BASE), "");
    // in place of one of its lines
    let other = |old: &str, new: &str, sentence: &str| {
        assert_eq!(BASE.matches(old).count(), 1, "{old}");
        let told = told(&BASE.replace(old, new));
        assert!(told.starts_with(sentence), "{new}:\n{told}\nwanted\n{sentence}");
    };
    for (old, new, sentence) in [
        (
            "gap = 1",
            "gap = [1]",
            "stop.wall.gap: invalid type: sequence, expected a number or an expression (line 9, column 7)",
        ),
        ("gap = 1", "gapp = 1", "stop.wall.gapp: unknown field `gapp`, expected one of"),
        ("gap = 1\n", "", "stop.wall: missing field `gap` (line 6, column 1)"),
        ("gap = 1", "gap = \"nu\"", "stop.wall.gap: `nu` is no parameter of this machine\nhint: its parameters are mu"),
        ("gap = 1", "gap = \"2*\"", "stop.wall.gap: the expression `2*` has its end where"),
        ("gap = 1", "gap = nan", "stop.wall.gap: NaN is not a finite number"),
        ("gap = 1", "gap = ", "line 9, column "),
        ("name = \"wall\"", "name = \"a wall\"", "stop: `a wall` cannot be used as a name"),
        ("stiffness = 1", "stiffness = -1", "link.body-ground.stiffness: -1 lies outside stiffness >= 0"),
        ("\"body\", \"ground\"]", "\"body\", \"body\"]", "link.body-body.between: the link joins nothing that moves"),
        ("shoe = 2", "shoe = 0", "mass: the mass matrix is not positive definite"),
        ("shoe = 2", "ground = 2", "coordinates: `ground` cannot be used as a name"),
        ("shoe = 2", "body = 2", "line 4, column"),
        ("[machine]", "[machin]", "machin: unknown field `machin`"),
        ("mu = 0.25", "pi = 3", "parameters: `pi` cannot be the name of a parameter"),
        ("mu = 0.25", "mu = \"1\"", "parameters.mu: invalid type: string"),
        ("mu = 0.25\n", "mu = 0.25\n[set]\n\"gap\" = 1\n", "set: gap: no such number in this machine"),
    ] {
        other(old, new, sentence);
    }
    for (new, sentence) in [
        ("restitution = 1.5", "stop.wall.restitution: 1.5 lies outside 0 <= restitution <= 1"),
        ("", "stop.wall: restitution of a rigid stop, or stiffness of a compliant one, is needed"),
        ("restitution = 1\nstiffness = 1", "stop.wall: only one of restitution and stiffness may be given"),
        ("restitution = 1\npreload = 1", "stop.wall.preload: has no meaning here: a stop with restitution is rigid"),
        ("stiffness = 1\nopening = \"late\"", "stop.wall.opening: unknown"),
        ("restitution = 1\nmotion = [{ sin = 1 }]", "stop.wall.motion.1: a harmonic needs the frequency"),
    ] {
        other("restitution = 0.5", new, sentence);
    }
    for (new, sentence) in [
        (
            "at = \"torso\"",
            "stop.wall.at: `torso` is the name of nothing in this machine\nhint: known names are body, shoe, ground",
        ),
        (
            "direction = [1]",
            "stop.wall.direction: has 1 number, and 2 are needed, one for each of the coordinates body, shoe",
        ),
        ("direction = 1", "stop.wall.direction: a number alone is given"),
        ("", "stop.wall: direction, between or at is needed"),
        (
            "at = \"body\"\nbetween = [\"body\", \"shoe\"]",
            "stop.wall: only one of direction, between and at may be given",
        ),
        ("between = [\"body\"]", "stop.wall.between: invalid length 1"),
        ("between = [\"ground\", \"ground\"]", "stop.wall.direction: the direction is zero"),
    ] {
        other("at = \"body\"", new, sentence);
    }
    for (more, sentence) in [
        ("mass = [1, 1]", "mass: has no meaning here: bodies and modes have masses of their own"),
        ("damping = [1]", "damping: has 1 number, and 2 are needed"),
        ("damping = [[1, 0], [0]]", "damping.shoe: has 1 number, and 2 are needed"),
        ("stiffness = [1, [2]]", "stiffness: numbers and rows are mixed in one matrix"),
        (
            "coordinates = [\"a\"]",
            "coordinates: has 1 names, and 2 are needed, one for each of the modes and bodies body, shoe",
        ),
        ("frequency = 1\nfrequency_hz = 1", "frequency_hz: only one of frequency and frequency_hz may be given"),
        ("modal_damping = [0, -1]", "modal_damping.2: -1 lies outside damping ratio >= 0"),
        ("modes = \"modes.csv\"", "modes: the file `modes.csv` cannot be read here"),
        ("mode = [{ shape = { tip = 1 } }]", "mode.1: frequency or frequency_hz is needed"),
        ("mode = [{ frequency = 1, shape = { body = 1 } }]", "mode.1.shape.body: the name is used twice"),
        (
            "mode = [{ frequency = 1, shape = { a = 1 } }, { frequency = 2, shape = { b = 1 } }]",
            "mode.2.shape: has the points b, and 1 are needed",
        ),
        ("force = [{ cos = 1 }]", "force.1.cos: a number alone is given"),
        ("force = [{ at = \"body\", cos = [1, 2] }]", "force.1.cos: has no meaning here: with `at` it is one number"),
        ("force = [{ order = -1 }]", "force.1.order: "),
        ("force = [{ order = 0, at = \"body\", cos = 1 }]", "force.0: "),
        (
            "friction = [{ name = \"f\", at = \"body\", sliding = 2, static = 1 }]",
            "friction.f.static: 1 lies outside static >= sliding",
        ),
    ] {
        other("[machine]", &format!("[machine]\n{more}"), sentence);
    }
    assert!(told("").starts_with("machine: missing field `machine`") || told("").starts_with("line 1"), "{}", told(""));
    for (text, sentence) in [
        ("[machine]", "coordinates: a list of coordinates, a table of bodies"),
        ("[machine]\ncoordinates = [\"a\"]", "mass: the mass matrix is needed"),
        ("{\"machine\": {\"mass\": [1}", "line 1, column "),
        (r#"{"machine": {"stop": [{"name": "wall", "gap": true}]}}"#, "stop.wall.gap: invalid type: boolean"),
        ("{\"machine\":{}} x", "line 1, column 16: the text does not end here"),
    ] {
        assert!(told(text).starts_with(sentence), "{text}: {}", told(text));
    }
}
