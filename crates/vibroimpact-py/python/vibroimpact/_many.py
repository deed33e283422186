"""Many motions at once: points of parameters and starts, as users write them, where they settle, and their events and states."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._arguments import BUDGET, SIMULATED, Progress, maybe, names, numbers, threads_of, watched, whole
from vibroimpact._ask import State, System
from vibroimpact._core import QuestionError
from vibroimpact._machine import Machine
from vibroimpact._motion import Settlement, names_of
from vibroimpact._oscillator import Oscillator
from vibroimpact._sample import Sample
from vibroimpact._stated import attributes_of, described

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from distributed import Client

#: Names with arrays that broadcast, a table of pandas, or a Dataset of xarray.
Points: TypeAlias = "Mapping[str, ArrayLike] | pd.DataFrame | xr.Dataset"

#: What an oscillator is made of; the first two are one parameter.
_PARAMETERS = (
    "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap", "second_restitution",
)
_STARTS = ("x", "v", "phase")
#: The dimension of points that have no other name.
POINT = "sample"


class Over(NamedTuple):
    """Points in the form in which the compiled module takes them."""

    #: The system of the first point; its other numbers are those of all points.
    system: Oscillator | Machine
    #: What varies, as flat columns of one length.
    columns: list[tuple[str, NDArray[np.float64]]]
    #: The parts of the start that do not vary: position, velocity and phase; of a machine coordinates, velocities and phase.
    start: Any
    #: The dimensions of the points, with their lengths.
    sizes: dict[str, int]
    #: The coordinates of the dimensions, and what varies, for the Dataset of the results.
    coords: dict[str, Any]


class _Collected(NamedTuple):
    """Numbers as users give them, broadcast against each other."""

    #: Those with one value.
    fixed: dict[str, float]
    #: Those that vary, as flat columns.
    columns: list[tuple[str, NDArray[np.float64]]]
    sizes: dict[str, int]
    coords: dict[str, Any]


def points(system: "Oscillator | Machine | Points", over: "Points | None", starts: "Points | None") -> Over:
    """The points of systems and starts, broadcast against each other."""
    if isinstance(system, Machine):
        return _of_machine(system, over, starts)
    osc, own = (system, None) if isinstance(system, Oscillator) else (None, system)
    fixed, columns, sizes, coords = _collected({"system": own, "over": over, "starts": starts}, _PARAMETERS, _STARTS)
    first = {name: values for name, values in fixed.items() if name not in _STARTS}
    first |= {name: float(values[0]) for name, values in columns if name not in _STARTS}
    if osc is None:
        osc = _system(first)
    elif fixed_here := {name: value for name, value in first.items() if name in fixed}:
        osc = osc.replace(**fixed_here)
    if osc.second_gap is None and "second_gap" in first:
        second = {"second_restitution": first["second_restitution"]} if "second_restitution" in first else {}
        osc = osc.replace(second_gap=first["second_gap"], **second)
    x, v, phase = (fixed.get(name) for name in _STARTS)
    if not columns:
        # one start still is a column, so that one way computes all
        columns = [("v", np.array([v or 0.0]))]
    return Over(osc, columns, (x, v or 0.0, phase or 0.0), sizes, coords)


def _of_machine(machine: Machine, over: "Points | None", starts: "Points | None") -> Over:
    positions, velocities = names_of(machine)
    parts = (*positions, *velocities, "phase")
    fixed, columns, sizes, coords = _collected({"over": over, "starts": starts}, tuple(machine.paths), parts)
    numbers_ = {name: value for name, value in fixed.items() if name not in parts}
    q, qdot, phase = machine.start_of()
    q, qdot = ([fixed.get(name, value) for name, value in zip(names, of)] for names, of in ((positions, q), (velocities, qdot)))
    start = (q, qdot, fixed.get("phase", phase))
    if not columns:
        columns = [("phase", np.array([start[2]]))]
    return Over(machine.set(numbers_) if numbers_ else machine, columns, start, sizes, coords)


def _collected(all_: "Mapping[str, Points | None]", parameters: tuple[str, ...], parts: tuple[str, ...]) -> _Collected:
    """The numbers in arguments by name; `parts` are those of a start."""
    given: dict[str, Any] = {}
    for where, of in all_.items():
        if of is None:
            continue
        for name, values in _named(where, of, (*parameters, *parts)).items():
            if name in given:
                raise QuestionError(f"{name} is given twice, the second time in {where}")
            if where == "starts" and name not in parts:
                raise QuestionError(
                    f"starts has no coordinate `{name}`; there are {', '.join(parts)}\n"
                    "hint: parameters of the system are given in the first argument, or in over"
                )
            given[name] = values
    arrays, sizes, coords = _broadcast(given)
    fixed = {name: float(values[()]) for name, values in arrays.items() if values.ndim == 0}
    varied = {name: values for name, values in arrays.items() if values.ndim > 0}
    if not all(sizes.values()):
        raise QuestionError(f"there are no points: {', '.join(f'{name} has length {n}' for name, n in sizes.items())}")
    shape = tuple(sizes.values())
    columns = [(name, np.ascontiguousarray(np.broadcast_to(of, shape)).reshape(-1)) for name, of in varied.items()]
    return _Collected(fixed, columns, sizes, {**coords, **_described(varied, sizes)})


def _system(first: Mapping[str, float]) -> Oscillator:
    unknown = [name for name in first if name not in _PARAMETERS]
    if unknown:
        raise QuestionError(
            f"`{unknown[0]}` is no parameter and no coordinate of a start; there are {', '.join(_PARAMETERS)}, {', '.join(_STARTS)}"
        )
    missing = [name for name in ("gap", "restitution") if name not in first]
    if missing:
        raise QuestionError(
            f"the systems have no {missing[0]}\nhint: an Oscillator as the first argument, and over={{...}} with what varies, "
            "gives the others their values"
        )
    return Oscillator(**first)  # type: ignore[arg-type]


def _named(where: str, of: Any, known: tuple[str, ...]) -> dict[str, Any]:
    """The columns of a mapping, a table or a Dataset, by name; of coordinates those that are known."""
    if hasattr(of, "data_vars") and hasattr(of, "coords"):
        return {str(name): of[name] for name in (*of.data_vars, *of.coords) if name in of.data_vars or name in known}
    if hasattr(of, "columns") and hasattr(of, "to_numpy"):
        return {str(name): of[name].to_numpy() for name in of.columns}
    if isinstance(of, Mapping):
        return {str(name): values for name, values in of.items()}
    raise TypeError(
        f"{where} is {type(of).__name__}, and not an Oscillator, a Machine, a mapping of names to arrays, a DataFrame or a Dataset"
        if where == "system"
        else f"{where} is {type(of).__name__}, and not a mapping of names to arrays, a DataFrame or a Dataset"
    )


def _broadcast(given: Mapping[str, Any]) -> tuple[dict[str, NDArray[np.float64]], dict[str, int], dict[str, Any]]:
    """Arrays with the same dimensions, the sizes of these, and the coordinates of DataArrays."""
    labelled = {name: of for name, of in given.items() if hasattr(of, "dims") and hasattr(of, "coords")}
    if not labelled:
        arrays = {name: numbers(name, of) for name, of in given.items()}
        shape = _shape(arrays)
        # a single number stays one; the others are broadcast later
        names = [POINT] if len(shape) == 1 else [f"{POINT}_{k}" for k in range(len(shape))]
        return arrays, dict(zip(names, shape)), {}
    import xarray as xr

    plain = {name: numbers(name, of) for name, of in given.items() if name not in labelled}
    if any(of.ndim > 0 for of in plain.values()):
        unnamed = next(name for name, of in plain.items() if of.ndim > 0)
        raise QuestionError(
            f"{unnamed} has no names of dimensions, and others have\nhint: xarray.DataArray({unnamed}, dims=[...]), or arrays alone"
        )
    aligned = xr.broadcast(*(of for of in labelled.values() if of.ndim > 0))
    together = dict(zip((name for name, of in labelled.items() if of.ndim > 0), aligned))
    alone = {name: of for name, of in labelled.items() if of.ndim == 0}
    arrays = {name: numbers(name, of.values) for name, of in {**together, **alone}.items()} | plain
    if not aligned:
        return arrays, {}, {}
    one = aligned[0]
    sizes = {str(name): int(size) for name, size in one.sizes.items()}
    coords = {str(name): of.variable for name, of in one.coords.items() if str(name) not in given}
    return arrays, sizes, coords


def _shape(arrays: Mapping[str, NDArray[np.float64]]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*(of.shape for of in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {of.shape}" for name, of in arrays.items() if of.ndim > 0)
        raise QuestionError(
            f"the arrays do not broadcast to one shape: {shapes}\nhint: one value for each point, or dimensions of length 1, as of[:, None]"
        ) from None


def _described(varied: Mapping[str, NDArray[np.float64]], sizes: Mapping[str, int]) -> dict[str, Any]:
    """What varies, as coordinates over those dimensions along which it does."""
    names = list(sizes)
    found = {}
    for name, values in varied.items():
        own = names[len(names) - values.ndim :]
        # a dimension along which an array has one value is none of its own
        kept = [k for k, length in enumerate(values.shape) if length != 1 or sizes[own[k]] == 1]
        one = values.reshape([values.shape[k] for k in kept])
        found[name] = ([own[k] for k in kept], one)
    return found


def dataset(over: Over, title: str, variables: Mapping[str, Any]) -> "xr.Dataset":
    """The Dataset of results at points, with numbers and starts as coordinates."""
    import xarray as xr

    from vibroimpact import _accessor, _si  # the import of _accessor registers ds.vibro

    system = over.system
    told = {"source": f"vibroimpact {_core.__version__}", "history": f"computed by vibroimpact {_core.__version__}"}
    if isinstance(system, Machine):
        # what varies has the name of a variable: it is that of the start
        starts = {name: f"start.{name}" for name in over.coords if name in variables}
        coords = {starts.get(name, name): of for name, of in over.coords.items()}
        return xr.Dataset(dict(variables), coords, {"title": title, **told})
    # what varies is in the coordinates
    own = {"system": system._file.json, **_si.attributes(system.units)}
    return xr.Dataset(dict(variables), _coordinates(over), {"Conventions": "CF-1.11", "title": title, **told, **own})


def _coordinates(over: Over) -> dict[str, Any]:
    """The coordinates: what varies over its dimensions, and all other parameters and coordinates of starts as scalars."""
    from vibroimpact._stated import described

    osc: Any = over.system
    varied = [name for name, _ in over.columns if name in over.coords]
    known = {name: (value, described(*words)) for name, value, *words in _core.point_coordinates(osc._file, over.start)}
    frequency = {"beta", "inverse_beta"}
    found: dict[str, Any] = {}
    for name, (value, attributes) in known.items():
        if name in over.coords:
            dims, values = over.coords[name]
            found[name] = (dims, values, attributes)
        elif name not in frequency or not frequency & set(varied):
            found[name] = ((), value, attributes)
    for name, of in over.coords.items():
        if name not in found:
            found[name] = (*of, described(*_core.coordinate_words(name))) if isinstance(of, tuple) else of
    return found


def over_points(over: Over, values: NDArray[Any], further: Sequence[tuple[str, int]] = ()) -> tuple[list[str], NDArray[Any]]:
    """The dimensions of a variable, and its flat values in their shape."""
    names = [*over.sizes, *(name for name, _ in further)]
    return names, values.reshape([*over.sizes.values(), *(size for _, size in further)])


def in_shape(ds: "xr.Dataset", over: Over) -> "xr.Dataset":
    """A Dataset over points in the order of a list, with the dimensions of the arrays that were given."""
    import xarray as xr

    def shaped(of: "xr.DataArray") -> tuple[list[str], NDArray[Any], dict[str, Any]]:
        names = [str(name) for name in of.dims if name != POINT]
        return [*over.sizes, *names], of.values.reshape([*over.sizes.values(), *of.shape[1:]]), of.attrs

    coords = {name: (*of, ds[name].attrs) if name in ds.coords else of for name, of in over.coords.items()}
    return xr.Dataset({name: shaped(of) for name, of in ds.data_vars.items()}, coords, ds.attrs)


def whole_numbers(dims: Sequence[str], codes: NDArray[Any]) -> dict[str, Any]:
    """Impacts m and periods n of the codes of labels: nan for what is not m/n, infinite impacts for a complete chatter."""
    whole = codes // 10_000
    impacts, periods = np.array(whole, dtype=np.float64), np.array(codes - whole * 10_000, dtype=np.float64)
    chatter = codes >= 1_000_000_000
    if chatter.any():
        impacts[chatter], periods[chatter] = np.inf, codes[chatter] - 1_000_000_000
    other = codes <= 0
    impacts[other] = periods[other] = np.nan
    words = {"impacts": "impacts m in a period of the motion m/n", "periods": "forcing periods n in a period of the motion m/n"}
    values = {"impacts": impacts, "periods": periods}
    return {name: (list(dims), of, {"long_name": words[name], "units": "1"}) for name, of in values.items()}


def with_whole_numbers(ds: "xr.Dataset") -> "xr.Dataset":
    """The Dataset with the variables `impacts` and `periods` of its labels."""
    whole: xr.Dataset = ds.assign(whole_numbers([str(name) for name in ds["label"].dims], ds["label"].values))
    return whole


@overload
def settle_many(
    system: Oscillator,
    x: ArrayLike,
    v: ArrayLike = 0.0,
    phase: ArrayLike = 0.0,
    *,
    threads: int = 0,
    progress: Progress = None,
) -> Settlement: ...


@overload
def settle_many(
    system: "System | Points",
    *,
    over: "Points | None" = None,
    starts: "Points | None" = None,
    fields: Sequence[str] = (),
    transient: bool = False,
    impacts: int | None = None,
    store: str | PathLike[str] | None = None,
    client: "Client | None" = None,
    tile: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset": ...


def settle_many(
    system: "System | Points",
    x: ArrayLike | None = None,
    v: ArrayLike = 0.0,
    phase: ArrayLike = 0.0,
    *,
    over: "Points | None" = None,
    starts: "Points | None" = None,
    fields: Sequence[str] = (),
    transient: bool = False,
    impacts: int | None = None,
    store: str | PathLike[str] | None = None,
    client: "Client | None" = None,
    tile: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "Settlement | xr.Dataset":
    """Follow many motions until they have settled: from many starts, of many systems.

    Systems and starts are names with arrays that broadcast against each other, tables of pandas or Datasets of xarray,
    whose dimensions are kept. The result does not depend on the number of threads. Starts of one system are followed side
    by side. Positions `x` as the second argument give a `Settlement` with the motions of one system, and no Dataset.

    Parameters
    ----------
    system : Oscillator, Machine, mapping, DataFrame or Dataset
        The system, or values of "inverse_beta" or "beta", "gap", "restitution", "damping", "second_gap",
        "second_restitution"; of "x", "v" and "phase" too.
    x, v, phase : array_like
        Positions, velocities and phases, broadcast to one shape.
    over : mapping, DataFrame or Dataset
        Values of parameters instead of those of an oscillator, in physical units also "force_n" and others; of the numbers of
        a machine by path.
    starts : mapping, DataFrame or Dataset
        Values of "x", "v" and "phase", of a machine of "q.NAME", "qdot.NAME" and "phase". Default: at rest, or on the stop, at
        phase 0; the start of the machine.
    fields : sequence of str
        Quantities of each motion as further variables, as for `basin`.
    transient : bool
        Whether to count the impacts until each motion was decided. Many starts of one system take longer then.
    impacts : int
        Budget of impacts for each start. Motions that have not settled by then are undecided.
    store, client, tile
        As for `basin`. In a store the points are one dimension, `sample`, whatever shape the arrays have.
    threads : int
        Number of threads; 0 for one per core.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Returns
    -------
    xarray.Dataset
        `label` (codes, which `ds.vibro.labels()` converts to text), `impacts` m and `periods` n of the motion m/n, the
        `reason` of the verdict, and what `fields` and `transient` ask for. For several systems the Floquet multipliers of
        each motion, `multiplier_1_re`, `multiplier_1_im` and `multiplier_2_...`, the larger first; for one system `cycle`,
        and the cycles in the tables `cycle_...`, as of `basin`. Of a machine there are `label`, `impacts`, `periods`, the largest
        `speed` of a closing, the largest modulus of the multipliers as `multiplier`, and `fields`; where a start lies beyond a
        stop, or the numbers are not allowed, there is no motion.

    Examples
    --------
    >>> import numpy as np
    >>> import vibroimpact as vi
    >>> from vibroimpact import Oscillator, settle_many
    >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> ds = settle_many({"inverse_beta": [1.3, 1.8], "gap": [0.75, 0.25], "restitution": 0.5}, starts={"v": 0.5})
    >>> ds.vibro.labels().values.tolist(), ds["impacts"].values.tolist()
    (['2/1', '4/1'], [2.0, 4.0])
    >>> found = settle_many(osc, np.linspace(-4, 0.75, 5), 0.0)
    >>> found.labels.tolist()
    ['1/1', '1/1', '1/1', '1/1', '2/1']
    >>> machine = vi.Machine.named("two-mass-hammer")
    >>> machine.settle_many(over={"frequency": [1.0, 1.2]}).vibro.labels().values.tolist()
    ['2/1', '1/1']
    """
    threads = threads_of(threads)
    if x is None:
        if any(np.ndim(of) > 0 or of != 0.0 for of in (v, phase)):
            raise TypeError('velocities and phases without positions are written starts={"v": ..., "phase": ...}')
        if store is None and client is None and tile is None and not isinstance(system, Machine):
            budget = maybe("impacts", impacts, BUDGET)
            return _of_points((system, over, starts), (budget, fields, transient), threads, progress)
        from vibroimpact import _store
        from vibroimpact._plan import Plan

        plan = Plan.samples(
            system, over=over, starts=starts, fields=fields, transient=transient, impacts=impacts, tile=tile
        )
        units = system.units if isinstance(system, Oscillator) else None
        ds = with_whole_numbers(_store.computed(plan, units, store, client, threads, progress))
        if not isinstance(system, Machine) or store is not None or any(isinstance(of, Sample) for of in (over, starts)):
            return ds
        return in_shape(ds, points(system, over, starts))
    if over is not None or starts is not None or len(fields) or transient or impacts is not None or store is not None:
        raise TypeError("x as the second argument has no over, starts, fields, transient, impacts and store: write starts={\"x\": ...}")
    if not isinstance(system, Oscillator):
        raise TypeError("x as the second argument is for one Oscillator: write starts={\"x\": ...}")
    return _of_starts(system, (x, v, phase), threads, progress)


def _of_points(
    asked: "tuple[Oscillator | Points, Points | None, Points | None]",
    options: tuple[int | None, Sequence[str], bool],
    threads: int,
    progress: Progress,
) -> "xr.Dataset":
    """The motions at points of systems and starts."""
    over = points(*asked)
    osc: Any = over.system
    impacts, fields, transient = options
    with watched(progress, "starts") as tell:
        found = _core.settle_points(
            osc._file, over.columns, over.start, (impacts, names(fields) or [], bool(transient)), threads, tell
        )
    variables = {}
    for of in found:
        (first, _), *further = of["dimensions"] or [("", 0)]
        if first == POINT:
            dims, values = over_points(over, of["values"], further)
        else:
            dims, values = [name for name, _ in of["dimensions"]], of["values"]
            values = np.array(values, dtype=object) if isinstance(values, list) else values
            values = values.reshape([size for _, size in of["dimensions"]])
        variables[of["name"]] = (dims, values, attributes_of(of))
        if of["name"] == "label":
            variables |= whole_numbers(dims, values)
    return dataset(over, "motions an impact oscillator settles into", variables)


def _of_starts(
    osc: Oscillator, given: tuple[ArrayLike, ArrayLike, ArrayLike], threads: int, progress: Progress
) -> Settlement:
    """The motions of one system from arrays of starts. Arrays of doubles are not copied."""
    columns = [numbers(name, of) for name, of in zip(("x", "v", "phase"), given)]
    shape = np.broadcast_shapes(*(column.shape for column in columns))
    size = int(np.prod(shape))
    # the compiled module accepts one number or a full column; only partly broadcast arrays must be expanded
    flat = [
        column.reshape(-1)
        if column.size in (1, size) and (column.size == 1 or column.shape == shape)
        else np.ascontiguousarray(np.broadcast_to(column, shape)).reshape(-1)
        for column in columns
    ]
    if size > 0 and all(column.size == 1 for column in flat):
        flat[0] = np.ascontiguousarray(np.broadcast_to(flat[0], (size,)))
    with watched(progress, "starts") as tell:
        found, cells = _core.settle_many(osc._file, flat[0], flat[1], flat[2], threads, tell)
    motions = [{**json.loads(told), "share": count / max(size, 1), "starts": count} for told, count in found]
    intervals = [_core.share_interval(count, size) for _, count in found]
    return Settlement({"motions": motions, "share_intervals": intervals, "starts": size, "cells": cells.reshape(shape)}, osc)


#: Kinds of events in the order of their codes.
_KINDS = ("impact", "graze", "stick", "release")


def simulate_many(
    system: "System | Points",
    *,
    over: "Points | None" = None,
    starts: "Points | None" = None,
    impacts: int | None = None,
    periods: float | None = None,
    time: float | None = None,
    at: ArrayLike | None = None,
    phase: float | None = None,
    position: float | Mapping[str, float] | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Follow many motions: their events, or their states where `at`, `phase` or `position` asks for them.

    Systems and starts are given as for `settle_many`. Rows of different lengths are filled up with nan. The result does not depend on
    the number of threads.

    Parameters
    ----------
    system : Oscillator, Machine, mapping, DataFrame or Dataset
        The system, or values of its parameters.
    over : mapping, DataFrame or Dataset
        Values of parameters instead of those of an oscillator; of the numbers of a machine by path.
    starts : mapping, DataFrame or Dataset
        Values of "x", "v" and "phase", of a machine of "q.NAME", "qdot.NAME" and "phase". Default: at rest, or on the stop, at
        phase 0; the start of the machine.
    impacts : int
        Stop after this number of impacts, of a machine of events, 1 to 1e7. Default: 100, or 1e6 with `periods` or `time`.
    periods : float
        Stop after this number of forcing periods, up to 1e9. Default for `phase` and `position`: 100.
    time : float
        Stop the events at this time, up to 1e10.
    at : array_like
        Times, 0 or more and rising: the states at these times, from the closed form of the flights. At the time of an event
        the state is that after it; while the last impacts of a chatter are summed, that of rest.
    phase : float
        A phase of the force, radians: the states at this phase, once in every period.
    position : float, or mapping
        A position between the stops: the states where the motion crosses it, upwards where the velocity is positive. Of a machine of
        several coordinates that of one of them: {"q.head": 0.1}.
    threads : int
        Number of threads; 0 for one per core.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Returns
    -------
    xarray.Dataset
        Of events: `time`, `kind` (codes, which `ds.vibro.labels("kind")` converts to text), `event_phase`, `side`,
        `velocity_before` and `velocity_after`, with the dimension `event`; `count`, `end` and `end_time` of each motion.
        Of a machine: `time`, `kind`, `event_phase`, `stop` (codes), `speed`, and coordinates and velocities after the event
        by their paths.
        Of states: `time`, `position`, `velocity` and `force_phase`, with the dimension `time` for `at`, and `state`
        otherwise; of a machine coordinates and velocities by their paths.

    Examples
    --------
    >>> import numpy as np
    >>> from vibroimpact import Oscillator, simulate_many
    >>> osc = Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)
    >>> ds = simulate_many(osc, starts={"x": [-1.0, 0.0], "v": 0.0}, impacts=20)
    >>> dict(ds.sizes), ds["time"].isel(sample=1, event=slice(3)).values.round(4).tolist()
    ({'sample': 2, 'event': 22}, [1.4598, 2.2409, 2.6025])
    >>> states = simulate_many(osc, starts={"x": [-1.0, 0.0]}, at=[0.0, 1.0])
    >>> states["position"].values[:, 0].tolist()
    [-1.0, 0.0]
    >>> import vibroimpact as vi
    >>> hammer = vi.Machine.named("two-mass-hammer")
    >>> strobes = hammer.simulate_many(over={"frequency": [1.1, 1.2]}, phase=0, periods=300).isel(state=-1)
    >>> strobes["q.head"].values.round(4).tolist()
    [-1.3879, -1.2446]
    >>> crossings = hammer.simulate_many(position={"q.head": 0.1}, periods=20)
    >>> crossings["q.head"].values[:3].round(12).tolist(), crossings["time"].values[:3].round(4).tolist()
    ([0.1, 0.1, 0.1], [1.3999, 4.1468, 7.6413])
    """
    given = [name for name, of in (("at", at), ("phase", phase), ("position", position)) if of is not None]
    if len(given) > 1:
        raise QuestionError(f"{given[0]} and {given[1]} are two questions\nhint: a call for each")
    for name, value, most in (("periods", periods, 1e9), ("time", time, 1e10)):
        if value is not None and not 0 < value <= most:
            raise QuestionError(f"{name} = {value} lies outside 0 < {name} <= {most:.0f}")
    for name, value in (("impacts", impacts), ("time", time)):
        if given and value is not None:
            raise QuestionError(f"{name} has no meaning with {given[0]}\nhint: periods limits the time")
    limit, threads = None if impacts is None else whole("impacts", impacts, SIMULATED, here=True), threads_of(threads)
    if at is not None and periods is not None:
        raise QuestionError("periods has no meaning with at\nhint: the last time limits the time")
    times = None if at is None else _times(at)
    turns = 100.0 if periods is None else float(periods)
    if phase is not None and turns < 1:
        raise QuestionError(f"periods = {periods} is less than one period, so there may be no state at the phase")
    strobes = None if phase is None else (_finite("phase", phase), math.floor(turns))
    over_all = points(system, over, starts)
    of, limits = over_all.system, (limit, periods, time)
    crossing = None if position is None else (*_place(of, position), turns)
    section = times.tolist() if times is not None else strobes or crossing
    with watched(progress, "motions") as tell:
        if isinstance(of, Machine):
            asked = _asked(over_all)
            if section is None:
                return _events(over_all, _core.simulate_machines(of._file, *asked, limits, threads, tell))
            return _states(over_all, times, _core.states_of_machines(of._file, *asked, section, threads, tell))
        if section is None:
            return _events(over_all, _core.simulate_points(of._file, over_all.columns, over_all.start, limits, threads, tell))
        return _states(over_all, times, _core.states_of_points(of._file, over_all.columns, over_all.start, section, threads, tell))


def _place(system: System, position: float | Mapping[str, float]) -> tuple[str, float]:
    """The coordinate of a position, and its value."""
    names = names_of(system)[0]
    if not isinstance(position, Mapping):
        if len(names) > 1:
            raise QuestionError(f'position = {position} of which coordinate?\nhint: position={{"{names[0]}": {position}}}')
        position = {names[0]: position}
    if len(position) != 1 or not set(position) <= set(names):
        raise QuestionError(f"position is that of one coordinate; there are {', '.join(names)}")
    ((name, value),) = position.items()
    return name.removeprefix("q."), _finite("position", value)


def _finite(name: str, value: float) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise QuestionError(f"{name} = {number} is not a finite number")
    return number


def _times(at: ArrayLike) -> NDArray[np.float64]:
    times = np.atleast_1d(numbers("at", at))
    if times.ndim != 1 or times.size == 0:
        raise QuestionError(f"at of shape {times.shape} is no list of times")
    wrong = times[~(np.isfinite(times) & (times >= 0))]
    if len(wrong):
        raise QuestionError(f"at = {wrong[0]} is no time: times are finite and 0 or more")
    falls = np.flatnonzero(np.diff(times) < 0)
    if len(falls):
        k = falls[0]
        raise QuestionError(f"at falls from {times[k]} to {times[k + 1]}\nhint: numpy.sort")
    return times


#: The scales of times, lengths and velocities of an oscillator, and their units; those of machines are their own.
_TIME, _LENGTH, _VELOCITY, _OWN = ("1/omega_n", "1"), ("F/k", "1"), ("omega_n F/k", "1"), ("", "")
#: No scale, of counts and angles.
_COUNT, _ANGLE = ("", "1"), ("", "rad")


class _Variables:
    """The variables of a Dataset, by name; those with a further dimension have `further`, its name and length."""

    def __init__(self, over: Over, further: tuple[str, int]) -> None:
        self.found: dict[str, Any] = {}
        self._over, self._further = over, further

    def add(
        self, name: str, values: NDArray[Any], words: str, of: tuple[str, str], codes: Mapping[str, int] | None = None, *, each: bool = True
    ) -> None:
        """A variable with its description; `each` tells whether it has a value for each event or state."""
        dims, array = over_points(self._over, values, (self._further,) if each else ())
        scale, unit = of
        flags = {} if codes is None else {"flag_values": list(codes.values()), "flag_meanings": " ".join(codes)}
        self.found[name] = (dims, array, {**described(words, unit, scale), **flags})


def _numbered(names: Iterable[str]) -> dict[str, int]:
    return {name: code for code, name in enumerate(names)}


def _title(over: Over, words: str) -> str:
    return f"{words}: {over.system.title or 'a machine'}" if isinstance(over.system, Machine) else f"{words} of an impact oscillator"


def _events(over: Over, found: dict[str, Any]) -> "xr.Dataset":
    """The Dataset of the events of motions."""
    own: list[tuple[str, Any, str, tuple[str, str], dict[str, int] | None]]
    if isinstance(over.system, Machine):
        events, stops = found["events"], over.system.stops + over.system.joints
        time, phase, speed, *states = events["real"]
        width, kind, kinds, ends, clock, force = found["width"], events["kind"], events["kinds"], found["ends"], _OWN, "forcing"
        own = [
            ("stop", events["stop"], "stop or joint of the event", _COUNT, _numbered(stops)),
            ("speed", speed, "speed of closing before the event", _OWN, None),
        ]
        paths = [path for of in names_of(over.system) for path in of]
        own += [(path, values, f"{path} after the event", _OWN, None) for path, values in zip(paths, states)]
    else:
        time, phase, before, after = found["real"].reshape(4, -1)
        width, kind, kinds, ends, clock, force = found["room"], found["kind"], _KINDS, _core.end_reasons(), _TIME, "force"
        own = [
            ("side", found["side"], "1 for the first stop, -1 for the second", _COUNT, None),
            ("velocity_before", before, "velocity before the impact", _VELOCITY, None),
            ("velocity_after", after, "velocity after the impact", _VELOCITY, None),
        ]
    all_ = _Variables(over, ("event", width))
    all_.add("time", time, "time of the event", clock)
    all_.add("kind", kind, "kind of the event", _COUNT, _numbered(kinds))
    all_.add("event_phase", phase, f"phase of the {force} at the event", _ANGLE)
    for variable in own:
        all_.add(*variable)
    all_.add("count", found["count"], "number of events", _COUNT, each=False)
    all_.add("end", found["end"], "why the list ends", _COUNT, _numbered(ends), each=False)
    all_.add("end_time", found["end_time"], "time at which the list ends", clock, each=False)
    # the further cells hold no events; without a copy
    last = slice(None, found["width"])
    used = {name: (dims, of[..., last] if "event" in dims else of, attrs) for name, (dims, of, attrs) in all_.found.items()}
    return dataset(over, _title(over, "events of motions"), used)


def _asked(over: Over) -> tuple[list[tuple[str, list[float]]], list[State]]:
    """The numbers of a machine that vary, and the start at each point."""
    columns = {name: values.tolist() for name, values in over.columns}
    count = len(over.columns[0][1])

    def column(name: str, value: float) -> list[float]:
        found: list[float] = columns.pop(name, [value] * count)
        return found

    q, qdot, phase = over.start
    rows = [np.array([column(*of) for of in zip(names, values)]) for names, values in zip(names_of(over.system), (q, qdot))]
    phases = column("phase", phase)
    starts = [(rows[0][:, k].tolist(), rows[1][:, k].tolist(), phases[k]) for k in range(count)]
    return list(columns.items()), starts


def _states(over: Over, times: NDArray[np.float64] | None, found: tuple[int, list[NDArray[np.float64]]]) -> "xr.Dataset":
    """The Dataset of states: at given times, or of a section."""
    width, (time, phase, *states) = found
    all_ = _Variables(over, ("state" if times is None else "time", width))
    if isinstance(over.system, Machine):
        names = [(path, _OWN) for of in names_of(over.system) for path in of]
        clock, forcing = _OWN, "phase of the forcing"
    else:
        names, clock, forcing = [("position", _LENGTH), ("velocity", _VELOCITY)], _TIME, "phase of the force"
    if times is None:
        all_.add("time", time, "time since the start", clock)
    for (name, scale), values in zip(names, states):
        all_.add(name, values, name, scale)
    all_.add("force_phase", phase, forcing, _ANGLE)
    ds = dataset(over, _title(over, "states of motions" if times is not None else "sections of motions"), all_.found)
    at = {} if times is None else {"time": ("time", times, described("time since the start", clock[1], clock[0]))}
    whole: xr.Dataset = ds.assign_coords(at)
    return whole
