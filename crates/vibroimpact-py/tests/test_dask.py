"""Tiles computed by real workers: any number of them, with some killed."""

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

import vibroimpact as vi

dask = pytest.importorskip("dask")
distributed = pytest.importorskip("distributed")

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def cluster() -> Iterator["distributed.LocalCluster"]:
    # after this time the cluster gives up a dead worker of this name, which may be a later victim,
    # and a dead worker is repeatedly asked for a result that it had
    settings = {"distributed.deploy.lost-worker-timeout": "1 hour", "distributed.comm.timeouts.connect": "2 s"}
    # workers are forked from a process that has imported what takes them two seconds
    settings["distributed.worker.multiprocessing-method"] = "forkserver"
    with dask.config.set(settings), distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster:
        yield cluster


@pytest.fixture
def client(cluster: "distributed.LocalCluster", workers: int) -> Iterator["distributed.Client"]:
    cluster.scale(workers)
    with distributed.Client(cluster) as client:
        client.wait_for_workers(workers, timeout=60)
        while len(cluster.scheduler.workers) > workers:
            time.sleep(0.01)
        yield client


@pytest.fixture
def workers() -> int:
    return 2


def contents(store: Path) -> dict[str, bytes]:
    return {str(file.relative_to(store)): file.read_bytes() for file in sorted(store.rglob("*")) if file.is_file()}


def test_workers_make_the_same_shards(client: "distributed.Client", s: vi.Oscillator, tmp_path: Path) -> None:
    plan = vi.Plan.map(s, {"inverse_beta": "1:1.5:11", "gap": "0:2:9"}, starts=4).with_tiles(tile=1, shard=4)
    vi.run(plan, tmp_path / "one.zarr")
    assert vi.dask.run(plan, tmp_path / "two.zarr", client).computed == 99
    assert contents(tmp_path / "two.zarr") == contents(tmp_path / "one.zarr")


def test_rounds_of_a_refined_study(client: "distributed.Client", s: vi.Oscillator, tmp_path: Path) -> None:
    over = {"inverse_beta": (1.1, 1.5), "gap": (0.5, 1.0)}
    here = vi.refine(s, over, tmp_path / "one", cells=4, rounds=1, impacts=500, tile=8)
    there = vi.refine(s, over, tmp_path / "two", cells=4, rounds=1, impacts=500, tile=8, client=client)
    assert there.load().identical(here.load())
    for number in range(2):
        name = f"round-{number}.zarr"
        assert contents(tmp_path / "two" / name) == contents(tmp_path / "one" / name) != {}


@pytest.mark.parametrize("workers", [1, 2, 4])
def test_workers_make_the_same_bytes(
    client: "distributed.Client", workers: int, s: vi.Oscillator, tmp_path: Path
) -> None:
    over = {"inverse_beta": "1:1.5:11", "gap": "0:2:9"}
    plan = vi.Plan.map(s, over, starts=16, tile=1)
    vi.run(plan, tmp_path / "one.zarr")
    seen: list[tuple[int, int]] = []
    ds = vi.region_map(
        s, over, starts=16, tile=1, store=tmp_path / "two.zarr", client=client, progress=lambda *of: seen.append(of)
    )
    assert contents(tmp_path / "two.zarr") == contents(tmp_path / "one.zarr")
    assert dict(ds["label"].sizes) == {"gap": 9, "inverse_beta": 11, "motion": 8} and seen[-1] == (99, 99)
    # all workers have computed tiles
    opened = client.run(lambda: vi.dask._opened.cache_info().currsize)
    assert len(opened) == workers and all(opened.values())
    # nothing is left to compute, and nothing is computed
    assert vi.dask.run(plan, tmp_path / "two.zarr", client) == vi.Ran(0, 99, 0, 0)


#: Kills of workers; the everyday run has fewer, because each run with five of them takes seven seconds.
KILLS = 20 if "VIBROIMPACT_LONG" in os.environ else 5
#: Of these in one run, one in each fifth of it.
A_RUN = 5


long = pytest.mark.skipif("VIBROIMPACT_LONG" not in os.environ, reason="half a minute; VIBROIMPACT_LONG=1 runs it")


@pytest.mark.parametrize("workers", [2])
@pytest.mark.parametrize("shard", [1, pytest.param(3, marks=long)])
def test_a_worker_may_be_killed_at_any_moment(
    cluster: "distributed.LocalCluster", client: "distributed.Client", u: vi.Oscillator, tmp_path: Path, shard: int
) -> None:
    """Many times `kill -9` of a worker that is computing a tile, at random moments over a whole run; with and without shards."""
    plan = vi.Plan.map(u, {"inverse_beta": "1.1:1.2:10", "gap": "2.5:3:10"}, starts=8).with_tiles(tile=1, shard=shard)
    vi.run(plan, tmp_path / "one.zarr")
    want = contents(tmp_path / "one.zarr")
    random = Random(1)
    killed: list[int] = []
    for number in range(3 * KILLS // A_RUN):
        place = tmp_path / f"{number}.zarr"
        over = threading.Event()
        moments = [random.uniform(k, k + 1) * 98 / A_RUN for k in range(A_RUN)]
        thread = threading.Thread(target=murder, args=(cluster, place, moments, random, over, killed))
        thread.start()
        try:
            ran = vi.dask.run(plan, place, client)
        finally:
            over.set()
            thread.join()
        assert ran.left == 0 and contents(place) == want, killed
        # early, late and in between; a kill that finds no tile at work does not count
        if len(killed) >= KILLS and {done // 20 for done in killed} == set(range(5)):
            return
        client.wait_for_workers(2, timeout=60)
    raise AssertionError(killed)


def murder(
    cluster: "distributed.LocalCluster", place: Path, moments: list[float], random: Random, over: threading.Event,
    killed: list[int],
) -> None:
    """Kill a worker at each of these moments, given as numbers of complete tiles. Late moments are left out."""
    gone: set[str] = set()
    for moment in moments:
        while not (place / "zarr.json").exists() or vi.status(place).done < int(moment):
            if over.wait(0.002):
                return
        # at some time within the next tile
        time.sleep(0.02 * (moment % 1))
        while not (victims := busy(cluster, gone)):
            if over.wait(0.002):
                return
        address, process = random.choice(victims)
        os.kill(process, signal.SIGKILL)
        gone.add(address)
        done = vi.status(place).done
        if done < 100:
            killed.append(done)


def busy(cluster: "distributed.LocalCluster", gone: set[str]) -> list[tuple[str, int]]:
    """Addresses and processes of the workers that compute tiles. The scheduler learns of a death some time later."""
    working = {address for address, of in list(cluster.scheduler.workers.items()) if of.processing} - gone
    nannies = [nanny for nanny in cluster.workers.values() if nanny.worker_address in working]
    return [(nanny.worker_address, nanny.pid) for nanny in nannies if nanny.pid]


def test_tasks_are_submitted_as_others_end(
    cluster: "distributed.LocalCluster", client: "distributed.Client", s: vi.Oscillator, tmp_path: Path
) -> None:
    plan = vi.Plan.basin(s, {"x": "-4:0.75:60", "v": "-4:4:50"}).with_tiles(tile=10, shard=2)
    vi.run(plan, tmp_path / "one.zarr")
    most = 0

    def look(done: int, total: int) -> None:
        nonlocal most
        most = max(most, sum(key.startswith("vibroimpact-tile") for key in list(cluster.scheduler.tasks)))

    ran = vi.dask.run(plan, tmp_path / "two.zarr", client, in_flight=4, progress=look, priority=1)
    assert ran == vi.Ran(30, 0, 0, 0) and 0 < most <= 8
    assert contents(tmp_path / "two.zarr") == contents(tmp_path / "one.zarr")
    # a budget that is spent, and the rest
    assert vi.dask.run(plan, tmp_path / "three.zarr", client, in_flight=2, budget=1e-6).left > 0
    # damaged tiles are computed again
    for name in ("label/c/0/0", "cycle/c/1/1"):
        shard = tmp_path / "two.zarr" / name
        shard.write_bytes(shard.read_bytes()[:-5])
    ran = vi.dask.run(plan, tmp_path / "two.zarr", client)
    assert ran.mended == ran.computed == 8 and contents(tmp_path / "two.zarr") == contents(tmp_path / "one.zarr")
    # workers without the resource compute nothing
    nobody = vi.dask.run(plan, tmp_path / "two.zarr", client, resources={"GPU": 1})
    assert nobody.computed == 0 and vi.dask.run(plan, tmp_path / "three.zarr", client).left == 0
    with pytest.raises(vi.QuestionError, match="in_flight"):
        vi.dask.run(plan, tmp_path / "two.zarr", client, in_flight=0)


def test_stopped_by_its_callback(client: "distributed.Client", u: vi.Oscillator, tmp_path: Path) -> None:
    plan = vi.Plan.basin(u, {"x": "-4:3:80", "v": "-4:4:80"}, tile=8)
    with pytest.raises(vi.StoppedError, match="stopped after"):
        vi.dask.run(plan, tmp_path / "some.zarr", client, progress=lambda done, total: done < 500)
    assert 0 < vi.status(tmp_path / "some.zarr").done < 100


def test_a_store_of_another_plan(client: "distributed.Client", s: vi.Oscillator, tmp_path: Path) -> None:
    vi.run(vi.Plan.basin(s, {"x": "-4:0.75:9"}), tmp_path / "one.zarr")
    with pytest.raises(vi.StoreError, match="holds another plan"):
        vi.dask.run(vi.Plan.basin(s, {"x": "-4:0.75:8"}), tmp_path / "one.zarr", client)
