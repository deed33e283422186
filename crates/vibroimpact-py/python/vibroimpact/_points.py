"""Points of parameters and starts, as users write them: names with arrays that broadcast, tables and Datasets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact._arguments import numbers
from vibroimpact._core import QuestionError
from vibroimpact._machine import Machine
from vibroimpact._oscillator import Oscillator
from vibroimpact._stated import POINT, STARTS, SYMBOLS
from vibroimpact._system import System, names_of

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Names with arrays that broadcast, a table of pandas, or a Dataset of xarray.
Points: TypeAlias = "Mapping[str, ArrayLike] | pd.DataFrame | xr.Dataset"
#: What an oscillator is made of, of which the first two are one parameter.
_PARAMETERS = tuple(SYMBOLS)


class Over(NamedTuple):
    """Points in the form in which the compiled module takes them."""

    #: The system of the first point; its other numbers are those of all points.
    system: System
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


def points(system: "System | Points", over: "Points | None", starts: "Points | None") -> Over:
    """The points of systems and starts, broadcast against each other."""
    if isinstance(system, Machine):
        return _of_machine(system, over, starts)
    osc, own = (system, None) if isinstance(system, Oscillator) else (None, system)
    fixed, columns, sizes, coords = _collected({"system": own, "over": over, "starts": starts}, _PARAMETERS, tuple(STARTS))
    first = {name: values for name, values in fixed.items() if name not in STARTS}
    first |= {name: float(values[0]) for name, values in columns if name not in STARTS}
    if osc is None:
        osc = _system(first)
    elif fixed_here := {name: value for name, value in first.items() if name in fixed}:
        osc = osc.replace(**fixed_here)
    if osc.second_gap is None and "second_gap" in first:
        second = {"second_restitution": first["second_restitution"]} if "second_restitution" in first else {}
        osc = osc.replace(second_gap=first["second_gap"], **second)
    x, v, phase = (fixed.get(name) for name in STARTS)
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
            f"`{unknown[0]}` is no parameter and no coordinate of a start; there are {', '.join(_PARAMETERS)}, {', '.join(STARTS)}"
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
