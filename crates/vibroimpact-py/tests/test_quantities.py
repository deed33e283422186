"""Quantities of motions, as attributes, as fields of Datasets, and over a parameter; numbers of a body vary in SI units, and results
are in the units of the body at each value."""

import pickle

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


MACHINE = vi.Oscillator.from_units(
    mass=0.8, stiffness=12_000, force=30, damping_ratio=0.02, gap=1.5e-3, restitution=0.65, frequency=20
)


def speed(osc: vi.Oscillator) -> float:
    """The largest impact speed from rest in m/s."""
    assert osc.units is not None
    return float(vi.settle(osc).quantities["impact_speed_max"]) * osc.units.velocity_m_per_s


def test_a_map_over_force_and_frequency_in_si():
    ds = vi.region_map(
        MACHINE, {"force_n": [10, 20, 30], "frequency_hz": "15:25:3"}, starts=1, fields=["impact_speed_max"]
    )
    si = ds.vibro.si()
    assert si["impact_speed_max"].attrs["units"] == "m/s"
    assert si["impact_speed_max"].dims == ds["impact_speed_max"].dims
    for force in (10.0, 20.0, 30.0):
        for hertz in (15.0, 20.0, 25.0):
            osc = MACHINE.replace(force_n=force, frequency_hz=hertz)
            found = si["impact_speed_max"].sel(force_n=force, frequency_hz=hertz, motion=0).item()
            assert found == pytest.approx(speed(osc), rel=1e-14)
    # a selection has the units of its own force
    one = ds.sel(force_n=20.0).vibro.si()
    np.testing.assert_array_equal(one["impact_speed_max"], si["impact_speed_max"].sel(force_n=20.0))


def test_a_number_is_replaced_and_all_others_are_held():
    heavier = MACHINE.replace(mass_kg=1.6)
    assert heavier.beta == pytest.approx(MACHINE.beta * np.sqrt(2), rel=1e-15)
    assert (heavier.damping, heavier.gap, heavier.restitution) == (0.02, MACHINE.gap, 0.65)
    assert heavier.units is not None and heavier.units.mass_kg == 1.6
    assert MACHINE.replace(force_n=60).gap == pytest.approx(MACHINE.gap / 2, rel=1e-15)
    again = pickle.loads(pickle.dumps(heavier))
    assert again == heavier and again.replace(mass_kg=0.8) == MACHINE


def test_a_response_over_a_number_is_in_si():
    found = vi.response(MACHINE, "force_n", "10:30:3", quantity="impact_speed_max")
    for force, value in zip(found.up.parameter, found.up.quantities["impact_speed_max"], strict=True):
        assert value == pytest.approx(speed(MACHINE.replace(force_n=force)), rel=1e-9)


def test_other_excitations():
    shared = {"mass": 0.7, "stiffness": 900, "gap": 0.004, "restitution": 0.7, "omega": 31}
    force = vi.Oscillator.from_units(**shared, force=0.7 * 31**2 * 0.002, damping=2.1)
    for motion in ({"base_displacement": 0.002}, {"base_acceleration": 31**2 * 0.002}, {"unbalance": 0.7 * 0.002}):
        osc = vi.Oscillator.from_units(**shared, **motion, damping=2.1)
        assert osc.gap == pytest.approx(force.gap, rel=1e-14)
    # the force of an unbalance grows as the square of the frequency
    unbalance = vi.Oscillator.from_units(**shared, unbalance=0.0014)
    faster = unbalance.replace(frequency_hz=2 * 31 / (2 * np.pi))
    assert faster.gap == pytest.approx(unbalance.gap / 4, rel=1e-14)
