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

import time
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from contextlib import closing
from functools import lru_cache
from itertools import islice
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, TypeVar
from uuid import uuid4

from vibroimpact import _core
from vibroimpact._arguments import AHEAD, Budget, COUNT, Progress, outside, seconds, watched, whole
from vibroimpact._plan import Plan
from vibroimpact._store import Ran

if TYPE_CHECKING:
    from distributed import Client

T = TypeVar("T")


@lru_cache(maxsize=4)
def _opened(place: str, plan: str) -> _core.Store:
    """The store, opened once in each worker, so that the survey of the system is computed only once there."""
    return _core.Store(place, plan)


def _tile(tile: int, points: int, place: str, plan: str) -> tuple[int, int, int]:
    """Compute a tile on a worker. Returns its points, and whether it had to be computed and was damaged."""
    computed, _, mended, _ = _opened(place, plan).run_tiles([tile], 1)
    return points, computed, mended


def run(
    plan: Plan, store: str | PathLike[str], client: "Client", *, retries: int = 3, progress: Progress = None,
    budget: Budget | None = None, in_flight: int = 1000, resources: Mapping[str, float] | None = None,
    workers: Sequence[str] | None = None, priority: int = 0,
) -> Ran:
    """Fill the store of a plan by the workers of a client. Tiles that it already contains are not computed again; damaged ones are.

    Tasks are submitted one after another as others end, from coarse to fine, so the scheduler never has more than `in_flight` of them.

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
    budget : float or str
        Seconds, or a text such as "8h", after which no further tiles are computed; `left` says how many are missing.
    in_flight : int
        Largest number of tiles that wait or are computed at the same time; more than the cluster has threads.
    resources, workers, priority
        Which workers may compute the tiles, and before what else: as for `client.submit`.
    """
    retries, in_flight = whole("retries", retries, COUNT), whole("in_flight", in_flight, AHEAD)
    if in_flight < 1:
        raise outside("in_flight", in_flight, 1, None, "more than the cluster has threads")
    end = None if budget is None else time.monotonic() + seconds("budget", budget)
    place = fspath(store)
    here = _core.Store(place, plan.json)
    begun = here.status()
    computed = mended = 0
    how: dict[str, Any] = {"retries": retries, "priority": priority}
    how |= {name: given for name, given in (("resources", resources), ("workers", workers)) if given is not None}
    with watched(progress, "points") as tell:
        todo, _ = here.to_do()
        spent = False
        while todo and not spent:
            done = begun["points"] - sum(points for _, points in todo)
            turn, before = uuid4().hex[:8], len(todo)
            tasks = ((f"vibroimpact-tile-{plan.hash}-{turn}-{tile}", (tile, points, place, plan.json)) for tile, points in todo)
            with closing(_rolling(client, _tile, tasks, in_flight, how)) as batches:
                for batch in batches:
                    for points, new, was_damaged in batch:
                        computed, mended, done = computed + new, mended + was_damaged, done + points
                    if tell is not None and tell(min(done, begun["points"] - 1), begun["points"]) is False:
                        raise _core.StoppedError(f"stopped after {done} of {begun['points']} points")
                    spent = end is not None and time.monotonic() >= end
                    if spent:
                        break
            if not spent:
                todo, _ = here.to_do()
                if len(todo) == before:
                    raise _core.StoreError(
                        f"the workers say that they filled tiles of {place}, and none of them is there\n"
                        "hint: workers and this process have to reach the store by the same name"
                    )
        if tell is not None and not spent:
            tell(begun["points"], begun["points"])
    here.conclude()
    far = here.status()
    return Ran(computed, max(far["done"] - computed, 0), mended, far["tiles"] - far["done"])


def _rolling(
    client: "Client", work: Callable[..., T], tasks: Iterable[tuple[str, tuple[Any, ...]]], in_flight: int,
    how: Mapping[str, Any],
) -> Generator[list[T], None, None]:
    """The results of `work` for the arguments of each task, which has a key, in batches as they come.

    At most `in_flight` tasks are with the scheduler; `how` are further arguments of `client.submit`. Tasks that are still there when
    the iterator is closed are cancelled.
    """
    from distributed import as_completed

    queue, running = iter(tasks), dict[str, Any]()

    def submit(count: int) -> list[Any]:
        new = {key: client.submit(work, *of, key=key, **how) for key, of in islice(queue, count)}
        running.update(new)
        return list(new.values())

    ended = as_completed(submit(in_flight), with_results=True)
    try:
        for batch in ended.batches():
            for task, _ in batch:
                running.pop(task.key, None)
            yield [result for _, result in batch]
            ended.update(submit(in_flight - len(running)))
    finally:
        client.cancel(list(running.values()))
