//! Machine files with random damage: no panic, and one sentence with a path or a place in the text.

use proptest::prelude::*;
use vibroimpact_study::machine::{CATALOGUE, MachineSource};

/// Pieces that are put in place of others.
const PIECES: [&str; 40] = [
    "",
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    "\"",
    "'",
    "\n",
    ".",
    "#",
    "0",
    "-1",
    "1e400",
    "nan",
    "inf",
    "-0.0",
    "1e-320",
    "true",
    "ground",
    "tip",
    "machine",
    "[[machine.stop]]\n",
    "[[machine.mode]]\n",
    "[machine.bodies]\n",
    "\nmass = [[1, 2], [3]]\n",
    "\nmodes = \"x.csv\"\n",
    "\nmodal_damping = [1, 2]\n",
    "\"1/0\"",
    "\"((((\"",
    "\"mu mu\"",
    "ü\u{7f}",
    "\u{0}",
    "order = 4294967296",
    "order = 0",
    "[[[[[[[[",
    "stiffness = 1e308\n",
    "\nname = \"a.b\"\n",
    "restitution",
];

fn damaged() -> impl Strategy<Value = String> {
    let damage = (any::<prop::sample::Index>(), 0usize..12, 0..PIECES.len(), any::<prop::sample::Index>());
    (0..CATALOGUE.len(), prop::collection::vec(damage, 1..4)).prop_map(|(which, damages)| {
        let mut text: Vec<char> = CATALOGUE[which].text.chars().collect();
        for (place, length, piece, other) in damages {
            let start = place.index(text.len() + 1);
            let end = (start + length).min(text.len());
            if length == 11 {
                // a line moves to another place
                let from = other.index(text.len() + 1);
                let line: Vec<char> = text[from..].iter().copied().take_while(|c| *c != '\n').collect();
                text.splice(start..start, line);
            } else {
                text.splice(start..end, PIECES[piece].chars());
            }
        }
        text.into_iter().collect()
    })
}

/// A line of the text with its number, or the mark below it.
fn is_of_the_text(line: &str) -> bool {
    line.split_once(" |").is_some_and(|(number, _)| number.trim().is_empty() || number.parse::<u32>().is_ok())
}

/// Words of the program that say nothing to a user.
const INSIDE: [&str; 6] = ["f64", "u32", "struct ", "variant", "WrittenMachine", "Option<"];

/// A line without what it quotes of the text, such as `14.13inf647`.
fn own(line: &str) -> String {
    line.split('`').step_by(2).collect()
}

/// One sentence with a path or a place; the lines after it are the line of the text and hints.
fn is_explained(told: &str) -> bool {
    let mut lines = told.lines();
    let first = lines.next().unwrap_or_default();
    let path = first.split_once(": ").map_or("", |(path, _)| path);
    let place = path.strip_prefix("line ").and_then(|rest| rest.split_once(", column "));
    let counted = place.is_some_and(|(line, column)| line.parse::<u32>().is_ok() && column.parse::<u32>().is_ok());
    !path.is_empty()
        && (counted || !path.contains(char::is_whitespace))
        && first.chars().count() < 600
        && lines.all(|line| line.starts_with("hint: ") || is_of_the_text(line))
        && told
            .lines()
            .filter(|line| !is_of_the_text(line))
            .all(|line| !INSIDE.iter().any(|word| own(line).contains(word)))
}

/// Found at random: the machine was accepted, and its expansion was not.
#[test]
fn a_start_of_a_coordinate_that_is_not_there_is_refused_with_the_machine() {
    let text = "start.qdot.\"1e-320mass\" = 1\n[machine]\nbodies = { mass = 1 }\n";
    let source = MachineSource::from_text(text, vibroimpact_study::machine::no_files).unwrap();
    let told = source.machine().unwrap_err().to_string();
    assert!(is_explained(&told) && told.starts_with("start.qdot.1e-320mass: "), "{told}");
    assert_eq!(source.expansion().unwrap_err().to_string(), told);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damage_is_explained(text in damaged()) {
        let files = |name: &str| if name == "x.csv" { Ok("frequency,tip\n1,2\n".to_owned()) } else { Err("is not there".to_owned()) };
        match MachineSource::from_text(&text, files) {
            Err(error) => prop_assert!(is_explained(&error.to_string()), "{error}\n{text}"),
            Ok(source) => match source.machine() {
                Err(error) => prop_assert!(is_explained(&error.to_string()), "{error}\n{text}"),
                // what is accepted can be printed and read again
                Ok(machine) => {
                    let printed = source.expansion().unwrap().to_toml();
                    let again = MachineSource::from_text(&printed, files).unwrap().machine().unwrap();
                    prop_assert_eq!(again, machine);
                }
            },
        }
    }

    #[test]
    fn any_text_is_explained(text in "\\PC{0,80}", brace in any::<bool>()) {
        let text = if brace { format!("{{{text}") } else { text };
        let told = MachineSource::from_text(&text, vibroimpact_study::machine::no_files).unwrap_err().to_string();
        prop_assert!(is_explained(&told), "{told}\n{text}");
    }

    #[test]
    fn any_expression_is_explained(text in "[-+*/^()0-9.eEa-z \\PC]{0,60}") {
        // an error names what was written
        prop_assume!(!INSIDE.iter().any(|word| text.contains(word)));
        let file = format!("[machine]\nbodies = {{ a = {} }}\n", toml::Value::from(text));
        if let Err(error) = MachineSource::from_text(&file, vibroimpact_study::machine::no_files).unwrap().machine() {
            prop_assert!(is_explained(&error.to_string()), "{error}");
        }
    }
}
