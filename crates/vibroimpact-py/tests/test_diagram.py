"""Orbit diagrams as Datasets."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi


@pytest.fixture
def ds() -> xr.Dataset:
    return vi.orbit_diagram(vi.Oscillator(inverse_beta=1.3, gap=0, restitution=0.5), "gap", "0.5:1:11")


def test_it_says_what_it_holds(ds: xr.Dataset) -> None:
    assert dict(ds.sizes) == {"sweep": 2, "gap": 11, "point": 64}
    assert ds.sel(sweep=1, gap=0.75).dropna("point")["side"].values.tolist() == [1, 1]
    assert (ds["gap"].attrs["units"], ds["gap"].attrs["scale"]) == ("1", "F/k") and ds["velocity"].attrs["long_name"] == "speed of arrival of an impact"
    plan = json.loads(ds.attrs["plan"])
    assert plan["task"]["diagram"]["over"] == "0.5:1:11" and plan["system"]["inverse_beta"] == 1.3
    assert ds.vibro.labels().values.tolist() == [["impacts"] * 11] * 2
    assert ds.vibro.labels("side").isel(sweep=0, gap=0, point=0).item() == "impact"
    with pytest.raises(vi.QuestionError, match="`velocity` has no codes"):
        ds.vibro.labels("velocity")


def test_an_axis_may_be_written_in_three_ways(ds: xr.Dataset) -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0, restitution=0.5)
    for over in ("0.5:1.0:11", np.linspace(0.5, 1, 11), list(np.linspace(0.5, 1, 11))):
        other = vi.orbit_diagram(osc, "gap", over, threads=1)
        xr.testing.assert_equal(other, ds)
        assert {"0.5:1:11", "0.5:1.0:11"} >= {json.loads(other.attrs["plan"])["task"]["diagram"]["over"]}


def test_listed_values(ds: xr.Dataset, tmp_path: Path) -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0, restitution=0.5)
    gaps = [0.5, 0.55, 0.75, 1.0]
    listed = vi.orbit_diagram(osc, "gap", gaps, direction="scatter", starts=3)
    whole = vi.orbit_diagram(osc, "gap", "0.5:1:11", direction="scatter", starts=3)
    assert json.loads(listed.attrs["plan"])["task"]["diagram"]["over"] == gaps
    xr.testing.assert_equal(listed, whole.sel(gap=gaps))
    # in a store, and as falling values
    stored = vi.orbit_diagram(osc, "gap", np.array(gaps)[::-1], direction="scatter", starts=3, store=tmp_path / "listed.zarr")
    assert stored["gap"].values.tolist() == gaps[::-1]
    for name in ("kind", "velocity", "impact_phase", "side"):
        np.testing.assert_array_equal(stored[name].isel(gap=slice(None, None, -1)), listed[name])
    lines = listed.vibro.plot().get_lines()
    assert {float(x) for line in lines for x in line.get_xdata()} == set(gaps)


def test_sweeps_and_what_is_shown(s: vi.Oscillator) -> None:
    down = vi.orbit_diagram(s, "gap", "0.5:1:5", direction="down")
    both = vi.orbit_diagram(s, "gap", "0.5:1:5")
    xr.testing.assert_equal(down.sel(sweep=-1), both.sel(sweep=-1))
    scatter = vi.orbit_diagram(s, "gap", "0.5:1:3", direction="scatter", starts=4, seed=2)
    assert dict(scatter.sizes) == {"start": 4, "gap": 3, "point": 64}
    strobe = vi.orbit_diagram(s, "inverse_beta", "1.2:1.3:3", show="strobe")
    assert {"x", "v"} <= set(strobe) and strobe["x"].max() <= s.gap
    with pytest.raises(vi.QuestionError, match="is no variable of this diagram; there are x, v"):
        strobe.vibro.plot(which="velocity")


def test_a_line_through_two_parameters(s: vi.Oscillator) -> None:
    line = vi.orbit_diagram(s, "inverse_beta", "1.2:1.4:3", also={"gap": (1, 0.5)}, direction="scatter", starts=3)
    assert line["gap"].dims == ("inverse_beta",) and line["gap"].values.tolist() == [1.0, 0.75, 0.5]
    with pytest.raises(TypeError, match="also is one parameter with its values"):
        vi.orbit_diagram(s, "gap", "0:1:3", also={"damping": (0, 1), "beta": (1, 2)})


def test_a_logarithmic_span_has_a_logarithmic_axis(s: vi.Oscillator) -> None:
    ds = vi.orbit_diagram(s, "damping", vi.span(0.001, 0.1, 5, log=True))
    assert ds.vibro.plot().get_xscale() == "log"


def test_a_line_survives_its_store(s: vi.Oscillator, tmp_path: Path) -> None:
    place = tmp_path / "line.zarr"
    line = vi.orbit_diagram(s, "inverse_beta", "1.2:1.4:3", also={"gap": (1, 0.5)}, store=place)
    with vi.open(place) as stored:
        assert set(stored.coords) == set(line.coords)
    with xr.open_zarr(place) as stored:
        assert set(stored.coords) < set(line.coords) and stored["gap"].values.tolist() == [1.0, 0.75, 0.5]
