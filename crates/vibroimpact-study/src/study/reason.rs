//! Why each verdict holds, as it is stored.

use crate::field::{Column, Field, NumberType};
use vibroimpact::verdict::{Ending, Reason};

/// The field of reasons.
pub(super) fn field() -> Field {
    let flags: Vec<_> = [(-1, "not_computed")].into_iter().chain((0..).zip(Reason::ALL.map(Reason::name))).collect();
    Field::integers("reason", "why the verdict holds", NumberType::I8, &[], &flags)
}

/// The column of reasons.
pub(super) fn column(endings: &[Ending]) -> Column {
    let number = |of: &Ending| Reason::ALL.iter().position(|reason| *reason == of.reason);
    Column::I8(endings.iter().map(|of| number(of).and_then(|k| i8::try_from(k).ok()).unwrap_or(-1)).collect())
}
