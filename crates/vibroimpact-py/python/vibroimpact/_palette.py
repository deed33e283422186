"""Colours of figures, the same as those of the command (crates/vibroimpact-plot/src/palette.rs).

The series are the set of M. Okabe and K. Ito, "Color Universal Design" (2002, 2008), https://jfly.uni-koeln.de/color/.
Motions of one group have similar colours: m/1 light to dark blue, 1/n yellow to red-brown, other periodic motions green, chatter pink.
"""

from vibroimpact._tables import CLASSES, GROUP_RULES, LEGEND, SERIES

__all__ = ["CLASSES", "LEGEND", "SERIES", "class_colour", "legend_group"]


def legend_group(label: str) -> str:
    """The key of `CLASSES` for the label of a motion."""
    impacts, slash, periods = label.partition("/")
    if not slash:
        return label if label in CLASSES else "other"
    if impacts == "inf":
        return "inf/n"
    if not (impacts.isdigit() and periods.isdigit()):
        return "other"
    m, n = int(impacts), int(periods)
    for (fewest, most), (shortest, longest), equal, group in GROUP_RULES:
        if fewest <= m <= most and shortest <= n <= longest and (m == n or not equal):
            return group
    return "other"


def class_colour(label: str) -> str:
    """The colour of the label of a motion, the same in every figure."""
    return CLASSES[legend_group(label)]
