"""The figure of margins: bars from the value of each parameter to its nearest events, and the box of all parameters."""

from itertools import cycle
from typing import TYPE_CHECKING, Any

from vibroimpact._core import QuestionError
from vibroimpact._figure import axis_of, equal, heading, legend, named, new_axes
from vibroimpact._palette import SERIES
from vibroimpact._tables import EVENT_COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: The colours of events that have none of their own: those before are of the most frequent events.
_OTHERS = SERIES[3:]
#: The look of the range in which there is no event.
_NONE = {"facecolor": "0.93", "edgecolor": "0.6", "hatch": "///", "linewidth": 0}


def plot(of: Any, ax: "Axes | None") -> "Axes":
    """Draw the changes of each parameter, in units of its scale, that lead to its nearest events."""
    if not of.parameters:
        raise QuestionError(f"the motion {of.motion.label} is not periodic, so it has no margins to draw")
    ax = new_axes(ax, (7.6, 1.6 + 0.5 * len(of.parameters)))
    colours, head = _colours(of), heading(of.system, tuple(of.parameters))
    shown: set[str] = set()
    for row, margin in enumerate(of.parameters.values()):
        for end, side in ((margin.down, -1), (margin.up, 1)):
            kind = "no event" if end.event is None else end.event["kind"]
            change = ((end.limit if end.at is None else end.at) - margin.value) / margin.scale
            look: dict[str, Any] = _NONE if end.event is None else {"color": colours[kind]}
            ax.barh(row, change, height=0.55, label=None if kind in shown else kind, **look)
            shown.add(kind)
            if end.at is not None:
                ax.annotate(f"{end.at:.3g}", (change, row), (4 * side, 0), textcoords="offset points", va="center",
                            ha="left" if side > 0 else "right", fontsize="small")
    if of.box is not None:
        ax.axvspan(-of.box.size, of.box.size, facecolor="none", edgecolor="black", linestyle="--", label="box", zorder=3)
    ax.axvline(0, color="black", linewidth=0.8)
    ax.set_yticks(range(len(of.parameters)), [equal(axis_of(of.system, one), margin.value) for one, margin in of.parameters.items()])
    ax.invert_yaxis()
    # room for the values at the ends of bars
    ax.margins(x=0.3)
    usual = all(margin.scale == abs(margin.value) for margin in of.parameters.values())
    ax.set_xlabel("change relative to the value" if usual else "change in units of the scale")
    ax.set_title(": ".join(filter(None, (head, named(of.motion.label)))))
    legend(ax)
    return ax


def _colours(of: Any) -> dict[str, str]:
    """The colour of each event in the figure."""
    ends = [end for margin in of.parameters.values() for end in (margin.down, margin.up)]
    kinds = dict.fromkeys(end.event["kind"] for end in ends if end.event is not None)
    colours = {kind: EVENT_COLOURS[kind] for kind in kinds if kind in EVENT_COLOURS}
    others = cycle([colour for colour in _OTHERS if colour not in colours.values()])
    return colours | {kind: next(others) for kind in kinds if kind not in colours}
