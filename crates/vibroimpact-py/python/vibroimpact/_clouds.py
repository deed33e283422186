"""The figure of an orbit diagram: a dot for every impact or state over the parameter, the sweeps in two colours.

Where both sweeps have the same cycle, the small dot of one lies inside the large dot of the other and both colours are
seen. What does not repeat itself has small dots in both.
"""

import json
from typing import TYPE_CHECKING

import numpy as np

from vibroimpact._core import QuestionError
from vibroimpact._figure import ARRIVAL, SYMBOLS, Scale, legend, new_axes, title
from vibroimpact._palette import SERIES
from vibroimpact._plan import oscillator

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_ORDINATES = {"velocity": ARRIVAL, "impact_phase": r"phase $\theta$", "x": r"$\xi$ at phase 0", "v": "$u$ at phase 0"}


def plot(ds: "xr.Dataset", ax: "Axes | None", which: str | None) -> "Axes":
    """Points of all sweeps."""
    plan = json.loads(ds.attrs["plan"])
    task = plan["task"]["diagram"]
    vary, which = task["vary"], which or ("velocity" if "velocity" in ds else "x")
    if which not in ds or which not in _ORDINATES:
        drawn = [name for name in _ORDINATES if name in ds]
        raise QuestionError(f"`{which}` is no variable of this diagram; there are {', '.join(drawn)}")
    ax = new_axes(ax, (9.0, 4.6))
    size = float(np.clip(430.0 / ds.sizes[vary], 1.2, 3.0))
    rows = "sweep" if "sweep" in ds.dims else "start"
    ways = ds["sweep"].values.tolist() if rows == "sweep" else []
    xs = np.broadcast_to(ds[vary].values[:, None], (ds.sizes[vary], ds.sizes["point"]))
    for k in range(ds.sizes[rows]):
        one = ds.isel({rows: k})
        ys = one[which].transpose(vary, "point").values
        falling = bool(ways) and ways[k] < 0
        colour = SERIES[1] if falling else SERIES[0]
        # small dots of the other sweep lie on the large ones of a motion that repeats itself
        kept = np.isfinite(ys).sum(axis=1)
        repeats = (kept < task["keep"]) | (kept == 1)
        large = repeats if len(ways) == 2 and not falling else np.zeros_like(repeats)
        for at, of in ((large, 1.9 * size), (~large, size)):
            ax.plot(xs[at].ravel(), ys[at].ravel(), "o", color=colour, markersize=of, markeredgewidth=0,
                    rasterized=xs.size > 50_000)
        if ways or k == 0:
            word = "falling" if falling else "rising"
            label = f"${SYMBOLS[vary]}$ {word}" if ways else f"{ds.sizes[rows]} starts at each value"
            ax.plot([], [], "o", color=colour, markersize=4, label=label)
    osc = oscillator(plan)
    also = tuple(task["also"].values()) if "also" in task else None
    values = ds[vary].values
    if task["over"].endswith(":log"):
        ax.set_xscale("log")
    ax.set_xlabel(Scale(osc, False).line(vary, (values[0], values[-1]), also))
    ax.set_ylabel(_ORDINATES[which])
    ax.set_title(title(osc, (vary, *(also or ())[:1])))
    legend(ax)
    return ax
