"""The arrays of branches, and orbits that are inadmissible. Branches of machines are in `test_machine_answers.py`."""

import numpy as np
import pytest

import vibroimpact as vi


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


def test_solutions_that_are_no_motions_say_where_they_fail() -> None:
    (virtual,) = vi.orbits(vi.Oscillator(inverse_beta=1.9, gap=1, restitution=0.5), "1/1")
    contact = virtual.earlier_contact
    assert not virtual.admissible and contact is not None and (contact.after_impact, contact.stop) == (1, "upper")
    with pytest.raises(vi.QuestionError, match="is inadmissible"):
        virtual.waveform()
