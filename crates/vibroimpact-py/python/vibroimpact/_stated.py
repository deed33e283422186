"""What a Dataset says about its parameters: scalar coordinates for those that its plan leaves as they are, and what a figure states.

A Dataset may have been selected from, joined with others or transposed since it was computed, while its attribute "plan" stays that of
the first one. So a figure states the coordinates, which follow the data, and nothing that only the plan says.
"""

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._figure import SYMBOLS, equal, span

if TYPE_CHECKING:
    import xarray as xr

#: Coordinates of a start.
STARTS = {"x": r"\xi_0", "v": r"u_0", "phase": r"\varphi_0"}
_FREQUENCIES = ("beta", "inverse_beta")
#: Those that a title states wherever they are known; the others where there is something to say of them.
_ALWAYS = (*_FREQUENCIES, "gap", "restitution")


def with_fixed(ds: "xr.Dataset") -> "xr.Dataset":
    """The Dataset of a plan with the parameters and coordinates of the start that vary over none of its axes as scalar coordinates."""
    import xarray as xr

    fixed = {
        name: xr.Variable((), value, {"long_name": long_name, "units": units})
        for name, value, long_name, units in _core.fixed_coordinates(ds.attrs["plan"])
        if name not in ds.variables
    }
    whole: xr.Dataset = ds.assign_coords(fixed)
    return whole


def symbol(name: str) -> str:
    """How an axis names a coordinate; one of another name as it is called."""
    known = SYMBOLS | STARTS
    return f"${known[name]}$" if name in known else name


def along(ds: "xr.Dataset", name: str) -> NDArray[np.float64]:
    """The values of an axis of a figure: a finite number for each place."""
    if name not in ds.coords or ds[name].dims != (name,) or ds[name].dtype.kind not in "iuf":
        raise QuestionError(
            f"the dimension {name} has no numbers along it, so there is no axis to draw it over\n"
            "hint: scattered starts have no axes; ds.assign_coords gives a dimension its values, ds.unstack undoes a stack"
        )
    values: NDArray[np.float64] = ds[name].values.astype(np.float64)
    wrong = values[~np.isfinite(values)]
    if len(wrong):
        raise QuestionError(f"{name} = {wrong[0]} is no place on an axis: values have to be finite")
    return values


def title(ds: "xr.Dataset", axes: tuple[str, ...]) -> str:
    """The parameters as the coordinates have them, without those on the axes of the figure."""
    plan = json.loads(ds.attrs["plan"]) if "plan" in ds.attrs else {}
    lost = {name for name in varied(plan) if name not in ds.coords and name not in axes}
    given = "beta" if "beta" in plan.get("system", {}) else "inverse_beta"
    drawn = set(axes) | ({*_FREQUENCIES} if {*_FREQUENCIES} & set(axes) else set())
    # of two words for the frequency the one that varies, else the one that was given
    lengths = {name: ds[name].size for name in _FREQUENCIES if name in ds.coords}
    if len(lengths) == 2:
        drawn |= {*_FREQUENCIES} - {given}
    said = []
    for name in (*SYMBOLS, *STARTS):
        if name in drawn:
            continue
        if name in lost:
            said.append(f"{symbol(name)} not known")
        elif name in ds.coords and ds[name].dtype.kind in "iuf":
            values = np.unique(ds[name].values.astype(np.float64))
            known = values[np.isfinite(values)]
            if _worth_saying(ds, name, known, axes, plan):
                one = equal(symbol(name), known[0]) if len(known) == 1 else span(symbol(name), known[0], known[-1])
                said.append(one if len(known) == len(values) else f"{one} or none")
    return ", ".join(said)


def varied(plan: dict[str, Any]) -> list[str]:
    """What varies over the axes of a plan's fields."""
    task: dict[str, Any] = next(iter(plan.get("task", {}).values()), {})
    names = [axis["vary"] for axis in task.get("axes", [])]
    if "vary" in task:
        names.append(task["vary"])
    if "also" in task:
        names.append(task["also"]["parameter"])
    return names


def _worth_saying(
    ds: "xr.Dataset", name: str, values: NDArray[np.float64], axes: tuple[str, ...], plan: dict[str, Any]
) -> bool:
    """Whether a title says it: not a second stop that is not there, no damping of 0, no restitution of the second stop like the first."""
    if not len(values):
        return False
    if name in _ALWAYS or len(values) > 1 or name in varied(plan):
        return True
    if name == "second_restitution":
        first = ds.coords.get("restitution")
        return "restitution" in axes or first is None or not np.array_equal(np.unique(first.values), values)
    return name == "second_gap" or bool(values[0] != 0)
