"""Quantities of motions, as attributes, as fields of Datasets, and over a parameter; numbers of a body vary in SI units, and results
are in the units of the body at each value."""

import numpy as np
import pytest

import vibroimpact as vi


def test_fields_in_si_units() -> None:
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5)
    ds = vi.region_map(osc, {"gap": [1.5, 2.0]}, starts=4, fields=["impact_speed_max", "impact_loss_per_period"])
    si = ds.vibro.si()
    units = osc.units
    assert units is not None and units.mass_kg == 2
    assert si["impact_loss_per_period"].attrs["units"] == "J"
    ratio = (si["impact_loss_per_period"] / ds["impact_loss_per_period"]).values.ravel()
    assert np.allclose(ratio[np.isfinite(ratio)], 2 * units.velocity_m_per_s**2)


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
