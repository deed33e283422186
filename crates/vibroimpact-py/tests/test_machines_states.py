"""Whole states of machines: a motion that goes on from one is the motion, to the last bit."""

import numpy as np
import pytest

import vibroimpact as vi

PAD = vi.Machine(
    coordinates=["mass"],
    mass=[2],
    stiffness=[[1]],
    frequency=0.7,
    forces=[{"at": "mass", "sin": 1}],
    stops={"pad": {"at": "mass", "gap": 0.05, "stiffness": 3, "damping": 9}},
)


def test_a14_a_motion_goes_on_from_each_event():
    motion = PAD.simulate(impacts=20)
    surfaces = 0
    for k in range(10):
        state = motion.state(k)
        surfaces += state["contacts"]["pad"].get("surface", 0) > 0
        again = PAD.starting(state).simulate(impacts=10)
        for name in ("kind", "q", "qdot", "phase", "speed"):
            assert np.array_equal(getattr(again, name), getattr(motion, name)[k + 1 : k + 11]), (k, name)
    assert surfaces > 3
    assert motion.state() == motion.state(19) and motion.state(-2) == motion.state(18)
    with pytest.raises(IndexError):
        motion.state(20)


def test_a14_a_settled_state_is_whole():
    found = PAD.settle().motion
    assert set((found.state or {})["contacts"]["pad"]) <= {"state", "surface"}
    again = PAD.starting(found.state or {}).settle()
    assert again.motion.label == found.label


def test_a14_wrong_contacts_are_refused():
    with pytest.raises(vi.QuestionError, match="known names are pad"):
        PAD.starting({"contacts": {"pat": {"state": "open"}}})
    with pytest.raises(vi.QuestionError, match=r"contact\.pad: the stop has the gap 0\.05"):
        PAD.starting({"contacts": {"pad": {"state": "closed"}}}).simulate()
