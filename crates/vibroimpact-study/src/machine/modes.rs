//! Modes of vibration from a table of numbers: the result of a finite-element program as CSV.

use super::named::Named;
use super::number::NumberText;
use super::text::ModeText;

/// The modes of a CSV table. The columns `frequency_hz` or `frequency`, `damping_ratio` and `modal_mass` have the
/// numbers of the modes; every other column is a point, and has its displacement in each mode. Empty lines and lines
/// that begin with # are passed over.
pub(super) fn from_csv(table: &str) -> Result<Vec<ModeText>, String> {
    let lines = table.trim_start_matches('\u{feff}').lines().map(str::trim).enumerate();
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let (_, head) = lines.next().ok_or("is empty")?;
    let columns: Vec<&str> = head.split(',').map(cell).collect();
    if let Some(k) = (0..columns.len()).find(|k| columns[..*k].contains(&columns[*k])) {
        return Err(format!("has two columns `{}`", shortened(columns[k])));
    }
    let mut modes = Vec::new();
    for (number, line) in lines {
        let cells: Vec<&str> = line.split(',').map(cell).collect();
        if cells.len() != columns.len() {
            return Err(format!("has {} cells in line {}, and {} columns", cells.len(), number + 1, columns.len()));
        }
        let mut mode = ModeText::default();
        for (column, cell) in columns.iter().zip(cells) {
            let value = cell.parse().map_err(|_| {
                format!(
                    "has `{}` in line {}, column `{}`, which is no number",
                    shortened(cell),
                    number + 1,
                    shortened(column)
                )
            })?;
            let value = NumberText::Value(value);
            match *column {
                "frequency" => mode.frequency = Some(value),
                "frequency_hz" => mode.frequency_hz = Some(value),
                "damping_ratio" => mode.damping_ratio = Some(value),
                "modal_mass" => mode.modal_mass = Some(value),
                point => mode.shape.0.push((point.to_owned(), value)),
            }
        }
        modes.push(mode);
    }
    match modes.first() {
        None => Err("has no modes".to_owned()),
        Some(mode) if mode.frequency.is_none() && mode.frequency_hz.is_none() => {
            Err("has neither a column `frequency_hz` nor `frequency`".to_owned())
        }
        Some(ModeText { shape: Named(points), .. }) if points.is_empty() => {
            Err("has no column of a point besides frequency and damping".to_owned())
        }
        Some(_) => Ok(modes),
    }
}

/// A cell without its spaces and quotes.
fn cell(text: &str) -> &str {
    let text = text.trim();
    text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text)
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_modes() {
        let modes = from_csv(
            "# of a beam\nfrequency_hz, damping_ratio, \"tip\", middle\n\n10,0.01,1.2,-0.3\n62.5,2e-2,-1.2,0.8\n",
        )
        .unwrap();
        assert_eq!(modes.len(), 2);
        assert_eq!(modes[1].frequency_hz, Some(NumberText::Value(62.5)));
        assert_eq!(modes[1].damping_ratio, Some(NumberText::Value(0.02)));
        assert_eq!(
            modes[0].shape,
            Named::from_iter([("tip", NumberText::Value(1.2)), ("middle", NumberText::Value(-0.3))])
        );
    }

    #[test]
    fn what_is_no_table_of_modes_is_explained() {
        for (table, said) in [
            ("", "is empty"),
            ("frequency_hz,tip\n", "no modes"),
            ("frequency_hz,tip\n1\n", "has 1 cells in line 2, and 2 columns"),
            ("frequency_hz,tip\n1,x\n", "has `x` in line 2, column `tip`, which is no number"),
            ("f,tip\n1,2\n", "neither a column"),
            ("frequency_hz,damping_ratio\n1,2\n", "no column of a point"),
            ("frequency,tip,tip\n1,2,3\n", "two columns `tip`"),
        ] {
            let told = from_csv(table).unwrap_err();
            assert!(told.contains(said), "{table:?}: {told}");
        }
    }
}
