"""Orbits that are inadmissible."""

import pickle

import pytest

import vibroimpact as vi


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
