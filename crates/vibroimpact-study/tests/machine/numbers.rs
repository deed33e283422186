//! Numbers by path: those of the file first, then those of the expansion.

use vibroimpact_study::machine::{MachineSource, no_files};

fn source() -> MachineSource {
    let text = r#"
        [parameters]
        mu = 0.25
        d = 1
        [machine]
        bodies = { body = 1, shoe = "mu" }
        frequency_hz = 2
        link = [
            { between = ["body", "shoe"], stiffness = "1/(1+mu)" },
            { name = "leg", between = ["shoe", "ground"], stiffness = 3, damping = 0.5 },
        ]
        force = [{ at = "shoe", cos = 0.1 }]
        stop = [{ name = "wall", at = "body", gap = "d", stiffness = 10 }]
        friction = [{ name = "floor", at = "shoe", sliding = 0.2 }]"#;
    MachineSource::from_text(text, no_files).unwrap()
}

#[test]
fn written_numbers_come_first() {
    let source = source();
    for (path, value) in [
        ("mu", 0.25),
        ("body.shoe.mass", 0.25),
        ("mass.shoe", 0.25),
        ("link.body-shoe.stiffness", 0.8),
        ("stiffness.shoe", 3.8),
        ("stiffness.shoe.body", -0.8),
        ("frequency_hz", 2.0),
        ("frequency", 4.0 * core::f64::consts::PI),
        ("stop.wall.gap", 1.0),
        ("stop.wall.damping", 0.0),
        ("friction.floor.static", 0.2),
        ("force.1.cos.shoe", 0.1),
        ("force.1.sin.body", 0.0),
    ] {
        assert_eq!(source.number(path), Ok(value), "{path}");
    }
    // a parameter changes all that depends on it
    let other = source.with("mu", 1.0).unwrap();
    assert_eq!(other.number("stiffness.body"), Ok(0.5));
    assert_eq!(other.number("mass.shoe"), Ok(1.0));
    // a static limit that is not written follows the sliding force
    assert_eq!(source.with("friction.floor.sliding", 0.7).unwrap().number("friction.floor.static"), Ok(0.7));
    // an expression is replaced
    let near = source.with("stop.wall.gap", 0.5).unwrap();
    assert_eq!((near.with("d", 9.0).unwrap().number("stop.wall.gap"), near.number("d")), (Ok(0.5), Ok(1.0)));
    let fast = source.with("frequency_hz", 1.0).unwrap();
    assert_eq!(fast.machine().unwrap().period(), Some(1.0));
}

#[test]
fn other_numbers_change_in_the_expansion() {
    let source = source();
    let damped = source.with("stop.wall.damping", 2.0).unwrap().with("stiffness.shoe.shoe", 9.0).unwrap();
    assert_eq!(damped.set.names(), ["stop.wall.damping", "stiffness.shoe"]);
    assert_eq!(damped.number("stiffness.shoe"), Ok(9.0));
    assert_eq!(damped.machine().unwrap().number("stop.wall.damping").unwrap(), 2.0);
    // they stay when the file changes, and are a part of the file
    let later = damped.with("link.leg.stiffness", 4.0).unwrap();
    assert_eq!((later.number("stiffness.shoe"), later.number("stiffness.body")), (Ok(9.0), Ok(0.8)));
    assert_eq!(MachineSource::from_text(&later.to_toml(), no_files).unwrap(), later);
    // an intermediate machine may be one that is not allowed
    let turned = source.with("friction.floor.static", 0.1).unwrap();
    assert!(turned.machine().unwrap_err().to_string().contains("friction.floor.static"));
    assert!(turned.with("friction.floor.sliding", 0.05).unwrap().machine().is_ok());
}

#[test]
fn every_path_leads_to_a_number_that_can_be_set() {
    let source = source();
    let paths = source.paths().unwrap();
    for wanted in ["mu", "body.body.mass", "link.leg.damping", "stiffness.body.shoe", "stop.wall.preload", "frequency"]
    {
        assert!(paths.iter().any(|path| path == wanted), "{wanted}: {paths:?}");
    }
    assert!(!paths.iter().any(|path| path == "mass.body.shoe"), "{paths:?}");
    for path in &paths {
        let value = source.number(path).unwrap();
        let other = source.with(path, value + 0.125).unwrap();
        assert_eq!(other.number(path), Ok(value + 0.125), "{path}");
        assert_ne!(other.parts().unwrap(), source.parts().unwrap(), "{path}");
    }
}

#[test]
fn unknown_paths_are_explained() {
    let source = source();
    for (path, said) in [
        (
            "link.leg.gap",
            "link.leg.gap: no such number in this machine\nhint: there are link.body-shoe.stiffness, link.leg.stiffness, link.leg.damping",
        ),
        ("nu", "nu: no such number in this machine\nhint: there are mu, d"),
        ("stop.wal.gap", "hint: the stops are wall"),
        ("stop.wall.restitution", "hint: the numbers of wall are gap, stiffness, damping, preload"),
        ("mode.1.frequency", "hint: paths begin with"),
        ("", "hint: there are mu, d"),
    ] {
        for told in [source.number(path).unwrap_err().to_string(), source.with(path, 1.0).unwrap_err().to_string()] {
            assert!(told.contains(said), "{told}");
        }
    }
}
