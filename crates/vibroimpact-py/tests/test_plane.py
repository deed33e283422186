"""Curves and regions compared with closed forms and with each other, and over numbers of a body."""

import math

import numpy as np
import pytest

import vibroimpact as vi


def fold_of_1_1(inverse: float, eps: float) -> float:
    """The gap at which 1/1 folds, without damping: |gap| = f sqrt(1 + (beta a/b)^2)."""
    beta, t = 1 / inverse, 2 * math.pi * inverse
    den = 2 * math.cos(t) - 2
    a, b = (1 + eps) * math.sin(t) / den, 1 - (1 + eps) * (math.cos(t) - 1) / den
    return abs(1 / (1 - beta**2)) * math.sqrt(1 + (beta * a / b) ** 2)


def test_the_fold_curve_is_the_closed_form() -> None:
    osc = vi.Oscillator(inverse_beta=0.7, gap=2, restitution=0.5)
    found = vi.curve(osc, "fold", {"gap": "0:5", "inverse_beta": (0.45, 0.9)}, label="1/1")
    gaps, inverses = found.values.T
    ordinary = inverses > 0.5 + 1e-6
    expected = [fold_of_1_1(inverse, 0.5) for inverse in inverses[ordinary]]
    np.testing.assert_allclose(gaps[ordinary], expected, rtol=1e-9)
    assert found.events[-1].kind == "end of box" and gaps[-1] == 5
    begin = found.through[1]
    assert gaps[begin] == pytest.approx(found.found_at[0], rel=1e-9) and inverses[begin] == 0.7


def test_points_inside_a_region_are_orbits() -> None:
    osc = vi.Oscillator(beta=1, gap=0, restitution=0.5)
    found = vi.region(osc, "1/1", {"inverse_beta": (0.6, 0.95), "gap": (0.5, 3)}, grid=8)
    rng = np.random.default_rng(3)
    inverses, gaps = rng.uniform(0.6, 0.95, 40), rng.uniform(0.5, 3, 40)
    exists, stable = found.existence.contains(inverses, gaps), found.stability.contains(inverses, gaps)
    assert exists.any() and not exists.all()
    for inverse, gap, here, firm in zip(inverses, gaps, exists, stable):
        orbits = [orbit for orbit in vi.orbits(osc.replace(inverse_beta=inverse, gap=gap), "1/1") if orbit.admissible]
        assert here == bool(orbits) and firm == any(orbit.stable for orbit in orbits)
    assert found.existence.contains(inverses[:, None], gaps[None, :]).shape == (40, 40)
    assert vi.region(osc, "1/1", {"inverse_beta": "0.6:0.95", "gap": (0.5, 3)}, grid=8, threads=1).to_dict() == found.to_dict()


def test_a_machine_that_is_an_oscillator_has_its_regions() -> None:
    machine = vi.Machine.named("fukaya-irie-1971")
    found = machine.region("1/1", {"inverse_beta": (0.6, 0.95), "delta": (0.5, 3)}, grid=5)
    osc = vi.Oscillator(beta=1, gap=0, restitution=0.5)
    known = vi.region(osc, "1/1", {"inverse_beta": (0.6, 0.95), "gap": (0.5, 3)}, grid=5)
    inverses, gaps = np.meshgrid(np.linspace(0.607, 0.943, 20), np.linspace(0.53, 2.97, 20))
    for own, other in ((found.existence, known.existence), (found.stability, known.stability)):
        np.testing.assert_array_equal(own.contains(inverses, gaps), other.contains(inverses, gaps))
    assert found.parameters == ("inverse_beta", "delta") and found.system is machine
    hammer = vi.Machine.named("two-mass-hammer")
    # a plane in which it is stable everywhere: the outline of an edge takes ten seconds
    other = hammer.region("1/1", {"frequency": (1.1, 1.2), "stop.anvil.gap": (0.48, 0.52)}, grid=2)
    assert other.stability.contains(1.15, 0.5) and not other.stability.contains(1.02, 0.5)


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
