"""Datasets of many motions: their attributes, coordinates and dimensions."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._over import POINT, MachineOver, Over

if TYPE_CHECKING:
    import xarray as xr


def dataset(over: Over, title: str, variables: Mapping[str, Any]) -> "xr.Dataset":
    """The Dataset of results at points, with parameters and starts as coordinates."""
    import xarray as xr

    from vibroimpact import _accessor, _si  # the import of _accessor registers ds.vibro

    ds = xr.Dataset(
        dict(variables),
        coords=_coordinates(over),
        attrs={
            "Conventions": "CF-1.11",
            "title": title,
            "source": f"vibroimpact {_core.__version__}",
            "history": f"computed by vibroimpact {_core.__version__}",
            # what varies is in the coordinates
            "system": over.osc._file.json,
            **_si.attributes(over.osc.units),
        },
    )
    return ds


def _coordinates(over: Over) -> dict[str, Any]:
    """The coordinates: what varies over its dimensions, and all other parameters and coordinates of starts as scalars."""
    from vibroimpact._unit_names import described

    varied = [name for name, _ in over.columns if name in over.coords]
    known = {name: (value, described(*words)) for name, value, *words in _core.point_coordinates(over.osc._file, over.start)}
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


def over_points(over: Over | MachineOver, values: NDArray[Any], further: Sequence[tuple[str, int]] = ()) -> tuple[list[str], NDArray[Any]]:
    """The dimensions of a variable, and its flat values in their shape."""
    names = [*over.sizes, *(name for name, _ in further)]
    return names, values.reshape([*over.sizes.values(), *(size for _, size in further)])


def in_shape(ds: "xr.Dataset", over: MachineOver) -> "xr.Dataset":
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
