"""Shares of starts."""

import pickle

import pytest

import vibroimpact as vi


def test_two_motions_share_the_starts(s: vi.Oscillator) -> None:
    found = vi.attractors(s, starts=500)
    assert len(found) == 2 and {motion.label for motion in found} == {"1/1", "2/1"}
    assert found[0].share >= found[1].share and sum(motion.count for motion in found) == 500
    assert sum(motion.share for motion in found) == pytest.approx(1)
    assert found.box["x"][1] == s.gap
    assert vi.attractors(s, starts=500, threads=3).motions == found.motions
    assert [m.count for m in vi.attractors(s, starts=500, seed=7)] != [m.count for m in found]


def test_it_can_be_pickled(s: vi.Oscillator) -> None:
    found = vi.attractors(s)
    again = pickle.loads(pickle.dumps(found))
    assert again.motions == found.motions and again.box == found.box and repr(again) == repr(found)
