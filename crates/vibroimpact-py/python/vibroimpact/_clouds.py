"""The figure of an orbit diagram: a dot for every impact or state over the parameter. The two sweeps have two colours.

Where both sweeps have the same cycle, the small dot of one lies inside the large dot of the other, so both colours are
visible. Motions that do not repeat have small dots in both sweeps.
"""

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact._core import QuestionError
from vibroimpact._figure import ARRIVAL, SYMBOLS, legend, name_axes, new_axes, span
from vibroimpact._palette import SERIES
from vibroimpact._points import shown_path
from vibroimpact._stated import along, named, symbol, title
from vibroimpact._unit_names import unit_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_ORDINATES = {
    "velocity": ARRIVAL,
    "impact_phase": r"phase $\theta$",
    "x": r"$\xi$ at phase 0",
    "v": "$u$ at phase 0",
    "speed": "speed of closing",
    "closing_phase": "phase of the forcing",
}


def _ordinates(ds: "xr.Dataset") -> dict[str, str]:
    """The variables of a diagram that can be drawn, and their names; coordinates of machines by their paths."""
    known = {name: _named(ds, name, text) for name, text in _ORDINATES.items() if name in ds.data_vars}
    path = shown_path(ds)
    if not path:
        return known
    head, _, name = path.partition(".")
    # the path of a quantity of a coordinate has one more name
    state = head in ("q", "qdot") and "." not in name
    return known | {path: f"{path} at phase 0" if state else path}


def _named(ds: "xr.Dataset", name: str, text: str) -> str:
    """The name of a variable, in a Dataset in metres and seconds with its unit."""
    if ds.attrs.get("units") != "si":
        return text
    unit, plain = unit_of(ds[name].attrs), {"velocity": "arrival velocity", "x": "$x$ at phase 0", "v": r"$\dot x$ at phase 0"}
    return f"{plain.get(name, text)} ({unit})" if unit else text


def plot(ds: "xr.Dataset", ax: "Axes | None", which: str | None) -> "Axes":
    """Draw the points of all sweeps. Axes and title use the coordinates, not the plan."""
    drawn = _ordinates(ds)
    which = which or next(iter(drawn))
    if which not in drawn:
        raise QuestionError(f"`{which}` is no variable of this diagram; there are {', '.join(drawn)}")
    task = json.loads(ds.attrs["plan"])["task"]["diagram"] if "plan" in ds.attrs else {}
    ds, vary, rows = _spread(ds, which, task)
    ax = new_axes(ax, (9.0, 4.6))
    size = float(np.clip(430.0 / ds.sizes[vary], 1.2, 3.0))
    values = along(ds, vary)
    ways = ds["sweep"].values.tolist() if rows == "sweep" and "sweep" in ds.coords else []
    keep = min(ds.sizes["point"], task.get("keep", ds.sizes["point"]))
    xs = np.broadcast_to(values[:, None], (len(values), ds.sizes["point"]))
    for k in range(ds.sizes[rows]):
        ys = ds[which].isel({rows: k}).transpose(vary, "point").values
        falling = bool(ways) and ways[k] < 0
        colour = SERIES[1] if falling else SERIES[0]
        # a motion that repeats has large dots in one sweep, under the small dots of the other sweep
        kept = np.isfinite(ys).sum(axis=1)
        repeats = (kept < keep) | (kept == 1)
        large = repeats if len(ways) == 2 and not falling else np.zeros_like(repeats)
        for at, of in ((large, 1.9 * size), (~large, size)):
            ax.plot(xs[at].ravel(), ys[at].ravel(), "o", color=colour, markersize=of, markeredgewidth=0,
                    rasterized=xs.size > 50_000)
        word = f"{symbol(vary)} {'falling' if falling else 'rising'}" if ways else _starts(ds.sizes[rows])
        if ways or k == 0:
            ax.plot([], [], "o", color=colour, markersize=4, label=word)
    if str(task.get("over", "")).endswith(":log") and values.min() > 0:
        ax.set_xscale("log")
    # the second parameter of a line, with its values at the left and the right end
    beside = [name for name in SYMBOLS if name in ds.coords and ds[name].dims == (vary,) and name != vary]
    ends = np.argsort(values)[[0, -1]]
    with_ = (span(named(ds, name), *ds[name].values[ends]) for name in beside)
    name_axes(ax, ", with ".join([named(ds, vary), *with_]), drawn[which], title(ds, (vary, *beside)))
    legend(ax)
    return ax


def is_diagram(ds: "xr.Dataset") -> bool:
    """Whether a Dataset is an orbit diagram or a part of one."""
    return "kind" in ds.data_vars and bool(_ordinates(ds))


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


def _starts(count: int) -> str:
    return "one start at each value" if count == 1 else f"{count} starts at each value"
