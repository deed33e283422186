"""Adaptively refined studies: the points of the finest grid where motions differ, in rounds."""

from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi

OVER = {"inverse_beta": (1.1, 1.5), "gap": "0.5:1"}


def test_points_are_those_of_the_full_grid(s: vi.Oscillator, tmp_path: Path) -> None:
    ds = vi.refine(s, OVER, tmp_path / "rounds", cells=4, rounds=3, impacts=2000, fields=["power"]).load()
    x, y = np.linspace(1.1, 1.5, 33), np.linspace(0.5, 1, 33)
    full = vi.settle_many(s, over={"inverse_beta": x[:, None], "gap": y}, impacts=2000)
    i, j = (np.rint((ds[name].values - low) / width * 32).astype(int) for name, low, width in (("inverse_beta", 1.1, 0.4), ("gap", 0.5, 0.5)))
    assert len(set(zip(i.tolist(), j.tolist()))) == ds.sizes["sample"] < 33 * 33 / 2
    np.testing.assert_array_equal(ds["label"].values, full["label"].values[i, j])
    np.testing.assert_allclose(ds["inverse_beta"], x[i], rtol=1e-15)
    # neighbours on the finest grid that differ are both among the points, where the coarse cells have seen the boundary
    computed = np.zeros((33, 33), dtype=bool)
    computed[i, j] = True
    labels = full["label"].values
    differ = labels[:-1] != labels[1:]
    seen = computed[:-1] & computed[1:]
    assert differ.sum() > 20 and (seen & differ).sum() > 0.8 * differ.sum()
    # what is not computed has the label of the computed corners around it, almost everywhere
    near = labels[(np.arange(33) // 8 * 8)[:, None], np.arange(33) // 8 * 8]
    assert (near == labels)[~computed].mean() > 0.97
    assert np.isfinite(ds["power"].where(ds["label"] > 0, 0.0)).all() and set(ds["round"].values.tolist()) == {0, 1, 2, 3}
    ax = ds.vibro.plot()
    assert ax.get_xlabel() and sum(len(line.get_xdata()) for line in ax.get_lines()) == ds.sizes["sample"]


def test_a_call_goes_on_and_adds_rounds(s: vi.Oscillator, tmp_path: Path) -> None:
    whole = vi.refine(s, OVER, tmp_path / "whole", cells=4, rounds=3, impacts=500).load()

    # as a call that was stopped in its second round leaves it: a tile is missing, and what follows
    vi.refine(s, OVER, tmp_path / "parts", cells=4, rounds=2, impacts=500, tile=4)
    first = sorted((tmp_path / "parts/round-2.zarr").glob("*/c/0"))
    assert len(first) > 2
    for chunk in first:
        chunk.unlink()
    parts = vi.refine(s, OVER, tmp_path / "parts", cells=4, rounds=3, impacts=500, tile=4).load()
    assert parts.drop_attrs().identical(whole.drop_attrs())
    few = vi.refine(s, OVER, tmp_path / "few", cells=4, rounds=1, impacts=500).load()
    before = {file: file.stat().st_mtime_ns for file in (tmp_path / "few").rglob("zarr.json")}
    more = vi.refine(s, OVER, tmp_path / "few", cells=4, rounds=3, impacts=500).load()
    assert more.drop_attrs().identical(whole.drop_attrs()) and few.sizes["sample"] < more.sizes["sample"]
    assert all(file.stat().st_mtime_ns == time for file, time in before.items())


def test_starts_and_dictionaries(s: vi.Oscillator, tmp_path: Path) -> None:
    ds = vi.refine(s, {"x": (-4, 0.75), "v": (-4, 4)}, tmp_path / "starts", cells=4, rounds=2).load()
    assert ds["gap"].item() == 0.75 and 25 < ds.sizes["sample"] < 17 * 17
    system = {"inverse_beta": 1.3, "gap": 0.75, "restitution": 0.5}
    same = vi.refine(system, {"x": (-4, 0.75), "v": (-4, 4)}, tmp_path / "same", cells=4, rounds=2).load()
    np.testing.assert_array_equal(same["label"], ds["label"])
    one = vi.refine({"gap": 0.75, "restitution": 0.5}, {"inverse_beta": (1, 2)}, tmp_path / "one", cells=8, rounds=2, impacts=500)
    assert one["inverse_beta"].dims == ("sample",)


def test_refusals(s: vi.Oscillator, tmp_path: Path) -> None:
    for over, message in (({}, "over has the ranges"), ({"gap": (1, 1)}, "gap from 1 to 1 is not a range"), ({"gap": "0:1:5"}, "is not a range")):
        with pytest.raises(vi.QuestionError, match=message):
            vi.refine(s, over, tmp_path / "none")
    with pytest.raises(vi.QuestionError, match="cells = 0 lies outside 1 <= cells <= 4096"):
        vi.refine(s, OVER, tmp_path / "none", cells=0)
    with pytest.raises(vi.QuestionError, match="rounds = -1 lies outside"):
        vi.refine(s, OVER, tmp_path / "none", rounds=-1)
    assert not (tmp_path / "none").exists()
