//! Machines as text.

use core::fmt::Write;
use vibroimpact_report::number::short;
use vibroimpact_study::machine::{MachineSource, Named};

/// The width of a paragraph.
const WIDTH: usize = 110;

/// The names of the catalogue with their titles.
pub(crate) fn list<'a>(entries: impl Iterator<Item = (&'a str, &'a str)> + Clone) -> String {
    let wide = entries.clone().map(|(name, _)| name.len()).max().unwrap_or(0);
    entries.map(|(name, title)| format!("{name:<wide$}  {title}\n")).collect()
}

/// The text of a machine: where it comes from, its numbers by path, and its expansion.
pub(crate) fn machine(name: &str, source: &MachineSource, numbers: &Named<f64>, expansion: &MachineSource) -> String {
    let mut text = match &source.title {
        Some(title) => format!("{name}: {title}\n"),
        None => format!("{name}\n"),
    };
    for (head, body) in [("", &source.summary), ("source: ", &source.source)] {
        if let Some(body) = body {
            text += &paragraph(&format!("{head}{body}"));
        }
    }
    let wide = numbers.names().iter().map(|path| path.len()).max().unwrap_or(0).max(4);
    let _ = writeln!(text, "  {:<wide$}  value", "path");
    for (path, value) in &numbers.0 {
        let _ = writeln!(text, "  {path:<wide$}  {}", short(*value));
    }
    // the head is above already
    let bare = MachineSource { machine: expansion.machine.clone(), ..MachineSource::default() };
    text + "\nexpansion\n" + &bare.to_toml()
}

/// Lines of a sentence.
fn paragraph(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last().map_or(0, |line| line.chars().count());
        if line > 0 && line + word.chars().count() >= WIDTH {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paragraphs_lose_no_word() {
        let text = "word ".repeat(60);
        let lines = paragraph(&text);
        assert_eq!(lines.split_whitespace().count(), 60);
        assert!(lines.lines().all(|line| line.len() <= WIDTH) && lines.lines().count() == 3, "{lines}");
        assert_eq!(paragraph(&"x".repeat(200)).lines().count(), 1);
    }
}
