"""Export of stores: NetCDF with all arrays, and Parquet and CSV with the table of the command."""

import contextlib
import os
import sys
from collections.abc import Callable
from importlib.util import find_spec
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact import _core, _si, _store
from vibroimpact._datasets import shown_path

if TYPE_CHECKING:
    import xarray as xr

#: Engines of xarray that write NetCDF, and the modules that each needs. The last one writes only the older format.
_ENGINES = {"netcdf4": ("netCDF4",), "h5netcdf": ("h5netcdf", "h5py"), "scipy": ("scipy",)}
#: Attributes of the study that are stored with a table.
_TOLD = ("title", "source", "plan", "plan_hash")
#: Columns of words of an orbit diagram, where the Dataset has codes.
_WORDS = ("sweep", "kind", "stop")
#: Columns of numbers of an orbit diagram whose variables have other names, by what it shows.
_NUMBERS = {"velocity": {"phase": "impact_phase", "speed": "velocity"}, "speed": {"phase": "closing_phase"}}


def export(store: str | PathLike[str], path: str | PathLike[str], form: str) -> None:
    """Write a store to a file in the format "netcdf", "parquet" or "csv". An incomplete file is never left behind."""
    writers: dict[str, Callable[[str, Path], None]] = {"netcdf": _netcdf, "parquet": _parquet, "csv": _csv}
    if form not in writers:
        raise _core.QuestionError(f"format = `{form}` is none of {', '.join(writers)}")
    if fspath(path) == "-":
        raise _core.QuestionError("a store is not exported to stdout here\nhint: `vibro export STORE --csv -` prints the table")
    # a store that is not there is refused first
    _core.Store(fspath(store))
    place = Path(fspath(path))
    if not place.parent.is_dir():
        raise FileNotFoundError(f"there is no folder {place.parent} to write {place.name} to")
    part = place.with_name(f".{place.name}.{os.getpid()}.part")
    try:
        writers[form](fspath(store), part)
        part.replace(place)
    finally:
        with contextlib.suppress(FileNotFoundError):
            part.unlink()


def _netcdf(store: str, path: Path) -> None:
    engine: Any = next((name for name, modules in _ENGINES.items() if all(map(find_spec, modules))), None)
    if engine is None:
        raise ImportError(
            "writing NetCDF needs netCDF4, h5netcdf or scipy, and none of them is installed\n"
            "hint: pip install netCDF4, or pip install h5netcdf h5py"
        )
    # chunks and compressors are those of Zarr; other formats do not support them
    ds = _store.with_status(store).drop_encoding()
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
    ds.to_netcdf(path, engine=engine)


def _csv(store: str, path: Path) -> None:
    """The table of the command."""
    if _core.vibro(["vibro", "export", store, "--csv", str(path), "--quiet"], sys.executable) != 0:
        raise OSError(f"the table of {store} was not written")


def _parquet(store: str, path: Path) -> None:
    if not find_spec("pyarrow"):
        raise ImportError("writing Parquet needs pyarrow, which is not installed\nhint: pip install pyarrow")
    import pyarrow as pa
    import pyarrow.csv
    import pyarrow.parquet as pq

    # one value of each variable describes it
    ds, rows = _store.with_status(store), path.with_suffix(".csv")
    ds = ds.isel({name: slice(0, 1) for name in ds.dims})
    if _si.LENGTH in ds.attrs:
        ds = _si.converted(ds, None)
    told = {name: str(ds.attrs[name]) for name in _TOLD if name in ds.attrs}
    try:
        _csv(store, rows)
        with rows.open() as file:
            columns = file.readline().rstrip("\n").split(",")
        known = {name: _attributes(ds, name) for name in columns}
        kinds = {name: {"U": pa.string(), "i": pa.int64(), "f": pa.float64()}[kind] for name, (kind, _) in known.items()}
        options = pyarrow.csv.ConvertOptions(column_types=kinds, strings_can_be_null=True)
        whole = pyarrow.csv.read_csv(rows, convert_options=options)
    finally:
        rows.unlink(missing_ok=True)
    fields = [field.with_metadata(known[field.name][1]) for field in whole.schema]
    pq.write_table(whole.cast(pa.schema(fields, metadata=told)), path)


def _attributes(ds: "xr.Dataset", column: str) -> tuple[str, dict[str, str]]:
    """The kind of the values of a column, words ("U"), whole numbers or numbers, and what describes its variable."""
    diagram = "point" in ds.dims
    if diagram and column in _WORDS:
        return "U", {}
    if column in ("start", "direction", "sample"):
        return "i", {}
    shown = {} if not diagram or shown_path(ds) else next((names for name, names in _NUMBERS.items() if name in ds), {})
    # a column in SI units ends in its unit
    name = next((name for of, name in shown.items() if column.startswith(of)), column)
    names = [str(of) for of in ds.variables if name == of or name.startswith(f"{of}_")]
    if not names:
        return "f", {}
    of = ds[max(names, key=len)]
    said = {name: str(of.attrs[name]) for name in ("long_name", "units", "scale") if name in of.attrs}
    return "U" if of.name == "label" or of.dtype == np.int8 else of.dtype.kind, said
