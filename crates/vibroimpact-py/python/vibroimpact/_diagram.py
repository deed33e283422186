"""The motion after its transient at each value of a parameter, as an xarray Dataset."""

from typing import TYPE_CHECKING

from vibroimpact import _core
from vibroimpact._axis import Axis, span
from vibroimpact._core import Oscillator
from vibroimpact._progress import Progress, watched

if TYPE_CHECKING:
    import xarray as xr

#: What varies, in words and with its unit.
LONG_NAMES = {
    "beta": "frequency ratio omega/omega_n",
    "inverse_beta": "inverse frequency ratio omega_n/omega",
    "gap": "distance of the stop",
    "restitution": "restitution of the stop",
    "damping": "damping ratio",
    "second_gap": "distance of the second stop",
    "second_restitution": "restitution of the second stop",
}


def orbit_diagram(
    osc: Oscillator,
    vary: str,
    over: Axis,
    *,
    show: str = "velocity",
    direction: str = "both",
    starts: int | None = None,
    seed: int | None = None,
    transient: int = 500,
    keep: int = 64,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Follow the motion along one parameter, swept up and down, so that coexisting motions show.

    A sweep carries the state: the one in which a value left the motion is the start at the next value. A motion that
    repeats itself is shown once, so `count` is its number of impacts; what is not filled is nan.

    Parameters
    ----------
    osc : Oscillator
        The system; its value of what varies counts for nothing.
    vary : str
        "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap" or "second_restitution".
    over : str, tuple or array
        Its values: "0:3:601", (0, 3, 601), or an evenly spaced array.
    show : str
        "velocity" for phase and speed of arrival of each impact, "strobe" for position and velocity at phase 0.
    direction : str
        "up", "down", "both", or "scatter" for several scattered starts at each value.
    starts, seed : int
        Of "scatter": how many (8), and which sequence of them (1).
    transient : int
        Impacts (velocity) or forcing periods (strobe) to pass before anything is shown.
    keep : int
        Impacts or states to show at each value at most.
    threads : int
        0 for one per core; the answer does not depend on it.
    progress : bool or callable
        True for a bar, or a function of what is done and what there is to do.

    Returns
    -------
    xarray.Dataset
        Dimensions `sweep`, the parameter, and `point`; `ds.vibro.plot()` draws it.

    Examples
    --------
    >>> from vibroimpact import Oscillator, orbit_diagram
    >>> ds = orbit_diagram(Oscillator(inverse_beta=1.3, gap=0, restitution=0.5), "gap", "0.5:1:11", direction="up")
    >>> ds["count"].sel(sweep="up", gap=0.75).item()
    2
    """
    import numpy as np
    import xarray as xr

    from vibroimpact import _accessor

    with watched(progress, "motions") as tell:
        found = _core.orbit_diagram(
            osc, vary, span(over), show, direction, starts, seed, transient, keep, threads, tell
        )
    deep, flat = ("sweep", vary, "point"), ("sweep", vary)

    def quantity(name: str, words: str) -> tuple[tuple[str, str, str], object, dict[str, str]]:
        return deep, found[name], {"long_name": words, "units": "1"}

    if show == "velocity":
        points = {
            "velocity": quantity("second", "arrival velocity"),
            "phase": (deep, found["first"], {"long_name": "phase of the force", "units": "rad"}),
            "side": (deep, found["side"], _accessor.flags("stop", {1: "upper", -1: "lower", 0: "none"})),
        }
    else:
        points = {"x": quantity("first", "position at phase 0"), "v": quantity("second", "velocity at phase 0")}
    kinds = {0: "impacts", 1: "no_impact", 2: "stuck", 3: "undecided"}
    ds = xr.Dataset(
        {
            **points,
            "count": (flat, found["count"], {"long_name": "points shown", "units": "1"}),
            "kind": (flat, found["kind"], _accessor.flags("what the motion is", kinds)),
        },
        coords={
            "sweep": np.array(found["sweeps"], dtype=object),
            vary: (vary, found["values"], {"long_name": LONG_NAMES[vary], "units": "1"}),
        },
        attrs={
            "title": f"orbit diagram over {vary}",
            "source": f"vibroimpact {_core.__version__}",
            "plan": found["plan"],
        },
    )
    return ds
