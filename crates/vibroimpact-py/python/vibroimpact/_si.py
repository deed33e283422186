"""Conversion of Datasets to metres and seconds."""

from typing import TYPE_CHECKING

from vibroimpact._core import QuestionError, Units

if TYPE_CHECKING:
    import xarray as xr

#: The attributes of a Dataset that contain its physical units.
_LENGTH, _TIME = "unit_length_m", "unit_time_s"


def attributes(units: Units | None) -> dict[str, float]:
    """The physical units as attributes of a Dataset; empty without units."""
    return {} if units is None else {_LENGTH: units.length_m, _TIME: units.time_s}


def converted(ds: "xr.Dataset", units: Units | None) -> "xr.Dataset":
    """The Dataset in metres and seconds, converted with the given units or those in its attributes."""
    if ds.attrs.get("units") == "si":
        raise QuestionError("this Dataset is in metres and seconds already")
    if units is None:
        if _LENGTH not in ds.attrs or _TIME not in ds.attrs:
            raise QuestionError(
                "this Dataset has no units of a machine\nhint: ds.vibro.si(osc.units), where osc comes from Oscillator.from_units"
            )
        units = Units(length_m=float(ds.attrs[_LENGTH]), time_s=float(ds.attrs[_TIME]))
    one = {
        "1": (1.0, "1"),
        "radian": (1.0, "radian"),
        "F/k": (units.length_m, "m"),
        "omega_n F/k": (units.velocity_m_per_s, "m/s"),
        "1/omega_n": (units.time_s, "s"),
        "omega_n": (1 / units.time_s, "1/s"),
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
    told = {name: value for name, value in ds.attrs.items() if name not in (_LENGTH, _TIME)}
    whole: xr.Dataset = moved.assign({name: (of.dims, of.data, of.attrs) for name, of in changed.items()})
    whole.attrs = {**told, **attributes(units), "units": "si"}
    return whole
