"""Conversion of Datasets to metres and seconds."""

from typing import TYPE_CHECKING

from vibroimpact._core import QuestionError, Units

if TYPE_CHECKING:
    import xarray as xr

#: The attributes of a Dataset that contain its physical units.
_LENGTH, _TIME, _MASS = _KEYS = ("unit_length_m", "unit_time_s", "unit_mass_kg")


def attributes(units: Units | None) -> dict[str, float]:
    """The physical units as attributes of a Dataset; empty without units."""
    return {} if units is None else {_LENGTH: units.length_m, _TIME: units.time_s, _MASS: units.mass_kg}


def converted(ds: "xr.Dataset", units: Units | None) -> "xr.Dataset":
    """The Dataset in metres and seconds, converted with the given units or those in its attributes."""
    if ds.attrs.get("units") == "si":
        raise QuestionError("this Dataset is in metres and seconds already")
    if units is None:
        if any(key not in ds.attrs for key in _KEYS):
            raise QuestionError(
                "this Dataset has no units of a machine\nhint: ds.vibro.si(osc.units), where osc comes from Oscillator.from_units"
            )
        length, time, mass = (float(ds.attrs[key]) for key in _KEYS)
        units = Units(length_m=length, time_s=time, mass_kg=mass)
    speed, mass = units.velocity_m_per_s, units.mass_kg
    one = {
        "1": (1.0, "1"),
        "radian": (1.0, "radian"),
        "F/k": (units.length_m, "m"),
        "omega_n F/k": (speed, "m/s"),
        "1/omega_n": (units.time_s, "s"),
        "omega_n": (1 / units.time_s, "1/s"),
        "omega_n^2 F/k": (speed / units.time_s, "m/s2"),
        "m omega_n F/k": (mass * speed, "N s"),
        "F^2/k": (mass * speed * speed, "J"),
        "omega_n F^2/k": (mass * speed * speed / units.time_s, "W"),
    }
    changed: dict[str, xr.DataArray] = {}
    for name, of in ds.variables.items():
        unit = of.attrs.get("units") or "1"
        if unit not in one:
            raise QuestionError(f"`{name}` is in units of `{unit}`, which are none of vibroimpact")
        factor, named = one[unit]
        if named != unit:
            array = ds[name]
            changed[str(name)] = (array * factor).assign_attrs({**array.attrs, "units": named})
    coordinates = {name: changed.pop(name) for name in list(changed) if name in ds.coords}
    moved = ds.assign_coords({name: (of.dims, of.values, of.attrs) for name, of in coordinates.items()})
    told = {name: value for name, value in ds.attrs.items() if name not in _KEYS}
    whole: xr.Dataset = moved.assign({name: (of.dims, of.data, of.attrs) for name, of in changed.items()})
    whole.attrs = {**told, **attributes(units), "units": "si"}
    return whole
