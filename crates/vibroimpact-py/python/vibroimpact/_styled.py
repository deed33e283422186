"""What all figures take: axes to draw into, a legend or none, a title, and properties of lines."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Drawn = TypeVar("Drawn")


class _Before(NamedTuple):
    """Axes that had something in them before."""

    axes: "Axes"
    limits: tuple[tuple[float, float], tuple[float, float]]
    title: str


def styled(draw: Callable[[Any], Drawn], ax: Any, legend: bool, title: str | None, line: Mapping[str, Any]) -> Drawn:
    """Draw into axes, and return what `draw` returns: axes, or an array of them.

    What was in the axes before stays in view, and so does its title. `line` are properties of the lines that are drawn.
    """
    from vibroimpact._figure import legend as add_legend

    given = [] if ax is None else _axes(ax)
    before = [_Before(one, (one.get_xlim(), one.get_ylim()), one.get_title()) for one in given if one.has_data()]
    old = {id(of) for one in given for of in one.get_lines()}
    drawn = draw(ax)
    panels = _axes(drawn)
    for one in before:
        one.axes.set_xlim(_both(one.limits[0], one.axes.get_xlim()))
        one.axes.set_ylim(_both(one.limits[1], one.axes.get_ylim()))
        one.axes.set_title(one.title or one.axes.get_title())
    for panel in panels:
        shown = panel.get_legend()
        for of in panel.get_lines() if line else ():
            if id(of) not in old:
                of.set(**line)
        if shown is not None and not legend:
            shown.remove()
        elif shown is not None and (line or before) and panel.get_legend_handles_labels()[0]:
            add_legend(panel)
    if title is not None:
        panels[0].set_title(title)
    return drawn


def _axes(of: Any) -> "list[Axes]":
    return list(np.atleast_1d(np.asarray(of, dtype=object)).ravel())


def _both(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    """Limits that hold both, in the direction of the first ones."""
    low, high = min(*one, *other), max(*one, *other)
    return (low, high) if one[0] <= one[1] else (high, low)
