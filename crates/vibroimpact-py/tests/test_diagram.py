"""Orbit diagrams as Datasets."""

import json

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi


@pytest.fixture
def ds() -> xr.Dataset:
    return vi.orbit_diagram(vi.Oscillator(inverse_beta=1.3, gap=0, restitution=0.5), "gap", "0.5:1:11")


def test_points_are_the_impacts_of_the_motion(ds: xr.Dataset, s: vi.Oscillator) -> None:
    assert dict(ds.sizes) == {"sweep": 2, "gap": 11, "point": int(ds["count"].max())}
    here = ds.sel(sweep="up", gap=0.75)
    motion = vi.settle(s)
    assert here["count"].item() == 2
    np.testing.assert_allclose(np.sort(here["velocity"].values[:2]), np.sort(motion.cycle.velocity_before), atol=1e-8)
    np.testing.assert_allclose(np.sort(here["phase"].values[:2]), np.sort(motion.cycle.phase), atol=1e-8)
    assert np.isnan(here["velocity"].values[2:]).all() and here["side"].values.tolist()[:2] == [1, 1]
    filled = np.isfinite(ds["velocity"]).sum("point")
    assert (filled == ds["count"]).all()


def test_it_says_what_it_holds(ds: xr.Dataset) -> None:
    assert ds["gap"].attrs["units"] == "1" and ds["velocity"].attrs["long_name"] == "arrival velocity"
    plan = json.loads(ds.attrs["plan"])
    assert plan["task"]["diagram"]["over"] == "0.5:1:11" and plan["system"]["inverse_beta"] == 1.3
    assert ds.vibro.labels().values.tolist() == [["impacts"] * 11] * 2
    assert ds.vibro.labels("side").shape == ds["side"].shape


def test_an_axis_may_be_written_in_three_ways(ds: xr.Dataset) -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0, restitution=0.5)
    for over in ((0.5, 1, 11), np.linspace(0.5, 1, 11), list(np.linspace(0.5, 1, 11))):
        xr.testing.assert_identical(vi.orbit_diagram(osc, "gap", over, threads=1), ds)


def test_sweeps_and_what_is_shown(s: vi.Oscillator) -> None:
    down = vi.orbit_diagram(s, "gap", "0.5:1:5", direction="down")
    both = vi.orbit_diagram(s, "gap", "0.5:1:5")
    np.testing.assert_array_equal(down["velocity"].values[0], both.sel(sweep="down")["velocity"].values[:, : down.sizes["point"]])
    scatter = vi.orbit_diagram(s, "gap", "0.5:1:3", direction="scatter", starts=4, seed=2)
    assert scatter["sweep"].values.tolist() == ["start 1", "start 2", "start 3", "start 4"]
    strobe = vi.orbit_diagram(s, "inverse_beta", "1.2:1.3:3", show="strobe")
    assert {"x", "v"} <= set(strobe) and strobe["x"].max() <= s.gap
    with pytest.raises(vi.QuestionError, match="is no variable of this diagram; there are x, v"):
        strobe.vibro.plot(which="velocity")


def test_it_survives_netcdf_or_zarr(ds: xr.Dataset, tmp_path: object) -> None:
    ds.to_zarr(f"{tmp_path}/diagram.zarr", consolidated=False)
    again = xr.open_zarr(f"{tmp_path}/diagram.zarr", consolidated=False).load()
    xr.testing.assert_equal(again, ds)
    assert again.vibro.labels().values.tolist() == ds.vibro.labels().values.tolist()
