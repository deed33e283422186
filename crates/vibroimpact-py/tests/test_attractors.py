"""Shares of starts."""

import pickle

import pytest

import vibroimpact as vi


def test_two_motions_share_the_starts(s: vi.Oscillator) -> None:
    found = vi.attractors(s, starts=500)
    assert len(found) == 2 and {motion.label for motion in found} == {"1/1", "2/1"}
    assert found[0].share >= found[1].share and sum(motion.starts for motion in found) == 500
    assert sum(motion.share for motion in found) == pytest.approx(1)
    assert found.box["x"][1] == s.gap
    assert vi.attractors(s, starts=500, threads=3).motions == found.motions
    assert [m.starts for m in vi.attractors(s, starts=500, seed=7)] != [m.starts for m in found]


def test_it_can_be_pickled(s: vi.Oscillator) -> None:
    found = vi.attractors(s)
    again = pickle.loads(pickle.dumps(found))
    assert again.motions == found.motions and again.box == found.box and repr(again) == repr(found)


def test_shares_have_intervals(s: vi.Oscillator) -> None:
    """Wilson's interval and the share that may be missed, by their definitions."""
    found = vi.attractors(s, starts=100)
    z2 = 1.959963984540054**2 / 100
    for motion in found:
        p, (low, high) = motion.share, motion.share_interval
        # the ends of the interval are the shares from which the observed one is z standard errors away
        for end in (low, high):
            assert (p - end) ** 2 == pytest.approx(z2 * end * (1 - end), rel=1e-9)
        assert low < p < high
    assert found.missed_below == pytest.approx(1 - 0.05**0.01, rel=1e-14)
    data = found.to_dict()
    assert data["share_intervals"] == [list(m.share_interval) for m in found]
    assert data["missed_below"] == found.missed_below
    settled = vi.settle_many(s, x=[0.0] * 100, v=0.0, phase=0.0)
    assert settled.motions[0].share_interval == pytest.approx((1 / (1 + z2), 1.0), rel=1e-14)
