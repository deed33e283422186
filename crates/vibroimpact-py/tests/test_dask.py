"""Tiles on real workers, one of them killed."""

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

import vibroimpact as vi

distributed = pytest.importorskip("distributed")

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def client() -> Iterator["distributed.Client"]:
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            yield client


def contents(store: Path) -> dict[str, bytes]:
    return {str(file.relative_to(store)): file.read_bytes() for file in sorted(store.rglob("*")) if file.is_file()}


def test_workers_make_the_same_bytes(client: "distributed.Client", s: vi.Oscillator, tmp_path: Path) -> None:
    over = {"inverse_beta": "1:1.5:11", "gap": "0:2:9"}
    plan = vi.Plan.map(s, over, starts=4, tile=3)
    vi.run(plan, tmp_path / "one.zarr")
    seen: list[tuple[int, int]] = []
    ds = vi.region_map(
        s, over, starts=4, tile=3, store=tmp_path / "two.zarr", client=client, progress=lambda *of: seen.append(of)
    )
    assert contents(tmp_path / "two.zarr") == contents(tmp_path / "one.zarr")
    assert dict(ds["label"].sizes) == {"gap": 9, "inverse_beta": 11, "motion": 4} and seen[-1] == (99, 99)
    # nothing is left to do, and nothing is done
    assert vi.dask.run(plan, tmp_path / "two.zarr", client) == vi.Ran(0, 12, 0, 0)


@pytest.mark.parametrize("tiles", [1, 30, 75])
def test_a_worker_may_be_killed(client: "distributed.Client", u: vi.Oscillator, tmp_path: Path, tiles: int) -> None:
    client.wait_for_workers(2, timeout=60)
    plan = vi.Plan.basin(u, {"x": "-4:3:60", "v": "-4:4:60"}, tile=6)
    vi.run(plan, tmp_path / "one.zarr")
    victims = list(client.run(os.getpid).values())
    place = tmp_path / "two.zarr"

    done: list[int] = []

    def murder() -> None:
        while not (place / "zarr.json").exists() or vi.status(place).done < tiles:
            time.sleep(0.005)
        os.kill(victims[0], signal.SIGKILL)
        done.append(vi.status(place).done)

    thread = threading.Thread(target=murder)
    thread.start()
    ran = vi.dask.run(plan, place, client)
    thread.join()
    assert tiles <= done[0] < 100, "the work was over before the worker was killed"
    assert ran.left == 0 and vi.verify(place, sample=5).whole
    assert contents(place) == contents(tmp_path / "one.zarr")


def test_stopped_by_its_callback(client: "distributed.Client", u: vi.Oscillator, tmp_path: Path) -> None:
    plan = vi.Plan.basin(u, {"x": "-4:3:80", "v": "-4:4:80"}, tile=8)
    with pytest.raises(vi.StoppedError, match="stopped after"):
        vi.dask.run(plan, tmp_path / "some.zarr", client, progress=lambda done, total: done < 500)
    assert 0 < vi.status(tmp_path / "some.zarr").done < 100


def test_a_store_of_another_plan(client: "distributed.Client", s: vi.Oscillator, tmp_path: Path) -> None:
    vi.run(vi.Plan.basin(s, {"x": "-4:0.75:9"}), tmp_path / "one.zarr")
    with pytest.raises(vi.StoreError, match="holds another plan"):
        vi.dask.run(vi.Plan.basin(s, {"x": "-4:0.75:8"}), tmp_path / "one.zarr", client)
