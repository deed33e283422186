"""The parameters of a Dataset: scalar coordinates for those that do not vary, and the title of its figure.

After a Dataset was computed, parts of it may be selected, or it may be joined with others or transposed. Its coordinates
then follow the data, but its attribute "plan" does not change. So a figure states the coordinates and not the plan.
"""

import json
import re
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._unit_names import described, unit_of

if TYPE_CHECKING:
    import xarray as xr

#: Symbols of parameters and of the coordinates of a start, in the markup of labels.
SYMBOLS = {
    "beta": "*β*", "inverse_beta": "1/*β*", "gap": "*δ*", "restitution": "*ε*", "damping": "*ζ*", "second_gap": "*δ*_2",
    "second_restitution": "*ε*_2",
}
STARTS = {"x": "*ξ*_0", "v": "*u*_0", "phase": "*φ*_0"}
_FREQUENCIES = ("beta", "inverse_beta")
#: Symbols of coordinates in metres and seconds.
IN_METRES = {"gap": "*d*", "second_gap": "*d*_2", "x": "*x*_0", "v": "*v*_0"}
#: Parameters that a title always states if they are known. The others are stated only where `_worth_saying` holds.
_ALWAYS = (*_FREQUENCIES, "gap", "restitution")


def with_fixed(ds: "xr.Dataset") -> "xr.Dataset":
    """The Dataset of a plan, with parameters and coordinates of the start that do not vary added as scalar coordinates."""
    import xarray as xr

    fixed = {
        name: xr.Variable((), value, described(long_name, units, scale))
        for name, value, long_name, units, scale in _core.fixed_coordinates(ds.attrs["plan"])
        if name not in ds.variables
    }
    whole: xr.Dataset = ds.assign_coords(fixed)
    return whole


def plain(text: str) -> str:
    """A text in the markup of labels, in which some characters have a meaning."""
    return re.sub(r"([*_^\\])", r"\\\1", text)


def span(sign: str, low: float, high: float) -> str:
    """Text for a parameter with a range of values."""
    return f"{sign} from {low:.6g} to {high:.6g}"


def _equal(sign: str, value: float) -> str:
    """Text for a parameter with one value."""
    mantissa, e, exponent = f"{value:.6g}".partition("e")
    return f"{sign} = {mantissa}" + (f"·10^{{{int(exponent)}}}" if e else "")


def symbol(name: str) -> str:
    """The symbol of a coordinate, or its name if it has no symbol."""
    return (SYMBOLS | STARTS).get(name) or plain(name)


def named(ds: "xr.Dataset", name: str) -> str:
    """The symbol of a coordinate for an axis, with its unit in a Dataset in metres and seconds; a number of a body in words."""
    if words := _core.body_parameters().get(name):
        return words
    unit = _unit(ds, name)
    return f"{_sign(ds, name)} ({unit})" if unit else _sign(ds, name)


def _sign(ds: "xr.Dataset", name: str) -> str:
    """The symbol of a coordinate in the units of the Dataset."""
    return IN_METRES[name] if _unit(ds, name) and name in IN_METRES else symbol(name)


def _unit(ds: "xr.Dataset", name: str) -> str:
    """The SI unit of a coordinate; empty for a number, an angle, and in nondimensional Datasets."""
    return unit_of(ds[name].attrs) if ds.attrs.get("units") == "si" and name in ds.coords else ""


def along(ds: "xr.Dataset", name: str) -> NDArray[np.float64]:
    """The values of an axis of a figure, all finite. Raises QuestionError otherwise."""
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
    """The title: the parameters from the coordinates, except those on the axes of the figure."""
    plan = _question(ds)
    if "machine" in plan:
        # a long title up to its first colon, then what does not vary in the figure any more
        first = str(plan.get("title", "")).split(": ")[0]
        return plain(", ".join([first, *_of_machine(ds, axes, varied(plan))] if first else _of_machine(ds, axes, varied(plan))))
    lost = {name for name in varied(plan) if name not in ds.coords and name not in axes}
    given = "beta" if "beta" in plan.get("system", {}) else "inverse_beta"
    drawn = set(axes) | ({*_FREQUENCIES} if {*_FREQUENCIES} & set(axes) else set())
    if not set(varied(plan)).isdisjoint(_core.body_parameters()):
        # a number of the body may change each of these
        drawn |= {*_FREQUENCIES, "gap", "damping", "second_gap"}
    # of beta and its inverse, state the one that varies, or else the one that was given
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
                sign, unit = _sign(ds, name), _unit(ds, name)
                one = _equal(sign, known[0]) if len(known) == 1 else span(sign, known[0], known[-1])
                one += f" {unit}" if unit else ""
                said.append(one if len(known) == len(values) else f"{one} or none")
    return ", ".join(said)


def _question(ds: "xr.Dataset") -> dict[str, Any]:
    """The plan of a Dataset; of points, which have no plan, their system."""
    if "plan" in ds.attrs:
        plan: dict[str, Any] = json.loads(ds.attrs["plan"])
        return plan
    return {"system": json.loads(ds.attrs["system"])} if "system" in ds.attrs else {}


def _of_machine(ds: "xr.Dataset", axes: tuple[str, ...], names: list[str]) -> list[str]:
    """The numbers of a machine, or of a start, that vary in the plan and not in the figure."""
    said = []
    for name in names:
        if name in axes:
            continue
        if name not in ds.coords:
            said.append(f"{name} not known")
            continue
        values = np.unique(ds[name].values.astype(np.float64))
        known = values[np.isfinite(values)]
        if len(known) == 1:
            said.append(f"{name} = {known[0]:.6g}")
        elif len(known):
            said.append(span(name, known[0], known[-1]))
    return said


def varied(plan: dict[str, Any]) -> list[str]:
    """The names of the quantities that vary in a plan."""
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
    """Whether a title states a parameter. Left out: an absent second stop, zero damping, a second restitution equal to the first."""
    if not len(values):
        return False
    if name in _ALWAYS or len(values) > 1 or name in varied(plan):
        return True
    if name == "second_restitution":
        first = ds.coords.get("restitution")
        return "restitution" in axes or first is None or not np.array_equal(np.unique(first.values), values)
    return name == "second_gap" or bool(values[0] != 0)
