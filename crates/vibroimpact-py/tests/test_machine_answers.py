"""What is computed for machines besides their events, compared with the command and with closed forms."""

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
    assert np.all(np.abs(motion.multipliers) < 1)
    # a rigid stop: the determinant of the monodromy matrix is restitution^2 times that of damping
    damping = np.trace(np.linalg.solve(np.diag([1, 0.5]), 0.1 * np.array([[2, -1], [-1, 1]])))
    restitution = HAMMER.number("stop.anvil.restitution")
    expected = restitution**2 * math.exp(-damping * (HAMMER.period or math.nan))
    assert abs(np.prod(motion.multipliers) - expected) < 1e-9 * expected
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
    f, fs, v = (belt.number(name) for name in ("f", "fs", "V"))
    period = 2 * (fs - f) / v + math.pi + 2 * math.atan(v / (fs - f))
    start, stop = motion.cycle.time
    assert abs(stop - start - 2 * (fs - f) / v) < 1e-12
    events = belt.starting(motion.state or {}).simulate(impacts=3)
    assert abs(events.time[2] - events.time[0] - period) < 1e-12
    assert [drawn.get_xlabel() for drawn in motion.plot()][-1] == "time"
    ds = vi.region_map(belt, {"V": [0.1, 1.0]}, starts=1)
    assert ds.vibro.labels().values[:, 0].tolist() == ["0/T", "0"]
    assert [text.get_text() for text in ds.vibro.plot().get_legend().get_texts()] == ["no impact", "0/T"]
    assert abs((motion.period or math.nan) - period) < 1e-12
    branch = belt.branch("V", 1.0)
    expected = 2 * (fs - f) / branch.parameter + math.pi + 2 * np.arctan(branch.parameter / (fs - f))
    assert np.allclose(branch.period, expected, atol=0, rtol=1e-12) and set(branch.label) == {"0/T"}
    assert branch.multipliers.shape == (len(branch), 1) and [event.kind for event in branch.events] == ["end of range"]
    orbits = belt.orbits("0/T")
    assert [orbit.label for orbit in orbits] == ["0/T"] and abs((orbits[0].period or math.nan) - period) < 1e-12


def test_a_capsule_drifts() -> None:
    capsule = vi.Machine.named("capsule")
    motion = capsule.settle().motion
    assert (motion.label, motion.stable, motion.multipliers.shape) == ("3/2", True, (3,))
    assert motion.drift is not None and motion.drift_velocity is not None and list(motion.drift) == ["mass", "capsule"]
    # two periods from its state lead to the same velocities, and on by the drift
    state = motion.state or {}
    qdot = state["qdot"]
    wave = capsule.starting(state).simulate(periods=2).waveform(events=True)
    assert np.allclose(wave.q[-1] - wave.q[0], list(motion.drift.values()), atol=1e-9, rtol=0)
    assert np.allclose(wave.qdot[-1], qdot, atol=1e-9)
    assert abs(motion.drift["mass"] / (2 * (capsule.period or math.nan)) - motion.drift_velocity["mass"]) < 1e-12
    exponents = capsule.lyapunov().exponents
    assert exponents is not None and len(exponents) == 4 and exponents[0].value == 0
    branch = capsule.branch("alpha", 1.55)
    assert branch.multipliers.shape == (len(branch), 3) and branch.drift.shape == (len(branch), 2)
    assert np.allclose(branch.drift[0], list(motion.drift.values()), atol=1e-9, rtol=0)
    assert HAMMER.settle().motion.drift is None and not HAMMER.branch("frequency", 1.19).drift.any()


def test_attractors_orbits_and_exponents_agree() -> None:
    found = HAMMER.attractors(12, seed=3, threads=1)
    assert found.starts == 12 == sum(motion.starts for motion in found) and abs(found.share.sum() - 1) < 1e-12
    orbits = HAMMER.orbits("1/1")
    stable = [orbit for orbit in orbits if orbit.stable]
    assert len(stable) == 1 and abs(stable[0].cycle.speed[0] - found[0].cycle.speed[0]) < 1e-8
    exponents = HAMMER.lyapunov(impacts=500).exponents
    largest = np.log(np.abs(stable[0].multipliers)) / (HAMMER.period or math.nan)
    assert exponents is not None and len(exponents) == 4
    assert all(abs(one.value - other) <= one.error + 1e-6 for one, other in zip(exponents, largest))


def test_a_branch_has_columns() -> None:
    found = HAMMER.branch("frequency", 1.05)
    assert found.parameter[0] == 1.2 and found.parameter[-1] == 1.05 and len(found.cycles) == len(found)
    assert found.multipliers.shape == (len(found), 4)
    assert [event.kind for event in found.events] == ["grazing", "fold", "end of range"]
    at = [event.point for event in found.events]
    assert found.parameter[at].tolist() == [event.parameter for event in found.events]
    assert [event.stop for event in found.events] == ["anvil", None, None] and found.events[1].before == "2/1"
    stable = np.abs(found.multipliers).max(axis=1) < 1
    ordinary = np.setdiff1d(np.arange(len(found)), at)
    assert np.array_equal(stable[ordinary], found.stable[ordinary]) and not found.stable.all()
    same = HAMMER.branch("frequency", 1.05, label="1/1", points=5)
    assert len(same) == 5 and [event.kind for event in same.events] == ["step limit"] and set(same.label) == {"1/1"}


def test_branches_follow_lines_orbits_and_flips() -> None:
    at = HAMMER.set(frequency=1.06)
    one, two = (at.branch("frequency", 1.065, label="2/1", orbit=k) for k in (1, 2))
    assert (one.orbit, two.orbit) == ((1, 2), (2, 2)) and not one.stable[0] and two.stable[0]
    orbits = at.orbits("2/1")
    assert [abs(found.speed[0] - orbit.cycle.speed[0]) < 1e-9 for found, orbit in zip((one, two), orbits)] == [True, True]
    with pytest.raises(vi.QuestionError, match="no orbit 2/1 number 3"):
        at.branch("frequency", 1.065, label="2/1", orbit=3)
    fold = {"frequency": (1.0, 1.1), "b": (0.45, 0.55)}
    curves = [at.curve("fold", fold, label="2/1", orbit=k, points=3) for k in (1, 2)]
    assert np.allclose(curves[0].found_at, curves[1].found_at, rtol=0, atol=1e-8)

    line = HAMMER.branch("frequency", 1.1, also={"stop.anvil.gap": 0.6})
    assert line.also == ("stop.anvil.gap", 0.5, 0.6) and line.second is not None and line.orbit is None
    assert np.allclose(line.second, 0.5 + (1.2 - line.parameter), rtol=0, atol=1e-12)
    assert line.to_dataframe()["stop.anvil.gap"].iloc[-1] == 0.6
    there = HAMMER.set({"frequency": 1.1, "stop.anvil.gap": 0.6}).settle().motion
    assert abs(there.cycle.speed.max() - line.speed[-1]) < 1e-9
    diagram = vi.orbit_diagram(HAMMER, "frequency", "1.1:1.2:3", also={"stop.anvil.gap": (0.6, 0.5)}, direction="up")
    assert diagram["stop.anvil.gap"].dims == ("frequency",)
    assert diagram["stop.anvil.gap"].values.tolist() == [0.6, 0.55, 0.5]
    assert abs(diagram["speed"].isel(frequency=0, sweep=0).max().item() - line.speed[-1]) < 1e-7

    branch = HAMMER.set(frequency=0.95).branch("frequency", 0.895, follow=1)
    (doubled,) = branch.followed
    (flip,) = [event for event in branch.events if event.kind == "flip"]
    assert doubled.origin == ("flip", flip.parameter, 1) and branch.origin is None
    assert "5/2" in set(doubled.label) and len(branch.to_dict()["branches"]) == 2
    assert doubled.to_dict() == branch.to_dict()["branches"][1]


def test_the_sections_of_an_attractor() -> None:
    found = HAMMER.set(frequency=1.06).lyapunov(impacts=200, points=30)
    cycle = found.motion.cycle
    assert found.closings.q.shape == found.strobes.qdot.shape == (30, 2) and set(found.closings.stop) == {"anvil"}
    near = np.abs(found.closings.speed[:, None] - cycle.speed) + np.abs(found.closings.phase[:, None] - cycle.phase)
    assert np.all(near.min(axis=1) < 1e-9)
    assert np.ptp(found.strobes.q, axis=0).max() < 1e-9
    bare = HAMMER.lyapunov(impacts=200)
    assert bare.closings.q.shape == bare.strobes.q.shape == (0, 2)
    with pytest.raises(vi.QuestionError, match="no points of the sections"):
        bare.plot_sections()
    with pytest.raises(vi.QuestionError, match="no section at a phase"):
        vi.Machine.named("sdnd122").lyapunov(points=10)


def test_a_curve_is_that_of_the_closed_form() -> None:
    ball = vi.Machine.named("bouncing-ball").set(Gamma=1.2)
    found = ball.curve("fold", {"Gamma": (0.2, 3), "e": (0.3, 0.8)}, label="1/1")
    gamma, e = found.values.T
    assert len(found) > 10 and np.allclose(gamma, math.pi * (1 - e) / (1 + e), rtol=0, atol=1e-9)
    assert found.parameters == ("Gamma", "e") and [event.kind for event in found.events] == ["end of box"] * 2
    assert found.multipliers.shape == (len(found), 2) and np.all(found.residual < 1e-9)
    assert np.allclose(found.values[found.through[1]], [found.found_at[found.through[0] - 1], 0.5], atol=1e-9)
    with pytest.raises(vi.QuestionError, match="a plane has two"):
        ball.curve("fold", {"Gamma": (0.2, 3)})
    with pytest.raises(vi.QuestionError, match="unknown variant"):
        ball.curve("folds", {"Gamma": (0.2, 3), "e": (0.3, 0.8)})


def test_a_curve_of_holding_is_that_of_den_hartog() -> None:
    # the mass begins to stick at its turning points: J. P. Den Hartog, Trans. ASME 53 (1931), 107-115
    oscillator = vi.Machine.named("den-hartog")
    found = oscillator.curve("holding", {"f": (0.05, 1.2), "b": (0.6, 0.97)}, event=1)
    f, b = found.values.T
    u = np.sin(np.pi / b) / (b * (1 + np.cos(np.pi / b)))
    assert len(b) > 10 and np.allclose(f, b**2 / (1 - b**2) / np.sqrt(1 + b**4 * u**2), rtol=0, atol=1e-12)
    assert found.kind == "holding" and [event.kind for event in found.events] == ["end of box"] * 2


def test_basins_and_maps_have_the_shape_of_their_axes() -> None:
    pytest.importorskip("xarray")
    found = HAMMER.basin({"q.head": "-1:1:5", "qdot.head": "-1:1:3"}, threads=2)
    assert found["label"].dims == ("qdot.head", "q.head") and found["q.head"].values.tolist() == [-1, -0.5, 0, 0.5, 1]
    # beyond the anvil
    assert np.all(found["label"].isel({"q.head": 4}) == -5) and set(found.vibro.labels().values[:, :4].ravel()) == {"1/1"}
    over = HAMMER.map({"frequency": "0.8:1.2:3", "stop.anvil.gap": "0.5:0.6:2"}, starts=2, seed=2)
    assert over["label"].dims == ("stop.anvil.gap", "frequency", "motion")
    assert np.allclose(over["share"].sum("motion"), 1)
    # the same machine at a point
    labels = over.vibro.labels().values
    for k, frequency in enumerate(over["frequency"].values):
        alone = HAMMER.set({"frequency": frequency, "stop.anvil.gap": 0.6}).attractors(2, seed=2)
        assert {m.label for m in alone} == {label for label in labels[1, k] if label}


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: HAMMER.settle(q=[1, 2, 3]), "start.q: has 3 numbers, and 2 are needed"),
        (lambda: HAMMER.branch("stop.anvil.gapp", 1), "no such number"),
        (lambda: HAMMER.basin({"q.tail": "0:1:2"}), "q.tail"),
        (lambda: HAMMER.map({"frequency": "0.8:1.2:3"}, starts=0), "starts"),
        (lambda: HAMMER.orbits("one"), "one"),
        (lambda: vi.Machine.named("sdnd101").orbits("1/1"), "forcing"),
    ],
)
def test_refusals(call: Callable[[], Any], said: str) -> None:
    with pytest.raises(vi.QuestionError, match="(?s)" + said.replace(".", r"\.")):
        call()


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


def test_quantities_by_path() -> None:
    """Of every part, with the energy balance of a cycle with a compliant stop and a friction joint, and error bars of chaos."""
    machine = vi.Machine(
        coordinates=["a", "b"], mass=[1, 0.5], stiffness=[[2, -1], [-1, 1]], damping=[0.1, 0.05], frequency=0.9,
        forces=[{"at": "a", "sin": 1}],
        stops={"pad": {"at": "a", "gap": 0.4, "stiffness": 50, "damping": 0.5}},
        joints={"guide": {"at": "b", "sliding": 0.05}},
    )
    of = machine.settle().motion.quantities
    assert of is not None
    lost = sum(of[f"{kind}_power"] for kind in ("impact", "contact", "friction", "damping"))
    assert abs(of["power"] - lost) < 1e-12 * lost
    assert of["stop.pad.force_max"] > 0 and of["friction.guide.friction_loss_per_period"] > 0
    assert of["force.1.work_per_period"] == pytest.approx(of["work_per_period"])
    assert of["q.b.displacement_min"] < of["q.b.displacement_mean"] < of["q.b.displacement_max"]
    chaotic = vi.Machine(
        bodies={"mass": 1}, links=[{"between": ["mass", "ground"], "stiffness": 1}], frequency=1 / 1.11,
        forces=[{"at": "mass", "sin": 1}], stops={"wall": {"at": "mass", "gap": 3, "restitution": 0.5}},
    ).settle().motion
    assert chaotic.kind == "chaotic" and chaotic.quantities is not None and chaotic.quantities_error is not None
    assert 0 < chaotic.quantities_error["power"] < 0.05 * chaotic.quantities["power"]
    assert "stop.wall.impact_speed_max" not in chaotic.quantities_error


SLIDER = """
[machine]
coordinates = ["slider", "hammer"]
mass = [1, 1]
stiffness = [[1, -1], [-1, 1]]
damping = [[0.2, -0.2], [-0.2, 0.2]]
frequency = 1.0
[[machine.force]]
order = 1
cos = [0, 0.05]
sin = [0, 0]
[[machine.stop]]
name = "right"
direction = [0, 1]
gap = 1.0
restitution = 0.5
[[machine.stop]]
name = "left"
direction = [0, -1]
gap = 1.0
restitution = 0.5
[[machine.friction]]
name = "ground"
direction = [1, 0]
sliding = 5
static = 5
"""


def test_rests_name_their_stops() -> None:
    """42.8: rests on different stops are different motions."""
    machine = vi.Machine.from_toml(SLIDER)
    stuck = [machine.settle(q=[q, 0]) for q in (-3, 3)]
    assert [motion.stops for motion in stuck] == [("left",), ("right",)]
    assert {motion.stability for motion in stuck} == {"neutral"} and not stuck[0].stable
    assert repr(stuck[0]) == "<Settled stuck on left, neutral>"
