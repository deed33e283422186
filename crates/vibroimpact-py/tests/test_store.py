"""Studies in stores: the bytes do not depend on how they were computed."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi


@pytest.fixture
def plan(s: vi.Oscillator) -> vi.Plan:
    return vi.Plan.basin(s, {"x": "-4:0.75:100", "v": "-4:4:90"}, tile=16)


def contents(store: Path) -> dict[str, bytes]:
    return {str(file.relative_to(store)): file.read_bytes() for file in sorted(store.rglob("*")) if file.is_file()}


def test_a_store_holds_what_memory_would(plan: vi.Plan, s: vi.Oscillator, tmp_path: Path) -> None:
    place = tmp_path / "basin.zarr"
    ran = vi.run(plan, place)
    assert (ran.computed, ran.left) == (42, 0) and vi.run(plan, place) == vi.Ran(0, 42, 0, 0)
    stored = vi.open(place).load()
    memory = vi.basin(s, x="-4:0.75:100", v="-4:4:90")
    for name, of in memory.variables.items():
        np.testing.assert_array_equal(stored[name].values, of.values)
        assert stored[name].dims == of.dims and stored[name].attrs == of.attrs, name
    assert stored.attrs["plan_hash"] == plan.hash and vi.Plan(stored.attrs["plan"]) == plan
    # xarray can open it directly; parameters that do not vary are only in the plan
    fixed = [name for name, of in stored.coords.items() if of.ndim == 0]
    xr.testing.assert_identical(xr.open_zarr(place).load().drop_vars("status"), stored.drop_vars(fixed))
    # the tiles have no dimensions here, so a table has a row for each point and cycle
    assert set(stored["label"].dims) == {"v", "x"} and not any(str(name).startswith("tile_") for name in stored.dims)
    assert {"gap", "restitution", "phase"} < set(fixed)


def test_a_budget_and_the_progress(plan: vi.Plan, tmp_path: Path) -> None:
    vi.run(plan, tmp_path / "one.zarr")
    ran = vi.run(plan, tmp_path / "two.zarr", budget=1e-6, threads=1)
    assert (ran.computed, ran.left) == (1, 41)
    ran = vi.resume(tmp_path / "two.zarr", budget="0.000001s", threads=1)
    assert (ran.computed, ran.found, ran.left) == (1, 1, 40)
    far = vi.status(tmp_path / "two.zarr")
    assert far.tile == {"v": 16, "x": 16} and far.shard is None and far.progress == far.points_done / 9000
    assert len(far.seconds_of_tiles) == 2 and set(far.seconds_of_tiles).isdisjoint(far.missing)
    assert vi.resume(tmp_path / "two.zarr", budget="1h").left == 0
    assert contents(tmp_path / "two.zarr") == contents(tmp_path / "one.zarr")
    assert len(vi.status(tmp_path / "two.zarr").seconds_of_tiles) == 42
    for bad, why in (("8", "hint: 8h, 8m or 8s"), (0, "lies outside 0 < budget"), (-1.0, "lies outside"), ("soon", "is no time")):
        with pytest.raises(vi.QuestionError, match=why):
            vi.run(plan, tmp_path / "no.zarr", budget=bad)
    with pytest.raises(TypeError, match="budget"):
        vi.run(plan, tmp_path / "no.zarr", budget=[1])  # type: ignore[arg-type]
    assert not (tmp_path / "no.zarr").exists()


def test_an_estimate_before_the_run(plan: vi.Plan, tmp_path: Path) -> None:
    cost = plan.estimate(threads=2)
    assert (cost.points, cost.tiles, cost.threads) == (9000, 42, 2) and 0 < cost.points_sampled <= 9000
    low, high = cost.processor_seconds_interval
    assert 0 < low <= cost.processor_seconds <= high and cost.seconds <= cost.processor_seconds
    vi.run(plan, tmp_path / "one.zarr")
    files = contents(tmp_path / "one.zarr")
    tables = {name.partition("/")[0] for name in files if name.startswith("cycle_")}
    assert cost.files == len(files) - 2 * len(tables)
    assert cost.bytes_raw == 8 * 9000 and cost.memory_bytes > cost.bytes_raw
    with pytest.raises(vi.QuestionError, match="sample"):
        plan.estimate(sample=0)


def test_shards_are_opened_by_zarr(plan: vi.Plan, tmp_path: Path) -> None:
    import zarr

    vi.run(plan, tmp_path / "tiles.zarr")
    sharded = plan.with_tiles(tile=16, shard=3)
    assert sharded.points == plan.points and sharded.hash != plan.hash
    vi.run(sharded, tmp_path / "some.zarr", budget=1e-6)
    # tiles that wait for their shard are not seen yet
    assert (xr.open_zarr(tmp_path / "some.zarr")["label"].values == -9).all()
    ran = vi.run(sharded, tmp_path / "shards.zarr")
    assert ran.computed == 42 and vi.verify(tmp_path / "shards.zarr").whole
    assert vi.status(tmp_path / "shards.zarr").shard == {"v": 48, "x": 48}
    one, other = (xr.open_zarr(tmp_path / f"{name}.zarr").load() for name in ("tiles", "shards"))
    xr.testing.assert_equal(one.drop_vars("status"), other.drop_vars("status"))
    label = zarr.open_group(tmp_path / "shards.zarr", mode="r")["label"]
    assert isinstance(label, zarr.Array) and label.shards == (48, 48) and label.chunks == (16, 16)
    assert len(contents(tmp_path / "shards.zarr")) < len(contents(tmp_path / "tiles.zarr"))


def test_stopped_and_resumed(plan: vi.Plan, tmp_path: Path) -> None:
    vi.run(plan, tmp_path / "one.zarr")
    vi.run(plan, tmp_path / "two.zarr", part=(1, 2))
    far = vi.status(tmp_path / "two.zarr")
    assert (far.tiles, far.done, far.complete) == (42, 21, False) and far.missing[0] == 1 and far.points == 9000
    found = vi.verify(tmp_path / "two.zarr")
    assert found.open == 21 and not found.whole and found.damage == []
    ran = vi.resume(tmp_path / "two.zarr")
    assert (ran.computed, ran.found) == (21, 21) and vi.status(tmp_path / "two.zarr").complete
    assert contents(tmp_path / "two.zarr") == contents(tmp_path / "one.zarr")


def test_damage_is_found_and_mended(plan: vi.Plan, tmp_path: Path) -> None:
    place = tmp_path / "basin.zarr"
    vi.run(plan, place)
    before = contents(place)
    chunk = max(file for file in place.glob("label/c/**/*") if file.is_file())
    bits = bytearray(chunk.read_bytes())
    bits[len(bits) // 2] ^= 4
    chunk.write_bytes(bits)
    found = vi.verify(place)
    assert len(found.damage) == 1 and "check sum" in found.damage[0][1] and not found.whole
    assert vi.resume(place).mended == 1 and contents(place) == before and vi.verify(place, sample=42).whole


def test_ctrl_c_keeps_what_is_done(tmp_path: Path) -> None:
    program = f"""
import signal
import vibroimpact as vi
u = vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5)
# where the tests run in the background of a shell, Ctrl-C would be ignored
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    vi.basin(u, x="-4:3:400", v="-4:4:400", tile=8, store={str(tmp_path / 'chaos.zarr')!r},
             progress=lambda done, total: print(done, flush=True))
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None
        for line in run.stdout:
            if int(line) > 200:
                break
        run.send_signal(signal.SIGINT)
        assert run.stdout.read().endswith("interrupted\n") and run.wait(60) == 0
    far = vi.status(tmp_path / "chaos.zarr")
    assert 0 < far.done < far.tiles


def test_stores_that_cannot_be_used(plan: vi.Plan, s: vi.Oscillator, tmp_path: Path) -> None:
    with pytest.raises(vi.StoreError, match="there is no store at"):
        vi.open(tmp_path / "none.zarr")
    with pytest.raises(vi.StoreError, match="there is no store at"):
        vi.status(tmp_path / "none.zarr")
    vi.run(plan, tmp_path / "one.zarr")
    with pytest.raises(vi.StoreError, match="holds another plan"):
        vi.basin(s, x="-4:0.75:9", store=tmp_path / "one.zarr")
    (tmp_path / "full").mkdir()
    (tmp_path / "full/diary.txt").write_text("mine")
    with pytest.raises(vi.StoreError, match="is not empty, and no store"):
        vi.run(plan, tmp_path / "full")
    if os.geteuid() != 0:
        (tmp_path / "locked").mkdir(mode=0o500)
        with pytest.raises(vi.StoreError, match="cannot write"):
            vi.run(plan, tmp_path / "locked/basin.zarr")
    assert issubclass(vi.StoreError, OSError)
