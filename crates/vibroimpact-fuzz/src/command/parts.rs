//! Parts of a command line: flags with their values, systems, starts, outputs, and unexpected words.

use crate::system::{self, SystemValues};
use crate::values::{ProptestText, file, number, odd, range, restitution, typed};
use proptest::prelude::*;

/// Words of a command line.
pub(super) type Words = BoxedStrategy<Vec<String>>;

/// `--name=value` with this probability.
pub(super) fn flag(name: &'static str, often: f64, value: ProptestText) -> Words {
    let given = value.prop_map(move |value| vec![format!("--{name}={value}")]);
    sometimes(often, given.boxed())
}

/// `--name` with this probability.
pub(super) fn switch(name: &'static str, often: f64) -> Words {
    sometimes(often, Just(vec![format!("--{name}")]).boxed())
}

fn sometimes(often: f64, words: Words) -> Words {
    if often >= 1.0 {
        return words;
    }
    prop::option::weighted(often, words).prop_map(Option::unwrap_or_default).boxed()
}

/// One of these words.
pub(super) fn word(words: &'static [&'static str]) -> ProptestText {
    prop::sample::select(words).prop_map(str::to_owned).boxed()
}

/// Values as flags.
#[must_use]
pub(super) fn flags(values: &SystemValues) -> Vec<String> {
    values.iter().map(|(name, value)| format!("--{}={value}", name.replace('_', "-"))).collect()
}

/// A system; one in ten in physical units.
pub(super) fn system() -> Words {
    prop_oneof![9 => system::system().prop_map(|values| flags(&values)), 1 => machine()].boxed()
}

fn positive() -> ProptestText {
    let with_unit = word(&["1.5mm", "12 N/mm", "900rpm", "2 %", "0.5 g", "20 g mm", "3 furlongs", "1,5 mm"]);
    prop_oneof![16 => (0.05..20.0_f64).prop_map(typed), 2 => number(), 1 => with_unit].boxed()
}

/// The mass, spring, force, gap and restitution of a system in physical units, of which something may be missing.
fn machine_without_frequency() -> Words {
    all(vec![
        flag("mass-kg", 0.97, positive()),
        flag("stiffness-n-per-m", 0.97, positive()),
        flag("force-n", 0.97, positive()),
        flag("gap-m", 0.97, prop_oneof![(-0.1..0.5_f64).prop_map(typed), number()].boxed()),
        flag("restitution", 0.97, restitution()),
    ])
}

/// A system in physical units of which one or two numbers vary over ranges.
pub(super) fn machine_with_ranges() -> Words {
    const NUMBERS: [&str; 10] = [
        "mass-kg",
        "stiffness-n-per-m",
        "force-n",
        "frequency-hz",
        "gap-m",
        "damping-ns-per-m",
        "unbalance-kg-m",
        "base-acceleration-m-per-s2",
        "constant-force-n",
        "gravity-m-per-s2",
    ];
    let over =
        prop_oneof![6 => range(0.1, 3.0), 1 => word(&["1 mm:2 mm:3", "1N:2N:2", "15Hz:25Hz:2", "0.5:2", "2 %:4 %:2"])];
    let varied = prop::collection::vec((prop::sample::select(NUMBERS.to_vec()), over), 1..3);
    (varied, machine())
        .prop_map(|(over, mut words)| {
            let is = |word: &String, name: &str| word.starts_with(&format!("--{name}="));
            words.retain(|word| !over.iter().any(|(name, _)| is(word, name)) && !is(word, "units"));
            words.extend(over.into_iter().map(|(name, range)| format!("--{name}={range}")));
            words
        })
        .boxed()
}

/// What drives a machine besides its force.
fn excitation() -> Words {
    let all = all(vec![
        flag("base-displacement-m", 0.4, positive()),
        flag("base-acceleration-m-per-s2", 0.1, positive()),
        switch("stop-in-space", 0.3),
        flag("stop-displacement-m", 0.1, positive()),
        flag("unbalance-kg-m", 0.2, positive()),
        flag("constant-force-n", 0.2, number()),
        flag("gravity-m-per-s2", 0.2, number()),
    ]);
    prop_oneof![4 => Just(Vec::new()), 1 => all].boxed()
}

/// A system in physical units, of which something may be missing.
pub(super) fn machine() -> Words {
    let parts: Vec<Words> = vec![
        machine_without_frequency(),
        flag("frequency-hz", 0.95, positive()),
        flag("omega-rad-per-s", 0.05, positive()),
        excitation(),
        flag("damping-ns-per-m", 0.4, positive()),
        flag("second-gap-m", 0.2, positive()),
        flag("gaps-m", 0.03, positive()),
        flag("log-decrement", 0.05, positive()),
        flag("units", 0.6, word(&["si", "nondimensional", "imperial"])),
        flag("gap", 0.03, number()),
    ];
    all(parts)
}

/// The flags of a start.
pub(super) fn start() -> Words {
    system::start().prop_map(|values| flags(&values)).boxed()
}

/// The flags of outputs: a table, a figure, JSON.
pub(super) fn outputs(table: &'static str) -> Words {
    const TABLES: &[&str] = &[".csv", ".csv", ".txt"];
    const FIGURES: &[&str] = &[".svg", ".svg", ".png", ".jpg"];
    let table_to = prop_oneof![2 => file(TABLES), 1 => Just("-".to_owned())].boxed();
    let table = if table.is_empty() { Just(Vec::new()).boxed() } else { flag(table, 0.15, table_to) };
    let look = all(vec![
        flag("title", 0.1, word(&["a title", "", "*x*_2"])),
        flag("size", 0.3, word(&["85x60mm", "8cmx5cm", "3x2in", "0x1mm", "x"])),
        flag("dpi", 0.2, word(&["72", "600", "0", "1e9"])),
        flag("x-limits", 0.2, word(&["0:1", "1:0", "0:0", "-1e308:1e308", "a"])),
        flag("y-limits", 0.2, word(&["-1:1", "0", ""])),
        switch("greyscale", 0.2),
    ]);
    let figure =
        prop_oneof![4 => flag("plot", 0.1, file(FIGURES)), 1 => all(vec![flag("plot", 0.6, file(FIGURES)), look])];
    all(vec![table, figure.boxed(), switch("json", 0.5)])
}

/// The words of several parts, in order.
pub(super) fn all(parts: Vec<Words>) -> Words {
    parts.prop_map(|parts| parts.concat()).boxed()
}

/// A command line: its verb, its parts, the global options, and sometimes an additional, repeated or truncated word.
pub(super) fn line(verb: impl Into<String>, parts: Vec<Words>) -> Words {
    let verb = verb.into();
    let usual = all(vec![
        flag("threads", 0.1, word(&["0", "1", "3", "1024", "1025", "-1", "x"])),
        switch("quiet", 0.2),
        switch("force", 0.05),
    ]);
    let spoil = prop::option::weighted(0.06, (any::<prop::sample::Index>(), 0..5_u8, odd()));
    (all(parts), usual, spoil)
        .prop_map(move |(parts, usual, spoil)| {
            let mut line: Vec<String> = [verb.clone()].into_iter().chain(parts).chain(usual).collect();
            let Some((place, how, odd)) = spoil else { return line };
            let k = place.index(line.len());
            match how {
                0 => line.insert(k + 1, odd),
                1 => line.insert(k + 1, format!("--{odd}")),
                2 => line.push(line[k].clone()),
                3 => {
                    let kept = line[k].chars().count() / 2;
                    line[k] = line[k].chars().take(kept).collect();
                }
                _ => line[k].push_str(&odd),
            }
            // no operating system passes a word with this character
            line.iter_mut().for_each(|word| word.retain(|c| c != '\0'));
            line
        })
        .boxed()
}
