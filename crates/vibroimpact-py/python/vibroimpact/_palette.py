"""Colours of figures, which are those of the command.

The series are the set of M. Okabe and K. Ito, "Color Universal Design" (2002, 2008), https://jfly.uni-koeln.de/color/.
Motions of one group have similar colours: m/1 light to dark blue, 1/n yellow to red-brown, other periodic motions green, chatter pink.
The labels of a group with several labels have its colour and its shades in turn, in every figure.
"""

from collections.abc import Iterable

from vibroimpact import _core
from vibroimpact._figure import mathtext

SERIES, _GROUPS = _core.palette()
#: The groups in the order of a legend, and their words.
LEGEND = {group: mathtext(words) for group, words in _GROUPS}
#: Groups that hold several labels, and the largest number of them that a legend names.
_SEVERAL = ("m/1", "1/n", "k/k", "m/n", "inf/n", "other")
_NAMED = 4
#: The largest number of labels each of which a legend names.
_EACH = 12


def legend_group(label: str) -> str:
    """The group of the label of a motion, a key of `LEGEND`."""
    return _core.look_of(label)[0]


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
    ordered = sorted(there, key=lambda label: (list(LEGEND).index(groups[label]), _numbers(label)))
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
    return _core.look_of(label)[1]


def variant(colour: str, k: int) -> tuple[float, float, float]:
    """Variant `k` of a colour, for motions of one label: the colour itself, darker, lighter, darker still, and so on."""
    from matplotlib.colors import to_rgb

    towards, part = (0.0 if k % 2 else 1.0), 1 - 0.6 ** ((k + 1) // 2)
    red, green, blue = to_rgb(colour)
    mixed = [channel + (towards - channel) * part for channel in (red, green, blue)]
    return mixed[0], mixed[1], mixed[2]
