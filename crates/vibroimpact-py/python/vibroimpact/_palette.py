"""Colours: those of the command's figures (crates/vibroimpact-plot/src/palette.rs).

The series are the set of M. Okabe and K. Ito, "Color Universal Design" (2002, 2008), https://jfly.uni-koeln.de/color/.
Motions follow their kin: m/1 light to dark blue, 1/n yellow to red-brown, other periodic ones green, chatter pink.
"""

from vibroimpact._tables import CLASSES, SERIES

__all__ = ["CLASSES", "LEGEND", "SERIES", "class_colour", "legend_group"]

#: The words of a legend.
LEGEND = {
    **{group: group for group in CLASSES},
    "0": "no impact",
    "m/1": r"$m$/1, $m \geq 5$",
    "1/n": r"1/$n$, $n \geq 4$",
    "k/k": r"$k$/$k$, $k \geq 2$",
    "m/n": r"other $m$/$n$",
    "inf/n": r"∞/$n$ (chatter)",
}


def legend_group(label: str) -> str:
    """The key of `CLASSES` that a motion's label belongs to."""
    if label in ("0", "chaotic", "stuck", "undecided"):
        return label
    impacts, slash, periods = label.partition("/")
    if not slash or not periods.isdigit() or int(periods) == 0:
        return "other"
    if impacts == "inf":
        return "inf/n"
    if not impacts.isdigit():
        return "other"
    m, n = int(impacts), int(periods)
    if m == 0:
        return "0"
    if n == 1:
        return f"{m}/1" if m <= 4 else "m/1"
    if m == 1:
        return f"1/{n}" if n <= 3 else "1/n"
    if m == n:
        return "k/k"
    return "3/2" if (m, n) == (3, 2) else "m/n"


def class_colour(label: str) -> str:
    """The colour of a motion's label, the same in every figure."""
    return CLASSES[legend_group(label)]
