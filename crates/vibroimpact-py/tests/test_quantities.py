"""Quantities of motions, as attributes, as fields of Datasets, and over a parameter."""

import numpy as np
import pytest

import vibroimpact as vi


def test_fields_of_maps_and_basins() -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    ds = vi.region_map(osc, {"gap": [0.5, 0.75]}, starts=8, fields=["impact_speed_max", "power"])
    assert ds["power"].attrs["scale"] == "omega_n F^2/k"
    here = ds.sel(gap=0.75)
    assert np.allclose(here["impact_speed_max"].values[:2], here["speed"].values[:2])
    basin = vi.basin(osc, x="-4:0.75:20", v="-4:4:20", fields=["impact_speed_max"])
    of = {m.label: m.quantities["impact_speed_max"] for m in vi.attractors(osc, starts=50) if m.quantities}
    for label, values in zip(basin.vibro.labels().values.ravel(), basin["impact_speed_max"].values.ravel(), strict=True):
        assert abs(values - of[label]) < 1e-9
    with pytest.raises(vi.QuestionError, match="a list of names"):
        vi.region_map(osc, {"gap": [0.5, 0.75]}, fields="power")
    with pytest.raises(vi.QuestionError, match="`speed` is no quantity"):
        vi.region_map(osc, {"gap": [0.5, 0.75]}, fields=["speed"])


def test_fields_in_si_units() -> None:
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
    ds = vi.region_map(osc, {"gap": [1.5, 2.0]}, starts=4, fields=["impact_speed_max", "impact_loss_per_period"])
    si = ds.vibro.si()
    units = osc.units
    assert units is not None and units.mass_kg == 2
    assert si["impact_loss_per_period"].attrs["units"] == "J"
    ratio = (si["impact_loss_per_period"] / ds["impact_loss_per_period"]).values.ravel()
    assert np.allclose(ratio[np.isfinite(ratio)], 2 * units.velocity_m_per_s**2)


def test_measures_of_a_basin() -> None:
    ds = vi.basin(vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5), x="-6:0.75:200", v="-6:6:200")
    of = ds.vibro.measures()
    # the definition, in numpy
    labels = ds["label"].values.reshape(40, 5, 40, 5).swapaxes(1, 2).reshape(-1, 25)
    shares = [np.unique(box, return_counts=True)[1] / 25 for box in labels]
    entropies = np.array([-(p * np.log(p)).sum() for p in shares])
    assert of["entropy"] == pytest.approx(entropies.mean(), rel=1e-12)
    assert of["boundary_entropy"] == pytest.approx(entropies[[len(p) > 1 for p in shares]].mean(), rel=1e-12)
    value, error = of["uncertainty_exponent"]
    assert 0.5 < value < 1.1 and 0 < error < 0.2
    assert of["merging"] is None
    with pytest.raises(vi.QuestionError, match="a basin over two axes"):
        ds.isel(v=0).vibro.measures()


def test_a_response() -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0.5, restitution=0.5)
    found = vi.response(osc, "gap", "0.5:1.5:21", quantity="impact-speed-max")
    assert found.quantity == "impact_speed_max" and len(found.up) == 21
    labels = {label for branch in found.branches for label in branch.label.tolist()}
    assert {"1/1", "2/1"} <= labels and any(not branch.stable.all() for branch in found.branches)
    ax = found.plot(quantity="power")
    assert ax.get_ylabel() == "power of the force" and len(ax.lines) > 4
    assert found.to_dict()["sweeps"][0]["points"][0]["label"] == "2/1"
    with pytest.raises(vi.QuestionError, match="no quantity"):
        found.plot(quantity="speed")
    listed = vi.response(osc, "gap", [0.5, 1.5, 0.75, 1.0])
    assert listed.up.parameter.tolist() == [0.5, 0.75, 1.0, 1.5] and listed.down.parameter.tolist() == [1.5, 1.0, 0.75, 0.5]
