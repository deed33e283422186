use super::{Document, TextError};
use crate::machine::Named;
use serde::Deserialize;

#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct All {
    real: f64,
    whole: u64,
    part: Option<i64>,
    table: Named<f64>,
    pair: Option<[f64; 2]>,
    word: Option<Word>,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Word {
    Alone,
    With { a: f64 },
}

fn read(text: &str) -> Result<All, TextError> {
    Document::parse(text).and_then(|document| document.read())
}

#[test]
fn numbers_keep_all_bits() {
    for real in [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 2.2250738585072014e-308, 9007199254740993e3, 1e22] {
        for text in [format!("real = {real:?}"), format!("{{\"real\":{real:?}}}")] {
            assert_eq!(read(&text).unwrap().real.to_bits(), real.to_bits(), "{text}");
        }
    }
    for text in [
        "whole = 18446744073709551615\npart = -9223372036854775808",
        "{\"whole\":18446744073709551615,\"part\":-9223372036854775808}",
    ] {
        let all = read(text).unwrap();
        assert_eq!((all.whole, all.part), (u64::MAX, Some(i64::MIN)));
    }
    assert!(read("real = -inf").unwrap().real == f64::NEG_INFINITY && read("real = nan").unwrap().real.is_nan());
    assert_eq!(read("{\"real\":3,\"part\":null}").unwrap(), All { real: 3.0, ..All::default() });
    for text in ["whole = 18446744073709551616", "whole = -1", "part = 9223372036854775808"] {
        let (error, number) = (read(text).unwrap_err().to_string(), text.rsplit(' ').next().unwrap());
        assert!(error.contains(number) && error.contains("line 1, column "), "{error}");
    }
}

#[test]
fn names_keep_their_order() {
    for text in
        ["table = { z = 1, a = 2, m = 3 }", "{\"table\":{\"z\":1,\"a\":2,\"m\":3}}", "[table]\nz = 1\na = 2\nm = 3"]
    {
        assert_eq!(read(text).unwrap().table.names(), ["z", "a", "m"]);
    }
}

/// The position is that of the value, or of the name if that is wrong.
#[test]
fn errors_have_a_path_and_a_position() {
    for (text, error) in [
        (
            "real = 1\nword = { with = { a = true } }",
            "word.with.a: invalid type: boolean `true`, expected a number (line 2, column 23)\n  |\n2 | word = { with = { a = true } }\n  |                       ^^^^",
        ),
        (
            "{\"real\": 1,\r\n\t\"word\": {\"with\": {\"\\u0061\": true}}}",
            "word.with.a: invalid type: boolean `true`, expected a number (line 2, column 30)\n  |\n2 |  \"word\": {\"with\": {\"\\u0061\": true}}}\n  |                              ^^^^",
        ),
        (
            "{\"ü\": 1}",
            "ü: unknown field `ü`, expected one of `real`, `whole`, `part`, `table`, `pair`, `word` (line 1, column 2)\n  |\n1 | {\"ü\": 1}\n  |  ^^^",
        ),
        ("{\"real\": 1, \"real\": 2}", "real: `real` is written twice (line 1, column 13)"),
        ("{\"table\": {\"a\": 1, \"a\": 2}}", "table: `a` is written twice (line 1, column 11)"),
        ("{\"real\": null}", "real: invalid type: null, expected a number (line 1, column 10)"),
        ("pair = [1, 2, 3]", "pair: invalid length 3, expected 2 items (line 1, column 8)"),
        ("pair = [1, \"b\"]", "pair.2: invalid type: string \"b\", expected a number (line 1, column 12)"),
        ("table = { \"a b\" = [] }", "table.a_b: invalid type: sequence, expected a number (line 1, column 19)"),
        ("word = \"with\"", "word: invalid type: a word alone, expected a table (line 1, column 8)"),
        ("word.alone = 1", "word.alone: invalid type: integer `1`, expected a word alone (line 1, column 14)"),
        ("word = {}", "word: 0 names are in this table, and one is needed: alone, with (line 1, column 8)"),
        ("{\"real\": 1}}", "line 1, column 12: the text does not end here\n  |\n1 | {\"real\": 1}}\n  |            ^"),
        ("real = 1\nreal = 2", "line 2, column 1: duplicate key"),
        ("{", "line 1, column "),
    ] {
        let message = read(text).unwrap_err().to_string();
        assert!(message.starts_with(error), "{message}\nwanted\n{error}");
    }
}

#[test]
fn long_lines_are_cut_around_the_position() {
    let numbers = "1, ".repeat(100);
    let error = read(&format!("pair = [{numbers}]")).unwrap_err().to_string();
    assert!(error.lines().all(|line| line.chars().count() <= 110), "{error}");
    let error = read(&format!("table = {{ {} b = true }}", " ".repeat(300))).unwrap_err();
    let place = error.place.clone().unwrap();
    assert_eq!((place.line, place.column), (1, 316));
    assert!(place.lines.contains("b = true }\n") && place.lines.ends_with("^^^^"), "{error}");
    let word = "x".repeat(5000);
    assert!(read(&format!("real = \"{word}\"")).unwrap_err().message.contains("string that begins \"xxx"));
}
