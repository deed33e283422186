//! Points of parameters and starts in a table: a header with their names, and one row for each point.

use crate::failure::Failure;
use std::io::Read;
use std::path::Path;
use vibroimpact_study::typed::decimal;
use vibroimpact_study::{Coordinate, ListedColumn};

/// Reads the columns of a table of comma-separated values for an oscillator; `-` is stdin.
pub(crate) fn read(path: &Path) -> Result<Vec<ListedColumn>, Failure> {
    columns_of(path, columns)
}

/// The same for a machine: what the columns vary is checked with its plan.
pub(crate) fn read_for_machine(path: &Path) -> Result<Vec<ListedColumn<String>>, Failure> {
    let column = |(name, values): (&str, Vec<f64>)| ListedColumn { vary: name.to_owned(), values };
    columns_of(path, |text| Ok(cells(text)?.into_iter().map(column).collect()))
}

fn columns_of<T>(path: &Path, columns: impl Fn(&str) -> Result<T, String>) -> Result<T, Failure> {
    let text = if path == Path::new("-") {
        let mut text = String::new();
        std::io::stdin().read_to_string(&mut text).map(|_| text)
    } else {
        std::fs::read_to_string(path)
    };
    let name = path.display();
    let text = text.map_err(|error| Failure::bad(format!("the points `{name}` cannot be read: {error}")))?;
    columns(&text).map_err(|why| Failure::bad(format!("`{name}`: {why}")))
}

/// The columns in a text.
fn columns(text: &str) -> Result<Vec<ListedColumn>, String> {
    let column = |(name, values): (&str, Vec<f64>)| Ok(ListedColumn { vary: coordinate(name)?, values });
    cells(text)?.into_iter().map(column).collect()
}

/// The names and values of the columns in a text. Empty lines, and lines that begin with `#`, are skipped.
fn cells(text: &str) -> Result<Vec<(&str, Vec<f64>)>, String> {
    let rows = text.trim_start_matches('\u{feff}').lines().zip(1..);
    let mut rows = rows.map(|(line, number)| (line.trim(), number)).filter(|(line, _)| {
        // lines without points
        !line.is_empty() && !line.starts_with('#')
    });
    let (head, _) = rows.next().ok_or("there is no header with the names of what varies")?;
    let mut columns: Vec<(&str, Vec<f64>)> =
        head.split(',').map(|name| (name.trim().trim_matches('"'), Vec::new())).collect();
    for (line, number) in rows {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if cells.len() != columns.len() {
            return Err(format!("line {number} has {} values, and the header has {}", cells.len(), columns.len()));
        }
        for ((name, values), cell) in columns.iter_mut().zip(cells) {
            let shown: String = cell.chars().take(60).collect();
            values.push(
                decimal(cell).ok_or_else(|| {
                    format!("line {number}: {name} = `{shown}` is not a number, such as 0.5 or -2e-3")
                })?,
            );
        }
    }
    if columns.iter().all(|(_, values)| values.is_empty()) {
        return Err("there is no point below the header".to_owned());
    }
    Ok(columns)
}

/// The parameter or coordinate with this name, which may be that of a flag.
fn coordinate(name: &str) -> Result<Coordinate, String> {
    let plain = name.replace('-', "_");
    Coordinate::named(&plain).ok_or_else(|| {
        let shown: String = name.trim().chars().take(60).collect();
        format!(
            "the column `{shown}` is no parameter and no coordinate of a start\n\
            hint: beta, inverse_beta, gap, restitution, damping, second_gap, second_restitution, x, v, phase, or a number of the body, such as gap_m"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use vibroimpact_study::Parameter;

    #[test]
    fn tables_and_what_is_none() {
        let found = columns("# a sample\n\ninverse-beta, \"gap\",v\r\n1.3,0.75,-1e-3\n\n1.4,1,0\n").unwrap();
        let names: Vec<&str> = found.iter().map(|column| column.vary.name()).collect();
        assert_eq!(names, ["inverse_beta", "gap", "v"]);
        assert_eq!(found[0].vary, Coordinate::Parameter(Parameter::InverseBeta));
        assert_eq!((found[0].values.clone(), found[2].values.clone()), (vec![1.3, 1.4], vec![-1e-3, 0.0]));
        for (bad, why) in [
            ("", "there is no header"),
            ("# nothing\n", "there is no header"),
            ("gap\n", "there is no point"),
            ("gap,mass\n1,2\n", "the column `mass` is no parameter"),
            ("gap,v\n1\n", "line 2 has 1 values, and the header has 2"),
            ("gap\n1\n\nx\n", "line 4: gap = `x` is not a number"),
        ] {
            assert!(columns(bad).is_err_and(|said| said.starts_with(why)), "{bad:?}");
        }
    }
}
