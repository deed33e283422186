//! The motion on a border: one row for each state.

use super::Table;
use crate::answer::{AnswerOf, Told};
use crate::number::Number;
use vibroimpact::edge::{Bordered as _, Edge};

/// The table of `vibro edge`.
pub(crate) fn table<'a, D: Told>(of: &'a AnswerOf<D>, found: &'a Edge<D::System>) -> Table<'a> {
    let (q, qdot) = D::names(of);
    let time = if of.units.si { "time_s" } else { "time" };
    let header = [&[time.to_owned()][..], &q, &qdot, &["phase".to_owned(), "apart".to_owned()]].concat().join(",");
    let rows = found.track.iter().map(|point| {
        let (q, qdot) = D::numbers(of, &point.state);
        let all =
            [&[point.time * of.units.time()][..], &q, &qdot, &[of.system.phase(&point.state), point.apart]].concat();
        all.into_iter().map(|value| Number(value).to_string()).collect::<Vec<_>>().join(",")
    });
    Table::new(header, rows)
}
