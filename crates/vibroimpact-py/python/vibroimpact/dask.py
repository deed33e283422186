"""Studies on the workers of a Dask cluster, on this machine or in a batch system with dask-jobqueue.

A task is one tile. A worker computes it, writes it to the store and returns its number, so results do not pass through
the scheduler. If a worker dies, its tiles are computed by others, and the store has the same bytes.

>>> import tempfile
>>> import vibroimpact as vi
>>> from distributed import Client
>>> from vibroimpact import dask
>>> plan = vi.Plan.basin(vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), {"x": "-4:0.75:60"}, v=0.5, tile=20)
>>> with tempfile.TemporaryDirectory() as folder, Client(processes=False, dashboard_address=":0") as client:
...     ran = dask.run(plan, folder + "/basin.zarr", client)
>>> ran.computed, ran.left
(3, 0)
"""

from functools import lru_cache
from os import PathLike, fspath
from typing import TYPE_CHECKING
from uuid import uuid4

from vibroimpact import _core
from vibroimpact._plan import Plan
from vibroimpact._progress import Progress, watched
from vibroimpact._store import Ran
from vibroimpact._whole import COUNT, whole

if TYPE_CHECKING:
    from distributed import Client


@lru_cache(maxsize=4)
def _opened(place: str, plan: str) -> _core.Store:
    """The store, opened once in each worker, so that the survey of the system is computed only once there."""
    return _core.Store(place, plan)


def _tile(tile: int, place: str, plan: str) -> tuple[int, bool]:
    """Compute a tile on a worker. Returns its number and whether it had to be computed."""
    computed, _, _, _ = _opened(place, plan).run_tiles([tile], 1)
    return tile, computed == 1


def run(
    plan: Plan,
    store: str | PathLike[str],
    client: "Client",
    *,
    retries: int = 3,
    progress: Progress = None,
) -> Ran:
    """Fill the store of a plan by the workers of a client. Tiles that it already contains are not computed again.

    Parameters
    ----------
    plan : Plan
        The study.
    store : path
        A path or URL under which the workers and this process can access the store.
    client : distributed.Client
        The cluster.
    retries : int
        Number of times that a failed tile is tried again.
    progress : bool or callable
        True for a progress bar, or a function called with the numbers of points done and in total; it stops the run by returning False.
    """
    from distributed import as_completed

    retries = whole("retries", retries, COUNT)
    place = fspath(store)
    here = _core.Store(place, plan.json)
    computed = 0
    begun = here.status()
    with watched(progress, "points") as tell:
        far, done = begun, begun["points_done"]
        each = begun["points"] / max(begun["tiles"], 1)
        # `missing` lists at most a thousand tiles, so the scheduler never holds all tiles of a large study
        while far["missing"]:
            turn = uuid4().hex[:8]
            keys = [f"vibroimpact-tile-{plan.hash}-{turn}-{tile}" for tile in far["missing"]]
            tasks = client.map(_tile, far["missing"], place=place, plan=plan.json, retries=retries, key=keys)
            try:
                for _, (_, new) in as_completed(tasks, with_results=True):  # type: ignore[no-untyped-call]
                    computed += new
                    done = min(done + each, begun["points"] - 1)
                    if tell is not None and tell(int(done), begun["points"]) is False:
                        raise _core.StoppedError(f"stopped after {int(done)} of {begun['points']} points")
            finally:
                client.cancel(tasks)  # type: ignore[no-untyped-call]
            before, far = far, here.status()
            if far["missing"] == before["missing"]:
                raise _core.StoreError(
                    f"the workers say that they filled tiles of {place}, and none of them is there\n"
                    "hint: workers and this process have to reach the store by the same name"
                )
        if tell is not None:
            tell(begun["points"], begun["points"])
    here.conclude()
    far = here.status()
    return Ran(computed, far["done"] - computed, 0, far["tiles"] - far["done"])
