"""Figures of the compiled module drawn with matplotlib: panels with marks and a legend, as the command draws them."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import QuestionError
from vibroimpact._figure import legend, mathtext, name_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Inches and points of one unit of a figure: larger than in print, as the text of matplotlib is.
_INCHES, _POINTS = 0.01, 0.64
#: Number of points from which they are drawn as an image in a vector graphic.
_MANY = 50_000
_DASHES = {"solid": "-", "dashed": "--", "dotted": ":", "dash_dot": "-."}
_SHAPES = {
    "circle": "o", "square": "s", "diamond": "D", "triangle_up": "^", "triangle_down": "v", "triangle_right": ">", "triangle_left": "<",
    "pentagon": "p", "star": "*", "bar": "d", "cross": "x", "plus": "+",
}
_HATCHES = {"rising": "///", "falling": "\\\\\\", "cross": "xxx", "horizontal": "---", "vertical": "|||", "dots": "..."}
_SIDES = {"above": (0, 1), "below": (0, -1), "right": (1, 1), "left": (1, -1)}


def paint(figure: Mapping[str, Any], axes: Any = None) -> Any:
    """Draw a figure into new axes or into given ones, the first panels if there are fewer. Returns the axes, or an array of them."""
    panels = figure["panels"]
    captions = all(panel["caption"] for panel in panels) and len(panels) > 1
    if axes is None:
        import matplotlib.pyplot as plt

        columns = min(figure["columns"], len(panels))
        rows, size = -(-len(panels) // columns), (figure["width"] * _INCHES, figure["height"] * _INCHES)
        shared = all(panel["x"] == panels[0]["x"] for panel in panels)
        whole, grid = plt.subplots(rows, columns, figsize=size, layout="constrained", sharex=shared, squeeze=False)
        drawn = grid.ravel()[: len(panels)]
        for unused in grid.ravel()[len(panels) :]:
            unused.remove()
        if captions:
            whole.suptitle(mathtext(figure["title"] or ""))
    else:
        drawn = np.atleast_1d(np.asarray(axes, dtype=object)).ravel()
        if not 1 <= len(drawn) <= len(panels):
            raise QuestionError(f"{len(drawn)} axes are given for a figure of {len(panels)} panels")
    for ax, panel in zip(drawn, panels):
        for order, mark in enumerate(panel["marks"]):
            ((kind, of),) = mark.items()
            _MARKS[kind](ax, of, 2 + 0.01 * order)
        _axis(ax.xaxis, ax.set_xlim, panel["x"])
        _axis(ax.yaxis, ax.set_ylim, panel["y"])
        if captions:
            name_axes(ax, title=mathtext(panel["caption"]))
    if not captions:
        name_axes(drawn[0], title=mathtext(figure["title"] or ""))
    _legend(drawn, panels, figure["legend"] or {"entries": []})
    return drawn[0] if len(panels) == 1 else drawn


def _axis(axis: Any, limits: Any, of: Mapping[str, Any]) -> None:
    axis.set_label_text(mathtext(of["label"]), wrap=True)
    if of["scale"] == "log10":
        axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    if of["range"] is not None:
        limits(*of["range"])
    if of["ticks"] is not None:
        shown = [tick for tick in of["ticks"] if tick["label"].strip()]
        axis.set_ticks([tick["value"] for tick in shown], [mathtext(tick["label"]) for tick in shown])


def _legend(drawn: "NDArray[Any]", panels: list[Any], of: Mapping[str, Any]) -> None:
    """Every entry in the panel that has its line or its points, or else in the first one."""
    for entry in of["entries"]:
        ((kind, look),) = entry["key"].items()
        found = (k for k, panel in enumerate(panels) for mark in panel["marks"] for own in mark.values()
                 if look in (own.get("stroke"), own.get("style")))
        place = next(found, 0)
        if place < len(drawn):
            _KEYS[kind](drawn[place], look, mathtext(entry["label"]))
    for ax in drawn:
        legend(ax)


def _numbers(values: list[float | None]) -> NDArray[np.float64]:
    return np.array(values, dtype=np.float64)


def _stroke(of: Mapping[str, Any]) -> dict[str, Any]:
    return {"color": of["colour"], "linewidth": of["width"] * _POINTS, "linestyle": _DASHES[of["dash"]]}


def _style(of: Mapping[str, Any], least: float = 0.0) -> dict[str, Any]:
    filled = of["filled"] and of["shape"] not in ("cross", "plus")
    edge = of["rim"] if of["rim"] is not None and filled else of["colour"]
    return {
        "linestyle": "", "marker": _SHAPES[of["shape"]], "markersize": max(of["size"] * _POINTS, least), "color": of["colour"],
        "markerfacecolor": of["colour"] if filled else of["rim"] or "none", "markeredgecolor": edge,
        "markeredgewidth": 0.8 if of["rim"] is not None or not filled else 0.0,
    }


def _fill(of: Mapping[str, Any]) -> dict[str, Any]:
    hatch = of["hatch"]
    lines = {} if hatch is None else {"hatch": _HATCHES[hatch["pattern"]], "edgecolor": hatch["colour"]}
    return {"facecolor": of["colour"] or "none", "linewidth": 0, **lines}


def _line(ax: "Axes", of: Mapping[str, Any], order: float) -> None:
    ax.plot(_numbers(of["xs"]), _numbers(of["ys"]), **_stroke(of["stroke"]), zorder=order)


def _points(ax: "Axes", of: Mapping[str, Any], order: float) -> None:
    xs, ys = _numbers(of["xs"]), _numbers(of["ys"])
    ax.plot(xs, ys, **_style(of["style"]), zorder=order, rasterized=len(xs) > _MANY, clip_on=len(xs) > _MANY)


def _rects(ax: "Axes", of: Mapping[str, Any], order: float) -> None:
    from matplotlib.collections import PolyCollection

    for number, style in enumerate(of["styles"]):
        sides = [(*one["x"], *one["y"]) for one in of["rects"] if one["class"] == number]
        corners = [[(left, low), (right, low), (right, high), (left, high)] for left, right, low, high in sides]
        ax.add_collection(PolyCollection(corners, **_fill(style), zorder=order))


def _region(ax: "Axes", of: Mapping[str, Any], order: float) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    rings = [Path(np.array([*ring, ring[0]]), closed=True) for ring in of["rings"]]
    outline = {} if of["outline"] is None else {**_stroke(of["outline"]), "edgecolor": of["outline"]["colour"]}
    outline.pop("color", None)
    look = {**_fill({"colour": of["fill"], "hatch": of["hatch"]}), **outline}
    ax.add_patch(PathPatch(Path.make_compound_path(*rings), **look, zorder=order))


def _text(ax: "Axes", of: Mapping[str, Any], order: float) -> None:
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=2, foreground="white")] if of["halo"] else None
    ax.annotate(mathtext(of["markup"]), (of["x"], of["y"]), (of["dx"] * _POINTS, of["dy"] * _POINTS), textcoords="offset points",
                ha={"start": "left", "middle": "center", "end": "right"}[of["anchor"]], va="center", color=of["colour"],
                fontsize="small", path_effects=halo, zorder=order)


def _wall(ax: "Axes", of: Mapping[str, Any], order: float) -> None:
    """A line, and behind it a hatch as far as any motion goes."""
    upright, sign = _SIDES[of["side"]]
    line, band = (ax.axvline, ax.axvspan) if upright else (ax.axhline, ax.axhspan)
    far = of["at"] + sign * max(1e3 * abs(of["at"]), 1e6)
    band(of["at"], far, facecolor="0.9", edgecolor="0.6", hatch="///", linewidth=0, zorder=0)
    line(of["at"], color=of["colour"], linewidth=1, zorder=order)


_MARKS: dict[str, Any] = {
    "line": _line, "points": _points, "rects": _rects, "filled_region": _region, "text": _text, "wall": _wall,
    "h_line": lambda ax, of, order: ax.axhline(of["y"], **_stroke(of["stroke"]), zorder=order),
    "v_line": lambda ax, of, order: ax.axvline(of["x"], **_stroke(of["stroke"]), zorder=order),
}
#: The signs of a legend; a small point is larger there, so that it is visible.
_KEYS: dict[str, Any] = {
    "line": lambda ax, look, label: ax.plot([], [], **_stroke(look), label=label),
    "point": lambda ax, look, label: ax.plot([], [], **_style(look, 4.0), label=label),
    "patch": lambda ax, look, label: ax.fill([], [], **_fill(look), label=label),
    "outline": lambda ax, look, label: ax.fill([], [], facecolor="none", edgecolor=look["colour"], label=label),
}
