"""Branches: their points, events and arrays; orbits that are inadmissible."""

import numpy as np
import pytest

import vibroimpact as vi


def test_points_are_orbits_and_branches_begin_at_flips() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    found = vi.branch(osc, "gap", 2.5, label="1/1", follow=3)
    flip = next(event for event in found.events if event.kind == "flip")
    assert abs(found.multipliers[flip.point] + 1).min() < 1e-9
    # every point is an orbit that is found independently at its value
    for k in (0, len(found) // 2, len(found) - 1):
        orbits = vi.orbits(osc.replace(gap=found.parameter[k]), "1/1")
        assert min(abs(orbit.cycle.speed[0] - found.speed[k]) for orbit in orbits) < 1e-10
    assert found.stable[0] and not found.stable[-1] and found.parameter[-1] == 2.5
    doubled = found.followed[0]
    assert doubled.origin is not None and doubled.origin.kind == "flip" and doubled.label[1] == "2/2"
    assert doubled.origin.parameter == flip.parameter and doubled.origin.branch == 1


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


def test_a_line_through_two_parameters() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5)
    found = vi.branch(osc, "gap", 2.5, label="1/1", also={"inverse_beta": 1.05})
    assert found.also == ("inverse_beta", 1.11, 1.05) and found.second is not None
    np.testing.assert_allclose(found.second, 1.11 - 0.06 * (found.parameter - 1.5), atol=1e-15)
    flip = next(event for event in found.events if event.kind == "flip")
    assert flip.values is not None and flip.values == [flip.parameter, found.second[flip.point]]
    assert found.to_dict()["also"] == {"parameter": "inverse_beta", "from": 1.11, "to": 1.05}
    assert "with 1/$β$ from 1.11 to 1.05" in found.plot(diagram=True).get_xlabel()


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
