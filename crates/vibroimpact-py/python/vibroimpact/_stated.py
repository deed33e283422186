"""What Datasets say of themselves: variables by their long names, units, and the parameters in titles of figures.

After a Dataset was computed, parts of it may be selected, or it may be joined with others or transposed. Its coordinates
then follow the data, but its attribute "plan" does not change. So a figure states the coordinates and not the plan.
"""

import json
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._json import read

if TYPE_CHECKING:
    import xarray as xr

#: What computed a Dataset, as its attributes.
SOURCE = {"source": f"vibroimpact {_core.__version__}", "history": f"computed by vibroimpact {_core.__version__}"}
#: The dimension of points that have no other name.
POINT = "sample"
#: Powers as figures show them.
_POWERS = {"2": "\u00b2", "3": "\u00b3"}


def described(long_name: str, units: str, scale: str) -> dict[str, Any]:
    """The attributes of a variable: the unit, if it is known, and the scale of nondimensional numbers."""
    given = {"long_name": long_name, "units": written(units), "scale": scale}
    return {name: text for name, text in given.items() if text}


def attributes_of(of: Mapping[str, Any]) -> dict[str, Any]:
    """The attributes of a variable that the compiled module describes."""
    attributes = described(of["long_name"], of["units"], of["scale"])
    if of["comment"]:
        attributes["comment"] = of["comment"]
    if of["flags"]:
        attributes["flag_values"] = [value for value, _ in of["flags"]]
        attributes["flag_meanings"] = " ".join(meaning for _, meaning in of["flags"])
    return attributes


def variable(of: Mapping[str, Any], points: Mapping[str, int] | None = None) -> tuple[list[str], NDArray[Any], dict[str, Any]]:
    """A variable that the compiled module describes, with other dimensions of points than that of a list."""
    sizes = dict(of["dimensions"])
    if points is not None and sizes.pop(POINT, None) is not None:
        sizes = {**points, **sizes}
    values = np.array(of["values"], dtype=object) if isinstance(of["values"], list) else of["values"]
    return list(sizes), values.reshape(list(sizes.values())), attributes_of(of)


def unit_of(attributes: Mapping[Any, Any]) -> str:
    """The unit or the scale of a variable, as labels of figures write it; empty for pure numbers and angles."""
    if scale := str(attributes.get("scale", "")):
        return f"*{scale.replace('omega_n', 'ω_n')}*"
    units = str(attributes.get("units", "1"))
    return "" if units in ("", "1", "rad") else fraction(units)


def written(units: str) -> str:
    """A unit of the compiled module or of a store, `m s-2`, as UDUNITS and pint read it: `m/s^2`."""
    factors = [factor.partition("-") for factor in units.split()]
    above = [symbol for symbol, sign, _ in factors if not sign]
    below = [f"/{symbol}" + (f"^{power}" if power != "1" else "") for symbol, sign, power in factors if sign]
    return " ".join(above or (["1"] if below else [])) + "".join(below)


def fraction(units: str) -> str:
    """A unit as figures show it: `m s-2` and `m/s^2` are m/s\u00b2."""
    text = written(units)
    for power, sign in _POWERS.items():
        text = text.replace(f"^{power}", sign)
    return text


#: The long names of the variables that figures and labels need.
_FIELDS = {
    "motion m/n, the most frequent first": "label",
    "motion m/n that the start leads to": "label",
    "share of the starts that lead to the motion": "share",
    "number of the cycle that the start leads to, in the tables cycle_*": "cycle",
    "whether the point was computed itself": "computed",
}


@lru_cache(maxsize=1)
def _known() -> dict[str, str]:
    """The names by the long names."""
    coordinates = (*SYMBOLS, *STARTS, *_core.body_parameters())
    return {**_FIELDS, **{_core.coordinate_words(name)[0]: name for name in coordinates}}


def _given(ds: "xr.Dataset") -> dict[str, str]:
    """The names that renamed variables were given when the Dataset was computed, by their names now."""
    known = _known()
    found = {str(now): known.get(str(of.attrs.get("long_name", "")), str(now)) for now, of in ds.variables.items()}
    return {now: name for now, name in found.items() if now != name and name not in ds.variables}


def here(ds: "xr.Dataset", name: str) -> str:
    """The name that a variable has now, if the Dataset has it."""
    return next((now for now, given in _given(ds).items() if given == name), name)


def restored(ds: "xr.Dataset") -> "xr.Dataset":
    """The Dataset with the names that its variables were given."""
    free = {now: name for now, name in _given(ds).items() if name not in ds.dims}
    whole: xr.Dataset = ds.rename(free) if free else ds
    return whole


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
        return read(ds.attrs["plan"])
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
