"""Basins and maps as Datasets."""

import pickle
import time
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import _core, _store


def test_each_start_has_the_motion_it_settles_into(s: vi.Oscillator) -> None:
    ds = vi.basin(s, x="-4:0.75:12", v=np.linspace(-4, 4, 9), phase=np.float32(0.5))
    assert ds["label"].dims == ("v", "x") and ds["label"].dtype == np.int32
    labels = ds.vibro.labels()
    alone = vi.settle_many(s, ds["x"].values[None, :], ds["v"].values[:, None], 0.5)
    np.testing.assert_array_equal(labels.values, alone.labels)
    cycles = ds["cycle_label"].values[ds["cycle"].values]
    np.testing.assert_array_equal(cycles.astype(str), labels.values)
    for k, name in enumerate(ds["cycle_label"].values):
        motion = next(motion for motion in alone.motions if motion.label == name)
        assert ds["cycle_share"].values[k] == motion.share
        phases = ds["cycle_phase"].values[k]
        np.testing.assert_array_equal(phases[: len(motion.cycle)], motion.cycle.phase)


def test_each_point_of_a_map_has_its_attractors() -> None:
    osc = vi.Oscillator(inverse_beta=1, gap=0, restitution=0.5)
    ds = vi.region_map(osc, {"inverse_beta": "0.6:1.5:4", "gap": [0.25, 0.75, 2.0]}, starts=30, seed=3)
    assert ds["label"].dims == ("gap", "inverse_beta", "motion")
    labels = ds.vibro.labels()
    for gap in ds["gap"].values:
        for inverse in ds["inverse_beta"].values:
            here = dict(inverse_beta=inverse, gap=gap)
            expected = vi.attractors(osc.replace(**here), starts=30, seed=3)
            names = [name for name in labels.sel(here).values.tolist() if name]
            assert names == [motion.label for motion in expected]
            assert ds["share"].sel(here).values[: len(names)].tolist() == [motion.share for motion in expected]
            fastest = [len(m.cycle) and m.cycle.speed.max() or np.nan for m in expected]
            np.testing.assert_array_equal(ds["speed"].sel(here).values[: len(names)], fastest)


def test_axes_may_be_ranges_logarithms_and_lists() -> None:
    osc = vi.Oscillator(inverse_beta=1, gap=1, restitution=0.5)
    plan = vi.Plan.map(osc, {"damping": vi.span(0.001, 0.1, 3, log=True), "gap": np.array([0.0, 0.5, 3.0])})
    over = [axis["over"] for axis in plan.to_dict()["task"]["map"]["axes"]]
    assert over == ["0.001:0.1:3:log", [0.0, 0.5, 3.0]]
    even = vi.Plan.map(osc, {"gap": np.linspace(0, 3, 4)})
    assert even == vi.Plan.map(osc, {"gap": "0:3:4"})


def test_plans_are_values(s: vi.Oscillator, tmp_path: Path) -> None:
    plan = vi.Plan.basin(s.replace(second_gap=2), {"x": "-1:0.75:10", "restitution": [0.3, 0.6]}, v=1, tile=8)
    assert plan == pickle.loads(pickle.dumps(plan)) == vi.Plan(plan.json) and len({plan, vi.Plan(plan.json)}) == 1
    assert plan.points == 20 and len(plan.hash) == 16 and plan != vi.Plan.basin(s, {"x": "-1:0.75:10"})
    (tmp_path / "plan.json").write_text(plan.json)
    assert vi.Plan.read(tmp_path / "plan.json") == plan
    (tmp_path / "plan.toml").write_text(
        """
version = 1
system = { inverse_beta = 1.3, restitution = 0.5 }
[task.map]
starts = 4
axes = [{ vary = "gap", over = "0:1:5" }]
"""
    )
    read = vi.Plan.read(str(tmp_path / "plan.toml"))
    assert read == vi.Plan.map(s.replace(gap=0), {"gap": "0:1:5"}, starts=4, seed=0)
    (tmp_path / "broken.toml").write_text("version = ")
    with pytest.raises(vi.QuestionError, match="broken.toml`: the plan does not read: line 1, column 11"):
        vi.Plan.read(tmp_path / "broken.toml")


def test_python_adds_next_to_nothing(s: vi.Oscillator) -> None:
    """Processor time before and after the work of the core, for a basin of a quarter of a million starts."""
    over = {"x": "-6:0.75:500", "v": "-6:6:500"}
    vi.basin(s, x="-6:0.75:10")
    clock = [time.process_time()]
    plan = vi.Plan.basin(s, over)
    clock.append(time.process_time())
    found = _core.fill(plan.json, 0, None)
    clock.append(time.process_time())
    assert _store._dataset(plan, *found)["label"].shape == (500, 500)
    clock.append(time.process_time())
    before, work, after = np.diff(clock)
    assert before + after < 0.05 * work
