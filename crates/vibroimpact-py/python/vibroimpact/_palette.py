"""Colours of figures, the same as those of the command (crates/vibroimpact-plot/src/palette.rs).

The series are the set of M. Okabe and K. Ito, "Color Universal Design" (2002, 2008), https://jfly.uni-koeln.de/color/.
Motions of one group have similar colours: m/1 light to dark blue, 1/n yellow to red-brown, other periodic motions green, chatter pink.
The labels of a group with several labels have its colour and its shades in turn, in every figure.
"""

from collections.abc import Iterable

from vibroimpact._tables import CLASSES, GROUP_RULES, LEGEND, SERIES, SHADES

#: Groups that hold several labels, and the largest number of them that a legend names.
_SEVERAL = ("m/1", "1/n", "k/k", "m/n", "inf/n", "other")
_NAMED = 4
#: The largest number of labels each of which a legend names.
_EACH = 12

__all__ = ["CLASSES", "LEGEND", "SERIES", "class_colour", "legend_group", "legend_text", "legend_words", "variant"]


def legend_group(label: str) -> str:
    """The key of `CLASSES` for the label of a motion."""
    impacts, slash, periods = label.partition("/")
    if not slash:
        return label if label in CLASSES else "other"
    if periods == "T" and impacts.isdigit():
        # a machine without forcing has no motions m/n: those with m closings have the colours of (m+1)/1
        return legend_group(f"{int(impacts) + 1}/1")
    if impacts == "inf":
        return "inf/n"
    if not (impacts.isdigit() and periods.isdigit()):
        return "other"
    m, n = int(impacts), int(periods)
    for (fewest, most), (shortest, longest), equal, group in GROUP_RULES:
        if fewest <= m <= most and shortest <= n <= longest and (m == n or not equal):
            return group
    return "other"


def legend_text(group: str, labels: Iterable[str]) -> str:
    """The words of a legend for the motions of a group. A group of several labels names those that are there, the most common
    first as given; with very many it names some."""
    there = [label.replace("inf", "∞") for label in dict.fromkeys(labels)]
    unforced = any(label.endswith("/T") for label in there)
    if (group not in _SEVERAL and not unforced) or not there:
        return LEGEND[group]
    if len(there) <= _NAMED:
        return ", ".join(there)
    return f"{', '.join(there[:_NAMED])} and {len(there) - _NAMED} more"


def legend_words(labels: Iterable[str]) -> dict[str, str]:
    """Labels in the order of a legend, each with its words: its own, or with very many labels those of its group. The most common
    labels are given first."""
    there = list(dict.fromkeys(labels))
    groups = {label: legend_group(label) for label in there}
    ordered = sorted(there, key=lambda label: (list(CLASSES).index(groups[label]), _numbers(label)))
    few = len(there) <= _EACH
    of_group = {group: [label for label in there if groups[label] == group] for group in groups.values()}
    return {label: legend_text(groups[label], [label] if few else of_group[groups[label]]) for label in ordered}


def _numbers(label: str) -> tuple[int, int]:
    """The numbers of a label, by which those of one group are ordered."""
    impacts, _, periods = label.partition("/")
    whole = [int(part) if part.isdigit() else 0 for part in (periods, impacts)]
    return whole[0], whole[1]


def class_colour(label: str) -> str:
    """The colour of the label of a motion, the same in every figure."""
    if label in CLASSES:
        return CLASSES[label]
    group = legend_group(label)
    if group not in SHADES:
        return CLASSES[group]
    impacts, _, periods = label.partition("/")
    if periods == "T":
        impacts, periods = (impacts if impacts == "inf" else str(int(impacts) + 1)), "1"
    number = ((0 if impacts == "inf" else int(impacts)) + 2 * int(periods)) % 5
    return (CLASSES[group], *SHADES[group])[number]


def variant(colour: str, k: int) -> tuple[float, float, float]:
    """Variant `k` of a colour, for motions of one label: the colour itself, darker, lighter, darker still, and so on."""
    from matplotlib.colors import to_rgb

    towards, part = (0.0 if k % 2 else 1.0), 1 - 0.6 ** ((k + 1) // 2)
    red, green, blue = to_rgb(colour)
    mixed = [channel + (towards - channel) * part for channel in (red, green, blue)]
    return mixed[0], mixed[1], mixed[2]
