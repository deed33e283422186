"""Exponents compared with exact values."""

import math

import numpy as np

import vibroimpact as vi


def test_chaos_obeys_the_identity(u: vi.Oscillator) -> None:
    found = vi.lyapunov(u, impacts=20_000, points=500)
    one, two = found.exponents
    assert found.motion.label == "chaotic" and one.value > one.error > 0 > two.value
    rate = found.impacts_per_period.value / u.period
    assert abs(one.value + two.value - 2 * math.log(0.5) * rate) < 1e-9
    assert found.dimension is not None and abs(found.dimension.value - (1 + one.value / -two.value)) < 1e-12
    assert len(found.closings.phase) == len(found.strobes.q) == 500 and found.strobes.q.max() <= u.gap
    assert found.grounds["kind"] == "measured" and found.grounds["impacts"] >= 20_000


def test_a_periodic_motion_has_those_of_its_multipliers(s: vi.Oscillator) -> None:
    found = vi.lyapunov(s, impacts=10_000)
    assert found.motion.multipliers is not None
    for exponent, multiplier in zip(found.exponents_per_period, found.motion.multipliers):
        assert abs(exponent.value - math.log(abs(multiplier))) <= exponent.error


def test_exact_ones_have_no_error() -> None:
    stuck = vi.lyapunov(vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5))
    assert stuck.exponents[0] == (-math.inf, 0.0) and stuck.grounds["kind"] == "stuck"
    assert stuck.to_dict()["exponents"][0] == {"value": None, "error": None, "why": "minus_infinity"}
    free = vi.lyapunov(vi.Oscillator(beta=0.5, gap=9, restitution=0.5, damping=0.1))
    assert free.exponents[0] == (-0.1, 0.0) and np.isfinite(free.identity)
