//! Machine files with difficult numbers, and paths of numbers in them and in machines of the catalogue.

use crate::values::{ProptestText, plain, restitution, typed};
use proptest::prelude::*;

/// The name of the machine file of a case.
pub(super) const FILE: &str = "drawn.toml";

const BODIES: [&str; 3] = ["a", "b", "c"];
/// What machines of the catalogue and the drawn file have, and some names that none of them has.
pub(super) const PATHS: &[&str] = &[
    "frequency",
    "mass.a",
    "damping.a",
    "stiffness.a",
    "stop.one.gap",
    "stop.one.restitution",
    "stop.two.gap",
    "stop.two.stiffness",
    "friction.rub.sliding",
    "force.1.sin.a",
    "constant.a",
    "stop.anvil.gap",
    "omega",
    "stop.one",
    "q.a",
    "",
];
/// Numbers of a start by path.
pub(super) const STARTS: &[&str] = &["q.a", "qdot.a", "q.b", "qdot.c", "phase", "q.head", "q.mass", "x", ""];

/// A number in a file: usual ones, and now and then an extreme one or a text.
fn value(low: f64, high: f64) -> ProptestText {
    prop_oneof![
        150 => (low..high).prop_map(typed),
        10 => prop::sample::select(vec!["0", "1", "0.5", "1e-9", "1e6"]).prop_map(str::to_owned),
        1 => plain(),
        1 => prop::sample::select(vec!["nan", "inf", "-1", "1e300", "1e-300", "\"x\"", "[1]", "\"2*mu\"", "true"])
            .prop_map(str::to_owned),
    ]
    .boxed()
}

/// One of the bodies that a machine has, and seldom another name.
fn body(n: usize) -> ProptestText {
    prop_oneof![100 => prop::sample::select(BODIES[..n].to_vec()), 1 => prop::sample::select(vec!["ground", "d", ""])]
        .prop_map(str::to_owned)
        .boxed()
}

/// Two places that something joins.
fn between(n: usize) -> ProptestText {
    let second = prop_oneof![1 => Just("ground".to_owned()).boxed(), 1 => body(n)];
    (body(n), second, any::<bool>())
        .prop_map(|(a, b, turned)| (if a == b { "ground".to_owned() } else { a }, b, turned))
        .prop_map(|(a, b, turned)| if turned { format!("[\"{b}\", \"{a}\"]") } else { format!("[\"{a}\", \"{b}\"]") })
        .boxed()
}

fn link(n: usize) -> ProptestText {
    (between(n), value(0.0, 4.0), value(0.0, 0.4))
        .prop_map(|(between, k, c)| format!("[[machine.link]]\nbetween = {between}\nstiffness = {k}\ndamping = {c}\n"))
        .boxed()
}

fn stop(n: usize, name: &'static str) -> ProptestText {
    let law = prop_oneof![
        3 => restitution().prop_map(|e| format!("restitution = {}", if e.is_empty() { "0.5".to_owned() } else { e })),
        2 => (value(1.0, 100.0), value(0.0, 2.0), value(0.0, 0.5), any::<bool>()).prop_map(|(k, c, p, position)| {
            let opening = if position { "position" } else { "force" };
            format!("stiffness = {k}\ndamping = {c}\npreload = {p}\nopening = \"{opening}\"")
        }),
    ];
    let motion = prop::option::weighted(0.2, (value(-0.3, 0.3), value(-0.3, 0.3)));
    (between(n), value(-0.2, 2.0), law, motion)
        .prop_map(move |(between, gap, law, motion)| {
            let motion = motion.map_or_else(String::new, |(cos, sin)| {
                format!("motion = [{{ order = 1, cos = {cos}, sin = {sin} }}]\n")
            });
            format!("[[machine.stop]]\nname = \"{name}\"\nbetween = {between}\ngap = {gap}\n{law}\n{motion}")
        })
        .boxed()
}

fn friction(n: usize) -> ProptestText {
    (body(n), value(0.0, 0.5), value(0.0, 0.3), prop::option::weighted(0.3, value(-1.0, 1.0)))
        .prop_map(|(at, sliding, more, belt)| {
            let belt = belt.map_or_else(String::new, |belt| format!("belt = {belt}\n"));
            let limit = match (sliding.parse::<f64>(), more.parse::<f64>()) {
                (Ok(a), Ok(b)) => typed(a + b),
                _ => more,
            };
            let name = "[[machine.friction]]\nname = \"rub\"";
            format!("{name}\nat = \"{at}\"\nsliding = {sliding}\nstatic = {limit}\n{belt}")
        })
        .boxed()
}

/// A machine file: one to three bodies, usually held and driven, with up to two stops and a friction joint.
pub(super) fn files() -> ProptestText {
    (1..=3_usize)
        .prop_flat_map(|n| {
            let masses = prop::collection::vec(value(0.2, 3.0), n);
            let driven = prop::option::weighted(0.85, (value(0.3, 3.0), body(n), value(-1.0, 1.0), 1..4_u32));
            let constant = prop::option::weighted(0.3, (body(n), value(-1.0, 1.0)));
            let links = prop::collection::vec(link(n), 0..=n + 1);
            let stops = (prop::option::weighted(0.9, stop(n, "one")), prop::option::weighted(0.5, stop(n, "two")));
            (masses, driven, constant, links, stops, prop::option::weighted(0.25, friction(n)))
        })
        .prop_map(|(masses, driven, constant, links, (one, two), friction)| {
            let bodies: Vec<String> =
                masses.iter().zip(BODIES).map(|(mass, name)| format!("{name} = {mass}")).collect();
            let mut text = format!("[machine]\nbodies = {{ {} }}\n", bodies.join(", "));
            if let Some((at, force)) = constant {
                text += &format!("constant = {{ {at} = {force} }}\n");
            }
            if let Some((frequency, at, force, order)) = driven {
                text += &format!(
                    "frequency = {frequency}\n[[machine.force]]\norder = {order}\nat = \"{at}\"\nsin = {force}\n"
                );
            }
            text + &links.concat() + &[one, two, friction].into_iter().flatten().collect::<String>()
        })
        .boxed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::runner;
    use proptest::strategy::ValueTree;
    use vibroimpact_study::machine::{MachineSource, no_files};

    /// Most of the files describe machines, and the others are refused with a path.
    #[test]
    fn most_files_are_machines() {
        let (mut good, total) = (0, 300);
        for k in 0..total {
            let text = files().new_tree(&mut runner(1, "machines", k)).unwrap().current();
            match MachineSource::from_text(&text, no_files).and_then(|source| source.machine()) {
                Ok(_) => good += 1,
                Err(why) => assert!(!why.path.is_empty(), "{text}\n{why}"),
            }
        }
        assert!(good > total / 3 && good < total, "{good}");
    }
}
