"""Conversion of Datasets to metres and seconds."""

import json
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._oscillator import Units

if TYPE_CHECKING:
    import xarray as xr

#: The attributes of a Dataset that contain its physical units.
LENGTH, _TIME, _MASS = _KEYS = ("unit_length_m", "unit_time_s", "unit_mass_kg")

#: The factor for each scale of nondimensional numbers, and the SI unit as UDUNITS and pint read it.
_Factors: TypeAlias = dict[str, tuple[Any, str]]

#: Units of numbers that have no scale.
_PLAIN = ("1", "rad")


def attributes(units: Units | None) -> dict[str, float]:
    """The physical units as attributes of a Dataset; empty without units."""
    return {} if units is None else {LENGTH: units.length_m, _TIME: units.time_s, _MASS: units.mass_kg}


def of_plan(plan: str) -> dict[str, float]:
    """Those of a plan, which is JSON."""
    units = json.loads(plan).get("units")
    return {key: float(units[key.removeprefix("unit_")]) for key in _KEYS} if units else {}


def converted(ds: "xr.Dataset", units: Units | None) -> "xr.Dataset":
    """The Dataset in metres and seconds, converted with the given units or those in its attributes.

    Coordinates of starts are in the units of the body of the plan. Results over a number of the body, such as the
    force, are in the units of the machine at each point.
    """
    if ds.attrs.get("units") == "si":
        raise QuestionError("this Dataset is in metres and seconds already")
    if units is None:
        if any(key not in ds.attrs for key in _KEYS):
            raise QuestionError(
                "this Dataset has no units of a body\nhint: ds.vibro.si(osc.units), where osc comes from Oscillator.from_units"
            )
        length, time, mass = (float(ds.attrs[key]) for key in _KEYS)
        units = Units(length_m=length, time_s=time, mass_kg=mass)
    fixed = _factors(units.length_m, units.time_s, units.mass_kg)
    here = _factors(*_scales(ds, units))
    changed: dict[str, xr.DataArray] = {}
    for name, of in ds.variables.items():
        scale, unit = of.attrs.get("scale"), of.attrs.get("units") or "1"
        if name in _core.body_parameters():
            continue
        known = scale in fixed if scale else unit in _PLAIN
        if not known:
            raise QuestionError(f"`{name}` is in units of `{scale or unit}`, which are none of vibroimpact")
        if scale:
            factor, named = (fixed if name in ds.coords else here)[scale]
            array = ds[name]
            kept = {key: value for key, value in array.attrs.items() if key != "scale"}
            scaled = (array * factor).transpose(*array.dims, ...)
            # assign_attrs would keep the scale
            scaled.attrs = {**kept, "units": named}
            changed[str(name)] = scaled
    coordinates = {name: changed.pop(name) for name in list(changed) if name in ds.coords}
    moved = ds.assign_coords({name: (of.dims, of.values, of.attrs) for name, of in coordinates.items()})
    told = {name: value for name, value in ds.attrs.items() if name not in _KEYS}
    whole: xr.Dataset = moved.assign({name: (of.dims, of.data, of.attrs) for name, of in changed.items()})
    whole.attrs = {**told, **attributes(units), "units": "si"}
    return whole


def _factors(length: Any, time: Any, mass: Any) -> _Factors:
    speed = length / time
    return {
        "F/k": (length, "m"),
        "omega_n F/k": (speed, "m/s"),
        "1/omega_n": (time, "s"),
        "omega_n": (1 / time, "1/s"),
        "omega_n^2 F/k": (speed / time, "m/s^2"),
        "m omega_n F/k": (mass * speed, "N s"),
        "F^2/k": (mass * speed * speed, "J"),
        "omega_n F^2/k": (mass * speed * speed / time, "W"),
    }


def _scales(ds: "xr.Dataset", units: Units) -> tuple[Any, Any, Any]:
    """The units of length, time and mass; over numbers of the body, arrays with these dimensions."""
    import xarray as xr

    names = [str(name) for name in ds.coords if name in _core.body_parameters()]
    system = ds.attrs.get("system") or json.dumps(json.loads(ds.attrs.get("plan", "{}")).get("system"))
    if not names or system == "null":
        return units.length_m, units.time_s, units.mass_kg
    columns = xr.broadcast(*(ds[name] for name in names))
    flat = [of.values.astype(np.float64).reshape(-1).tolist() for of in columns]
    scales = _core.scales_of_points(system, names, flat)
    arrays = [xr.DataArray(np.reshape(of, columns[0].shape), dims=columns[0].dims) for of in scales]
    return arrays[0], arrays[1], arrays[2]
