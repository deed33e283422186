"""Figures in a plane of two parameters: curves of events, regions."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vibroimpact._figure import SYMBOLS, legend, named, new_axes, title
from vibroimpact._palette import SERIES, class_colour

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from vibroimpact._curve import Curve
    from vibroimpact._region import Part, Polygon, Region

_KINDS = {"fold": SERIES[1], "flip": SERIES[0], "grazing": SERIES[2]}
_MARKS = {
    "cusp": "v",
    "resonant grazing": "D",
    "double grazing": "s",
    "degenerate grazing": "^",
    "touch": "o",
    "1:2": "o",
    "degenerate flip": "X",
    "loss of contact": "P",
    "whole periods": "P",
    "speeds without bound": "P",
}
#: What bounds a region: colour, dash, words. The frame is the edge of the figure.
_BOUNDS = {
    "fold": (SERIES[1], "-", "fold"),
    "flip": (SERIES[0], "--", "flip"),
    "no speed": (SERIES[2], "-.", "an impact without speed"),
    "touch": ("black", "-", "a touch on the way"),
    "merging": (SERIES[3], ":", "merging"),
}


def _frame(ax: "Axes", of: "Curve | Region") -> None:
    (p, q), (across, up) = of.parameters, of.ranges
    ax.set_xlim(*across)
    ax.set_ylim(*up)
    ax.set_xlabel(f"${SYMBOLS[p]}$")
    ax.set_ylabel(f"${SYMBOLS[q]}$")
    ax.set_title(title(of.osc, (p, q)))
    legend(ax)


def curve(of: "Curve", ax: "Axes | None") -> "Axes":
    """The curve, dotted where the orbit is inadmissible, with its points of codimension two."""
    ax = new_axes(ax, (7.2, 4.8))
    colour, events = _KINDS[of.kind], {event.point for event in of.events}
    # an event lies on the edge and counts for neither side
    steps = [k if k + 1 in events and k not in events else k + 1 for k in range(len(of) - 1)]
    for physical, dash, words in ((True, "-", ""), (False, ":", ", inadmissible")):
        xs, ys = (np.array(column, dtype=float) for column in _broken(of.values, of.physical[steps] == physical))
        if len(xs):
            ax.plot(xs, ys, dash, color=colour, linewidth=1.8, label=f"{of.kind} of {named(of.label)}{words}")
    for kind, mark in _MARKS.items():
        places = [event.values for event in of.events if event.kind == kind]
        if places:
            xs, ys = np.array(places).T
            ax.plot(xs, ys, mark, color="white", markeredgecolor="black", markersize=8, label=kind, zorder=4, clip_on=False)
    begin = of.values[of.through[1]]
    ax.plot(*begin, "o", color="black", markersize=5, label="found on the branch", zorder=5)
    _frame(ax, of)
    return ax


def _broken(values: NDArray[np.float64], drawn: NDArray[np.bool_]) -> tuple[list[float], list[float]]:
    """The steps of a polyline that are drawn, broken by nan."""
    rows: list[NDArray[np.float64]] = []
    for k, draw in enumerate(drawn):
        if draw:
            if k == 0 or not drawn[k - 1]:
                rows += [np.full(2, np.nan), values[k]]
            rows.append(values[k + 1])
    return [float(row[0]) for row in rows], [float(row[1]) for row in rows]


def region(of: "Region", ax: "Axes | None") -> "Axes":
    """Both regions, their edges in the colour of what bounds them; those of the sheet above are thin."""
    ax = new_axes(ax, (7.2, 5.2))
    name = named(of.label)
    exists = "exists, neutrally stable" if of.neutrally_stable else "exists, unstable"
    fills = ((of.existence, "#ececec", exists), (of.stability, class_colour(of.label), "stable"))
    for part, colour, words in fills[: 1 if of.neutrally_stable else 2]:
        _fill(ax, part, colour)
        ax.fill([], [], color=colour, label=f"{name} {words}")
    polygons = of.existence.polygons + of.stability.polygons
    for bound, (colour, dash, words) in _BOUNDS.items():
        label: str | None = words
        for sheet, width in (("above", 0.9), ("below", 2.0)):
            for polygon in polygons:
                xs, ys = _edges(polygon, bound) if polygon.sheet == sheet else ([], [])
                if xs:
                    ax.plot(xs, ys, dash, color=colour, linewidth=width, zorder=2)
                    if label is not None:
                        ax.plot([], [], dash, color=colour, linewidth=2, label=label)
                        label = None
    _frame(ax, of)
    return ax


def _edges(polygon: "Polygon", bound: str) -> tuple[list[float], list[float]]:
    closed = np.vstack([polygon.vertices, polygon.vertices[:1]])
    return _broken(closed, np.array([of == bound for of in polygon.bounds]))


def _fill(ax: "Axes", part: "Part", colour: str) -> None:
    """Each outer ring with the holes in it: sheets of a surface may overlap, so not all rings together."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    from vibroimpact._region import Part as OnePart

    for outer in (polygon for polygon in part.polygons if not polygon.hole):
        alone = OnePart([outer], part.unresolved[:0])
        holes = [
            hole
            for hole in part.polygons
            if hole.hole and hole.sheet == outer.sheet and bool(alone.contains(*hole.vertices[0]))
        ]
        rings = [Path(np.vstack([ring.vertices, ring.vertices[:1]]), closed=True) for ring in (outer, *holes)]
        ax.add_patch(PathPatch(Path.make_compound_path(*rings), facecolor=colour, edgecolor="none", zorder=1))
