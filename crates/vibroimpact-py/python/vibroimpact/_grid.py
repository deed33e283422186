"""Studies over grids as xarray Datasets, in memory or in a store."""

from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact import _core
from vibroimpact._oscillator import Units
from vibroimpact._plan import Plan
from vibroimpact._progress import Progress, watched
from vibroimpact._whole import threads_of

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


def computed(
    plan: Plan,
    units: Units | None,
    store: str | PathLike[str] | None,
    client: "Client | None",
    threads: int,
    progress: Progress,
) -> "xr.Dataset":
    """Compute the Dataset of a plan: in memory, or in a store by threads of this process or by the workers of a client."""
    from vibroimpact import _store

    threads = threads_of(threads)
    if store is None:
        if client is not None:
            raise _core.QuestionError(
                "a client needs a store\nhint: store=..., a place that all workers reach; results do not travel"
            )
        with watched(progress, "points") as tell:
            return _dataset(plan, units, *_core.fill(plan.json, threads, tell))
    # check before a long computation that its result can be read
    _store.need_readers(fspath(store))
    if client is None:
        _store.run(plan, store, threads=threads, progress=progress)
    else:
        from vibroimpact import dask

        dask.run(plan, store, client, progress=progress)
    return _store.open(store)


def _dataset(
    plan: Plan, units: Units | None, coordinates: list[dict[str, Any]], variables: list[dict[str, Any]]
) -> "xr.Dataset":
    import xarray as xr

    from vibroimpact import _accessor, _si  # the import of _accessor registers ds.vibro
    from vibroimpact._stated import with_fixed
    from vibroimpact._unit_names import attributes_of

    def variable(of: dict[str, Any]) -> tuple[list[str], Any, dict[str, Any]]:
        shape = [length for _, length in of["dimensions"]]
        values = of["values"]
        array = np.array(values, dtype=object) if isinstance(values, list) else values.reshape(shape)
        return [name for name, _ in of["dimensions"]], array, attributes_of(of)

    ds = xr.Dataset(
        {of["name"]: variable(of) for of in variables},
        {of["name"]: variable(of) for of in coordinates},
        {
            "Conventions": "CF-1.11",
            "title": plan.title,
            "source": f"vibroimpact {_core.__version__}",
            "history": f"computed by vibroimpact {_core.__version__}",
            "plan": plan.json,
            "plan_hash": plan.hash,
            **_si.attributes(units),
        },
    )
    return with_fixed(ds)
