"""Studies: over grids as xarray Datasets, in memory or in a store; and stores: run, resume, status, verify and open."""

import os
from dataclasses import dataclass
from importlib.util import find_spec
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, NamedTuple, SupportsIndex

from vibroimpact import _core
from vibroimpact._arguments import COUNT, SEED, Budget, Progress, part_of, seconds, threads_of, watched, whole
from vibroimpact._plan import Plan

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


def computed(
    plan: Plan, store: str | PathLike[str] | None, client: "Client | None", threads: SupportsIndex, progress: Progress,
) -> "xr.Dataset":
    """Compute the Dataset of a plan: in memory, or in a store by threads of this process or by the workers of a client."""
    threads = threads_of(threads)
    if store is None:
        if client is not None:
            raise _core.QuestionError(
                "a client needs a store\nhint: store=..., a place that all workers reach; results do not travel"
            )
        with watched(progress, "points") as tell:
            return _dataset(plan, *_core.fill(plan.json, threads, tell))
    # check before a long computation that its result can be read
    need_readers(fspath(store))
    if client is None:
        run(plan, store, threads=threads, progress=progress)
    else:
        from vibroimpact import dask

        dask.run(plan, store, client, progress=progress)
    return open(store)


def _dataset(plan: Plan, coordinates: list[dict[str, Any]], variables: list[dict[str, Any]]) -> "xr.Dataset":
    import xarray as xr

    from vibroimpact import _accessor, _si  # the import of _accessor registers ds.vibro
    from vibroimpact._stated import SOURCE, variable, with_fixed

    ds = xr.Dataset(
        {of["name"]: variable(of) for of in variables},
        {of["name"]: variable(of) for of in coordinates},
        {
            "Conventions": "CF-1.11", "title": plan.title, **SOURCE, "plan": plan.json, "plan_hash": plan.hash, **_si.of_plan(plan.json),
        },
    )
    return with_fixed(ds)


class Ran(NamedTuple):
    """The result of a run, as numbers of tiles."""

    #: Tiles that this run computed.
    computed: int
    #: Tiles that were complete before, or were completed by another process meanwhile.
    found: int
    #: Complete tiles that were damaged and have been computed again.
    mended: int
    #: Tiles of the whole study that are not complete yet: those of other parts, and those for which there was no time.
    left: int


@dataclass(frozen=True, slots=True)
class Status:
    """The progress of a store."""

    #: Total number of tiles, and number of complete tiles.
    tiles: int
    done: int
    #: Total number of points, and number of points of complete tiles.
    points: int
    points_done: int
    #: Whether the store is complete, including its final tables.
    complete: bool
    #: Points per second at the rate of the last tiles, or None.
    points_per_second: float | None
    #: Estimated time for the remaining tiles, at the rate of the last ones, or None.
    seconds_left: float | None
    #: Points of a tile along each dimension.
    tile: dict[str, int]
    #: Points of a shard along each dimension, or None for a store without shards.
    shard: dict[str, int] | None
    #: Processor time of each tile, as far as it was recorded beside the store, under its name with ".costs".
    seconds_of_tiles: dict[int, float]
    #: Numbers of the tiles that are not complete, at most a thousand.
    missing: list[int]
    #: Number of further tiles that are not complete.
    missing_left_out: int
    #: Size of the store in bytes.
    bytes: int

    @property
    def progress(self) -> float:
        """Points done over points, 0 to 1."""
        return self.points_done / self.points if self.points else 0.0


@dataclass(frozen=True, slots=True)
class Verified:
    """The result of a verification."""

    #: Number of tiles whose checksums were verified.
    checked: int
    #: Number of tiles that were computed again and compared byte by byte.
    recomputed: int
    #: Number of tiles that are not complete.
    open: int
    #: Each fault: the number of the tile (None for the whole store) and a description.
    damage: list[tuple[int | None, str]]

    @property
    def whole(self) -> bool:
        """Whether the store is complete and has no faults."""
        return not self.damage and self.open == 0


def run(
    plan: Plan, store: str | PathLike[str], *, part: tuple[int, int] = (1, 1), threads: int = 0,
    progress: Progress = None, budget: Budget | None = None,
) -> Ran:
    """Fill the store of a plan. Tiles that it already contains are not computed again.

    Any number of processes may work on one store; the bytes of the result are always the same. If a run is stopped or
    killed, the same call, or `resume`, completes the store.

    Parameters
    ----------
    plan : Plan
        The study.
    store : path
        A folder for this store alone, created if absent; or "s3://BUCKET/PREFIX" if the package was built with the feature `s3`.
    part : (int, int)
        (i, n): compute only every n-th tile, beginning with tile i; i from 1 to n. For job arrays.
    threads : int
        Number of threads; 0 for one per core.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.
    budget : float or str
        Seconds, or a text such as "30m", "8h" or "2d", after which no tile is begun. Tiles that were begun are finished, so the
        run gets on by at least one. `left` says how many tiles are missing; the same call goes on.

    Examples
    --------
    >>> import tempfile
    >>> from vibroimpact import Oscillator, Plan, run, open, verify
    >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> plan = Plan.basin(osc, {"x": "-4:0.75:60", "v": "-4:4:50"}, tile=20)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ran = run(plan, folder + "/basin.zarr")
    ...     whole = verify(folder + "/basin.zarr").whole
    ...     labels = set(open(folder + "/basin.zarr").vibro.labels().values.ravel().tolist())
    >>> ran.computed, whole, sorted(labels)
    (9, True, ['1/1', '2/1'])
    """
    return _filled(fspath(store), plan.json, part_of(part), threads_of(threads), progress, budget)


def resume(
    store: str | PathLike[str], *, threads: int = 0, progress: Progress = None, budget: Budget | None = None
) -> Ran:
    """Compute the missing and damaged tiles of a store; `budget` is that of `run`.

    Examples
    --------
    >>> from vibroimpact import resume
    >>> resume("no/such/place")
    Traceback (most recent call last):
        ...
    vibroimpact.StoreError: there is no store at no/such/place
    hint: `run(plan, store)` begins one
    """
    return _filled(fspath(store), None, (1, 1), threads_of(threads), progress, budget)


def _filled(place: str, plan: str | None, part: tuple[int, int], threads: int, progress: Progress, budget: Budget | None) -> Ran:
    """Compute the tiles that a store lacks."""
    time = None if budget is None else seconds("budget", budget)
    with watched(progress, "points") as tell:
        return Ran(*_core.Store(place, plan).run(part, threads, tell, time))


def status(store: str | PathLike[str]) -> Status:
    """The progress of a store: the complete and missing tiles, and the estimated time for the rest.

    Examples
    --------
    >>> import tempfile
    >>> from vibroimpact import Oscillator, Plan, run, status
    >>> plan = Plan.attractors(Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), 300, tile=100)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ran = run(plan, folder + "/shares.zarr", part=(1, 3))
    ...     far = status(folder + "/shares.zarr")
    >>> far.done, far.tiles, far.missing, far.complete
    (1, 3, [1, 2], False)
    """
    far = _core.Store(fspath(store)).status()
    shard = far["shard"]
    return Status(**{**far, "tile": dict(far["tile"]), "shard": None if shard is None else dict(shard)})


def verify(
    store: str | PathLike[str], *, sample: int = 4, seed: int = 1, threads: int = 0, progress: Progress = None
) -> Verified:
    """Compare the metadata of a store with its plan, verify the checksums of all tiles, and compute a sample of tiles again.

    The store is not changed. `resume` computes damaged tiles again.

    Parameters
    ----------
    store : path
        The store.
    sample, seed : int
        Number of tiles to compute again, and the seed of their choice.
    threads : int
        Number of threads; 0 for one per core.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Examples
    --------
    >>> import tempfile
    >>> from vibroimpact import Oscillator, Plan, run, verify
    >>> plan = Plan.attractors(Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), 300, tile=100)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ran = run(plan, folder + "/shares.zarr")
    ...     found = verify(folder + "/shares.zarr", sample=2)
    >>> found.checked, found.recomputed, found.damage
    (3, 2, [])
    """
    sample, seed = whole("sample", sample, COUNT), whole("seed", seed, SEED)
    threads = threads_of(threads)
    with watched(progress, "points") as tell:
        return Verified(**_core.Store(fspath(store)).verify(sample, seed, threads, tell))


def open(store: str | PathLike[str]) -> "xr.Dataset":
    """Open a store as a Dataset. Values are read when they are used; `ds.vibro` draws figures.

    Parameters that do not vary are scalar coordinates, so that they stay with the data when Datasets are joined.
    `xarray.open_zarr(store)` opens a store too, but without these coordinates; they are then only in the attribute `plan`,
    and figures do not state them. Stores in buckets are read by s3fs.

    Examples
    --------
    >>> import tempfile
    >>> from vibroimpact import Oscillator, Plan, open, run
    >>> plan = Plan.attractors(Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), 300)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ran = run(plan, folder + "/shares.zarr")
    ...     ds = open(folder + "/shares.zarr").load()
    >>> ds["cycle_label"].values.tolist()
    ['2/1', '1/1']
    """
    # which tiles are done is told by `status(store)`, and its dimensions would multiply the rows of a table
    ds: xr.Dataset = with_status(store).drop_vars("status", errors="ignore")
    return ds


def with_status(store: str | PathLike[str]) -> "xr.Dataset":
    """A store as a Dataset, with the variable `status` over its tiles."""
    import xarray as xr

    from vibroimpact import _accessor, _si  # the import of _accessor registers ds.vibro
    from vibroimpact._stated import with_fixed, written

    place = fspath(store)
    _core.Store(place)
    need_readers(place)
    ds: xr.Dataset = xr.open_zarr(place, storage_options=_bucket() if place.startswith("s3://") else None)
    for variable in ds.variables.values():
        if "units" in variable.attrs:
            variable.attrs["units"] = written(str(variable.attrs["units"]))
    ds.attrs |= _si.of_plan(ds.attrs["plan"])
    return with_fixed(ds)


def _bucket() -> dict[str, Any]:
    """What s3fs does not read in the environment for itself."""
    region = os.environ.get("AWS_REGION")
    return {"client_kwargs": {"region_name": region}} if region else {}


def need_readers(place: str) -> None:
    """Raise ImportError if zarr 3 (for version 3 of the format), or s3fs for a bucket, is not installed."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        found = version("zarr")
    except PackageNotFoundError:
        found = ""
    if int(found.partition(".")[0] or 0) < 3:
        here = f"zarr {found} is" if found else "no zarr is"
        raise ImportError(
            f"reading a store as a Dataset needs zarr 3 or later, and {here} installed\n"
            "hint: pip install 'zarr>=3', which needs Python 3.11; `vibro export STORE --csv FILE` reads the store without it"
        )
    if place.startswith("s3://") and not find_spec("s3fs"):
        raise ImportError(
            "reading a store in a bucket as a Dataset needs s3fs, which is not installed\n"
            "hint: pip install s3fs; runs, `status` and `verify` do without it"
        )
