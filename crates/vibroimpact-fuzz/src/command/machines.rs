//! Machine files, also with difficult numbers, and questions about them and about machines of the catalogue.

use super::parts::{Words, flag, line, outputs, switch, word};
use crate::plan::Written;
use crate::values::{ProptestText, count, label, odd, plain};
use proptest::prelude::*;
use vibroimpact_cases::FAMILIES;
use vibroimpact_study::machine::{CATALOGUE, MachineSource, no_files};

/// The name of the machine file of a case.
pub(super) const FILE: &str = "drawn.toml";

/// Names that few machines have.
const PATHS: &[&str] = &["frequency", "stop.one.gap", "stop.anvil.gap", "omega", "stop.one", "q.a", ""];
const STARTS: &[&str] = &["phase", "q.head", "q.mass", "x", ""];

/// The text of a machine of the catalogue, or of a family of degenerate machines; of some, parts are other ones or missing.
fn files() -> ProptestText {
    let of_catalogue = prop::sample::select(CATALOGUE).prop_map(|entry| entry.text.to_owned());
    let of_family =
        (0..FAMILIES.len(), any::<u16>()).prop_map(|(family, seed)| FAMILIES[family].case(seed.into()).toml());
    let tree =
        prop_oneof![1 => of_catalogue, 2 => of_family].prop_map(|text| toml::from_str(&text).unwrap_or_default());
    Written::of(tree.boxed()).prop_map(|written| written.toml()).boxed()
}

/// A machine file, and any command line about it or about a machine of the catalogue.
pub(super) fn asked() -> BoxedStrategy<(String, Vec<String>)> {
    let with_line = |text: String| {
        let source = MachineSource::from_text(&text, no_files);
        let paths = source.as_ref().ok().and_then(|source| source.paths().ok()).unwrap_or_default();
        let coordinates = source.and_then(|source| source.machine()).map(|machine| machine.parts().coordinates.clone());
        let starts =
            coordinates.unwrap_or_default().into_iter().flat_map(|name| [format!("q.{name}"), format!("qdot.{name}")]);
        let lines = lines(&known(paths, PATHS), &known(starts.collect(), STARTS));
        (Just(text), lines)
    };
    files().prop_flat_map(with_line).boxed()
}

/// Names of a machine, most of them, and names that none or only some other has.
fn known(names: Vec<String>, others: &'static [&'static str]) -> ProptestText {
    let other = word(others);
    if names.is_empty() { other } else { prop_oneof![9 => prop::sample::select(names), 1 => other].boxed() }
}

/// Any command line about a machine with numbers and starts of these names.
fn lines(paths: &ProptestText, starts: &ProptestText) -> Words {
    let machine =
        || {
            flag("machine", 1.0, prop_oneof![
            12 => word(&[FILE]),
            3 => word(&["two-mass-hammer", "soft-stop", "impact-damper", "bouncing-ball", "capsule", "sdnd101"]),
            1 => word(&["machine.toml", "bad.toml", "plan.toml", "none", "", "."]),
        ].boxed())
        };
    let few = || prop_oneof![6 => word(&["1", "2", "5"]), 1 => count()].boxed();
    let budget = || flag("impacts", 0.9, word(&["60", "200", "400", "0", "-1"]));
    let path = || prop_oneof![9 => paths.clone(), 1 => odd()].boxed();
    let named = |path, value| (path, value).prop_map(|(path, value)| format!("{path}={value}")).boxed();
    let set = || flag("set", 0.2, prop_oneof![19 => named(path(), plain()), 1 => odd()].boxed());
    let start = || {
        let list = || prop::collection::vec(plain(), 1..4).prop_map(|list| list.join(",")).boxed();
        super::parts::all(vec![flag("q", 0.2, list()), flag("qdot", 0.2, list()), flag("phase", 0.2, plain())])
    };
    let axis = |names: &ProptestText| {
        let axis = (names.clone(), crate::values::range(-0.5, 1.5)).prop_map(|(path, over)| format!("{path}={over}"));
        flag("axis", 0.97, axis.boxed())
    };
    let stored = || flag("store", 0.15, word(&["s.zarr", "thesis.zarr", "", "plan.toml"]));
    prop_oneof![
        4 => line("settle", vec![machine(), set(), start(), budget(), outputs("csv")]),
        4 => line("simulate", vec![machine(), set(), start(), flag("impacts", 0.8, word(&["1", "40", "300", "0"])),
            flag("periods", 0.2, plain()), outputs("csv")]),
        2 => line("attractors", vec![machine(), set(), flag("starts", 0.97, few()), budget(), outputs("csv")]),
        1 => line("orbit", vec![machine(), set(), flag("label", 0.98, label()), switch("json", 0.6)]),
        2 => line("lyapunov", vec![machine(), set(), start(), flag("impacts", 1.0, word(&["60", "300", "24"])),
            flag("transient", 1.0, word(&["10", "0", "-1"])), flag("points", 0.2, word(&["3", "40", "0"])),
            outputs("csv")]),
        2 => line("branch", vec![machine(), set(), start(), flag("vary", 0.98, path()),
            flag("to", 0.98, prop_oneof![4 => plain(), 1 => word(&["0.2,1.5", "1.5,0.1"])].boxed()),
            flag("also", 0.2, named(path(), plain())), flag("label", 0.3, label()), flag("orbit", 0.1, count()),
            flag("follow", 0.1, word(&["1", "2"])), switch("no-diagram", 0.05),
            flag("points", 1.0, word(&["2", "5", "12", "1"])), outputs("csv")]),
        2 => line("basin", vec![machine(), set(), axis(starts), axis(starts), budget(), stored(), outputs("csv")]),
        2 => line("map", vec![machine(), set(), axis(paths), axis(paths), flag("starts", 0.97, few()), budget(), stored(),
            outputs("csv")]),
        2 => line("diagram", vec![machine(), set(), flag("vary", 0.97, path()),
            flag("over", 0.97, prop_oneof![3 => crate::values::range(0.2, 1.5), 1 => word(&["0.3,0.5,1.2", "1.2,0.4", "0.5,0.5", "0.5,x"])].boxed()),
            flag("also", 0.1, named(path(), word(&["1:2", "0.4:0.2", "1"]))),
            flag("show", 0.3, word(&["speed", "q.a", "qdot.b", "x", ""])),
            flag("direction", 0.2, word(&["up", "down", "scatter"])), flag("transient", 1.0, word(&["10", "0", "30"])),
            flag("keep", 1.0, word(&["5", "1", "0"])), stored(), outputs("csv")]),
        1 => line("machine", vec![word(&["show"]).prop_map(|word| vec![word]).boxed(),
            word(&[FILE]).prop_map(|word| vec![word]).boxed(), set(), switch("toml", 0.3), switch("json", 0.4)]),
    ]
    .boxed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::runner;
    use proptest::strategy::ValueTree;

    /// Many of the files describe machines, and many do not.
    #[test]
    fn many_files_are_machines() {
        let mut good = 0;
        for k in 0..300 {
            let text = files().new_tree(&mut runner(1, "machines", k)).unwrap().current();
            let machine = MachineSource::from_text(&text, no_files).and_then(|source| source.machine());
            good += usize::from(machine.is_ok());
        }
        assert!((100..250).contains(&good), "{good} of 300");
    }
}
