//! Counts as text.

/// A count and its noun, with an `s` unless the count is 1: `1 tile`, `0 tiles`.
///
/// ```
/// use vibroimpact_study::counted;
/// assert_eq!([counted(0, "tile"), counted(1, "tile"), counted(2, "tile")], ["0 tiles", "1 tile", "2 tiles"]);
/// ```
#[must_use]
pub fn counted(count: u64, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}
