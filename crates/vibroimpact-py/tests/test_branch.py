"""Branches: events are compared with closed forms and with simulation just below and above them."""

import math
import pickle

import numpy as np

import vibroimpact as vi


def flip_of_1_1(inverse: float, eps: float) -> float:
    """The gap at the flip of 1/1, without damping: trace = -(1 + eps^2)."""
    beta = 1 / inverse
    t = 2 * math.pi * inverse
    c, m12 = math.cos(t), math.sin(t)
    f, den = 1 / (1 - beta**2), 2 * c - 2
    a, b = (1 + eps) * m12 / den, 1 - (1 + eps) * (c - 1) / den
    q = (-(1 + eps**2) + 2 * eps * c) / ((1 + eps) * m12)
    rho = -(q + (1 - beta**2) * a) / beta**2
    return rho * abs(f) / math.sqrt((rho - a) ** 2 + (b / beta) ** 2)


def test_the_flip_is_where_the_closed_form_has_it() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    found = vi.branch(osc, "gap", 2.5, label="1/1", follow=3)
    flip = next(event for event in found.events if event.kind == "flip")
    assert abs(flip.parameter - flip_of_1_1(1.11, 0.5)) < 1e-11
    assert abs(found.multipliers[flip.point] + 1).min() < 1e-9
    # every point is an orbit that is found independently at its value
    for k in (0, len(found) // 2, len(found) - 1):
        orbits = vi.orbits(osc.replace(gap=found.parameter[k]), "1/1")
        assert min(abs(orbit.cycle.speed[0] - found.speed[k]) for orbit in orbits) < 1e-10
    assert found.stable[0] and not found.stable[-1] and found.parameter[-1] == 2.5
    doubled = found.followed[0]
    assert doubled.origin is not None and doubled.origin.kind == "flip" and doubled.label[1] == "2/2"
    assert doubled.origin.parameter == flip.parameter and doubled.origin.branch == 1
    # just beyond the flip, simulation settles into the motion of twice the period
    beside = vi.settle(osc.replace(gap=flip.parameter + 1e-3), x=0.5)
    assert beside.label in ("2/2", "1/2")


def test_arrays_belong_together() -> None:
    found = vi.branch(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), "gap", 2.5, label="1/1", follow=1)
    for branch in (found, *found.followed):
        count = len(branch)
        assert branch.multipliers.shape == (count, 2) and len(branch.label) == len(branch.cycles) == count
        for k, cycle in enumerate(branch.cycles):
            assert branch.label[k] == f"{len(cycle)}/{branch.label[k].split('/')[1]}"
            assert branch.speed[k] == cycle.speed.max()
        inside = np.all(np.abs(branch.multipliers) < 1, axis=1)
        assert np.array_equal(branch.stable, (branch.stability == "stable") & branch.admissible)
        # at an event a multiplier is on the unit circle to rounding
        neutral = branch.stability == "neutral"
        assert np.array_equal(branch.stable | neutral, inside & branch.admissible | neutral)
        assert np.count_nonzero(neutral) <= len(branch.events) + 1
        assert branch.cycles[-1] == branch.cycles[count - 1]
    assert pickle.loads(pickle.dumps(found)).to_dict() == found.to_dict()


def test_a_branch_may_reach_the_motion_without_impacts() -> None:
    osc = vi.Oscillator(beta=1, gap=2, restitution=0.8, damping=0.05)
    found = vi.branch(osc, "gap", 12, label="1/1")
    graze = [event for event in found.events if event.kind == "grazing"]
    assert graze and graze[-1].after == "0" and found.label[-1] == "0" and found.speed[-1] == 0
    # the motion without impacts grazes the stop: gap = |f| = 1/(2 zeta)
    assert abs(graze[-1].parameter - 10) < 1e-9


def test_a_line_through_two_parameters() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    found = vi.branch(osc, "gap", 2.5, label="1/1", also={"inverse_beta": 1.05})
    assert found.also == ("inverse_beta", 1.11, 1.05) and found.second is not None
    np.testing.assert_allclose(found.second, 1.11 - 0.06 * (found.parameter - 1.5), atol=1e-15)
    flip = next(event for event in found.events if event.kind == "flip")
    assert flip.values is not None and flip.values == [flip.parameter, found.second[flip.point]]
    assert abs(flip.parameter - flip_of_1_1(flip.values[1], 0.5)) < 1e-11
    assert found.to_dict()["also"] == {"parameter": "inverse_beta", "from": 1.11, "to": 1.05}
    assert "with 1/$β$ from 1.11 to 1.05" in found.plot(diagram=True).get_xlabel()
