"""Machines of several coordinates: as files, from arrays, their motions, states and waveforms."""

import math
import pickle
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import _core

NAMES = _core.machine_names()


@pytest.mark.parametrize("name", NAMES)
def test_files_read_as_the_same_machine(name: str, tmp_path: Path) -> None:
    machine = vi.Machine.named(name)
    assert vi.Machine.from_toml(machine.toml()) == machine
    file = tmp_path / "machine.toml"
    file.write_text(machine.toml())
    assert vi.Machine.from_toml(file) == machine == vi.Machine.from_toml(str(file))
    assert pickle.loads(pickle.dumps(machine)) == machine and hash(vi.Machine.from_toml(file)) == hash(machine)
    # the expansion moves as the machine does
    expanded = vi.Machine.from_toml(machine.toml(expanded=True))
    one, other = machine.simulate(impacts=20), expanded.simulate(impacts=20)
    assert np.array_equal(one.time, other.time) and np.array_equal(one.q, other.q)
    assert all(math.isfinite(machine.number(path)) for path in machine.paths)
    assert machine.coordinates[0] in repr(machine)


def two(**changes: object) -> vi.Machine:
    given: dict[str, object] = {
        "coordinates": ["body", "shoe"],
        "mass": np.array([1.0, 2.0]),
        "stiffness": np.array([[1.0, -1.0], [-1.0, 2.0]]),
        "damping": 0.03 * np.array([[1.0, -1.0], [-1.0, 2.0]]),
        "frequency": np.float64(0.66),
        "forces": [{"order": 1, "cos": np.array([0.0, 0.5])}],
        "stops": [{"name": "wall", "direction": np.array([1, 0]), "gap": 0.2, "restitution": 0.8}],
        "joints": {"guide": {"direction": [0, 1], "sliding": 0.02, "static": 0.03}},
    }
    return vi.Machine(**(given | changes))  # type: ignore[arg-type]


def test_arrays_are_the_same_as_a_file() -> None:
    text = """
[machine]
bodies = { body = 1, shoe = 2 }
frequency = 0.66
link = [{ between = ["body", "shoe"], stiffness = 1, damping = 0.03 },
        { between = ["shoe", "ground"], stiffness = 1, damping = 0.03 }]
force = [{ at = "shoe", cos = 0.5 }]
stop = [{ name = "wall", at = "body", gap = 0.2, restitution = 0.8 }]
friction = [{ name = "guide", at = "shoe", sliding = 0.02, static = 0.03 }]
"""
    machine = two()
    assert machine.toml(expanded=True) == vi.Machine.from_toml(text).toml(expanded=True)
    assert vi.Machine.from_toml(machine.toml()) == machine
    assert machine.coordinates == ("body", "shoe") and machine.stops == ("wall",) and machine.joints == ("guide",)
    assert machine.period == pytest.approx(2 * math.pi / 0.66, rel=1e-15)
    assert repr(machine) == "<Machine of 2 coordinates: body, shoe; stops: wall; joints: guide>"


def test_numbers_by_path() -> None:
    machine = vi.Machine(parameters={"mu": 0.25}, bodies={"a": 1, "b": "2*mu"},
                         links=[{"between": ["a", "b"], "stiffness": 3}])
    assert machine.number("mass.b") == 0.5
    heavy = machine.set(mu=1)
    assert heavy.number("mass.b") == 2 and machine.number("mass.b") == 0.5 and heavy != machine
    assert machine.set({"link.a-b.stiffness": 5, "stiffness.a": 7}).number("stiffness.a") == 7
    assert "mu" in machine.paths and "stiffness.a.b" in machine.paths


def test_modes_beside_a_file(tmp_path: Path) -> None:
    (tmp_path / "modes.csv").write_text("frequency,damping_ratio,tip\n1,0.01,2\n6,0.01,-2\n")
    file = tmp_path / "beam.toml"
    file.write_text('[machine]\nmodes = "modes.csv"\nstop = [{ name = "s", at = "tip", gap = 1, restitution = 0.5 }]\n')
    machine = vi.Machine.from_toml(file)
    assert machine.coordinates == ("mode1", "mode2") and machine.number("mode.2.shape.tip") == -2
    with pytest.raises(vi.QuestionError, match="`modes.csv` cannot be read"):
        vi.Machine.from_toml(file.read_text())


def test_refusals() -> None:
    for make, said in [
        (lambda: vi.Machine.named("hammer"), "is no machine of the catalogue"),
        (lambda: two(mass=[1, -1]), "mass"),
        (lambda: two(mass=[[1, 2], [3, 4]]), "mass"),
        (lambda: two(stops=[{"name": "s", "gap": 1}]), "stop"),
        (lambda: two(stops=[{"name": "s", "gapp": 1}]), "unknown field `gapp`"),
        (lambda: two(mass=[1, math.nan]), "mass"),
        (lambda: two().set({"stop.wall.gapp": 1}), "no such number"),
        (lambda: two().number("x.y"), "no such number"),
        (lambda: two().simulate(q=[1]), "start.q: has 1 numbers, and 2 are needed"),
        (lambda: two().simulate(q=[1, 0]), "wall"),
        (lambda: two().simulate(periods=-1), "periods = -1"),
        (lambda: two().simulate(impacts=0), "impacts = 0"),
        (lambda: two().simulate(impacts=3).waveform(0), "step = 0"),
        (lambda: two(frequency=None, forces=None).simulate(periods=3), "no forcing"),
    ]:
        with pytest.raises(vi.QuestionError, match=said):
            make()


def test_a_waveform_is_even_and_has_the_events() -> None:
    motion = two().simulate(periods=10)
    assert len(motion) > 10 and {"impact", "slip"} <= set(motion.kind.tolist())
    wave = motion.waveform(0.125, events=False)
    assert np.array_equal(wave.time, 0.125 * np.arange(len(wave))) and wave.time[-1] <= motion.end_time
    assert wave.q.shape == wave.qdot.shape == (len(wave), 2)
    assert wave.gap.shape == (len(wave), 1) and wave.force.shape == (len(wave), 2)
    full = motion.waveform(0.125, events=True)
    assert set(wave.time) <= set(full.time) and set(motion.time) <= set(full.time) and full.time[-1] == motion.end_time
    assert np.all(full.gap[:, 0] > -1e-14) and np.all(np.abs(full.force[:, 1]) <= 0.03 * (1 + 1e-12))
    struck = np.flatnonzero(motion.kind == "impact")[0]
    sides = np.flatnonzero(full.time == motion.time[struck])
    before, after = full.qdot[sides[0], 0], full.qdot[sides[-1], 0]
    assert before == pytest.approx(motion.speed[struck], rel=1e-12) and after == pytest.approx(-0.8 * before, rel=1e-12)


@pytest.mark.parametrize(("name", "panels"), [("two-mass-hammer", 1), ("soft-stop", 2), ("cantilever", 2), ("chain", 2)])
def test_figures(name: str, panels: int, tmp_path: Path) -> None:
    axes = vi.Machine.named(name).simulate(periods=8).plot()
    assert len(axes) == panels and axes[-1].get_xlabel() == "time"
    machine = vi.Machine.named(name)
    labels = axes[0].get_legend_handles_labels()[1]
    assert set(machine.coordinates[:6]) <= set(labels)
    axes[0].figure.savefig(tmp_path / "a.png")
    import matplotlib.pyplot as plt

    given = plt.subplots()[1]
    assert machine.simulate(impacts=2).plot([given])[0] is given


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


def test_a14_wrong_contacts_are_refused():
    with pytest.raises(vi.QuestionError, match="known names are pad"):
        PAD.starting({"contacts": {"pat": {"state": "open"}}})
    with pytest.raises(vi.QuestionError, match=r"contact\.pad: the stop has the gap 0\.05"):
        PAD.starting({"contacts": {"pad": {"state": "closed"}}}).simulate()
