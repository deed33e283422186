//! The machines of the catalogue.

use core::f64::consts::PI;
use vibroimpact_study::machine::{CATALOGUE, MachineSource, NumberText};

fn source(name: &str) -> MachineSource {
    MachineSource::of_catalogue(name).unwrap()
}

#[test]
fn every_machine_is_allowed_and_says_where_it_comes_from() {
    for entry in CATALOGUE {
        let source = entry.source().unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        let machine = source.machine().unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        assert!(source.title.is_some() && source.source.is_some() && source.summary.is_some(), "{}", entry.name);
        assert!(!machine.stops().is_empty() || !machine.joints().is_empty(), "{}", entry.name);
        // the expansion is the same machine, and every parameter changes it
        let again = source.expansion().unwrap();
        assert_eq!(again.machine().unwrap(), machine, "{}", entry.name);
        for (name, value) in &source.parameters.0 {
            let other = source.with(name, value * 1.01 + 0.01).unwrap();
            let changed = other.machine().unwrap_or_else(|error| panic!("{}: {error}", entry.name));
            let (changed, machine) = (changed.parts(), machine.parts());
            assert!(changed != machine || name == "g", "{}: {name}", entry.name);
        }
        for path in source.paths().unwrap() {
            assert!(source.number(&path).is_ok(), "{}: {path}", entry.name);
        }
    }
    assert!(
        MachineSource::of_catalogue("soft").unwrap_err().to_string().contains("there are soft-stop, bouncing-ball")
    );
}

/// The matrices of the example of NLvib: masses 1, springs 0, 1, 1 and dampers 0.03 times them, a force 0.1 on the
/// second, and a spring of 100 behind a gap of 1 on the first.
#[test]
fn the_chain_has_the_matrices_of_its_source() {
    let machine = source("chain").machine().unwrap();
    let parts = machine.parts();
    assert_eq!(parts.stiffness.values(), [1.0, -1.0, -1.0, 2.0]);
    assert_eq!(parts.damping.values(), [0.03, -0.03, -0.03, 0.06]);
    assert_eq!(parts.mass.values(), [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(parts.forces[0].cos, [0.0, 0.1]);
    assert_eq!(machine.number("stop.stop.stiffness").unwrap(), 100.0);
    assert_eq!(parts.stops[0].direction, [1.0, 0.0]);
}

/// Bending modes of a cantilever: roots by bisection, shapes normalised by Simpson's rule.
#[test]
fn the_modes_of_the_cantilever_are_those_of_a_beam() {
    let source = source("cantilever");
    for (k, mode) in source.machine.mode.iter().enumerate() {
        let secular = |x: f64| x.cos() + 1.0 / x.cosh();
        let (mut low, mut high) = (PI * k as f64, PI * (k as f64 + 1.0));
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if (secular(low) > 0.0) == (secular(middle) > 0.0) { low = middle } else { high = middle }
        }
        let root = 0.5 * (low + high);
        let sigma = (root.cosh() + root.cos()) / (root.sinh() + root.sin());
        // 1 - sigma without cancellation
        let rest = (root.sin() - root.cos() - (-root).exp()) / (root.sinh() + root.sin());
        let shape = |x: f64| {
            let s = root * x;
            0.5 * (rest * s.exp() + (1.0 + sigma) * (-s).exp()) - s.cos() + sigma * s.sin()
        };
        let simpson = |of: &dyn Fn(f64) -> f64| {
            let n = 2000;
            let at = |i: usize| {
                of(i as f64 / n as f64)
                    * if i == 0 || i == n {
                        1.0
                    } else if i % 2 == 1 {
                        4.0
                    } else {
                        2.0
                    }
            };
            (0..=n).map(at).sum::<f64>() / (3.0 * n as f64)
        };
        let norm = simpson(&|x| shape(x) * shape(x)).sqrt();
        let number = |number: &NumberText| number.value(&source.parameters).unwrap();
        let near = |value: f64, wanted: f64, what: &str| {
            assert!((value - wanted).abs() < 1e-9 * (1.0 + wanted.abs()), "mode {}: {what} {value} {wanted}", k + 1);
        };
        near(number(mode.frequency.as_ref().unwrap()), root * root, "frequency");
        near(number(mode.shape.get("tip").unwrap()), shape(1.0) / norm, "tip");
        near(number(mode.shape.get("middle").unwrap()), shape(0.5) / norm, "middle");
        near(number(mode.shape.get("base").unwrap()), simpson(&shape) / norm, "base");
    }
    assert_eq!(source.machine.mode.len(), 5);
}

/// Numbers of the sources and of their closed forms.
#[test]
fn numbers_of_the_sources() {
    let number = |name: &str, path: &str| source(name).number(path).unwrap();
    assert_eq!(number("sdnd101", "stop.stop.stiffness"), 1e6);
    assert_eq!(number("sdnd106", "friction.floor.static"), 3000.0);
    assert_eq!(number("sdnd122", "stop.stop.gap"), 0.01);
    // the base of SDND102 moves as -sin(w t)/w^2; spring and damper pull with k y + c y'
    let (k, w) = (98696.0, 20.0 * PI);
    let c = 2.0 * 0.07 * (k * 25.0_f64).sqrt();
    assert!((number("sdnd102", "force.1.sin.mass") + k / (w * w)).abs() < 1e-12 * k);
    assert!((number("sdnd102", "force.1.cos.mass") + c / w).abs() < 1e-12 * c);
    assert_eq!(number("den-hartog", "friction.floor.sliding"), 0.3);
    assert_eq!(number("fukaya-irie-1971", "frequency"), 1.0 / 1.3);
    assert_eq!(number("gear-rattle", "constant.gear"), 4.0 * PI * 0.6);
    // level, the cup has no constant force; upright it is gravity
    assert_eq!(number("impact-pair", "constant.ball"), 0.0);
    let upright = source("impact-pair").with("alpha", PI / 2.0).unwrap();
    assert_eq!(upright.machine().unwrap().number("constant.ball").unwrap(), 1.0);
}

#[test]
fn a_name_or_a_text_opens_a_machine() {
    assert_eq!(MachineSource::open("chain"), Ok(source("chain")));
    for entry in CATALOGUE {
        assert_eq!(MachineSource::open(entry.text), entry.source(), "{}", entry.name);
    }
    assert!(MachineSource::open("chains").unwrap_err().to_string().starts_with("chains: no such machine"));
    assert!(MachineSource::open("").unwrap_err().to_string().contains("missing field `machine`"));
}

#[test]
fn a_start_belongs_to_the_machine() {
    let start = source("sdnd101").start().unwrap();
    assert_eq!((start.q, start.qdot, start.phase), (vec![0.0], vec![1.0], 0.0));
    // SDND102: the velocity of the base
    assert_eq!(source("sdnd102").start().unwrap().qdot, [-1.0 / (20.0 * PI)]);
    assert_eq!(source("sdnd102").with("w", 2.0).unwrap().start().unwrap().qdot, [-0.5]);
    assert_eq!(source("chain").start().unwrap().q, [0.0, 0.0]);
    let text = |start: &str| {
        let machine = "[machine]\nbodies = { body = 1, shoe = 2 }\nmode = [{ frequency = 1, shape = { tip = 2 } }]\n";
        MachineSource::open(&format!("[parameters]\nv = 0.1\n[start]\n{start}\n{machine}"))
    };
    let written = text("q = { shoe = -0.25 }\nqdot = [1, 2, \"10*v\"]\nphase = \"pi/2\"").unwrap();
    let start = written.start().unwrap();
    assert_eq!((start.q.as_slice(), start.qdot.as_slice()), ([0.0, 0.0, -0.25].as_slice(), [1.0, 2.0, 1.0].as_slice()));
    assert_eq!(start.phase, PI / 2.0);
    // the expansion has the same start, also as text
    let printed = MachineSource::open(&written.expansion().unwrap().to_toml()).unwrap();
    assert_eq!(printed.start(), Ok(start));
    assert_eq!(text("").unwrap().expansion().unwrap().start, None);
    for (start, told) in [
        (
            "q = { tip = 1 }",
            "start.q.tip: `tip` is the name of nothing in this machine\nhint: known names are mode1, body, shoe",
        ),
        ("q = [1, 2]", "start.q: has 2 numbers, and 3 are needed, one for each of the coordinates mode1, body, shoe"),
        ("qdot = 1", "start.qdot: a number alone is given"),
        ("phase = nan", "start.phase: NaN is not a finite number"),
        ("phase = \"w\"", "start.phase: `w` is no parameter"),
        ("v = [1]", "start.v: unknown field `v`"),
    ] {
        let error = text(start).and_then(|source| source.start()).unwrap_err().to_string();
        assert!(error.starts_with(told), "{error}");
    }
}
