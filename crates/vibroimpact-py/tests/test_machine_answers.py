"""Answers about machines as columns and views. That they are those of the command is in `test_command.py`; what they are is tested in the core."""

import json
import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

HAMMER = vi.Machine.named("two-mass-hammer")


def test_a_settled_motion_has_columns() -> None:
    found = HAMMER.settle(q=[0.1, 0])
    motion, cycle = found.motion, found.motion.cycle
    assert (motion.label, motion.kind, motion.stable, motion.counts) == ("1/1", "periodic", True, {"anvil": 1})
    assert motion.multipliers.shape == (4,) and motion.multipliers.dtype == np.complex128
    assert cycle.kind.tolist() == ["impact"] and cycle.stop.tolist() == ["anvil"]
    assert cycle.q.shape == cycle.qdot.shape == (1, 2) and abs(cycle.q[0, 1] - HAMMER.number("stop.anvil.gap")) < 1e-12
    assert json.loads(found.plan)["start"] == {"q": [0.1, 0.0], "qdot": [0.0, 0.0]}
    # one period from its state leads back to it
    state = motion.state or {}
    q, qdot = state["q"], state["qdot"]
    wave = HAMMER.starting(state).simulate(periods=1).waveform(events=True)
    assert np.allclose(wave.q[-1], q, atol=1e-9) and np.allclose(wave.qdot[-1], qdot, atol=1e-9)


def test_a_limit_cycle_without_forcing() -> None:
    belt = vi.Machine.named("stick-slip")
    motion = belt.settle().motion
    assert (motion.label, motion.kind, motion.stable, motion.impacts, motion.periods) == ("0/T", "periodic", True, 0, None)
    assert motion.cycle.kind.tolist() == ["hold", "slip"] and motion.multipliers.shape == (1,)
    events = belt.starting(motion.state or {}).simulate(impacts=3)
    assert abs(events.time[2] - events.time[0] - (motion.period or math.nan)) < 1e-12
    assert [drawn.get_xlabel() for drawn in motion.plot()][-1] == "time"
    ds = vi.region_map(belt, {"V": [0.1, 1.0]}, starts=1)
    assert ds.vibro.labels().values[:, 0].tolist() == ["0/T", "0"]
    assert [text.get_text() for text in ds.vibro.plot().get_legend().get_texts()] == ["no impact", "0/T"]
    branch = belt.branch("V", 1.0)
    assert branch.period[0] == motion.period and branch.multipliers.shape == (len(branch), 1)


def test_a_capsule_drifts() -> None:
    capsule = vi.Machine.named("capsule")
    motion = capsule.settle().motion
    assert (motion.label, motion.stable, motion.multipliers.shape) == ("3/2", True, (3,))
    assert motion.drift is not None and motion.drift_velocity is not None and list(motion.drift) == ["mass", "capsule"]
    branch = capsule.branch("alpha", 1.55)
    assert branch.multipliers.shape == (len(branch), 3) and branch.drift.shape == (len(branch), 2)
    assert np.allclose(branch.drift[0], list(motion.drift.values()), atol=1e-9, rtol=0)
    assert HAMMER.settle().motion.drift is None and not HAMMER.branch("frequency", 1.19).drift.any()


def test_a_branch_has_columns() -> None:
    found = HAMMER.branch("frequency", 1.05)
    assert found.parameter[0] == 1.2 and found.parameter[-1] == 1.05 and len(found.cycles) == len(found)
    assert found.multipliers.shape == (len(found), 4)
    assert [event.kind for event in found.events] == ["grazing", "fold", "end of range"]
    at = [event.point for event in found.events]
    assert found.parameter[at].tolist() == [event.parameter for event in found.events]
    assert [event.stop for event in found.events] == ["anvil", None, None] and found.events[1].before == "2/1"


def test_branches_follow_lines_orbits_and_flips() -> None:
    one = HAMMER.set(frequency=1.06).branch("frequency", 1.065, label="2/1", orbit=1)
    assert one.orbit == (1, 2) and not one.stable[0]
    line = HAMMER.branch("frequency", 1.1, also={"stop.anvil.gap": 0.6})
    assert line.also == ("stop.anvil.gap", 0.5, 0.6) and line.second is not None and line.orbit is None
    assert np.allclose(line.second, 0.5 + (1.2 - line.parameter), rtol=0, atol=1e-12)
    assert line.to_dataframe()["stop.anvil.gap"].iloc[-1] == 0.6
    diagram = vi.orbit_diagram(HAMMER, "frequency", "1.1:1.2:3", also={"stop.anvil.gap": (0.6, 0.5)}, direction="up")
    assert diagram["stop.anvil.gap"].dims == ("frequency",)
    assert diagram["stop.anvil.gap"].values.tolist() == [0.6, 0.55, 0.5]

    branch = HAMMER.set(frequency=0.95).branch("frequency", 0.895, follow=1)
    (doubled,) = branch.followed
    (flip,) = [event for event in branch.events if event.kind == "flip"]
    assert doubled.origin == ("flip", flip.parameter, 1) and branch.origin is None
    assert "5/2" in set(doubled.label) and len(branch.to_dict()["branches"]) == 2
    assert doubled.to_dict() == branch.to_dict()["branches"][1]


def test_the_sections_of_an_attractor() -> None:
    found = HAMMER.set(frequency=1.06).lyapunov(impacts=200, points=30)
    assert found.closings.q.shape == found.strobes.qdot.shape == (30, 2) and set(found.closings.stop) == {"anvil"}
    bare = HAMMER.lyapunov(impacts=200)
    assert bare.closings.q.shape == bare.strobes.q.shape == (0, 2)
    with pytest.raises(vi.QuestionError, match="no points of the sections"):
        bare.plot_sections()


def test_a_curve_is_that_of_the_closed_form() -> None:
    ball = vi.Machine.named("bouncing-ball").set(Gamma=1.2)
    found = ball.curve("fold", {"Gamma": (0.2, 3), "e": (0.3, 0.8)}, label="1/1")
    gamma, e = found.values.T
    assert len(found) > 10 and np.allclose(gamma, math.pi * (1 - e) / (1 + e), rtol=0, atol=1e-9)
    assert found.parameters == ("Gamma", "e") and [event.kind for event in found.events] == ["end of box"] * 2
    assert found.multipliers.shape == (len(found), 2) and np.all(found.residual < 1e-9)
    assert np.allclose(found.values[found.through[1]], [found.found_at[found.through[0] - 1], 0.5], atol=1e-9)


def test_progress_stops() -> None:
    seen = []

    def stop(done: int, total: int) -> bool:
        seen.append((done, total))
        return False

    axes = {"q.head": "-1:0.4:200", "qdot.head": "-1:1:200"}
    with pytest.raises(vi.StoppedError):
        HAMMER.basin(axes, progress=stop, threads=1)
    assert seen[0][1] == 40_000


#: 1/beta = 1.11, a gap of 3 F/k.
CHAOTIC = vi.Machine(
    coordinates=["x"], mass=[1], stiffness=[1], frequency=1 / 1.11, forces=[{"at": "x", "cos": 1}],
    stops={"wall": {"at": "x", "gap": 3, "restitution": 0.5}},
)


@pytest.mark.parametrize("ask", [
    lambda **of: HAMMER.simulate(impacts=10_000_000, **of),
    lambda **of: CHAOTIC.lyapunov(impacts=10_000_000, **of),
    lambda **of: HAMMER.branch("frequency", 0.2, points=100_000, **of),
], ids=["simulate", "lyapunov", "branch"])
def test_long_work_on_one_motion_stops(ask: Callable[..., Any]) -> None:
    begun = time.monotonic()
    with pytest.raises(vi.StoppedError):
        ask(progress=lambda done, total: False)
    assert time.monotonic() - begun < 5
