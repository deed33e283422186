"""Figures of basins and maps: the motions over two axes, in colours, or their shares over one axis.

If several motions coexist at a point of a map, its cell is divided between them, with the most frequent on the left.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._core import QuestionError
from vibroimpact._figure import legend, name_axes, new_axes
from vibroimpact._palette import class_colour, legend_words, variant
from vibroimpact._stated import along, named, title

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: With more columns than this, cells are too narrow to be divided.
_DIVIDED = 400
#: Number of stripes of a divided cell: divisible by two, three and four, so that up to four motions have equal parts.
_STRIPES = 12


def plot(ds: "xr.Dataset", ax: "Axes | None") -> "Axes":
    """Draw cells over two axes; the faster one is the abscissa. Axes and title use the coordinates, not the plan."""
    shares = "motion" in ds["label"].dims and "share" in ds
    dims = axes_of(ds, (1, 2) if shares else (2,))
    if len(dims) == 1:
        return _shares(in_order(ds, dims[0]), ax, dims[0])
    up, across = dims
    for name in dims:
        ds = in_order(ds, name)
    classes, cells = classes_of(ds, ds["label"].transpose(up, across, ...))
    ax = new_axes(ax, (7.4, 5.0))
    xs, ys = edges(ds[across].values), edges(ds[up].values)
    cells, xs = _divided(cells, xs)

    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    colours = ListedColormap([colour for _, colour in classes])
    ax.pcolormesh(xs, ys, cells, cmap=colours, vmin=-0.5, vmax=len(classes) - 0.5, rasterized=True)
    handles = [Patch(facecolor=colour, edgecolor="0.4", linewidth=0.6, label=name) for name, colour in classes]
    legend(ax, handles)
    name_axes(ax, named(ds, across), named(ds, up), title(ds, (across, up)))
    return ax


def axes_of(ds: "xr.Dataset", allowed: tuple[int, ...]) -> list[str]:
    """The dimensions of the cells, the slowest first, if their number is allowed."""
    dims = [str(name) for name in ds["label"].dims if name != "motion"]
    if len(dims) not in allowed:
        words = " or ".join({1: "one", 2: "two"}[count] for count in allowed)
        raise QuestionError(
            f"a figure has {words} axes, and there are {len(dims)}: {', '.join(dims)}\nhint: ds.isel(...) takes one value of an axis"
        )
    return dims


def _shares(ds: "xr.Dataset", ax: "Axes | None", dim: str) -> "Axes":
    """Stacked bars over one axis: the shares of starts that lead to the motions of each group."""
    words = ds["label"].transpose(dim, "motion")
    names = ds.assign(label=words).vibro.labels().values
    shares = np.nan_to_num(ds["share"].transpose(dim, "motion").values)
    ax = new_axes(ax, (7.4, 4.2))
    xs = edges(ds[dim].values)
    bottom = np.zeros(len(names))
    for name, word in legend_words(_common(names[(names != "") & (shares > 0)])).items():
        height = np.where(names == name, shares, 0.0).sum(axis=1)
        # undecided starts are hatched, because white bars would look like none
        hatch = "xxxx" if name == "undecided" else None
        ax.bar(xs[:-1], height, np.diff(xs), bottom, align="edge", facecolor=class_colour(name), edgecolor="#d02020", hatch=hatch,
               linewidth=0, label=word)
        bottom += height
    ax.set_xlim(min(xs[0], xs[-1]), max(xs[0], xs[-1]))
    ax.set_ylim(0, 1)
    name_axes(ax, named(ds, dim), "share of starts", title(ds, (dim,)))
    legend(ax)
    return ax


def in_order(ds: "xr.Dataset", name: str) -> "xr.Dataset":
    """The Dataset sorted along an axis, unless its values already rise or fall, as neighbouring cells require."""
    steps = np.diff(along(ds, name))
    if np.all(steps > 0) or np.all(steps < 0):
        return ds
    ds = ds.sortby(name)
    values = ds[name].values
    twice = values[1:][values[1:] == values[:-1]]
    if len(twice):
        raise QuestionError(f'{name} = {twice[0]:g} is there more than once\nhint: ds.drop_duplicates("{name}") keeps the first')
    return ds


def classes_of(ds: "xr.Dataset", label: "xr.DataArray") -> tuple[list[tuple[str, Any]], NDArray[np.int64]]:
    """Names and colours of the classes of motions, and the class of each cell (and motion); -1 for no motion."""
    names = ds.assign(label=label).vibro.labels().values
    if "motion" not in label.dims:
        names = names[..., None]
    found, place = np.unique(names, return_inverse=True)
    place = place.reshape(names.shape)
    numbers = np.zeros(names.shape, dtype=np.int64)
    if _numbered(ds, label):
        # two cycles with the same label are two motions
        numbers = np.maximum(ds["cycle"].transpose(*label.dims).values.reshape(names.shape), -1) + 1
    classes: list[tuple[str, Any]] = []
    cells = np.full(names.shape, -1)
    for name, word in legend_words(_common(names[names != ""])).items():
        here = place == np.searchsorted(found, name)
        for k, number in enumerate(np.unique(numbers[here])):
            cells[here & (numbers == number)] = len(classes)
            classes.append((f"{word}, no. {k + 1}" if k else word, variant(class_colour(name), k)))
    return classes or [("not computed", "#ffffff")], cells


def _common(names: NDArray[np.str_]) -> list[str]:
    """The distinct names, the most common first."""
    distinct, counts = np.unique(names, return_counts=True)
    found: list[str] = distinct[np.argsort(-counts, kind="stable")].tolist()
    return found


def _numbered(ds: "xr.Dataset", label: "xr.DataArray") -> bool:
    """Whether cycles are numbered in the same way everywhere, which is not the case in Datasets that were joined."""
    return "cycle" in ds and "cycle_label" in ds and ds["cycle"].dims == ds["label"].dims and not (
        set(ds["cycle_label"].dims) & set(label.dims)
    )


def edges(centres: NDArray[np.float64]) -> NDArray[np.float64]:
    """Edges of cells around values that rise or fall."""
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    between = 0.5 * (centres[:-1] + centres[1:])
    return np.concatenate([[2 * centres[0] - between[0]], between, [2 * centres[-1] - between[-1]]])


def _divided(
    cells: NDArray[np.int64], xs: NDArray[np.float64]
) -> tuple["np.ma.MaskedArray[Any, np.dtype[np.int64]]", NDArray[np.float64]]:
    """Divide cells into stripes, one part for each motion. If stripes would be too narrow, only the first motion is kept."""
    count = (cells >= 0).sum(axis=-1)
    if count.max(initial=0) <= 1 or cells.shape[1] > _DIVIDED:
        first = cells[..., 0]
        return np.ma.masked_less(first, 0), xs
    stripes = np.arange(_STRIPES)
    which = stripes * np.maximum(count, 1)[..., None] // _STRIPES
    wide = np.take_along_axis(cells, which, axis=-1).reshape(cells.shape[0], -1)
    parts = xs[:-1, None] + np.diff(xs)[:, None] * stripes / _STRIPES
    return np.ma.masked_less(wide, 0), np.append(parts.reshape(-1), xs[-1])
