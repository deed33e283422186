"""Datasets of results at points of parameters and starts, whose dimensions are those of the points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._machine import Machine
from vibroimpact._points import Over
from vibroimpact._stated import POINT, SOURCE, described

if TYPE_CHECKING:
    import xarray as xr


def dataset(over: Over, title: str, variables: Mapping[str, Any]) -> "xr.Dataset":
    """The Dataset of results at points, with numbers and starts as coordinates."""
    import xarray as xr

    from vibroimpact import _accessor, _si  # the import of _accessor registers ds.vibro

    system = over.system
    if isinstance(system, Machine):
        # what varies has the name of a variable: it is that of the start
        starts = {name: f"start.{name}" for name in over.coords if name in variables}
        coords = {starts.get(name, name): of for name, of in over.coords.items()}
        return xr.Dataset(dict(variables), coords, {"title": title, **SOURCE})
    # what varies is in the coordinates
    own = {"system": system._file.json, **_si.attributes(system.units)}
    return xr.Dataset(dict(variables), _coordinates(over), {"Conventions": "CF-1.11", "title": title, **SOURCE, **own})


def _coordinates(over: Over) -> dict[str, Any]:
    """The coordinates: what varies over its dimensions, and all other parameters and coordinates of starts as scalars."""
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
