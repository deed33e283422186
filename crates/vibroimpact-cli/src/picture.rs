//! Output files of figures.

use crate::args::{FigureArgs, Format};
use crate::failure::Failure;
use crate::files::Target;
use std::path::Path;
use vibroimpact_plot::{DPI_300, Figure};

/// A place for a figure that is known to be writable and has a supported format.
#[derive(Debug)]
pub(crate) struct Picture {
    target: Target,
    format: Format,
    look: FigureArgs,
}

impl Picture {
    /// Reserves a file that ends in .svg, .png or .pdf.
    pub(crate) fn reserve(path: &Path, look: &FigureArgs, force: bool) -> Result<Self, Failure> {
        if path == Path::new("-") {
            return Err(Failure::bad(
                "a figure cannot go to stdout\nhint: name a file that ends in .svg, .png or .pdf",
            ));
        }
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let format = match ending.as_deref() {
            Some("svg") => Format::Svg,
            Some("png") => Format::Png,
            Some("pdf") => Format::Pdf,
            _ => {
                let (name, stem) = (path.display(), path.with_extension("svg"));
                let hint = if path.file_stem().is_some_and(|stem| !stem.to_string_lossy().starts_with('.')) {
                    format!("\nhint: --plot {}, or the same with .png or .pdf", stem.display())
                } else {
                    String::new()
                };
                return Err(Failure::bad(format!("the figure `{name}` ends in none of .svg, .png and .pdf{hint}")));
            }
        };
        look.check(format)?;
        let target = Target::reserve(path, force)?;
        Ok(Self { target, format, look: look.clone() })
    }

    pub(crate) fn write(self, figure: Figure) -> Result<(), Failure> {
        let figure = self.look.apply(figure)?;
        let bytes = match (self.format, self.look.resolution()) {
            (Format::Svg, _) => figure.to_svg().into_bytes(),
            (Format::Pdf, _) => figure.to_pdf()?,
            (Format::Png, None) => figure.to_png(DPI_300)?,
            (Format::Png, Some(dpi)) => figure.to_print(dpi)?,
        };
        self.target.write(|out| out.write_all(&bytes))
    }
}
