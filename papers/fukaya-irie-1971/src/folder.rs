//! The folder of a reproduction. It is recognised by a marker file, and each file is written completely or not at all.

use crate::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use vibroimpact_plot::{DPI_300, Figure};

/// The marker file, which describes the folder. It is written first, so that even a stopped run can be repeated.
const MARKER: &str = "REPRODUCTION.txt";

/// Its content.
const ABOUT: &str = "Reproduction of K. Fukaya, T. Irie, \"On the Transient Oscillation of a Vibro-Impact System\",
Bulletin of the Faculty of Engineering, Hokkaido University 62 (1971) 31-39, https://hdl.handle.net/2115/41063

Begin with report.html. Each figure is there as SVG (for screens), PNG (300 dpi at its print width) and CSV (its data).
The next reproduction into this folder overwrites these files.
";

/// An open folder.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Creates the folder, or opens one that is empty, contains an earlier reproduction, or is to be used because of
    /// `force`.
    pub(crate) fn open(path: &Path, force: bool) -> Result<Self, Error> {
        let unusable = |source| Error::Unusable { path: path.to_owned(), source };
        if path.exists() && !path.is_dir() {
            return Err(Error::NotAFolder(path.to_owned()));
        }
        fs::create_dir_all(path).map_err(unusable)?;
        let ours = fs::read_to_string(path.join(MARKER)).is_ok_and(|text| text.lines().next() == ABOUT.lines().next());
        if !ours && !force && fs::read_dir(path).map_err(unusable)?.next().is_some() {
            return Err(Error::Foreign(path.to_owned()));
        }
        let folder = Self { path: path.to_owned() };
        // a folder in which no marker can be written cannot hold figures either: an invalid question, not a failed run
        match folder.write(MARKER, ABOUT.as_bytes()) {
            Err(Error::Write { source, .. }) => Err(unusable(source)),
            other => other.map(|()| folder),
        }
    }

    /// Writes a file under a temporary name and then renames it, so that readers never see an incomplete file.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let path = self.path.join(name);
        let temporary = self.path.join(format!(".{name}.{}.tmp", std::process::id()));
        fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, &path)).map_err(|source| {
            let _ = fs::remove_file(&temporary);
            Error::Write { path, source }
        })
    }

    /// Writes `name.svg` and `name.png` and returns the SVG text.
    pub(crate) fn figure(&self, name: &str, figure: Figure) -> Result<String, Error> {
        let figure = Figure { id: format!("{name}-"), ..figure };
        let svg = figure.to_svg();
        self.write(&format!("{name}.svg"), svg.as_bytes())?;
        self.write(&format!("{name}.png"), &figure.to_png(DPI_300)?)?;
        Ok(svg)
    }
}

/// A table as text: a comment that describes it, a header, and rows. Numbers read back as the same doubles.
#[derive(Debug)]
pub(crate) struct Csv(String);

impl Csv {
    /// A table with these columns.
    pub(crate) fn new(about: &str, columns: &str) -> Self {
        Self(format!("# {about}\n{columns}\n"))
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: &[&dyn std::fmt::Display]) {
        for (k, cell) in cells.iter().enumerate() {
            let comma = if k == 0 { "" } else { "," };
            // writing to a string cannot fail
            let _ = write!(self.0, "{comma}{cell}");
        }
        self.0.push('\n');
    }

    /// The bytes of the file.
    pub(crate) fn bytes(&self) -> &[u8] {
        self.0.as_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foreign_folders_are_left_alone() {
        let dir = tempfile::tempdir().unwrap();
        let at = dir.path().join("out");
        assert!(Folder::open(&at, false).is_ok() && Folder::open(&at, false).is_ok());
        fs::write(dir.path().join("thesis.tex"), "years of work").unwrap();
        let refused = Folder::open(dir.path(), false).unwrap_err();
        assert!(refused.is_bad_question() && refused.to_string().contains("--force"));
        assert!(Folder::open(&dir.path().join("thesis.tex"), true).is_err());
        assert!(Folder::open(dir.path(), true).is_ok());
        let left: Vec<_> = fs::read_dir(&at).unwrap().map(|f| f.unwrap().file_name()).collect();
        assert_eq!(left, [MARKER], "no temporary file stays");
    }
}
