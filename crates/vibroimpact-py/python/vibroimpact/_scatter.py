"""The figure of motions at points: a dot for each, over the first two of what varies, in the colours of the labels."""

from typing import TYPE_CHECKING

from vibroimpact._cells import classes_of
from vibroimpact._core import QuestionError
from vibroimpact._figure import legend, name_axes, new_axes
from vibroimpact._stated import named, title

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


def sides(ds: "xr.Dataset") -> list[str]:
    """What varies along the one dimension of the points of a Dataset; empty for a Dataset with axes."""
    dims = [str(name) for name in ds["label"].dims if name != "motion"]
    if len(dims) != 1 or "motion" in ds["label"].dims:
        return []
    along = [str(name) for name, of in ds.coords.items() if of.dims == (dims[0],) and of.dtype.kind in "iuf"]
    return [] if dims[0] in along else along


def plot(ds: "xr.Dataset", ax: "Axes | None") -> "Axes":
    """Draw the points. The title states the ranges of what else varies."""
    varied = sides(ds)
    if len(varied) < 2:
        raise QuestionError(f"the points differ in {varied[0]} only, and a figure has two axes\nhint: a map or a diagram over {varied[0]}")
    across, up = varied[:2]
    classes, cells = classes_of(ds, ds["label"])
    ax = new_axes(ax, (7.4, 5.0))
    size = 3.0 if len(cells) > 2000 else 6.0
    for k, (name, colour) in enumerate(classes):
        here = cells[:, 0] == k
        ax.plot(ds[across].values[here], ds[up].values[here], "o", color=colour, markersize=size, markeredgecolor="0.38",
                markeredgewidth=0.5, label=name, rasterized=len(cells) > 5000)
    name_axes(ax, named(ds, across), named(ds, up), title(ds, (across, up)))
    legend(ax)
    return ax
