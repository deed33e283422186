//! CSV: a header, commas, a line feed after each row; numbers in the shortest form that reads back as the same double.

use std::fmt::{self, Display};
use std::io::{self, Write};

/// A number in its shortest round-trip form.
pub(crate) struct Number(pub(crate) f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // minus zero is zero
        let x = self.0 + 0.0;
        if x == 0.0 || (1e-5..1e16).contains(&x.abs()) { write!(f, "{x}") } else { write!(f, "{x:e}") }
    }
}

/// Writes a header and rows.
pub(crate) fn write<Row: Display>(
    out: &mut dyn Write,
    header: &str,
    rows: impl Iterator<Item = Row>,
) -> io::Result<()> {
    writeln!(out, "{header}")?;
    for row in rows {
        writeln!(out, "{row}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back() {
        for (x, text) in
            [(0.1, "0.1"), (-0.0, "0"), (1.0, "1"), (1e-7, "1e-7"), (1e300, "1e300"), (-123_456.789, "-123456.789")]
        {
            assert_eq!(Number(x).to_string(), text);
            assert_eq!(text.parse::<f64>(), Ok(x));
        }
    }
}
