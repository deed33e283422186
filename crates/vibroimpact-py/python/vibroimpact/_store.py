"""Studies in stores: run, resumed, looked at, verified, opened."""

import os
from dataclasses import dataclass
from importlib.util import find_spec
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, NamedTuple

from vibroimpact import _core, _whole
from vibroimpact._plan import Plan
from vibroimpact._progress import Progress, watched
from vibroimpact._whole import COUNT, SEED, THREADS, whole

if TYPE_CHECKING:
    import xarray as xr


class Ran(NamedTuple):
    """What a run did, in tiles."""

    #: Computed now.
    computed: int
    #: Done before, or by another process meanwhile.
    found: int
    #: Finished, damaged, and computed anew.
    mended: int
    #: Of the whole, not done yet.
    left: int


@dataclass(frozen=True, slots=True)
class Status:
    """How far a store is."""

    #: Tiles in all, and those that are done.
    tiles: int
    done: int
    #: Points in all, and those of the tiles that are done.
    points: int
    points_done: int
    #: Whether it was concluded.
    complete: bool
    #: How long the rest takes at the rate of the last tiles, or None.
    seconds_left: float | None
    #: Numbers of the tiles that are not done, up to a thousand.
    missing: list[int]
    #: Tiles that are not done and not among these.
    missing_left_out: int
    #: Bytes of the store.
    bytes: int


@dataclass(frozen=True, slots=True)
class Verified:
    """What a verification found."""

    #: Tiles whose check sums were read.
    checked: int
    #: Tiles that were computed again and compared byte by byte.
    recomputed: int
    #: Tiles that are not done.
    open: int
    #: Number of a tile, None for what belongs to the whole store, and what is wrong with it.
    damage: list[tuple[int | None, str]]

    @property
    def whole(self) -> bool:
        """Whether nothing is wrong and nothing open."""
        return not self.damage and self.open == 0


def run(
    plan: Plan,
    store: str | PathLike[str],
    *,
    part: tuple[int, int] = (1, 1),
    threads: int = 0,
    progress: Progress = None,
) -> Ran:
    """Fill the store of a plan: what is there already is not computed again.

    Any number of processes may work on one store; it has the same bytes however it came about. Stopped or killed, it
    is finished by the same call, or by `resume`.

    Parameters
    ----------
    plan : Plan
        The study.
    store : path
        A folder of its own, begun where there is none; "s3://BUCKET/PREFIX" where the package was built with the feature `s3`.
    part : (int, int)
        (i, n): every n-th tile only, i from 1 to n, for job arrays.
    threads : int
        0 for one per core.
    progress : bool or callable
        True for a bar, or a function of what is done and what there is to do.

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
    part, threads = _whole.part(part), whole("threads", threads, THREADS)
    with watched(progress, "points") as tell:
        return Ran(*_core.Store(fspath(store), plan.json).run(part, threads, tell))


def resume(store: str | PathLike[str], *, threads: int = 0, progress: Progress = None) -> Ran:
    """Compute what is missing or damaged in a store.

    Examples
    --------
    >>> from vibroimpact import resume
    >>> resume("no/such/place")
    Traceback (most recent call last):
        ...
    vibroimpact.StoreError: there is no store at no/such/place
    hint: `vibro run PLAN --store no/such/place` begins one
    """
    threads = whole("threads", threads, THREADS)
    with watched(progress, "points") as tell:
        return Ran(*_core.Store(fspath(store)).run((1, 1), threads, tell))


def status(store: str | PathLike[str]) -> Status:
    """How far a store is: which tiles are done, how long the rest takes.

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
    return Status(**_core.Store(fspath(store)).status())


def verify(
    store: str | PathLike[str], *, sample: int = 4, seed: int = 1, threads: int = 0, progress: Progress = None
) -> Verified:
    """Compare all that describes a store with its plan, read the check sums of all tiles, and compute a sample of them again.

    Nothing is changed; `resume` writes anew what is damaged.

    Parameters
    ----------
    store : path
        The store.
    sample, seed : int
        How many tiles to compute again, and which.
    threads : int
        0 for one per core.
    progress : bool or callable
        True for a bar, or a function of what is done and what there is to do.

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
    threads = whole("threads", threads, THREADS)
    with watched(progress, "points") as tell:
        return Verified(**_core.Store(fspath(store)).verify(sample, seed, threads, tell))


def open(store: str | PathLike[str]) -> "xr.Dataset":
    """The Dataset of a store, read from it when it is looked at; `ds.vibro` draws it.

    Parameters that vary over none of its axes are scalar coordinates, so that they stay with the data where Datasets are joined.
    xarray opens a store without help too: `xarray.open_zarr(store)`, but without these; they are then in the attribute `plan` only,
    and figures do not state them. One in a bucket is read by s3fs.

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
    import xarray as xr

    from vibroimpact import _accessor  # noqa: F401  registers ds.vibro
    from vibroimpact._stated import with_fixed

    place = fspath(store)
    _core.Store(place)
    need_readers(place)
    ds: xr.Dataset = xr.open_zarr(place, storage_options=_bucket() if place.startswith("s3://") else None)
    return with_fixed(ds)


def _bucket() -> dict[str, Any]:
    """What s3fs does not read in the environment for itself."""
    region = os.environ.get("AWS_REGION")
    return {"client_kwargs": {"region_name": region}} if region else {}


def need_readers(place: str) -> None:
    """Says what is missing where there is no zarr that reads version 3 of the format, or nothing that reads a bucket."""
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
