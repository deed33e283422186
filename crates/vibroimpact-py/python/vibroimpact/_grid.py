"""Studies over grids as xarray Datasets: in memory, or in a store."""

from collections.abc import Mapping
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact import _core
from vibroimpact._axis import Axis, Interval
from vibroimpact._core import Oscillator, Units
from vibroimpact._plan import Plan
from vibroimpact._progress import Progress, watched
from vibroimpact._whole import THREADS, whole

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


def bare(osc: Oscillator, store: str | PathLike[str] | None) -> Oscillator:
    """The oscillator without the units of a machine, which plans do not have; a store has no place for them either."""
    if osc.units is not None and store is not None:
        raise _core.QuestionError(
            "a store keeps no units of a machine\n"
            "hint: osc.replace(units=None) fills a nondimensional one, and ds.vibro.si(osc.units) converts what is read from it"
        )
    return osc.replace(units=None)


def computed(
    plan: Plan,
    units: Units | None,
    store: str | PathLike[str] | None,
    client: "Client | None",
    threads: int,
    progress: Progress,
) -> "xr.Dataset":
    """The Dataset of a plan: in memory, or through a store, by threads here or by the workers of a client."""
    from vibroimpact import _store

    threads = whole("threads", threads, THREADS)
    if store is None:
        if client is not None:
            raise _core.QuestionError(
                "a client needs a store\nhint: store=..., a place that all workers reach; results do not travel"
            )
        with watched(progress, "points") as tell:
            return _dataset(plan, units, *_core.fill(plan.json, threads, tell))
    # what is to be read in the end has to be readable before hours are spent
    _store.need_readers(fspath(store))
    if client is None:
        _store.run(plan, store, threads=threads, progress=progress)
    else:
        from vibroimpact import dask

        dask.run(plan, store, client, progress=progress)
    return _store.open(store)


def _dataset(
    plan: Plan, units: Units | None, coordinates: list[dict[str, Any]], variables: list[dict[str, Any]]
) -> "xr.Dataset":
    import xarray as xr

    from vibroimpact import _accessor, _si  # the former registers ds.vibro
    from vibroimpact._stated import with_fixed

    def variable(of: dict[str, Any]) -> tuple[list[str], Any, dict[str, Any]]:
        attributes: dict[str, Any] = {"long_name": of["long_name"], "units": of["units"]}
        if of["comment"]:
            attributes["comment"] = of["comment"]
        if of["flags"]:
            attributes["flag_values"] = [value for value, _ in of["flags"]]
            attributes["flag_meanings"] = " ".join(meaning for _, meaning in of["flags"])
        shape = [length for _, length in of["dimensions"]]
        values = of["values"]
        array = np.array(values, dtype=object) if isinstance(values, list) else values.reshape(shape)
        return [name for name, _ in of["dimensions"]], array, attributes

    ds = xr.Dataset(
        {of["name"]: variable(of) for of in variables},
        {of["name"]: variable(of) for of in coordinates},
        {
            "Conventions": "CF-1.11",
            "title": plan.title,
            "source": f"vibroimpact {_core.__version__}",
            "plan": plan.json,
            "plan_hash": plan.hash,
            **_si.attributes(units),
        },
    )
    return with_fixed(ds)


def basin(
    osc: Oscillator,
    over: Mapping[str, Axis] | None = None,
    *,
    x: Axis | float | None = None,
    v: Axis | float = 0.0,
    phase: Axis | float = 0.0,
    refine: int | None = None,
    impacts: int | None = None,
    store: str | PathLike[str] | None = None,
    client: "Client | None" = None,
    tile: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Find out which motion each start leads to.

    Parameters
    ----------
    osc : Oscillator
        The system. Of a machine in physical units the starts and the Dataset are nondimensional all the same, its units
        are kept in the attributes, and `ds.vibro.si()` converts; a store does not take one.
    over : mapping
        Parameters that vary besides the start, with their values; one of the start is needed too.
    x, v, phase : float, str or array
        Position, velocity and phase of the starts: a number for all, or values: "-4:0.75:200" for 200 of them, or an array.
        The first of them that varies is drawn to the right, the second upwards.
    refine : int
        Compute every K-th point first, K being this number, and those between only where neighbours differ.
    impacts : int
        Budget of impacts for each start; what is not settled by then is undecided.
    store : path
        Where results are kept; what is there already is not computed again.
    client : distributed.Client
        Whose workers fill the store.
    tile : int
        Points of a tile along each axis.
    threads : int
        0 for one per core; the answer does not depend on it.
    progress : bool or callable
        True for a bar, or a function of what is done and what there is to do.

    Returns
    -------
    xarray.Dataset
        `label` as codes, `ds.vibro.labels()` has them as text; `cycle` numbers the cycles described in `cycle_...`.

    Examples
    --------
    >>> from vibroimpact import Oscillator, basin
    >>> ds = basin(Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), x="-4:0.75:40", v="-4:4:30")
    >>> dict(ds.sizes)["x"], sorted(set(ds.vibro.labels().values.ravel().tolist()))
    (40, ['1/1', '2/1'])
    """
    axes, fixed = dict[str, Axis](), dict[str, float | None]()
    for name, of in (("x", x), ("v", v), ("phase", phase)):
        if of is None or isinstance(of, (int, float, np.number)):
            fixed[name] = None if of is None else float(of)
        else:
            axes[name] = of
    plan = Plan.basin(
        bare(osc, store),
        {**axes, **(over or {})},
        x=fixed.get("x"),
        v=fixed.get("v") or 0.0,
        phase=fixed.get("phase") or 0.0,
        refine=refine, impacts=impacts,
        tile=tile,
    )
    return computed(plan, osc.units, store, client, threads, progress)


def region_map(
    osc: Oscillator,
    over: Mapping[str, Axis],
    *,
    starts: int = 8,
    seed: int = 1,
    refine: int | None = None,
    impacts: int | None = None,
    store: str | PathLike[str] | None = None,
    client: "Client | None" = None,
    tile: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Find out which motions there are at each point of a plane of parameters.

    Parameters
    ----------
    osc : Oscillator
        The system; its values of what varies count for nothing. A machine in physical units as for `basin`.
    over : mapping
        One to four parameters with their values, the first drawn to the right:
        {"inverse_beta": "0.4:2:33", "gap": [0, 1, 2.5]}.
    starts : int
        Starts at each point: at rest, on the free motion, the others scattered.
    seed : int
        Which sequence of them.
    refine : int
        Compute every K-th point first, K being this number, and those between only where neighbours differ.
    impacts : int
        Budget of impacts for each start; what is not settled by then is undecided.
    store, client, tile, threads, progress
        As for `basin`.

    Returns
    -------
    xarray.Dataset
        `label`, `share`, `speed` and `multiplier` of the motions at each point, the most frequent first.

    Examples
    --------
    >>> from vibroimpact import Oscillator, region_map
    >>> osc = Oscillator(inverse_beta=1, gap=0, restitution=0.5)
    >>> ds = region_map(osc, {"inverse_beta": "1:1.3:4", "gap": [0.5, 0.75]}, starts=4)
    >>> ds.vibro.labels().sel(inverse_beta=1.3, gap=0.75, motion=0).item()
    '2/1'
    """
    plan = Plan.map(bare(osc, store), over, starts=starts, seed=seed, refine=refine, impacts=impacts, tile=tile)
    return computed(plan, osc.units, store, client, threads, progress)


def orbit_diagram(
    osc: Oscillator,
    vary: str,
    over: Axis,
    *,
    also: Mapping[str, Interval] | None = None,
    show: str = "velocity",
    direction: str = "both",
    starts: int | None = None,
    seed: int | None = None,
    transient: int = 500,
    keep: int = 64,
    store: str | PathLike[str] | None = None,
    client: "Client | None" = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Follow the motion along one parameter, or along a line through two, swept up and down, so that coexisting motions show.

    A sweep carries the state: the one in which a value left the motion is the start at the next value. A motion that
    repeats itself is shown once; what is not filled is nan.

    Parameters
    ----------
    osc : Oscillator
        The system; its value of what varies counts for nothing. A machine in physical units as for `basin`.
    vary : str
        "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap" or "second_restitution".
    over : str or array
        Its values: "0:3:601" for 601 of them, or an evenly spaced array.
    also : dict
        A second parameter that varies with it in proportion, with its values at the first and the last of these:
        {"gap": (0.5, 1.5)}. It becomes a second coordinate along the same dimension.
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
    store, client, threads, progress
        As for `basin`.

    Returns
    -------
    xarray.Dataset
        Dimensions `sweep` (1 with rising values, -1 with falling ones; `start` of scattered ones), the parameter, and `point`.

    Examples
    --------
    >>> from vibroimpact import Oscillator, orbit_diagram
    >>> ds = orbit_diagram(Oscillator(inverse_beta=1.3, gap=0, restitution=0.5), "gap", "0.5:1:11")
    >>> ds["velocity"].sel(sweep=1, gap=0.75).dropna("point").size
    2
    """
    plan = Plan.diagram(
        bare(osc, store),
        vary,
        over,
        also=also,
        show=show,
        direction=direction,
        starts=starts,
        seed=seed,
        transient=transient,
        keep=keep,
    )
    return computed(plan, osc.units, store, client, threads, progress)
