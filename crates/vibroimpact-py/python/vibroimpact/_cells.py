"""Figures of basins and maps: which motions there are over two axes, each in its colour.

Where several motions coexist at a point of a map, its cell is divided between them, the most frequent to the left.
"""

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import QuestionError
from vibroimpact._figure import SYMBOLS, legend, new_axes, title
from vibroimpact._palette import CLASSES, LEGEND, legend_group
from vibroimpact._plan import oscillator

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_STARTS = {"x": r"\xi_0", "v": r"u_0", "phase": r"\varphi_0"}
#: Columns beyond which a cell is too narrow to be divided.
_DIVIDED = 400
#: Stripes of a divided cell: of two, three or four motions each has as many.
_STRIPES = 12


def plot(ds: "xr.Dataset", ax: "Axes | None") -> "Axes":
    """Cells over the two axes, the faster one to the right."""
    label = ds["label"]
    dims = [str(name) for name in label.dims if name != "motion"]
    if len(dims) != 2:
        raise QuestionError(
            f"a figure has two axes, and there are {len(dims)}: {', '.join(dims)}\nhint: ds.isel(...) takes one value of an axis"
        )
    up, across = dims
    if up not in ds.coords or across not in ds.coords:
        raise QuestionError("these starts are scattered: they lie on no axes")
    classes, cells = _classes(ds, label.transpose(up, across, ...))
    ax = new_axes(ax, (7.4, 5.0))
    xs, ys = _edges(ds[across].values), _edges(ds[up].values)
    cells, xs = _divided(cells, xs)

    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    colours = ListedColormap([colour for _, colour in classes])
    ax.pcolormesh(xs, ys, cells, cmap=colours, vmin=-0.5, vmax=len(classes) - 0.5, rasterized=True)
    handles = [Patch(facecolor=colour, edgecolor="0.4", linewidth=0.6, label=name) for name, colour in classes]
    legend(ax, handles)
    plan = json.loads(ds.attrs["plan"])
    symbols = SYMBOLS | _STARTS
    ax.set_xlabel(f"${symbols[across]}$")
    ax.set_ylabel(f"${symbols[up]}$")
    ax.set_title(title(oscillator(plan), (across, up)))
    return ax


def _classes(ds: "xr.Dataset", label: "xr.DataArray") -> tuple[list[tuple[str, Any]], NDArray[np.int64]]:
    """Names and colours of what there is, and the class of each cell (and motion); -1 where there is none."""
    names = ds.assign(label=label).vibro.labels().values
    if "motion" not in label.dims:
        names = names[..., None]
    groups = np.array([legend_group(name) if name else "" for name in np.unique(names)])
    group = groups[np.searchsorted(np.unique(names), names)]
    numbers = np.zeros(names.shape, dtype=np.int64)
    if "cycle" in ds:
        # two cycles of one label are two motions
        numbers = np.maximum(ds["cycle"].transpose(*label.dims).values.reshape(names.shape), -1) + 1
    classes: list[tuple[str, Any]] = []
    cells = np.full(names.shape, -1)
    for key in CLASSES:
        here = group == key
        kinds = np.unique(numbers[here])
        for k, number in enumerate(kinds):
            cells[here & (numbers == number)] = len(classes)
            word = LEGEND[key] if k == 0 else f"{LEGEND[key]}, no. {k + 1}"
            classes.append((word, _variant(CLASSES[key], k)))
    if not classes:
        classes = [("not computed", "#ffffff")]
    return classes, cells


def _variant(colour: str, k: int) -> tuple[float, float, float]:
    """Itself, darker, lighter, darker still ... for motions of one class."""
    from matplotlib.colors import to_rgb

    towards, part = (0.0 if k % 2 else 1.0), 1 - 0.6 ** ((k + 1) // 2)
    red, green, blue = to_rgb(colour)
    mixed = [channel + (towards - channel) * part for channel in (red, green, blue)]
    return mixed[0], mixed[1], mixed[2]


def _edges(centres: NDArray[np.float64]) -> NDArray[np.float64]:
    """Edges of cells around values in any order that rises or falls."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    between = 0.5 * (centres[:-1] + centres[1:])
    return np.concatenate([[2 * centres[0] - between[0]], between, [2 * centres[-1] - between[-1]]])


def _divided(
    cells: NDArray[np.int64], xs: NDArray[np.float64]
) -> tuple["np.ma.MaskedArray[Any, np.dtype[np.int64]]", NDArray[np.float64]]:
    """Each cell in stripes, shared by its motions; the first alone where stripes would be too narrow."""
    count = (cells >= 0).sum(axis=-1)
    if count.max(initial=0) <= 1 or cells.shape[1] > _DIVIDED:
        first = cells[..., 0]
        return np.ma.masked_less(first, 0), xs
    stripes = np.arange(_STRIPES)
    which = stripes * np.maximum(count, 1)[..., None] // _STRIPES
    wide = np.take_along_axis(cells, which, axis=-1).reshape(cells.shape[0], -1)
    parts = xs[:-1, None] + np.diff(xs)[:, None] * stripes / _STRIPES
    return np.ma.masked_less(wide, 0), np.append(parts.reshape(-1), xs[-1])
