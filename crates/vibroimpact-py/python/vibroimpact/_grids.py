"""The questions over grids, whose answers are Datasets, and the plans of grids, as the questions of `_questions.py`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact._arguments import SEED, STARTS, Axis, Interval, Progress, axes, beside, interval, names, sweep, whole
from vibroimpact._core import QuestionError
from vibroimpact._oscillator import Oscillator
from vibroimpact._plan import Plan, made
from vibroimpact._question import document, given_fields, known
from vibroimpact._store import computed
from vibroimpact._system import Start, System, numbered

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


def _plan(place: Start, task: str, fields: Mapping[str, Any], tile: SupportsIndex | None) -> Plan:
    return made(place.system, task, given_fields(task, place.system, fields), tile, place)


def basin(
    system: System, over: Mapping[str, Axis] | None = None, *, x: Axis | float | None = None, v: Axis | float | None = None,
    phase: Axis | float | None = None, q: ArrayLike | None = None, qdot: ArrayLike | None = None, refine: SupportsIndex | None = None,
    impacts: SupportsIndex | None = None, fields: Sequence[str] = (), store: str | PathLike[str] | None = None,
    client: Client | None = None, tile: SupportsIndex | None = None, threads: SupportsIndex = 0, progress: Progress = None,
) -> xr.Dataset:
    """Find the motion to which each start leads.

    Parameters
    ----------
    system : Oscillator or Machine
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
    plan = plan_basin(
        system, over, x=x, v=v, phase=phase, q=q, qdot=qdot, refine=refine, impacts=impacts, fields=fields, tile=tile
    )
    return computed(plan, store, client, threads, progress)


def plan_basin(
    system: System, over: Mapping[str, Axis] | None = None, *, x: Axis | float | None = None, v: Axis | float | None = None,
    phase: Axis | float | None = None, q: ArrayLike | None = None, qdot: ArrayLike | None = None, refine: SupportsIndex | None = None,
    impacts: SupportsIndex | None = None, fields: Sequence[str] = (), tile: SupportsIndex | None = None,
) -> Plan:
    of_start: dict[str, Any] = {"x": x, "v": v, "phase": phase}
    varied = {name: of for name, of in of_start.items() if not (of is None or isinstance(of, (int, float, np.number)))}
    start = {name: None if of is None else float(of) for name, of in of_start.items() if name not in varied}
    place = Start(system, **start, q=q, qdot=qdot)
    task = {"axes": axes({**varied, **(over or {})}), "refine": refine, "impacts": impacts, "fields": names(fields)}
    return _plan(place, "basin", place.within(task), tile)


def region_map(
    system: System, over: Mapping[str, Axis], *, starts: SupportsIndex = 8, seed: SupportsIndex = 1, refine: SupportsIndex | None = None,
    impacts: SupportsIndex | None = None, fields: Sequence[str] = (), store: str | PathLike[str] | None = None,
    client: Client | None = None, tile: SupportsIndex | None = None, threads: SupportsIndex = 0, progress: Progress = None,
) -> xr.Dataset:
    """Find the motions at each point of a plane of parameters.

    Parameters
    ----------
    system : Oscillator or Machine
        The system; its values of the parameters that vary are ignored. Physical units as for `basin`.
    over : mapping
        One to four parameters, for a machine the paths of numbers, with their values; the first one is the abscissa:
        {"inverse_beta": "0.4:2:33", "gap": [0, 1, 2.5]}.

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
    plan = plan_map(system, over, starts=starts, seed=seed, refine=refine, impacts=impacts, fields=fields, tile=tile)
    return computed(plan, store, client, threads, progress)


def plan_map(
    system: System, over: Mapping[str, Axis], *, starts: SupportsIndex = 8, seed: SupportsIndex = 1, refine: SupportsIndex | None = None,
    impacts: SupportsIndex | None = None, fields: Sequence[str] = (), tile: SupportsIndex | None = None,
) -> Plan:
    task = {"axes": axes(over), "starts": starts, "seed": seed, "refine": refine, "impacts": impacts, "fields": names(fields)}
    return _plan(Start(system), "map", task, tile)


def orbit_diagram(
    system: System, vary: str, over: Axis, *, also: Mapping[str, Interval] | None = None, show: str | None = None,
    direction: str = "both", starts: SupportsIndex | None = None, seed: SupportsIndex | None = None, transient: SupportsIndex = 500,
    keep: SupportsIndex = 64, store: str | PathLike[str] | None = None, client: Client | None = None,
    tile: SupportsIndex | None = None, threads: SupportsIndex = 0, progress: Progress = None,
) -> xr.Dataset:
    """Compute the motion after its transient at each value of a parameter, or along a line through two parameters.

    A sweep carries the state: the last state at one value is the start at the next value. Sweeps in both directions show
    coexisting motions. The points of a motion that repeats are stored once; unused places are nan.

    Parameters
    ----------
    system : Oscillator or Machine
        The system; its value of the parameter that varies is ignored. Physical units as for `basin`. A sweep of a machine begins
        at `machine.start`.
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
    plan = plan_diagram(
        system, vary, over, also=also, show=show, direction=direction, starts=starts, seed=seed, transient=transient, keep=keep, tile=tile
    )
    return computed(plan, store, client, threads, progress)


def plan_diagram(
    system: System, vary: str, over: Axis, *, also: Mapping[str, Interval] | None = None, show: str | None = None,
    direction: str = "both", starts: SupportsIndex | None = None, seed: SupportsIndex | None = None, transient: SupportsIndex = 500,
    keep: SupportsIndex = 64, tile: SupportsIndex | None = None,
) -> Plan:
    known("direction", direction, ("up", "down", "both", "scatter"))
    if isinstance(system, Oscillator):
        known("show", show, (None, "velocity", "strobe"))
    way: str | dict[str, Any] = direction
    if direction == "scatter":
        count, number = whole("starts", 8 if starts is None else starts, STARTS), whole("seed", 1 if seed is None else seed, SEED)
        way = {"scatter": {"starts": count, "seed": number}}
    elif starts is not None or seed is not None:
        raise QuestionError('starts and seed belong to direction="scatter"')
    second = beside(also)
    line = second and dict(zip((numbered(system), "from", "to"), (second[0], *interval(second[1]))))
    show = show or ("velocity" if isinstance(system, Oscillator) else "speed")
    task = {"vary": vary, "over": sweep(over), "also": line, "show": show, "direction": way, "transient": transient, "keep": keep}
    return _plan(Start(system), "diagram", task, tile)


def plan_lyapunov(
    system: System, over: Mapping[str, Axis], *, x: float | None = None, v: float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, impacts: SupportsIndex | None = None, transient: SupportsIndex = 1000,
    tile: SupportsIndex | None = None,
) -> Plan:
    """A plan for all Lyapunov exponents over parameters and coordinates of the start.

    For a machine it is over paths of numbers, "q.COORDINATE", "qdot.COORDINATE" and "phase". They are measured over
    100 000 impacts of an oscillator and 20 000 events of a machine, if nothing else is given.
    """
    place = Start(system, x, v, q, qdot, phase)
    return _plan(place, "lyapunov", place.within({"axes": axes(over), "impacts": impacts, "transient": transient}), tile)


def plan_attractors(
    system: System, starts: SupportsIndex, *, seed: SupportsIndex = 1, impacts: SupportsIndex | None = None,
    tile: SupportsIndex | None = None,
) -> Plan:
    """A plan for the motion to which each of many scattered starts leads."""
    return _plan(Start(system), "attractors", {"starts": starts, "seed": seed, "impacts": impacts}, tile)


document(
    basin=[basin, plan_basin], map=[region_map, plan_map], diagram=[orbit_diagram, plan_diagram], lyapunov=[plan_lyapunov],
    attractors=[plan_attractors]
)
