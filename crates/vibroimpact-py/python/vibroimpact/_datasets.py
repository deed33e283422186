"""Figures of Datasets: motions over one or two axes or at points, a quantity of them, and orbit diagrams.

The compiled module chooses marks and colours, as it does for the command. Axes and titles use the coordinates, not the plan.
"""

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._stated import SYMBOLS, along, named, plain, span, symbol, title, unit_of

if TYPE_CHECKING:
    import xarray as xr

#: Ways to choose one of several motions, and other names of them.
_CHOICES = {"largest": "largest", "smallest": "smallest", "likeliest": "likeliest", "worst": "largest", "least": "smallest"}
#: Sizes of figures, and of those of diagrams.
_SIZE, _WIDE = (740.0, 500.0), (900.0, 460.0)
#: The code of a label where nothing was computed, and codes that stand for no number.
_NOT_COMPUTED, _NO_CYCLE = -9, -1
#: What a diagram shows.
_ORDINATES = {
    "velocity": "arrival velocity *u*_-", "impact_phase": "phase *θ*", "x": "*ξ* at phase 0", "v": "*u* at phase 0",
    "speed": "speed of closing", "closing_phase": "phase of the forcing",
}
#: The same in metres and seconds.
_PLAIN = {"velocity": "arrival velocity", "x": "*x* at phase 0", "v": "velocity at phase 0"}


def figure_of(ds: "xr.Dataset", which: str | None, colour: str | None, of: str) -> dict[str, Any]:
    """The figure of a Dataset of vibroimpact."""
    if "kind" in ds.data_vars and _ordinates(ds):
        if colour is not None:
            raise QuestionError("only basins and maps have colours by a quantity\nhint: which=... is the ordinate")
        return _diagram(ds, which)
    if "label" not in ds:
        raise QuestionError(
            "this Dataset is none that vibroimpact draws\nhint: those of basin, region_map and orbit_diagram have a figure"
        )
    varied = _sides(ds) if colour is None else []
    return _points(ds, varied) if varied else _cells(ds, colour, of)


def _named(figure: str, x: str, y: str | None, head: str, size: tuple[float, float] = _SIZE) -> dict[str, Any]:
    """A figure of the compiled module with names of axes and a title, wide enough for a legend beside the axes."""
    whole: dict[str, Any] = {**json.loads(figure), **dict(zip(("width", "height"), size))}
    (panel,) = whole["panels"]
    panel["x"]["label"], panel["y"]["label"], whole["title"] = x, panel["y"]["label"] if y is None else y, head
    return whole


def codes_of(array: "xr.DataArray", name: str, nothing: int) -> NDArray[np.int64]:
    """The codes of a variable; points that are in none of several aligned Datasets are nan, and have the code of nothing."""
    values = array.values
    if values.dtype.kind == "f":
        values = np.where(np.isfinite(values), values, nothing)
        broken = values[values != np.round(values)]
        if len(broken):
            raise QuestionError(
                f"`{name}` has the value {broken[0]:g}, which is no code\nhint: codes are names, so means and interpolations have no meaning"
            )
    return values.astype(np.int64)


def _cells(ds: "xr.Dataset", colour: str | None, of: str) -> dict[str, Any]:
    """Motions over one or two axes, the faster one is the abscissa; or the values of a quantity of them."""
    dims = [str(name) for name in ds["label"].dims if name != "motion"]
    if len(dims) not in (1, 2):
        raise QuestionError(
            f"a figure has one or two axes, and there are {len(dims)}: {', '.join(dims)}\nhint: ds.isel(...) takes one value of an axis"
        )
    if of not in _CHOICES:
        raise QuestionError(f"`{of}` is no way to choose one of several motions; there are {', '.join(_CHOICES)}")
    quantity = None if colour is None else _variable(ds, colour)
    for name in dims:
        ds = _in_order(ds, name)
    label = ds["label"].transpose(*dims, ...)

    def flat(name: str, dtype: Any, nothing: float) -> Any:
        array = ds[name].transpose(*(dim for dim in label.dims if dim in ds[name].dims)).values.astype(np.float64)
        return np.where(np.isnan(array), nothing, array).astype(dtype).ravel()

    # cycles that were joined are not numbered in the same way everywhere
    numbered = "cycle_label" in ds and not set(ds["cycle_label"].dims) & set(label.dims)
    further = (
        flat("share", np.float64, 0.0) if "share" in ds and "motion" in label.dims else None,
        flat("cycle", np.int32, _NO_CYCLE) if "cycle" in ds and (numbered or quantity) else None,
        flat("computed", np.int8, 0.0) if "computed" in ds else None,
    )
    shown = None if quantity is None else (flat(quantity, np.float64, np.nan), _CHOICES[of], _quantity(ds, quantity))
    codes = codes_of(label, "label", _NOT_COMPUTED).astype(np.int32).ravel()
    figure = _core.cells_figure([along(ds, name) for name in reversed(dims)], codes, ds.sizes.get("motion", 1), further, shown)
    up = named(ds, dims[0]) if len(dims) == 2 else None
    return _named(figure, named(ds, dims[-1]), up, title(ds, tuple(dims)))


def _in_order(ds: "xr.Dataset", name: str) -> "xr.Dataset":
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


def _variable(ds: "xr.Dataset", colour: str) -> str:
    """The name of a variable with a number for each motion."""
    name = colour.strip().replace("-", "_")
    known = [str(key) for key, of in ds.data_vars.items() if of.dtype.kind == "f" and set(of.dims) == set(ds["label"].dims)]
    if name not in known:
        there = f"there are {', '.join(known)}" if known else "there are none"
        raise QuestionError(f'`{colour}` is no quantity of the motions in this Dataset; {there}\nhint: fields=["{name}"] computes it')
    return name


def _quantity(ds: "xr.Dataset", name: str) -> str:
    """The name of a variable with its unit."""
    attributes = ds[name].attrs
    text, unit = plain(str(attributes.get("long_name", name))), unit_of(attributes)
    return f"{text} ({unit})" if unit else text


def _sides(ds: "xr.Dataset") -> list[str]:
    """What varies along the one dimension of the points of a Dataset; empty for a Dataset with axes."""
    dims = [str(name) for name in ds["label"].dims]
    if len(dims) != 1 or "motion" in dims:
        return []
    varied = [str(name) for name, of in ds.coords.items() if of.dims == (dims[0],) and of.dtype.kind in "iuf"]
    return [] if dims[0] in varied else varied


def _points(ds: "xr.Dataset", varied: list[str]) -> dict[str, Any]:
    """A dot for the motion at each point, over the first two of what varies. The title states the ranges of what else varies."""
    if len(varied) < 2:
        raise QuestionError(f"the points differ in {varied[0]} only, and a figure has two axes\nhint: a map or a diagram over {varied[0]}")
    across, up = varied[:2]
    xs, ys = (ds[name].values.astype(np.float64) for name in (across, up))
    figure = _core.scattered_figure(xs, ys, codes_of(ds["label"], "label", _NOT_COMPUTED).astype(np.int32))
    return _named(figure, named(ds, across), named(ds, up), title(ds, (across, up)))


def shown_path(ds: "xr.Dataset") -> str:
    """The path of the coordinate, velocity or quantity that a diagram of a machine shows; empty if it shows none."""
    task = json.loads(ds.attrs.get("plan", "{}")).get("task", {})
    shown = str(task.get("diagram", {}).get("show", ""))
    return shown if shown in ds.data_vars and shown not in _ORDINATES else ""


def _ordinates(ds: "xr.Dataset") -> dict[str, str]:
    """The variables of a diagram that can be drawn, and their names; coordinates of machines by their paths."""

    def worded(name: str, text: str) -> str:
        if ds.attrs.get("units") != "si":
            return text
        unit = unit_of(ds[name].attrs)
        return f"{_PLAIN.get(name, text)} ({unit})" if unit else text

    known = {name: worded(name, text) for name, text in _ORDINATES.items() if name in ds.data_vars}
    path = shown_path(ds)
    if not path:
        return known
    head, _, name = path.partition(".")
    # the path of a quantity of a coordinate has one more name
    state = head in ("q", "qdot") and "." not in name
    return known | {path: plain(f"{path} at phase 0" if state else path)}


def _diagram(ds: "xr.Dataset", which: str | None) -> dict[str, Any]:
    """The points of all sweeps."""
    drawn = _ordinates(ds)
    which = which or next(iter(drawn))
    if which not in drawn:
        raise QuestionError(f"`{which}` is no variable of this diagram; there are {', '.join(drawn)}")
    task = json.loads(ds.attrs["plan"])["task"]["diagram"] if "plan" in ds.attrs else {}
    ds, vary, rows = _spread(ds, which, task)
    ds = _in_order(ds, vary)
    ways = ds["sweep"].values.astype(int).tolist() if rows == "sweep" and "sweep" in ds.coords else []
    points = ds[which].transpose(rows, vary, "point").values.astype(np.float64)
    keep = min(points.shape[2], task.get("keep", points.shape[2]))
    figure = _core.diagram_figure(along(ds, vary), points, ways, symbol(vary), keep)
    # the second parameter of a line, with its values at the left and the right end
    beside = [name for name in SYMBOLS if name in ds.coords and ds[name].dims == (vary,) and name != vary]
    ends = np.argsort(ds[vary].values)[[0, -1]]
    with_ = (span(named(ds, name), *ds[name].values[ends]) for name in beside)
    return _named(figure, ", with ".join([named(ds, vary), *with_]), drawn[which], title(ds, (vary, *beside)), _WIDE)


def _spread(ds: "xr.Dataset", which: str, task: dict[str, Any]) -> tuple["xr.Dataset", str, str]:
    """The Dataset with all three dimensions of a diagram (dropped ones restored with length 1), and the names of the first two."""
    rows = "start" if "start" in ds.dims or isinstance(task.get("direction"), dict) else "sweep"
    others = [str(name) for name in ds[which].dims if name not in ("sweep", "start", "point")]
    vary = others[0] if others else str(task.get("vary", ""))
    if not others:
        if vary not in ds.coords:
            raise QuestionError("this diagram has no parameter to draw it over\nhint: ds.isel(...) without drop=True keeps its value")
        ds = ds.expand_dims(vary)
    for name in (rows, "point"):
        if name not in ds[which].dims:
            ds = ds.expand_dims(name)
    if len(ds[which].dims) != 3:
        names = ", ".join(map(str, ds[which].dims))
        raise QuestionError(
            f"a diagram is drawn over {rows}, a parameter and point, and the dimensions are {names}\n"
            "hint: ds.isel(...) takes one value of a dimension"
        )
    return ds, vary, rows
