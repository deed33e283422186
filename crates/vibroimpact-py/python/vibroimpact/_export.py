"""Export of stores: NetCDF with all arrays, or Parquet and CSV with a row for each point, or each point and motion."""

import contextlib
import os
from collections.abc import Callable
from importlib.util import find_spec
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact import _core, _points, _store

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Engines of xarray that write NetCDF, and the modules that each needs. The last one writes only the older format.
_ENGINES = {"netcdf4": ("netCDF4",), "h5netcdf": ("h5netcdf", "h5py"), "scipy": ("scipy",)}
#: Attributes of the study that are stored with a table.
_TOLD = ("title", "source", "plan", "plan_hash")


def export(store: str | PathLike[str], path: str | PathLike[str], form: str) -> None:
    """Write a store to a file in the format "netcdf", "parquet" or "csv". An incomplete file is never left behind."""
    writers: dict[str, Callable[[xr.Dataset, Path], None]] = {"netcdf": _netcdf, "parquet": _parquet, "csv": _csv}
    if form not in writers:
        raise _core.QuestionError(f"format = `{form}` is none of {', '.join(writers)}")
    if fspath(path) == "-":
        raise _core.QuestionError("a store is not exported to stdout here\nhint: `vibro export STORE --csv -` prints the table")
    ds = _store.with_status(store)
    place = Path(fspath(path))
    if not place.parent.is_dir():
        raise FileNotFoundError(f"there is no folder {place.parent} to write {place.name} to")
    part = place.with_name(f".{place.name}.{os.getpid()}.part")
    try:
        writers[form](ds, part)
        part.replace(place)
    finally:
        with contextlib.suppress(FileNotFoundError):
            part.unlink()


def _netcdf(ds: "xr.Dataset", path: Path) -> None:
    engine = next((name for name, modules in _ENGINES.items() if all(map(find_spec, modules))), None)
    if engine is None:
        raise ImportError(
            "writing NetCDF needs netCDF4, h5netcdf or scipy, and none of them is installed\n"
            "hint: pip install netCDF4, or pip install h5netcdf h5py"
        )
    # chunks and compressors are those of Zarr; other formats do not support them
    ds = ds.drop_encoding()
    for of in ds.variables.values():
        if of.dtype.kind in "TU":
            # text as objects, which all engines support
            of.data = of.values.astype(object)
        else:
            # without a fill value, readers mask nothing and integers stay integers
            of.encoding["_FillValue"] = None
        if "flag_values" in of.attrs:
            # CF requires the type of the variable
            of.attrs["flag_values"] = np.asarray(of.attrs["flag_values"], dtype=of.dtype)
    ds.to_netcdf(path, engine=engine)  # type: ignore[call-overload]


def table(ds: "xr.Dataset") -> "pd.DataFrame":
    """A table with a row for each point, or each point and motion: the coordinates, then all fields, with codes as texts.

    The dimension of the abscissa comes first and varies fastest. Missing values are empty. Columns and rows are those of
    `vibro export --csv`.
    """
    if "point" in ds.dims:
        return _points.table(ds)
    import pandas as pd

    along = [str(name).removeprefix("tile_") for name in ds["status"].dims]
    names = [str(name) for name, of in ds.data_vars.items() if of.dims[: len(along)] == tuple(along)]
    extra = next((str(ds[name].dims[-1]) for name in names if ds[name].ndim > len(along)), None)
    shape = [ds.sizes[name] for name in along]
    points, width = int(np.prod(shape)), ds.sizes[extra] if extra else 1
    columns: dict[str, Any] = {}
    places = np.unravel_index(np.arange(points), shape)
    for k, name in reversed(list(enumerate(along))):
        # scattered starts are numbered; their positions are fields
        values = ds[name].values if name in ds.coords else np.arange(1, shape[k] + 1)
        columns[name] = np.repeat(values[places[k]], width)
    for key, of in ds.coords.items():
        # points have several coordinates along one dimension
        if of.ndim == 1 and key not in along and str(of.dims[0]) in along:
            columns[str(key)] = np.repeat(of.values[places[along.index(str(of.dims[0]))]], width)
    if extra == "direction":
        columns[extra] = np.tile(np.arange(1, width + 1), points)
    keep = np.zeros((points, width), dtype=bool)
    keep[:, 0] = True
    for name in names:
        words = _words(ds, name)
        wide = ds[name].ndim > len(along)
        column = pd.Series(words.reshape(-1) if wide else np.repeat(words.reshape(-1), width))
        if ds[name].dtype.kind == "i" and words.dtype.kind == "i":
            column = column.astype("Int64").mask(column < 0)
        columns[name] = column
        if wide:
            keep |= column.notna().to_numpy().reshape(points, width)
    rows: pd.DataFrame = pd.DataFrame(columns).loc[keep.reshape(-1)].reset_index(drop=True)
    return rows


def _words(ds: "xr.Dataset", name: str) -> Any:
    """The values of a field. Labels and flags are converted to texts, or None where there is no value."""
    of = ds[name]
    if name != "label" and of.dtype != np.int8:
        return of.values
    words = ds.vibro.labels(name).values.astype(object)
    words[words == ""] = None
    return words


def _parquet(ds: "xr.Dataset", path: Path) -> None:
    if not find_spec("pyarrow"):
        raise ImportError(
            "writing Parquet needs pyarrow, which is not installed\n"
            "hint: pip install pyarrow"
        )
    import pyarrow as pa
    import pyarrow.parquet as pq

    whole = pa.Table.from_pandas(table(ds), preserve_index=False)
    told = {name: str(ds.attrs[name]) for name in _TOLD if name in ds.attrs}
    # the text columns of an orbit diagram do not belong to one variable each
    shown = _points.shown(ds) if "point" in ds.dims else {name: str(name) for name in ds.variables}
    fields = []
    for field in whole.schema:
        attributes = ds[shown[field.name]].attrs if field.name in shown else {}
        said = {name: str(attributes[name]) for name in ("long_name", "units", "scale") if name in attributes}
        fields.append(field.with_metadata(said))
    schema = pa.schema(fields, metadata={**(whole.schema.metadata or {}), **told})
    pq.write_table(whole.cast(schema), path)


def _csv(ds: "xr.Dataset", path: Path) -> None:
    table(ds).to_csv(path, index=False, lineterminator="\n")
