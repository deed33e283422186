//! The response over a number: one row for each motion of a sweep and each point of a branch.

use super::Table;
use super::orbits::finite;
use crate::number::Number;
use crate::response::ResponseView;
use vibroimpact_study::ResponseRow;

/// The table of `vibro response`, with all quantities. The first column is `up`, `down` or the number of a branch.
pub(crate) fn table(view: ResponseView<'_>) -> Table<'_> {
    let found = view.found;
    let sweeps = [("up", &found.up), ("down", &found.down)].map(|(name, rows)| (name.to_owned(), rows));
    let branches = found.branches.iter().enumerate().map(|(k, rows)| ((k + 1).to_string(), rows));
    let header = format!("curve,{},label,admissible,stable,stability,event,{}", view.column, view.columns.join(","));
    let curves: Vec<(String, &Vec<ResponseRow>)> = sweeps.into_iter().chain(branches).collect();
    let rows = curves.into_iter().flat_map(move |(name, rows)| {
        let view = view.clone();
        rows.iter().map(move |row| {
            let values: Vec<f64> = (0..row.quantities.len()).map(|k| view.value(row, k)).collect();
            format!(
                "{name},{},{},{},{},{},{}{}",
                Number(view.parameter(row)),
                row.label,
                row.admissible,
                row.stable(),
                row.stability.map_or("", |stability| stability.name()),
                row.event.unwrap_or_default(),
                finite(&values)
            )
        })
    });
    Table::new(header, rows)
}
