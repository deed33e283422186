"""Figures of the compiled module drawn with matplotlib: panels with marks and a legend, as the command draws them.

All figures take axes to draw into, a legend or none, a title, and properties of lines.
"""

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import QuestionError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Inches and points of one unit of a figure: larger than in print, as the text of matplotlib is.
_INCHES, _POINTS = 0.01, 0.64
#: Number of points from which they are drawn as an image in a vector graphic.
_MANY = 50_000
#: Number of cells of a class above which they are one path.
_MANY_CELLS = 500
_DASHES = {"solid": "-", "dashed": "--", "dotted": ":", "dash_dot": "-."}
_SHAPES = {
    "circle": "o", "square": "s", "diamond": "D", "triangle_up": "^", "triangle_down": "v", "triangle_right": ">", "triangle_left": "<",
    "pentagon": "p", "star": "*", "bar": "d", "cross": "x", "plus": "+",
}
_HATCHES = {"rising": "///", "falling": "\\\\\\", "cross": "xxx", "horizontal": "---", "vertical": "|||", "dots": "..."}
#: Width of axes in inches below which there is no room for a legend beside them, and how far below the axes it then begins.
_NARROW, _BELOW = 3.6, 0.42
#: Number of entries above which a narrow legend has three columns.
_MANY_ENTRIES = 6
_TOKENS = re.compile(r"\\(.)|(\*\*)|(\*)|([_^])(?:\{([^}]*)\}|(.))|([^\\*_^]+)")
_SIDES = {"above": (0, 1), "below": (0, -1), "right": (1, 1), "left": (1, -1)}


class _Before(NamedTuple):
    """Axes that had something in them before."""

    axes: "Axes"
    limits: tuple[tuple[float, float], tuple[float, float]]
    title: str


def paint(
    figure: Mapping[str, Any], ax: Any = None, legend: bool = True, title: str | None = None,
    line: Mapping[str, Any] = MappingProxyType({}),
) -> Any:
    """Draw a figure into new axes or into given ones, the first panels if there are fewer. Returns the axes, or an array of them.

    What was in the axes before stays in view, and so does its title. `line` are properties of the lines that are drawn.
    """
    given = [] if ax is None else _all_axes(ax)
    before = [_Before(one, (one.get_xlim(), one.get_ylim()), one.get_title()) for one in given if one.has_data()]
    old = {id(of) for one in given for of in one.get_lines()}
    drawn = _draw(figure, ax)
    panels = _all_axes(drawn)
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
            _add_legend(panel)
    if title is not None:
        panels[0].set_title(title)
    return drawn


def _all_axes(of: Any) -> "list[Axes]":
    return list(np.atleast_1d(np.asarray(of, dtype=object)).ravel())


def _both(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    """Limits that hold both, in the direction of the first ones."""
    low, high = min(*one, *other), max(*one, *other)
    return (low, high) if one[0] <= one[1] else (high, low)


def _add_legend(ax: "Axes", below: str | None = None) -> None:
    """Add a legend where it covers nothing: to the right of the axes, or below them if they are as narrow as a column of text, or if
    there is a colour bar; then it has the title `below`."""
    of = ax.get_legend_handles_labels()[0]
    if not of and not below:
        return
    # of one label once: several figures may be in these axes
    once = {str(handle.get_label()): handle for handle in reversed(of)}
    shown = list(reversed(once.values()))
    narrow = ax.get_position().width * ax.figure.get_figwidth() < _NARROW  # type: ignore[union-attr]
    if below is None and not narrow:
        ax.legend(handles=shown, loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, borderaxespad=0.0)
        return
    from matplotlib.transforms import ScaledTranslation

    columns = {"ncols": 3 if len(shown) > _MANY_ENTRIES else 2, "columnspacing": 1.0, "handlelength": 1.5, "handletextpad": 0.5}
    place = ax.transAxes + ScaledTranslation(0, -_BELOW, ax.figure.dpi_scale_trans)
    small = "x-small" if narrow else "small"
    ax.legend(handles=shown, title=below or None, loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=place, frameon=False,
              borderaxespad=0.0, fontsize=small, title_fontsize=small, **(columns if narrow else {"ncols": max(len(shown), 1)}))


def mathtext(markup: str) -> str:
    """A label with `*italics*`, `_sub` and `^super` scripts as matplotlib writes it."""
    text, italic = "", False
    for escaped, _, star, script, group, one, plain in _TOKENS.findall(markup):
        part = (escaped or plain).replace("$", r"\$")
        if star:
            italic = not italic
        elif script:
            text += f"${script}{{{group or one}}}$"
        else:
            text += f"${part}$" if italic else part
    return text.replace("$$", "")


def named(label: str) -> str:
    """The text of a label in a figure."""
    return "no impact" if label == "0" else label.replace("inf", "∞")


def _draw(figure: Mapping[str, Any], axes: Any) -> Any:
    """The figure alone."""
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
        drawn = np.array(_all_axes(axes), dtype=object)
        if not 1 <= len(drawn) <= len(panels):
            raise QuestionError(f"{len(drawn)} axes are given for a figure of {len(panels)} panels")
    for ax, panel in zip(drawn, panels):
        for order, mark in enumerate(panel["marks"]):
            ((kind, of),) = mark.items()
            _MARKS[kind](ax, of, 2 + 0.01 * order)
        _axis(ax.xaxis, ax.set_xlim, panel["x"])
        _axis(ax.yaxis, ax.set_ylim, panel["y"])
        if captions:
            ax.set_title(mathtext(panel["caption"]), wrap=True)
    if not captions:
        drawn[0].set_title(mathtext(figure["title"] or ""), wrap=True)
    legend = figure["legend"] or {"entries": [], "title": None}
    bar = figure.get("colour_bar")
    if bar is not None:
        _colour_bar(drawn[0], bar["axis"])
    _legend(drawn, panels, legend, None if bar is None else legend["title"] or "")
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


def _legend(drawn: "NDArray[Any]", panels: list[Any], of: Mapping[str, Any], below: str | None) -> None:
    """Every entry in the panel that has its line or its points, or else in the first one."""
    for entry in of["entries"]:
        ((kind, look),) = entry["key"].items()
        found = (k for k, panel in enumerate(panels) for mark in panel["marks"] for own in mark.values()
                 if look in (own.get("stroke"), own.get("style")))
        place = next(found, 0)
        if place < len(drawn):
            _KEYS[kind](drawn[place], look, mathtext(entry["label"]))
    for ax in drawn:
        _add_legend(ax, below)


def _colour_bar(ax: "Axes", of: Mapping[str, Any]) -> None:
    """The colours of the values of a quantity, beside the axes."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    values = ScalarMappable(Normalize(*of["range"]), "viridis")
    ax.figure.colorbar(values, ax=ax, label=mathtext(of["label"]), pad=0.02)


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
    from matplotlib.collections import PathCollection
    from matplotlib.path import Path

    sides = np.array([(*one["x"], *one["y"]) for one in of["rects"]], dtype=np.float64).reshape(-1, 4)
    classes = np.array([one["class"] for one in of["rects"]])
    for number, style in enumerate(of["styles"]):
        left, right, low, high = sides[classes == number].T
        if len(left):
            corners = np.array([[left, low], [right, low], [right, high], [left, high], [left, low]]).transpose(2, 0, 1)
            # the hatch of many cells is drawn once
            many = corners[None].reshape(1, -1, 2) if len(left) > _MANY_CELLS else corners
            codes = np.tile([Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY], many.shape[1] // 5)
            # neighbours join without a seam
            paths = [Path(one, codes) for one in many]
            ax.add_collection(PathCollection(paths, **_fill(style), antialiased=False, zorder=order), autolim=False)
            ax.update_datalim(corners.reshape(-1, 2))


def _raster(ax: "Axes", of: Mapping[str, Any], order: float) -> None:
    """Equal cells in the colours of their classes; a class without a colour is left out."""
    from matplotlib.colors import ListedColormap

    xs, ys = (np.linspace(of[name][0], of[name][1], of[f"n{name}"] + 1) for name in ("x", "y"))
    classes, count = np.reshape(of["classes"], (of["ny"], of["nx"])), len(of["palette"])
    shown = np.ma.masked_greater_equal(classes, count)
    ax.pcolormesh(xs, ys, shown, cmap=ListedColormap(of["palette"]), vmin=-0.5, vmax=count - 0.5, rasterized=True, zorder=order)


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
    "line": _line, "points": _points, "rects": _rects, "raster": _raster, "filled_region": _region, "text": _text, "wall": _wall,
    "h_line": lambda ax, of, order: ax.axhline(of["y"], **_stroke(of["stroke"]), zorder=order),
    "v_line": lambda ax, of, order: ax.axvline(of["x"], **_stroke(of["stroke"]), zorder=order),
}
#: The signs of a legend; a small point is larger there, so that it is visible.
_KEYS: dict[str, Any] = {
    "line": lambda ax, look, label: ax.plot([], [], **_stroke(look), label=label),
    "point": lambda ax, look, label: ax.plot([], [], **_style(look, 4.0), label=label),
    "patch": lambda ax, look, label: ax.fill([], [], **{"edgecolor": "0.4", **_fill(look), "linewidth": 0.6}, label=label),
    "outline": lambda ax, look, label: ax.fill([], [], facecolor="none", edgecolor=look["colour"], label=label),
}
