//! `cargo xtask links`: every relative link in a Markdown file leads to a file or folder of this
//! repository, and, where it names one, to a heading in it.
//!
//! It reads `[text](target)`, `[name]: target`, `src="target"` and `href="target"`, outside code.
//! Addresses with a scheme are not visited: a check must not depend on the network. It does not
//! read headings underlined with `===`, nor a target on another line than its bracket.

use std::collections::HashMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Folders that hold what was built, besides the hidden ones.
const BUILT: &[&str] = &["target", "out", "node_modules"];

/// Checks the Markdown files of the repository.
///
/// # Errors
/// A line for each link that leads nowhere: file, line number, target and what is wrong.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    let mut files = Vec::new();
    collect(root, &mut files).map_err(|error| format!("the repository cannot be read: {error}"))?;
    files.sort();
    let mut number = 0;
    let mut faults = Vec::new();
    for file in &files {
        let shown = file.strip_prefix(root).unwrap_or(file).display();
        let text = fs::read_to_string(file).map_err(|error| format!("{shown} cannot be read: {error}"))?;
        for (line, target) in links(&text) {
            if is_elsewhere(&target) {
                continue;
            }
            number += 1;
            if let Some(why) = fault(root, file, &target) {
                faults.push(format!("{shown}:{line}: link to `{target}`: {why}"));
            }
        }
    }
    if faults.is_empty() {
        Ok(format!("{number} relative links in {} Markdown files lead somewhere", files.len()))
    } else {
        Err(faults.join("\n"))
    }
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let kind = entry.file_type()?;
        if kind.is_dir() && !name.starts_with('.') && !BUILT.contains(&name.as_ref()) {
            collect(&entry.path(), files)?;
        } else if kind.is_file() && name.ends_with(".md") {
            files.push(entry.path());
        }
    }
    Ok(())
}

/// The lines outside fenced code, with their numbers from 1 and without code between backticks.
fn prose(text: &str) -> impl Iterator<Item = (usize, String)> + '_ {
    let mut fence: Option<(char, usize)> = None;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let start = line.trim_start();
        let mark = start.chars().next().filter(|c| matches!(c, '`' | '~'));
        let length = mark.map_or(0, |mark| start.chars().take_while(|&c| c == mark).count());
        match (fence, mark) {
            (None, Some(mark)) if length >= 3 => fence = Some((mark, length)),
            (Some((open, least)), Some(mark)) if mark == open && length >= least => fence = None,
            (None, _) => return Some((index + 1, without_code(line))),
            (Some(_), _) => {}
        }
        None
    })
}

/// The line without what stands between equally long runs of backticks.
fn without_code(line: &str) -> String {
    let mut plain = String::new();
    let mut rest = line;
    while let Some(start) = rest.find('`') {
        plain.push_str(&rest[..start]);
        let run = rest[start..].len() - rest[start..].trim_start_matches('`').len();
        let after = &rest[start + run..];
        match closing(after, run) {
            Some(end) => rest = &after[end..],
            None => {
                plain.push_str(&rest[start..start + run]);
                rest = after;
            }
        }
    }
    plain.push_str(rest);
    plain
}

/// Where the text goes on after the first run of exactly `run` backticks.
fn closing(text: &str, run: usize) -> Option<usize> {
    let mut at = 0;
    while let Some(found) = text[at..].find('`') {
        let start = at + found;
        let length = text[start..].len() - text[start..].trim_start_matches('`').len();
        at = start + length;
        if length == run {
            return Some(at);
        }
    }
    None
}

/// The targets of all links in a Markdown text, with their line numbers from 1.
fn links(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (number, line) in prose(text) {
        for (start, mark) in line.match_indices("](") {
            if let Some(target) = destination(&line[start + mark.len()..]) {
                found.push((number, target));
            }
        }
        if let Some((name, after)) = line.trim_start().strip_prefix('[').and_then(|rest| rest.split_once("]: "))
            && !name.starts_with('^')
            && let Some(target) = after.split_whitespace().next()
        {
            found.push((number, target.trim_matches(['<', '>']).to_owned()));
        }
        for mark in [" src=\"", " href=\""] {
            for (start, _) in line.match_indices(mark) {
                if let Some((target, _)) = line[start + mark.len()..].split_once('"') {
                    found.push((number, target.to_owned()));
                }
            }
        }
    }
    found
}

/// The target at the start of `text`, which follows `](`: up to the bracket that closes it, or to
/// a title; in pointed brackets it may hold blanks.
fn destination(text: &str) -> Option<String> {
    let text = text.trim_start();
    if let Some(pointed) = text.strip_prefix('<') {
        return pointed.split_once('>').map(|(target, _)| target.to_owned());
    }
    let mut depth = 0_usize;
    let end = text.find(|c: char| {
        match c {
            '(' => depth += 1,
            ')' if depth == 0 => return true,
            ')' => depth -= 1,
            _ => {}
        }
        c.is_whitespace()
    })?;
    Some(text[..end].to_owned())
}

/// True for an address with a scheme (`https:`, `mailto:`) or a host (`//...`).
fn is_elsewhere(target: &str) -> bool {
    target.starts_with("//")
        || target.split_once(':').is_some_and(|(scheme, _)| {
            scheme.starts_with(|c: char| c.is_ascii_alphabetic())
                && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
        })
}

/// What is wrong with a relative link from `file`; `None` where it leads somewhere.
fn fault(root: &Path, file: &Path, target: &str) -> Option<String> {
    let (path, heading) = target.split_once('#').unwrap_or((target, ""));
    let path = decoded(path);
    let goal = if path.is_empty() {
        file.to_path_buf()
    } else if let Some(from_root) = path.strip_prefix('/') {
        normal(&root.join(from_root))
    } else {
        normal(&file.with_file_name("").join(&path))
    };
    if !goal.starts_with(root) {
        return Some("it leads out of the repository".to_owned());
    }
    if !goal.exists() {
        return Some("there is no such file".to_owned());
    }
    let is_markdown = goal.extension().is_some_and(|extension| extension == "md");
    if heading.is_empty() || !is_markdown {
        return None;
    }
    let text = fs::read_to_string(&goal).unwrap_or_default();
    (!anchors(&text).contains(&decoded(heading))).then(|| "there is no such heading".to_owned())
}

/// The path with `.` and `..` resolved by name alone.
fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                normal.pop();
            }
            part => normal.push(part),
        }
    }
    normal
}

/// The text with `%20` and its like replaced by what they stand for.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let hex = |byte: u8| char::from(byte).to_digit(16).and_then(|digit| u8::try_from(digit).ok());
        if first == b'%'
            && let [high, low, tail @ ..] = after
            && let (Some(high), Some(low)) = (hex(*high), hex(*low))
        {
            bytes.push(16 * high + low);
            rest = tail;
        } else {
            bytes.push(first);
            rest = after;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The names under which the headings of a Markdown text can be linked to, as GitHub makes them,
/// and those set by hand with `id="..."` or `name="..."`.
fn anchors(text: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut seen: HashMap<String, usize> = HashMap::new();
    // the words between backticks are part of a heading's name, so only the fences are left out
    let prose_lines: Vec<usize> = prose(text).map(|(number, _)| number).collect();
    for line in prose_lines.iter().filter_map(|number| text.lines().nth(number - 1)) {
        for mark in ["id=\"", "name=\""] {
            for (start, _) in line.match_indices(mark) {
                if let Some((name, _)) = line[start + mark.len()..].split_once('"') {
                    names.push(name.to_owned());
                }
            }
        }
        let title = line.trim_start_matches('#');
        let level = line.len() - title.len();
        if (1..=6).contains(&level) && title.starts_with(' ') {
            let name = anchor(title.trim().trim_end_matches('#').trim_end());
            let again = seen.entry(name.clone()).or_insert(0);
            names.push(if *again == 0 { name } else { format!("{name}-{again}") });
            *again += 1;
        }
    }
    names
}

fn anchor(title: &str) -> String {
    // of a link in a heading only the text counts
    let mut text = String::new();
    let mut rest = title;
    while let Some((before, after)) = rest.split_once("](") {
        text.push_str(before);
        rest = after.split_once(')').map_or("", |(_, rest)| rest);
    }
    text.push_str(rest);
    text.to_lowercase()
        .chars()
        .filter(|&c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn targets(text: &str) -> Vec<String> {
        links(text).into_iter().map(|(_, target)| target).collect()
    }

    #[test]
    fn links_of_every_form_are_found() {
        assert_eq!(targets("see [a](x.md), ![b](y.svg \"title\")"), ["x.md", "y.svg"]);
        assert_eq!(targets("[![badge](b.svg)](c.md)"), ["b.svg", "c.md"]);
        assert_eq!(targets("[a](<x y.md>) and [b](w(1).md)"), ["x y.md", "w(1).md"]);
        assert_eq!(targets("[ref]: docs/a.md \"t\"\n[^note]: words"), ["docs/a.md"]);
        assert_eq!(targets("<img width=\"3\" src=\"m.png\"><a href=\"n.md\">"), ["m.png", "n.md"]);
        assert_eq!(links("one\n\n[a](x)"), [(3, "x".to_owned())]);
    }

    #[test]
    fn code_holds_no_links() {
        assert_eq!(targets("`[a](x)` and ``[b](`y`)`` but [c](z)"), ["z"]);
        assert_eq!(targets("```text\n[a](x)\n~~~\n```\n[b](y)"), ["y"]);
        assert_eq!(targets("````\n```\n[a](x)\n````\n[b](y)"), ["y"]);
        assert_eq!(targets("a lone ` and [c](z)"), ["z"]);
        assert_eq!(targets("[`code`](z)"), ["z"]);
    }

    #[test]
    fn other_places_are_not_visited() {
        for target in ["https://doi.org/10.1/x", "mailto:a@b.c", "//host/x"] {
            assert!(is_elsewhere(target), "{target}");
        }
        for target in ["a.md", "../a.md", "#heading", "/docs/a.md", "a b:c.md"] {
            assert!(!is_elsewhere(target), "{target}");
        }
    }

    #[test]
    fn headings_become_anchors() {
        let text = "# The `vibro` command\n## Why, and how?\n## Again\n## Again ##\n\
                    ```\n# not one\n```\n### [1.2](x.md) step_by\n<a id=\"by-hand\"></a>\n#no";
        assert_eq!(anchors(text), ["the-vibro-command", "why-and-how", "again", "again-1", "12-step_by", "by-hand"]);
    }

    #[test]
    fn a_link_resolves_or_says_why_not() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        fs::create_dir_all(root.join("docs")).unwrap();
        fs::write(root.join("README.md"), "# Top\n").unwrap();
        fs::write(root.join("docs/a b.md"), "[up](../README.md#top)").unwrap();
        let file = root.join("docs/a b.md");
        for target in ["../README.md", "../README.md#top", "a%20b.md", "/README.md", "..", "a b.md#"] {
            assert_eq!(fault(root, &file, target), None, "{target}");
        }
        let why = |target: &str| fault(root, &file, target).unwrap();
        assert_eq!(why("README.md"), "there is no such file");
        assert_eq!(why("../README.md#bottom"), "there is no such heading");
        assert_eq!(why("#top"), "there is no such heading");
        assert_eq!(why("../../elsewhere.md"), "it leads out of the repository");

        assert_eq!(check(root), Ok("1 relative links in 2 Markdown files lead somewhere".to_owned()));
        fs::write(root.join("README.md"), "# Top\n\n[x](gone.md)\n").unwrap();
        assert_eq!(check(root), Err("README.md:3: link to `gone.md`: there is no such file".to_owned()));
    }
}
