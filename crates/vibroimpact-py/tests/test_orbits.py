"""Orbits compared with the closed form of one impact in n periods."""

import math
import pickle

import numpy as np
import pytest

import vibroimpact as vi


def one_impact(osc: vi.Oscillator, n: int) -> list[tuple[float, float]]:
    """Speeds and phases of 1/n without damping: f sin = gap + kappa U, f beta cos = (1 - eps) U/2 in the phase."""
    beta, gap, eps = osc.beta, osc.gap, osc.restitution
    f = 1 / (1 - beta**2)
    kappa, half = (1 + eps) / (2 * math.tan(math.pi * n / beta)), (1 - eps) / (2 * beta)
    roots = np.roots([kappa**2 + half**2, 2 * gap * kappa, gap**2 - f**2])
    speeds = sorted(float(u.real) for u in roots if abs(u.imag) < 1e-9 and u.real > 0)
    return [(u, math.atan2((gap + kappa * u) / f, half * u / f) % (2 * math.pi)) for u in speeds]


@pytest.mark.parametrize(("inverse", "gap", "n"), [(1.11, 2.0, 1), (1.11, 2.0, 2), (1.3, 0.75, 1), (0.7, 2.0, 1)])
def test_as_the_closed_form(inverse: float, gap: float, n: int) -> None:
    osc = vi.Oscillator(inverse_beta=inverse, gap=gap, restitution=0.5)
    expected = one_impact(osc, n)
    found = vi.orbits(osc, f"1/{n}")
    assert expected and len(found) == len(expected)
    for orbit, (speed, phase) in zip(found, expected):
        assert orbit.cycle.speed[0] == pytest.approx(speed, rel=1e-12)
        assert orbit.cycle.phase[0] == pytest.approx(phase, abs=1e-12)
        assert orbit.multipliers is not None
        # the determinant is known exactly
        assert np.prod(orbit.multipliers).real == pytest.approx(osc.restitution**2, rel=1e-12)
        assert orbit.stable == bool(np.all(np.abs(orbit.multipliers) < 1))


def test_solutions_that_are_no_motions_say_where_they_fail() -> None:
    osc = vi.Oscillator(inverse_beta=1.9, gap=1, restitution=0.5)
    virtual = vi.orbits(osc, "1/1")
    assert len(virtual) == 1 and not virtual[0].admissible
    contact = virtual[0].earlier_contact
    assert contact is not None and (contact.after_impact, contact.stop) == (1, "upper")
    # a simulation from there has this next impact
    assert vi.simulate(osc, **virtual[0].start(), impacts=1).time[0] == pytest.approx(contact.time, rel=1e-12)
    assert contact.time < osc.period
    with pytest.raises(vi.QuestionError, match="is inadmissible"):
        virtual[0].waveform()
    assert pickle.loads(pickle.dumps(virtual)) == virtual
