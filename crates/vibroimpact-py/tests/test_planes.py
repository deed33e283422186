"""Curves and regions over numbers of a body."""

import numpy as np
import pytest

import vibroimpact as vi

MACHINE = vi.Oscillator.from_units(
    mass=0.8, stiffness=12e3, force=30, damping=4, gap=3.75e-3, restitution=0.5, omega=110.34
)


def test_curves_over_numbers_of_a_machine() -> None:
    """Where the gap doubles with the force, the oscillator is the same."""
    found = vi.curve(MACHINE, "flip", {"gap_m": (1e-3, 9e-3), "force_n": (15, 60)}, label="1/1")
    gap, force = found.values.T
    assert len(found) > 10 and np.ptp(force) > 35
    np.testing.assert_allclose(gap / force, gap[0] / force[0], rtol=1e-9)
    ax = found.plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("gap (m)", "force (N)")


def test_regions_over_numbers_of_a_machine() -> None:
    """The edge of the region of stability is a flip at every force."""
    found = vi.region(MACHINE, "1/1", {"mass_kg": (0.7, 0.95), "force_n": (10, 60)}, grid=6)
    flip = vi.curve(MACHINE, "flip", {"force_n": (10, 60), "mass_kg": (0.7, 0.95)}, label="1/1")
    for force, mass in flip.values[1:-1:10]:
        assert found.stability.contains(mass, force + 0.1) and not found.stability.contains(mass, force - 0.1)
        assert found.existence.contains(mass, force - 0.1)
    assert found.plot().get_xlabel() == "mass (kg)"


def test_planes_that_are_refused() -> None:
    with pytest.raises(vi.QuestionError, match=r"gap and mass_kg do not span a plane"):
        vi.region(MACHINE, "1/1", {"mass_kg": (0.7, 0.95), "gap": (1, 2)})
