//! Colours for series, and one fixed style for each group of motions.
//!
//! [`SERIES`] is the eight-colour set of M. Okabe and K. Ito, "Color Universal Design" (2002,
//! 2008), `https://jfly.uni-koeln.de/color/`.
//!
//! Motions of one group have similar colours: `m/1` motions go from light to dark blue as m grows, subharmonic `1/n`
//! motions from yellow to red-brown, other periodic motions are green, complete chatter is pink, motions without impact
//! are cream. The motions of a group with several labels have shades of its colour. Hues lie on the blue-yellow axis, which red-green blindness does not affect, and similar colours differ in lightness, so that they
//! can be distinguished in grey print. Groups that are similar in grey have a hatch. The tests check that trichromats,
//! protanopes and deuteranopes can distinguish the main groups.

use crate::colour::Colour;
use crate::hatch::{Hatch, Pattern};
use serde::Serialize;

/// The colours of Okabe and Ito for lines and points, in an order in which consecutive ones are easy to distinguish.
pub const SERIES: [Colour; 8] = [
    Colour::hex(0x00_72b2),
    Colour::hex(0xd5_5e00),
    Colour::hex(0x00_9e73),
    Colour::hex(0xcc_79a7),
    Colour::hex(0xe6_9f00),
    Colour::hex(0x56_b4e9),
    Colour::hex(0x00_0000),
    Colour::hex(0xf0_e442),
];

/// The style of a class on a map and in the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct ClassStyle {
    /// The fill.
    pub colour: Colour,
    /// Hatch over the fill. A [`Raster`](crate::Raster) has no room for it and shows only the fill.
    pub hatch: Option<Hatch>,
}

impl ClassStyle {
    /// A plain fill.
    #[must_use]
    pub const fn plain(colour: Colour) -> Self {
        Self { colour, hatch: None }
    }
}

const fn plain(colour: u32) -> ClassStyle {
    ClassStyle::plain(Colour::hex(colour))
}

const fn hatched(colour: u32, pattern: Pattern, lines: u32) -> ClassStyle {
    ClassStyle { hatch: Some(Hatch::new(pattern, Colour::hex(lines))), ..plain(colour) }
}

/// All legend groups in the order of a legend, each with its text in the markup of [labels](crate::plain) and its style.
const LOOKS: [(&str, &str, ClassStyle); 17] = [
    ("0", "no impact", plain(0xf2_eecb)),
    ("1/1", "1/1", plain(0x9a_d6ee)),
    ("2/1", "2/1", plain(0x3f_a0d0)),
    ("3/1", "3/1", plain(0x1a_6fb0)),
    ("4/1", "4/1", plain(0x17_3f86)),
    ("m/1", "*m*/1, *m* ≥ 5", hatched(0x2b_1b57, Pattern::Rising, 0xa9_9ae0)),
    ("1/2", "1/2", plain(0xf2_a71b)),
    ("1/3", "1/3", plain(0xd9_601a)),
    ("1/n", "1/*n*, *n* ≥ 4", hatched(0x9a_2f0e, Pattern::Falling, 0xf2_b79a)),
    ("k/k", "*k*/*k*, *k* ≥ 2", hatched(0xd3_e27a, Pattern::Horizontal, 0x7b_8a1e)),
    ("3/2", "3/2", hatched(0x0b_8f62, Pattern::Vertical, 0xb5_ead2)),
    ("m/n", "other *m*/*n*", hatched(0x7f_d0a0, Pattern::Dots, 0x14_5c3a)),
    ("inf/n", "∞/*n* (chatter)", hatched(0xee_94bb, Pattern::Falling, 0x93_1f5c)),
    ("chaotic", "chaotic", plain(0x10_1010)),
    ("stuck", "stuck", hatched(0x5e_4636, Pattern::Horizontal, 0xd9_c3ae)),
    ("undecided", "undecided", hatched(0xe8_eaee, Pattern::Cross, 0xd0_2020)),
    ("other", "other", hatched(0x8a_8a80, Pattern::Dots, 0xff_ffff)),
];

/// All legend groups, in the order of a legend.
pub const GROUPS: [&str; LOOKS.len()] = {
    let mut groups = [""; LOOKS.len()];
    let mut k = 0;
    while k < LOOKS.len() {
        groups[k] = LOOKS[k].0;
        k += 1;
    }
    groups
};

/// The legend group of the label of a motion: one of [`GROUPS`].
///
/// `0` and `0/n` are motions without impact. `m/1` contains m >= 5, `1/n` n >= 4, `k/k` equal numbers from 2 on, `m/n`
/// all other periodic motions; `inf/n` (also `∞/n`) is complete chatter. Characters after the numbers, as in `2/1'`,
/// are ignored. Texts that are no label are `other`.
#[must_use]
pub fn legend_group(label: &str) -> &'static str {
    let label = label.trim();
    let word = label.to_lowercase();
    match word.as_str() {
        "0" => return "0",
        "chaotic" | "chaos" => return "chaotic",
        "stuck" | "sticking" => return "stuck",
        "undecided" | "unknown" | "" => return "undecided",
        _ => {}
    }
    let Some((m, n)) = word.split_once('/') else {
        return "other";
    };
    let m = m.trim();
    if matches!(m, "inf" | "∞") {
        return "inf/n";
    }
    let n: String = n.trim_start().chars().take_while(char::is_ascii_digit).collect();
    let (Ok(m), Ok(n)) = (m.parse::<u64>(), n.parse::<u64>()) else {
        return "other";
    };
    let rule = GROUP_RULES.iter().find(|rule| rule.holds(m, n));
    rule.map_or("other", |rule| rule.group)
}

/// A rule for the motions m/n of a legend group: m and n must lie in these ranges.
#[derive(Clone, Copy, Debug)]
pub struct GroupRule {
    /// The smallest and the largest number of impacts.
    pub m: (u64, u64),
    /// The smallest and the largest number of forcing periods.
    pub n: (u64, u64),
    /// Whether m = n is required.
    pub equal: bool,
    /// The group.
    pub group: &'static str,
}

impl GroupRule {
    const fn new(m: (u64, u64), n: (u64, u64), group: &'static str) -> Self {
        Self { m, n, equal: false, group }
    }

    /// Whether m/n satisfies the rule.
    pub(crate) const fn holds(&self, m: u64, n: u64) -> bool {
        self.m.0 <= m && m <= self.m.1 && self.n.0 <= n && n <= self.n.1 && (!self.equal || m == n)
    }
}

/// No upper bound.
const ANY: u64 = u64::MAX;

/// The groups of motions m/n: the first rule that is satisfied determines the group. The page
/// contains the same table.
pub const GROUP_RULES: [GroupRule; 12] = [
    GroupRule::new((0, 0), (1, ANY), "0"),
    GroupRule::new((1, 1), (1, 1), "1/1"),
    GroupRule::new((2, 2), (1, 1), "2/1"),
    GroupRule::new((3, 3), (1, 1), "3/1"),
    GroupRule::new((4, 4), (1, 1), "4/1"),
    GroupRule::new((5, ANY), (1, 1), "m/1"),
    GroupRule::new((1, 1), (2, 2), "1/2"),
    GroupRule::new((1, 1), (3, 3), "1/3"),
    GroupRule::new((1, 1), (4, ANY), "1/n"),
    GroupRule { equal: true, ..GroupRule::new((2, ANY), (2, ANY), "k/k") },
    GroupRule::new((3, 3), (2, 2), "3/2"),
    GroupRule::new((2, ANY), (2, ANY), "m/n"),
];

/// Further colours of the groups that have several labels; the labels of such a group have these and its own colour in
/// turn. The page contains the same table.
pub const SHADES: [(&str, [Colour; 4]); 5] = [
    ("m/1", colours([0xbb_acff, 0x73_8dfb, 0x5e_4674, 0x1c_5ac0])),
    ("1/n", colours([0xbf_5c40, 0xab_544e, 0xb5_531d, 0x65_0b00])),
    ("k/k", colours([0xbb_ca86, 0x8e_a035, 0xbf_cd55, 0xad_a95c])),
    ("m/n", colours([0x54_f1d8, 0x78_9c5d, 0x4d_f7b5, 0x59_b281])),
    ("inf/n", colours([0xde_75d3, 0x9e_668e, 0x62_394d, 0x8a_576b])),
];

const fn colours([a, b, c, d]: [u32; 4]) -> [Colour; 4] {
    [Colour::hex(a), Colour::hex(b), Colour::hex(c), Colour::hex(d)]
}

/// The style of the label of a motion, the same in every figure. The label of a group has the style of the group.
///
/// A motion m/T of a machine without forcing, whose group is `other`, has the style of (m+1)/1: no motion m/n is in a figure
/// with it, and 0/T differs from a motion without events.
#[must_use]
pub fn class_style(label: &str) -> ClassStyle {
    if let Some(m) = unforced(label) {
        return class_style(&format!("{}/1", m.saturating_add(1)));
    }
    let (group, _, style) = look(label);
    match shade(label, group) {
        Some(colour) => ClassStyle { colour, ..style },
        None => style,
    }
}

/// The number m of closings of a label m/T.
#[must_use]
pub fn unforced(label: &str) -> Option<u64> {
    label.trim().strip_suffix("/T")?.parse().ok()
}

/// The colour of a label in a group with several labels; none if it is that of the group.
fn shade(label: &str, group: &str) -> Option<Colour> {
    let (_, shades) = SHADES.iter().find(|(name, _)| *name == group)?;
    let (m, n) = label.trim().split_once('/')?;
    let digits = |text: &str| text.chars().take_while(char::is_ascii_digit).collect::<String>().parse::<u64>();
    // infinitely many impacts count as none; neither number is one in the label of a group
    let m = if matches!(m.trim(), "inf" | "∞") { 0 } else { digits(m.trim()).ok()? };
    let n = digits(n.trim_start()).ok()?;
    shades.get(usize::try_from((m % 5 + 2 * (n % 5)) % 5).ok()?.checked_sub(1)?).copied()
}

/// The text of the group of a label for a legend, in the markup of [labels](crate::plain).
#[must_use]
pub fn legend_text(label: &str) -> &'static str {
    look(label).1
}

/// The group of a label with its text and its style; the label may be that of a group.
fn look(label: &str) -> (&'static str, &'static str, ClassStyle) {
    let group = GROUPS.into_iter().find(|group| *group == label).unwrap_or_else(|| legend_group(label));
    LOOKS.into_iter().find(|(name, ..)| *name == group).unwrap_or(LOOKS[LOOKS.len() - 1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vision::Vision;

    const EYES: [Vision; 3] = [Vision::Normal, Vision::Protanopia, Vision::Deuteranopia];

    fn closest(groups: &[&str], eye: Vision) -> (f64, String) {
        let seen = |g: &str| eye.see(class_style(g).colour);
        let mut best = (f64::INFINITY, String::new());
        for (i, a) in groups.iter().enumerate() {
            for b in &groups[i + 1..] {
                let d = seen(a).delta_e(seen(b));
                if d < best.0 {
                    best = (d, format!("{a} and {b}"));
                }
            }
        }
        best
    }

    #[test]
    fn main_groups_are_told_apart_by_every_eye() {
        let main = ["0", "1/1", "2/1", "3/1", "4/1", "1/2", "chaotic", "inf/n"];
        for eye in EYES {
            let (d, pair) = closest(&main, eye);
            assert!(d >= 14.0, "{eye:?}: {pair} only {d:.1} apart");
            let (d, pair) = closest(&GROUPS, eye);
            assert!(d >= 7.0, "{eye:?}: {pair} only {d:.1} apart");
        }
    }

    #[test]
    fn grey_print_tells_groups_apart_by_lightness_or_hatch() {
        for (i, a) in GROUPS.iter().enumerate() {
            for b in &GROUPS[i + 1..] {
                let (s, t) = (class_style(a), class_style(b));
                let d = Vision::Grey.see(s.colour).delta_e(Vision::Grey.see(t.colour));
                let hatch = |c: ClassStyle| c.hatch.map(|h| h.pattern);
                assert!(d >= 7.0 || hatch(s) != hatch(t), "{a} and {b}: {d:.1}");
            }
        }
    }

    #[test]
    fn shades_are_told_apart_by_every_eye() {
        let shades = SHADES.iter().flat_map(|(_, shades)| shades).copied();
        let all: Vec<Colour> = GROUPS.iter().map(|group| class_style(group).colour).chain(shades).collect();
        for eye in EYES {
            for (k, a) in all.iter().enumerate() {
                for b in &all[k + 1..] {
                    let d = eye.see(*a).delta_e(eye.see(*b));
                    assert!(d >= 7.0, "{eye:?}: {} and {} only {d:.1} apart", a.to_hex(), b.to_hex());
                }
            }
        }
    }

    #[test]
    fn labels_of_one_group_have_its_shades_in_turn() {
        let colours = |labels: [&str; 5]| labels.map(|label| class_style(label).colour.to_hex());
        for labels in [
            ["5/1", "6/1", "7/1", "8/1", "9/1"],
            ["1/4", "1/5", "1/6", "1/7", "1/8"],
            ["2/2", "3/3", "4/4", "5/5", "6/6"],
            ["inf/1", "inf/2", "inf/3", "inf/4", "inf/5"],
        ] {
            let mut found = colours(labels).to_vec();
            found.sort_unstable();
            found.dedup();
            assert_eq!(found.len(), 5, "{labels:?}");
        }
        assert_eq!(class_style("8/1"), class_style("m/1"));
        assert_eq!(class_style("5/1").colour, class_style("10/1").colour);
        assert_eq!(class_style("2/1'"), class_style("2/1"));
        assert_eq!([0, 3, 7].map(|m| class_style(&format!("{m}/T"))), ["1/1", "4/1", "8/1"].map(class_style));
        assert_eq!(class_style("inf/T"), class_style("inf/n"));
    }

    #[test]
    fn labels_find_their_group() {
        for (label, group) in [
            ("0", "0"),
            ("0/1", "0"),
            ("1/1", "1/1"),
            (" 4/1 ", "4/1"),
            ("5/1", "m/1"),
            ("17/1", "m/1"),
            ("1/2", "1/2"),
            ("1/9", "1/n"),
            ("2/2", "k/k"),
            ("7/7", "k/k"),
            ("3/2", "3/2"),
            ("2/3", "m/n"),
            ("2/1'", "2/1"),
            ("inf/1", "inf/n"),
            ("∞/2", "inf/n"),
            ("Chaotic", "chaotic"),
            ("stuck", "stuck"),
            ("", "undecided"),
            ("quasi-periodic", "other"),
            ("1/0", "other"),
            ("-1/2", "other"),
        ] {
            assert_eq!(legend_group(label), group, "{label:?}");
            let (own, of_group) = (class_style(label), class_style(group));
            assert_eq!(own.hatch, of_group.hatch, "{label:?}");
            assert!(SHADES.iter().any(|(name, _)| *name == group) || own == of_group, "{label:?}");
        }
        for group in GROUPS {
            assert!(!legend_text(group).is_empty());
        }
    }
}
