"""Points drawn from a box, and studies of points in stores: the same results as in memory."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

xr = pytest.importorskip("xarray")
BOX = {"inverse_beta": (1.0, 2.0), "gap": (0.0, 2.0), "v": (-1.0, 1.0)}


def test_sobol_is_that_of_scipy() -> None:
    qmc = pytest.importorskip("scipy.stats").qmc
    for seed in (0, 5):
        points = vi.sample("sobol", 256, {f: (0, 1) for f in ("gap", "restitution", "damping", "v", "phase")}, seed=seed)
        mine = np.stack([points[name] for name in points], axis=1)
        if seed == 0:
            np.testing.assert_array_equal(mine, qmc.Sobol(5, scramble=False).random(256))
        for column in mine.T:
            assert np.array_equal(np.sort((column * 256).astype(int)), np.arange(256))


def test_a_sample_is_a_value() -> None:
    points = vi.sample("lhs", 50, BOX, seed=3)
    assert not np.array_equal(points["gap"], vi.sample("lhs", 50, BOX, seed=4)["gap"])
    assert points == vi.sample("lhs", 50, BOX, seed=3) and list(points) == list(BOX) and len(points) == 3
    assert repr(points) == "<Sample of 50 points by lhs: inverse_beta from 1 to 2, gap from 0 to 2, v from -1 to 1>"


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda: vi.sample("grid", 5, BOX), "rule = `grid` is none of sobol, lhs"),
        (lambda: vi.sample("lhs", 0, BOX), "points = 0 lies outside 1 <= points"),
        (lambda: vi.sample("lhs", -1, BOX), "count = -1 lies outside 1 <= count"),
        (lambda: vi.sample("lhs", 5, {"gap": (1, 0)}), "gap from 1 to 0"),
        (lambda: vi.settle_many(vi.sample("lhs", 5, {"gup": (0, 1)})), "`gup` is no parameter"),
        (lambda: vi.sample("lhs", 5, {}), "ranges given: 0"),
        (lambda: vi.Plan.samples(vi.sample("lhs", 5, BOX), over=vi.sample("lhs", 5, {"restitution": (0, 1)})), "are two samples"),
        (lambda: vi.Plan.samples(vi.sample("lhs", 5, BOX), over={"restitution": [0.5, 0.6]}), "two sets of points"),
        (lambda: vi.Plan.samples(vi.sample("lhs", 5, {**BOX, "restitution": (0.5, 1.5)})), "restitution eps = 1.* lies outside 0 <= eps <= 1"),
    ],
)
def test_samples_that_make_no_sense(ask: Callable[[], Any], sentence: str) -> None:
    with pytest.raises(vi.QuestionError, match=sentence):
        ask()


def test_a_store_of_a_sample_holds_what_memory_would(tmp_path: Path) -> None:
    pytest.importorskip("zarr", minversion="3")
    points = vi.sample("lhs", 120, BOX, seed=3)
    asked: dict[str, Any] = {"over": {"restitution": 0.5}, "fields": ["impact_speed_max"], "transient": True}
    memory = vi.settle_many(points, **asked)
    plan = vi.Plan.samples(points, **asked, tile=25)
    assert plan.points == 120 and "values" not in plan.json and "points of inverse_beta, gap, v" in plan.title
    place = tmp_path / "sample.zarr"
    assert vi.run(plan, place, part=(1, 2)).left > 0
    assert vi.status(place).missing and vi.resume(place).left == 0 and vi.verify(place, sample=2).whole
    stored = vi.settle_many(points, **asked, tile=25, store=place)
    for name in ("label", "reason", "transient", "impacts", "periods", "impact_speed_max", "multiplier_1_re", "multiplier_2_im"):
        np.testing.assert_allclose(stored[name].values, memory[name].values, rtol=1e-12, err_msg=name)
    for name in BOX:
        np.testing.assert_array_equal(stored[name].values, memory[name].values)
    assert stored["restitution"].item() == 0.5 and stored["gap"].dims == ("sample",) and stored["gap"].attrs == memory["gap"].attrs
    # the same bytes for other tiles in time
    other = vi.settle_many(points, **asked, store=tmp_path / "whole.zarr", threads=1)
    np.testing.assert_array_equal(other["label"].values, stored["label"].values)


def test_a_store_of_arrays(s: vi.Oscillator, tmp_path: Path) -> None:
    pytest.importorskip("zarr", minversion="3")
    starts = {"x": np.linspace(-3, 0.75, 40), "v": np.linspace(-2, 2, 40)}
    memory = vi.settle_many(s, starts=starts)
    stored = vi.settle_many(s, starts=starts, store=tmp_path / "starts.zarr", tile=7)
    np.testing.assert_array_equal(stored["label"].values, memory["label"].values)
    assert sorted(stored["cycle_label"].values.tolist()) == sorted(memory["cycle_label"].values.tolist())
    assert vi.Plan(stored.attrs["plan"]).to_dict()["task"]["basin"]["points"]["listed"][0]["vary"] == "x"
