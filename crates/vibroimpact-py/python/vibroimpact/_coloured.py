"""Figures of a quantity of motions: cells in the colours of its values, or dots over one axis.

The colours are viridis, as in the command. Cells without a value have looks of their own, which the legend explains.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._cells import axes_of, edges, in_order
from vibroimpact._core import QuestionError
from vibroimpact._figure import legend, name_axes, new_axes
from vibroimpact._palette import class_colour, legend_words
from vibroimpact._stated import named, title
from vibroimpact._unit_names import unit_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Values that are no finite number: face, lines and hatch of their cells, in the order of the legend.
MISSING = {
    "infinite": ("#f29bc1", "#931f5c", "\\\\\\\\"),
    "not defined": ("#b8b8b8", "#606060", "////"),
    "undecided": ("#ffffff", "#d02020", "xxxx"),
    "not computed": ("#ffffff", "#606060", ""),
}
#: The sentence of the figure for each way to choose one of several motions, and the other names of these ways.
_SENTENCES = {
    "largest": "where motions coexist: the largest value",
    "smallest": "where motions coexist: the smallest value",
    "likeliest": "where motions coexist: the most frequent motion",
}
_OTHER_NAMES = {"worst": "largest", "least": "smallest"}
#: Codes of labels: nothing was computed, and there is no further motion.
_NOT_COMPUTED, _NO_MOTION = -9, -1
#: Distance of the marks of missing values from the values, relative to the range of values.
_AWAY = 0.08


def plot(ds: "xr.Dataset", ax: "Axes | None", colour: str, of: str) -> "Axes":
    """Draw the values of a variable over one or two axes."""
    name, of = _variable(ds, colour), _OTHER_NAMES.get(of, of)
    if of not in _SENTENCES:
        known = ", ".join([*_SENTENCES, *_OTHER_NAMES])
        raise QuestionError(f"`{of}` is no way to choose one of several motions; there are {known}")
    dims = axes_of(ds, (1, 2))
    for dim in dims:
        ds = in_order(ds, dim)
    values, missing, words = _values(ds, name, dims)
    if len(dims) == 1:
        return _dots(ds, new_axes(ax, (7.4, 4.6)), name, dims[0], (values, missing, words))
    several = bool(((words != "").sum(axis=-1) > 1).any())
    return _plane(ds, new_axes(ax, (7.0, 5.4)), name, dims, (*_chosen(values, missing, of), _SENTENCES[of] if several else None))


def _variable(ds: "xr.Dataset", colour: str) -> str:
    """The name of a variable with a number for each motion."""
    name = colour.strip().replace("-", "_")
    known = [
        str(key) for key, of in ds.data_vars.items() if of.dtype.kind == "f" and set(of.dims) == set(ds["label"].dims)
    ]
    if name not in known:
        there = f"there are {', '.join(known)}" if known else "there are none"
        raise QuestionError(
            f'`{colour}` is no quantity of the motions in this Dataset; {there}\nhint: fields=["{name}"] computes it'
        )
    return name


def _values(
    ds: "xr.Dataset", name: str, dims: list[str]
) -> tuple[NDArray[np.float64], NDArray[np.str_], NDArray[np.str_]]:
    """The values of all motions, the reason why a value is missing ("" if it is not) and the labels ("" for no motion)."""
    label = ds["label"].transpose(*dims, ...)
    words = ds.assign(label=label).vibro.labels().values
    codes = label.values
    values = ds[name].transpose(*dims, ...).values.astype(np.float64)
    if "motion" not in label.dims:
        words, codes, values = words[..., None], codes[..., None], values[..., None]
    missing = np.full(values.shape, "", dtype="<U12")
    missing[np.isnan(values)] = "not defined"
    missing[np.isnan(values) & (words == "undecided")] = "undecided"
    missing[np.isinf(values)] = "infinite"
    if "computed" in ds and "cycle" not in ds:
        # a cell that took the label of its neighbours has no quantities of its own, unless all starts are of one system
        own = ds["computed"].transpose(*dims).values == 1
        missing[(missing == "not defined") & ~own[..., None]] = "not computed"
    there = words != ""
    missing[~there] = "not computed"
    # a point without any motion that was computed is no valid system
    invalid = ~there.any(axis=-1) & np.isfinite(codes[..., 0]) & (codes[..., 0] != _NOT_COMPUTED)
    missing[invalid, 0] = "not defined"
    values = np.where(missing == "", values, np.nan)
    return values, missing, words


def _chosen(
    values: NDArray[np.float64], missing: NDArray[np.str_], of: str
) -> tuple[NDArray[np.float64], NDArray[np.str_]]:
    """One of the motions of each cell: the first, or that with the largest or smallest value. Motions without a value are
    passed over if another motion has one; an infinite value is the largest."""
    place = np.zeros(values.shape[:-1], dtype=np.int64)
    if of != "likeliest":
        size = np.nan_to_num(values if of == "largest" else -values, nan=0.0)
        order = {"": 3, "infinite": 4 if of == "largest" else 2, "undecided": 1, "not defined": 0, "not computed": -1}
        rank = np.vectorize(order.__getitem__, otypes=[np.int64])(missing)
        size = np.where(rank == rank.max(axis=-1, keepdims=True), size, -np.inf)
        place = np.argmax(size, axis=-1)
    at = place[..., None]
    return np.take_along_axis(values, at, -1)[..., 0], np.take_along_axis(missing, at, -1)[..., 0]


def _quantity(ds: "xr.Dataset", name: str) -> str:
    """The name of a variable with its unit."""
    attributes = ds[name].attrs
    text, unit = str(attributes.get("long_name", name)), unit_of(attributes)
    return f"{text} ({unit})" if unit else text


def _plane(
    ds: "xr.Dataset",
    ax: "Axes",
    name: str,
    dims: list[str],
    cells: tuple[NDArray[np.float64], NDArray[np.str_], str | None],
) -> "Axes":
    """Cells in colours, with a colour bar."""
    from matplotlib.collections import PolyCollection
    from matplotlib.patches import Patch

    up, across = dims
    values, missing, sentence = cells
    xs, ys = edges(ds[across].values), edges(ds[up].values)
    if np.isfinite(values).any():
        mesh = ax.pcolormesh(xs, ys, np.ma.masked_invalid(values), cmap="viridis", rasterized=True)
        ax.figure.colorbar(mesh, ax=ax, label=_quantity(ds, name), pad=0.02)
    handles = []
    for reason, (face, lines, hatch) in MISSING.items():
        rectangles = _rectangles(missing == reason, xs, ys)
        if rectangles:
            look: dict[str, Any] = {"facecolor": face, "edgecolor": lines, "hatch": hatch}
            ax.add_collection(PolyCollection(rectangles, linewidth=0, **look), autolim=False)
            handles.append(Patch(**look, linewidth=0.6, label=reason))
    ax.set_xlim(min(xs[0], xs[-1]), max(xs[0], xs[-1]))
    ax.set_ylim(min(ys[0], ys[-1]), max(ys[0], ys[-1]))
    name_axes(ax, named(ds, across), named(ds, up), title(ds, (across, up)))
    legend(ax, handles, below=sentence or "")
    return ax


def _rectangles(
    where: NDArray[np.bool_], xs: NDArray[np.float64], ys: NDArray[np.float64]
) -> list[list[tuple[float, float]]]:
    """The corners of rectangles over cells; neighbours in a row are one rectangle."""
    found = []
    for j in np.flatnonzero(where.any(axis=1)):
        ends = np.flatnonzero(np.diff(np.concatenate([[False], where[j], [False]]).astype(np.int8)))
        for first, last in zip(ends[::2], ends[1::2]):
            left, right, low, high = xs[first], xs[last], ys[j], ys[j + 1]
            found.append([(left, low), (right, low), (right, high), (left, high)])
    return found


def _dots(
    ds: "xr.Dataset",
    ax: "Axes",
    name: str,
    dim: str,
    of: tuple[NDArray[np.float64], NDArray[np.str_], NDArray[np.str_]],
) -> "Axes":
    """The values of all motions over one axis, in the colours of their labels; marks for values that are missing."""
    values, missing, words = of
    xs = np.broadcast_to(ds[dim].values[:, None], values.shape)
    size = 3.5 if len(xs) > 120 else 6.0
    for label, text in legend_words(words[(words != "") & (missing == "")].tolist()).items():
        here = (words == label) & (missing == "")
        ax.plot(xs[here], values[here], "o", color=class_colour(label), markersize=size, markeredgecolor="0.38",
                markeredgewidth=0.7, label=text)
    finite = values[np.isfinite(values)]
    low, high = (finite.min(), finite.max()) if len(finite) else (0.0, 1.0)
    away = _AWAY * ((high - low) or abs(low) or 1.0)
    for reason, (_, colour, _) in MISSING.items():
        here = (missing == reason) & ((words != "") | (reason == "not defined"))
        if here.any():
            y, mark = {"infinite": (high + away, "^"), "undecided": (low - away, "x")}.get(reason, (low - 2 * away, "+"))
            ax.plot(xs[here], np.full(int(here.sum()), y), mark, color=colour, markersize=size, label=reason)
    name_axes(ax, named(ds, dim), _quantity(ds, name), title(ds, (dim,)))
    legend(ax)
    return ax
