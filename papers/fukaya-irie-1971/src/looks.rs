//! Common parts of figures and numbers: axes of the plane, legends of motions, percentages.

use vibroimpact_plot::{ClassStyle, Figure, GROUPS, Legend, class_style, legend_group, legend_text};

/// Number of the style of the group of a label, for a [`Rects`](vibroimpact_plot::Rects) made with [`styles`].
pub(crate) fn class(label: &str) -> usize {
    let group = legend_group(label);
    GROUPS.iter().position(|g| *g == group).unwrap_or(GROUPS.len() - 1)
}

/// The styles of all groups.
pub(crate) fn styles() -> Vec<ClassStyle> {
    GROUPS.map(class_style).to_vec()
}

/// A legend of the groups of these labels, in the order of the palette.
pub(crate) fn legend<'a>(labels: impl Iterator<Item = &'a str>) -> Legend {
    let present: Vec<usize> = labels.map(class).collect();
    GROUPS
        .into_iter()
        .enumerate()
        .filter(|(k, _)| present.contains(k))
        .fold(Legend::below(), |legend, (_, group)| legend.patch(class_style(group), legend_text(group)))
}

/// The numbers m and n of a label m/n.
pub(crate) fn numbers(label: &str) -> Option<(u32, u32)> {
    let (m, n) = label.split_once('/')?;
    Some((m.parse().ok()?, n.parse().ok()?))
}

/// A figure for one column, with its height in units of 1/8 mm.
pub(crate) fn column(panel: vibroimpact_plot::Panel, height: f64) -> Figure {
    Figure::new(panel).size(vibroimpact_plot::COLUMN, height)
}

/// A part of a count.
#[allow(clippy::cast_precision_loss)] // counts of points and starts
pub(crate) fn ratio(part: usize, all: usize) -> f64 {
    part as f64 / all.max(1) as f64
}

/// The text of a share: `12.3 %`, with more digits for small shares, and never rounded to 0 or 100.
pub(crate) fn percent(share: f64) -> String {
    let p = 100.0 * share;
    let from_end = p.min(100.0 - p);
    if from_end <= 0.0 {
        format!("{p:.0} %")
    } else if from_end >= 1.0 {
        format!("{p:.1} %")
    } else {
        format!("{p:.3} %")
    }
}

/// `1 point`, `2 points`.
pub(crate) fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// `(1.8, 0.25)`, with at most four digits.
pub(crate) fn place(x: f64, gap: f64) -> String {
    let short = |v: f64| (v * 1e4).round() / 1e4;
    format!("({}, {})", short(x), short(gap))
}

/// `a, b and c`: at most `most` items, then `...`.
pub(crate) fn list(items: &[String], most: usize) -> String {
    if items.len() > most {
        return format!("{}, ... ({} in all)", items[..most].join(", "), items.len());
    }
    match items {
        [] => "none".into(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_near_the_ends_keep_their_digits() {
        assert_eq!(percent(0.1234), "12.3 %");
        assert_eq!(percent(1.0), "100 %");
        assert_eq!(percent(0.99999), "99.999 %");
        assert_eq!(percent(0.0008), "0.080 %");
        assert_eq!(list(&["a".into(), "b".into(), "c".into()], 3), "a, b and c");
        assert_eq!(list(&["a".into(), "b".into()], 1), "a, ... (2 in all)");
    }
}
