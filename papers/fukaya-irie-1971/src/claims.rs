//! The rows of the report: a statement of the paper, the result of this run, and whether they agree.

use std::fmt::Write as _;

/// Whether the paper and this run agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Agreement {
    /// They agree.
    Agrees,
    /// They agree in part; the row states in which part.
    Partly,
    /// They differ.
    Differs,
}

impl Agreement {
    /// `Agrees` if `all`, else `Partly` if `some`, else `Differs`.
    #[must_use]
    pub const fn of(all: bool, some: bool) -> Self {
        match (all, some) {
            (true, _) => Self::Agrees,
            (false, true) => Self::Partly,
            (false, false) => Self::Differs,
        }
    }

    /// One word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Partly => "partly",
            Self::Differs => "differs",
        }
    }
}

/// A row: one statement of the paper.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Its place in the paper: `4`, `1`, or `(2)` for its second conclusion.
    pub figure: &'static str,
    /// The statement, in our words.
    pub says: String,
    /// The result of this run.
    pub found: String,
    /// Whether they agree.
    pub verdict: Agreement,
}

/// A section of the report: a figure with its rows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Section {
    pub(crate) title: &'static str,
    pub(crate) caption: String,
    pub(crate) svg: Option<String>,
    /// The files of the figure, for the links below it.
    pub(crate) files: Vec<String>,
    pub(crate) claims: Vec<Claim>,
}

impl Section {
    pub(crate) fn new(title: &'static str, caption: impl Into<String>) -> Self {
        Self { title, caption: caption.into(), svg: None, files: Vec::new(), claims: Vec::new() }
    }

    pub(crate) fn svg(mut self, name: &str, svg: String, more: &[&str]) -> Self {
        self.svg = Some(svg);
        self.files = ["svg", "png", "csv"].map(|end| format!("{name}.{end}")).into();
        self.files.extend(more.iter().map(ToString::to_string));
        self
    }

    pub(crate) fn claim(
        &mut self,
        figure: &'static str,
        says: impl Into<String>,
        found: impl Into<String>,
        verdict: Agreement,
    ) {
        self.claims.push(Claim { figure, says: says.into(), found: found.into(), verdict });
    }
}

/// All results of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    pub(crate) quick: bool,
    pub(crate) sections: Vec<Section>,
}

/// Width of the table, in columns of a terminal.
const WIDTH: usize = 108;
/// Number of columns before the text of a row.
const INDENT: usize = 17;

impl Report {
    pub(crate) const fn new(quick: bool) -> Self {
        Self { quick, sections: Vec::new() }
    }

    /// All rows, in the order of the paper.
    pub fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.sections.iter().flat_map(|section| &section.claims)
    }

    /// Numbers of rows that agree, agree in part, and differ.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        [Agreement::Agrees, Agreement::Partly, Agreement::Differs]
            .map(|kind| self.claims().filter(|claim| claim.verdict == kind).count())
    }

    /// The rows as plain text, at most 108 columns wide.
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = format!(
            "{:<8}{:<9}what the paper says\n{:<INDENT$}= what this run found\n{}\n",
            "figure",
            "verdict",
            "",
            "-".repeat(WIDTH)
        );
        for claim in self.claims() {
            let head = format!("{:<8}{:<9}", claim.figure, claim.verdict.word());
            text.push_str(&wrap(&head, &claim.says));
            text.push_str(&wrap(&format!("{:<INDENT$}= ", ""), &claim.found));
        }
        let [agrees, partly, differs] = self.counts();
        // writing to a string cannot fail
        let _ = writeln!(
            text,
            "{}\n{agrees} agree, {partly} in part, {differs} differ{}",
            "-".repeat(WIDTH),
            if self.quick { QUICK } else { "" }
        );
        text
    }
}

const QUICK: &str = " (a quick run: coarse grids, few starts; not to be cited)";

/// `head` followed by `text`, in lines of at most [`WIDTH`] characters with further lines indented.
fn wrap(head: &str, text: &str) -> String {
    let indent = head.chars().count().max(INDENT);
    let mut out = head.to_owned();
    let mut column = head.chars().count();
    for (k, word) in text.split_whitespace().enumerate() {
        let length = word.chars().count();
        if k > 0 && column + 1 + length > WIDTH {
            out.push('\n');
            out.push_str(&" ".repeat(indent));
            column = indent;
        } else if k > 0 {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += length;
    }
    out.push('\n');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_stays_within_its_width() {
        let mut report = Report::new(true);
        let mut section = Section::new("Figure 4", "");
        section.claim("4", "word ".repeat(60), "number ".repeat(70), Agreement::Partly);
        report.sections.push(section);
        let table = report.table();
        assert!(table.lines().all(|line| line.chars().count() <= WIDTH || line.contains("quick run")));
        assert!(table.contains("4       partly   word word") && table.contains("0 agree, 1 in part"));
    }
}
