"""Studies over grids as xarray Datasets, in memory or in a store."""

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact import _core
from vibroimpact._ask import System
from vibroimpact._axis import Axis, Interval
from vibroimpact._oscillator import Oscillator, Units
from vibroimpact._plan import Plan
from vibroimpact._progress import Progress, watched
from vibroimpact._whole import threads_of

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


def computed(
    plan: Plan,
    units: Units | None,
    store: str | PathLike[str] | None,
    client: "Client | None",
    threads: int,
    progress: Progress,
) -> "xr.Dataset":
    """Compute the Dataset of a plan: in memory, or in a store by threads of this process or by the workers of a client."""
    from vibroimpact import _store

    threads = threads_of(threads)
    if store is None:
        if client is not None:
            raise _core.QuestionError(
                "a client needs a store\nhint: store=..., a place that all workers reach; results do not travel"
            )
        with watched(progress, "points") as tell:
            return _dataset(plan, units, *_core.fill(plan.json, threads, tell))
    # check before a long computation that its result can be read
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

    from vibroimpact import _accessor, _si  # the import of _accessor registers ds.vibro
    from vibroimpact._stated import with_fixed
    from vibroimpact._unit_names import attributes_of

    def variable(of: dict[str, Any]) -> tuple[list[str], Any, dict[str, Any]]:
        shape = [length for _, length in of["dimensions"]]
        values = of["values"]
        array = np.array(values, dtype=object) if isinstance(values, list) else values.reshape(shape)
        return [name for name, _ in of["dimensions"]], array, attributes_of(of)

    ds = xr.Dataset(
        {of["name"]: variable(of) for of in variables},
        {of["name"]: variable(of) for of in coordinates},
        {
            "Conventions": "CF-1.11",
            "title": plan.title,
            "source": f"vibroimpact {_core.__version__}",
            "history": f"computed by vibroimpact {_core.__version__}",
            "plan": plan.json,
            "plan_hash": plan.hash,
            **_si.attributes(units),
        },
    )
    return with_fixed(ds)


def _units(osc: System) -> Units | None:
    """The units of the results of an oscillator; those of a machine are its own."""
    return osc.units if isinstance(osc, Oscillator) else None


def basin(
    osc: System,
    over: Mapping[str, Axis] | None = None,
    *,
    x: Axis | float | None = None,
    v: Axis | float | None = None,
    phase: Axis | float | None = None,
    q: ArrayLike | None = None,
    qdot: ArrayLike | None = None,
    refine: int | None = None,
    impacts: int | None = None,
    fields: Sequence[str] = (),
    store: str | PathLike[str] | None = None,
    client: "Client | None" = None,
    tile: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Find the motion to which each start leads.

    Parameters
    ----------
    osc : Oscillator or Machine
        The system. For an oscillator with physical units the starts and the Dataset are nondimensional too; the units are
        kept in the attributes, and `ds.vibro.si()` converts the Dataset.
    over : mapping
        Parameters that vary in addition to the start, with their values. At least one coordinate of the start must vary too.
        For a machine what varies of the start: {"q.head": "-1:1:9", "phase": "0:6:7"}.
    x, v, phase : float, str or array
        Position, velocity and phase of the starts: one number for all starts, a range ("-4:0.75:200" has 200 values) or an
        array. The first one that varies is the abscissa, the second one the ordinate.
    q, qdot : array
        Coordinates and velocities of the starts of a machine, where they do not vary. Default: those of `machine.start`, or 0.
    refine : int
        Step K of a coarse grid: every K-th point is computed first, and points between only where their neighbours differ.
    impacts : int
        Budget of impacts for each start. Motions that have not settled by then are undecided.
    fields : sequence of str
        Quantities of each motion as further variables: ["impact_speed_max", "power"]. `Motion.quantities` has the names.
    store : path
        The store for the results; tiles that it already contains are not computed again.
    client : distributed.Client
        A Dask client, whose workers fill the store.
    tile : int
        Points of a tile along each axis.
    threads : int
        Number of threads; 0 for one per core. The result does not depend on it.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Returns
    -------
    xarray.Dataset
        `label` contains codes, which `ds.vibro.labels()` converts to text. `cycle` contains the numbers of the cycles, which
        the variables `cycle_...` describe.

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
        osc,
        {**axes, **(over or {})},
        x=fixed.get("x"),
        v=fixed.get("v"),
        phase=fixed.get("phase"),
        q=q,
        qdot=qdot,
        refine=refine,
        impacts=impacts,
        fields=fields,
        tile=tile,
    )
    return computed(plan, _units(osc), store, client, threads, progress)


def region_map(
    osc: System,
    over: Mapping[str, Axis],
    *,
    starts: int = 8,
    seed: int = 1,
    refine: int | None = None,
    impacts: int | None = None,
    fields: Sequence[str] = (),
    store: str | PathLike[str] | None = None,
    client: "Client | None" = None,
    tile: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Find the motions at each point of a plane of parameters.

    Parameters
    ----------
    osc : Oscillator or Machine
        The system; its values of the parameters that vary are ignored. Physical units as for `basin`.
    over : mapping
        One to four parameters, for a machine the paths of numbers, with their values; the first one is the abscissa:
        {"inverse_beta": "0.4:2:33", "gap": [0, 1, 2.5]}.
    starts : int
        Number of starts at each point: the first at rest, the second on the motion without impacts, the others scattered.
    seed : int
        Seed of the sequence of starts.
    refine : int
        Step K of a coarse grid: every K-th point is computed first, and points between only where their neighbours differ.
    impacts : int
        Budget of impacts for each start. Motions that have not settled by then are undecided.
    fields : sequence of str
        Quantities of each motion as further variables, as for `basin`.
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
    plan = Plan.map(
        osc, over, starts=starts, seed=seed, refine=refine, impacts=impacts, fields=fields, tile=tile
    )
    return computed(plan, _units(osc), store, client, threads, progress)


def orbit_diagram(
    osc: System,
    vary: str,
    over: Axis,
    *,
    also: Mapping[str, Interval] | None = None,
    show: str | None = None,
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
    """Compute the motion after its transient at each value of a parameter, or along a line through two parameters.

    A sweep carries the state: the last state at one value is the start at the next value. Sweeps in both directions show
    coexisting motions. The points of a motion that repeats are stored once; unused places are nan.

    Parameters
    ----------
    osc : Oscillator or Machine
        The system; its value of the parameter that varies is ignored. Physical units as for `basin`. A sweep of a machine begins
        at `machine.start`.
    vary : str
        "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap" or "second_restitution"; for a
        machine the path of a number.
    over : str or array
        Its values: a range ("0:3:601" has 601 values), or a list or an array of rising or falling values. An array that is evenly
        spaced to rounding is the range.
    also : dict
        A second parameter that varies in proportion to the first, with its values at the first and the last value of
        `over`: {"gap": (0.5, 1.5)}. It is a second coordinate of the same dimension.
    show : str
        "velocity" (default) for the phase of each impact and the speed before it; "strobe" for position and velocity at phase 0.
        For a machine "speed" (default) for the phase and speed of each closing of a stop; "q.NAME" or "qdot.NAME" for a coordinate
        or velocity at phase 0.
    direction : str
        "up", "down", "both", or "scatter" for several scattered starts at each value.
    starts, seed : int
        For "scatter": the number of starts (default 8), and the seed of their sequence (default 1).
    transient : int
        Number of impacts ("velocity") or forcing periods ("strobe") before the points shown.
    keep : int
        Maximum number of impacts or states shown at each value.
    store, client, threads, progress
        As for `basin`.

    Returns
    -------
    xarray.Dataset
        Dimensions `sweep` (1 for rising values, -1 for falling values; or `start` for scattered starts), the parameter, and `point`.

    Examples
    --------
    >>> from vibroimpact import Oscillator, orbit_diagram
    >>> ds = orbit_diagram(Oscillator(inverse_beta=1.3, gap=0, restitution=0.5), "gap", "0.5:1:11")
    >>> ds["velocity"].sel(sweep=1, gap=0.75).dropna("point").size
    2
    """
    plan = Plan.diagram(
        osc,
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
    return computed(plan, _units(osc), store, client, threads, progress)
