//! Errors of texts: where something is wrong, and what is expected there.

use super::place::TextPlace;
use core::fmt;

/// A text that cannot be read as what is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// The path of the part that is wrong, as `stop.wall.gap`; empty for the whole and where the text cannot be parsed.
    pub path: String,
    /// What is wrong, and what is expected. A line of it that begins with `hint: ` is a hint.
    pub message: String,
    /// Where it is in the text.
    pub place: Option<Box<TextPlace>>,
}

impl TextError {
    pub(super) fn new(path: String, message: &str, place: Option<TextPlace>) -> Self {
        Self { path, message: plain(message), place: place.map(Box::new) }
    }

    /// The same without a position, for a text that the user has not written.
    #[must_use]
    pub fn without_place(self) -> Self {
        Self { place: None, ..self }
    }

    /// The path or, where there is none, the position.
    pub(crate) fn head(&self) -> Option<String> {
        if self.path.is_empty() { self.place.as_ref().map(ToString::to_string) } else { Some(self.path.clone()) }
    }

    /// All that follows the head: the message, the line of the text, and hints.
    pub(crate) fn body(&self) -> String {
        let (message, hint) = self.message.split_at(self.message.find("\nhint: ").unwrap_or(self.message.len()));
        match &self.place {
            Some(place) if self.path.is_empty() => format!("{message}\n{}{hint}", place.lines),
            Some(place) => format!("{message} ({place})\n{}{hint}", place.lines),
            None => self.message.clone(),
        }
    }
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.head() {
            Some(head) => write!(f, "{head}: {}", self.body()),
            None => f.write_str(&self.body()),
        }
    }
}

impl core::error::Error for TextError {}

/// Characters of a message.
const WIDTH: usize = 400;

/// The message of a parser in plain words: without names of types of this program, in one line, cut where it is long.
/// Hints have lines of their own.
fn plain(message: &str) -> String {
    const WORDS: [(&str, &str); 13] = [
        ("floating point `", "number `"),
        ("expected f64", "expected a number"),
        ("expected u32", "expected a whole number, 0 or more"),
        ("expected u64", "expected a whole number, 0 or more"),
        ("expected unit variant", "expected a word alone"),
        ("expected newtype variant", "expected a table"),
        ("expected struct variant", "expected a table"),
        ("expected struct", "expected a table"),
        ("expected enum", "expected a word or a table"),
        ("expected unit", "expected a word alone"),
        ("unit variant", "a word alone"),
        ("newtype variant", "a table"),
        ("struct variant", "a table"),
    ];
    let mut text = String::new();
    for line in message.lines() {
        let line: String = line.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(WIDTH).collect();
        let gap = if text.is_empty() {
            ""
        } else if line.starts_with("hint: ") {
            "\n"
        } else {
            " "
        };
        text = text + gap + &line;
    }
    WORDS.into_iter().fold(text, |text, (inside, word)| {
        let mut parts = text.split(inside);
        let first = parts.next().unwrap_or_default().to_owned();
        // the name of a type is removed together with its kind
        let named = |rest: &str| match rest.strip_prefix(' ') {
            Some(name) if inside.contains("variant") || inside.contains("struct") || inside.contains("enum") => {
                let kind = name.starts_with(|c: char| c.is_ascii_uppercase());
                let end = if kind { name.find([' ', '\n']).unwrap_or(name.len()) } else { 0 };
                if kind { name[end..].to_owned() } else { rest.to_owned() }
            }
            _ => rest.to_owned(),
        };
        parts.fold(first, |told, rest| told + word + &named(rest))
    })
}
