//! Machine files, also with difficult numbers, and paths of numbers in machines.

use crate::machines::file;
use crate::plan::Written;
use crate::values::ProptestText;
use proptest::prelude::*;
use vibroimpact_cases::FAMILIES;
use vibroimpact_study::machine::CATALOGUE;

/// The name of the machine file of a case.
pub(super) const FILE: &str = "drawn.toml";

/// Numbers of which many machines have some, and some names that none of them has.
pub(super) const PATHS: &[&str] = &[
    "frequency",
    "frequency",
    "mass.first",
    "stiffness.first",
    "stop.stop.gap",
    "stop.one.gap",
    "stop.one.restitution",
    "stop.anvil.gap",
    "force.1.sin.first",
    "friction.rub.sliding",
    "omega",
    "eps",
    "stop.one",
    "",
];
/// Numbers of a start by path.
pub(super) const STARTS: &[&str] = &["phase", "q.first", "qdot.first", "q.head", "q.mass", "q.x", "x", ""];

/// The text of a machine of the catalogue, or of a family of degenerate machines; of some, parts are other ones or missing.
pub(super) fn files() -> ProptestText {
    let of_catalogue = prop::sample::select(CATALOGUE).prop_map(|entry| entry.text.to_owned());
    let of_family = (0..FAMILIES.len(), any::<u16>())
        .prop_map(|(family, seed)| file(&FAMILIES[family].case(seed.into())).to_toml());
    let tree =
        prop_oneof![1 => of_catalogue, 2 => of_family].prop_map(|text| toml::from_str(&text).unwrap_or_default());
    Written::of(tree.boxed()).prop_map(|written| written.toml()).boxed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::runner;
    use proptest::strategy::ValueTree;
    use vibroimpact_study::machine::{MachineSource, no_files};

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
