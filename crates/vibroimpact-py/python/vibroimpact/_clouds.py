"""The figure of an orbit diagram: a dot for every impact or state over the parameter, the sweeps in two colours.

Where both sweeps have the same cycle, the small dot of one lies inside the large dot of the other and both colours are
seen. What does not repeat itself has small dots in both.
"""

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact._core import Oscillator, QuestionError
from vibroimpact._figure import ARRIVAL, SYMBOLS, legend, new_axes, title
from vibroimpact._palette import SERIES

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


def plot(ds: "xr.Dataset", ax: "Axes | None", which: str | None) -> "Axes":
    """Points of all sweeps."""
    plan = json.loads(ds.attrs["plan"])
    task = plan["task"]["diagram"]
    vary = task["vary"]
    which = which or ("velocity" if "velocity" in ds else "x")
    if which not in ds or "point" not in ds[which].dims:
        raise QuestionError(f"`{which}` is no variable of this diagram; there are {', '.join(_drawn(ds))}")
    ax = new_axes(ax, (9.0, 4.6))
    size = float(np.clip(430.0 / ds.sizes[vary], 1.2, 3.0))
    sweeps = [str(name) for name in ds["sweep"].values]
    both = sweeps == ["up", "down"]
    names = {"up": "rising", "down": "falling"}
    xs = np.broadcast_to(ds[vary].values[:, None], (ds.sizes[vary], ds.sizes["point"]))
    for k, sweep in enumerate(sweeps):
        one = ds.isel(sweep=k)
        colour = SERIES[1] if sweep == "down" and both else SERIES[0]
        label = f"${SYMBOLS[vary]}$ {names[sweep]}" if sweep in names else f"{len(sweeps)} starts at each value"
        # chatter ends are no impacts kept, but fewer than were asked for is fewer
        large = (both and sweep == "up") & ((one["count"].values < task["keep"]) | (one["count"].values == 1))
        for rows, of in ((large, 1.9 * size), (~large, size)):
            ax.plot(xs[rows].ravel(), one[which].values[rows].ravel(), "o", color=colour, markersize=of,
                    markeredgewidth=0, rasterized=xs.size > 50_000)
        if k == 0 or sweep in names:
            ax.plot([], [], "o", color=colour, markersize=4, label=label)
    ax.set_xlabel(f"${SYMBOLS[vary]}$")
    ordinates = {"velocity": ARRIVAL, "phase": r"phase $\theta$", "x": r"$\xi$ at phase 0", "v": "$u$ at phase 0"}
    ax.set_ylabel(ordinates.get(which, which))
    ax.set_title(title(_system(plan["system"]), (vary,)))
    legend(ax)
    return ax


def _drawn(ds: "xr.Dataset") -> list[str]:
    return [str(name) for name, of in ds.data_vars.items() if "point" in of.dims and name != "side"]


def _system(system: dict[str, Any]) -> Oscillator:
    """The oscillator of a plan."""
    second = system.pop("second_stop", None) or {}
    return Oscillator(**system, **{f"second_{name}": value for name, value in second.items()})
