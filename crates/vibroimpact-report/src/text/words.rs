//! Words and numbers that texts have in common, and the printer of their tables, of which a long one shows the largest shares.

use crate::Units;
use crate::number::{percent, short};
use std::fmt::Write;
use vibroimpact::Side;
use vibroimpact::math::{Multiplier, sort_by};
use vibroimpact::verdict::Stability;

/// A time with its unit, if there is one.
pub(crate) fn seconds(time: f64, units: &Units) -> String {
    let number = short(time * units.time());
    if units.si { format!("{number} s") } else { number }
}

/// A table of columns. Numbers are right-aligned under their heads; texts, whose heads begin with `<`, are
/// left-aligned.
pub(crate) fn aligned(heads: &[String], rows: &[Vec<String>]) -> String {
    let wide = |text: &str| text.chars().count();
    let left: Vec<bool> = heads.iter().map(|head| head.starts_with('<')).collect();
    let heads: Vec<String> = heads.iter().map(|head| head.trim_start_matches('<').to_owned()).collect();
    let widths: Vec<usize> = heads
        .iter()
        .enumerate()
        .map(|(k, head)| rows.iter().filter_map(|row| row.get(k)).map(|cell| wide(cell)).fold(wide(head), usize::max))
        .collect();
    let mut text = String::new();
    for row in core::iter::once(heads.as_slice()).chain(rows.iter().map(Vec::as_slice)) {
        let cells: Vec<String> = row
            .iter()
            .zip(widths.iter().zip(&left))
            .map(|(cell, (width, left))| {
                let air = " ".repeat(width - wide(cell).min(*width));
                if *left { format!("{cell}{air}") } else { format!("{air}{cell}") }
            })
            .collect();
        let _ = writeln!(text, "  {}", cells.join("  ").trim_end());
    }
    text
}

/// A count as text, such as `two impacts`.
pub(crate) fn counted_word(n: u32, one: &str) -> String {
    const WORDS: [&str; 11] = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"];
    let number =
        usize::try_from(n).ok().and_then(|n| WORDS.get(n)).map_or_else(|| n.to_string(), |word| (*word).to_owned());
    format!("{number} {one}{}", if n == 1 { "" } else { "s" })
}

/// Why the period of a motion that returns to a release is not known.
pub(crate) const ROUNDING_DECIDES: &str =
    "it is periodic, as it returns to a release from rest, but rounding errors decide its period";

/// Why that is so.
pub(crate) const ROUNDING_GROWS: &str =
    "from the release to the next rest the rounding errors grow beyond what tells one motion from another";

/// What a motion is whose impacts fade away.
pub(crate) const EVER_GENTLER: &str = "ever gentler impacts: in the limit it only touches the stop";

/// Why impacts of a machine fade away.
pub(crate) const IMPACTS_FADE: &str = "impact speeds tend to zero, and rounding errors decide how many impacts follow";

pub(crate) const fn stop_name(side: Side) -> &'static str {
    match side {
        Side::Upper => "stop",
        Side::Lower => "second stop",
    }
}

/// A stability in words; of motions without impacts and without damping, and of chaotic ones.
pub(crate) const fn in_words(stability: Option<Stability>, undamped: bool, chaotic: bool) -> &'static str {
    match stability {
        Some(Stability::Neutral) if undamped => "neutral (no damping)",
        Some(_) if chaotic => "every single motion in it is unstable",
        Some(stability) => stability.name(),
        None => "open",
    }
}

/// The text of multipliers: `0.44, 0.14`, or `0.3 +- 0.4i (modulus 0.5)` for a pair.
pub(crate) fn multipliers(all: &[Multiplier]) -> String {
    let paired =
        |k: usize| all.get(k).zip(all.get(k + 1)).is_some_and(|(a, b)| a.im != 0.0 && a.re == b.re && a.im == -b.im);
    let mut told = Vec::new();
    let mut k = 0;
    while let Some(a) = all.get(k) {
        told.push(match (paired(k), a.im) {
            (true, im) => format!("{} +- {}i (modulus {})", short(a.re), short(im.abs()), short(a.modulus())),
            (false, 0.0) => short(a.re),
            (false, im) => format!("{} + {}i (modulus {})", short(a.re), short(im), short(a.modulus())),
        });
        k += if paired(k) { 2 } else { 1 };
    }
    told.join(", ")
}

/// Number of items that are shown of a longer list.
const SHOWN: usize = 12;

/// The items to show of a list, and what the others have in common.
pub(crate) struct Leading<T> {
    pub(crate) shown: Vec<T>,
    /// The number of the others, and the sum of their shares. `None` if all are shown.
    pub(crate) others: Option<(usize, f64)>,
}

/// The twelve items with the largest shares, in falling order, and those that must be `kept`. A list with one more is shown as it is.
pub(crate) fn leading<T>(items: Vec<T>, share: impl Fn(&T) -> f64, kept: impl Fn(&T) -> bool) -> Leading<T> {
    if items.len() <= SHOWN + 1 {
        return Leading { shown: items, others: None };
    }
    let mut items = items;
    // a stable sort: equal shares stay in their order
    sort_by(&mut items, |a, b| share(b).total_cmp(&share(a)));
    let rest = items.split_off(SHOWN);
    let (kept, others): (Vec<T>, Vec<T>) = rest.into_iter().partition(kept);
    items.extend(kept);
    let sum = others.iter().map(share).sum();
    Leading { shown: items, others: Some((others.len(), sum)).filter(|(count, _)| *count > 0) }
}

impl<T> Leading<T> {
    /// The rows of a table with `width` columns: one for each item, and one for the others, with their share in column `share`
    /// and their name in column `name`.
    pub(crate) fn rows(
        &self,
        row: impl Fn(&T) -> Vec<String>,
        noun: &str,
        (name, share, width): (usize, usize, usize),
    ) -> Vec<Vec<String>> {
        let others = self.others.map(|(count, sum)| {
            let mut cells = vec![String::new(); width];
            cells[name] = format!("others ({count} {noun}s)");
            cells[share] = percent(sum);
            cells
        });
        self.shown.iter().map(row).chain(others).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_in_words() {
        assert_eq!(counted_word(1, "impact"), "one impact");
        assert_eq!(counted_word(12, "impact"), "12 impacts");
    }

    #[test]
    fn the_largest_dozen_and_the_sum_of_the_others() {
        let items = |n: u32| (0..n).map(|k| (k, f64::from(k))).collect::<Vec<_>>();
        let few = leading(items(13), |item| item.1, |_| false);
        assert_eq!((few.shown.len(), few.shown[0].0, few.others), (13, 0, None));
        let many = leading(items(50), |item| item.1, |item| item.0 == 3);
        assert_eq!(
            many.shown.iter().map(|item| item.0).collect::<Vec<_>>(),
            [49, 48, 47, 46, 45, 44, 43, 42, 41, 40, 39, 38, 3]
        );
        assert_eq!(many.others, Some((37, f64::from((0..38).sum::<i32>() - 3))));
        let rows = many.rows(|item| vec![item.0.to_string(), String::new()], "label", (0, 1, 2));
        assert_eq!(rows.last().unwrap()[0], "others (37 labels)");
        assert_eq!(rows.len(), 14);
    }
}
