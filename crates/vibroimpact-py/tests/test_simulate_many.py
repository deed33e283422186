"""Many motions event by event, and their states at given times, phases and positions."""

import json
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

STARTS = {"x": np.array([-1.0, 0.1, 0.25, -3.0]), "v": np.array([0.3, 0.0, -1.0, 2.0]), "phase": np.array([0.0, 1.0, 2.0, 3.0])}


def alone(osc: vi.Oscillator, k: int, **limits: Any) -> vi.Simulation:
    return vi.simulate(osc, **{name: float(of[k]) for name, of in STARTS.items()}, **limits)


SYSTEMS = [
    vi.Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5),
    vi.Oscillator(beta=0.9, gap=0.25, restitution=0.4, damping=0.01, second_gap=4),
    vi.Oscillator(beta=0.5, gap=40, restitution=0.5),
]


@pytest.mark.parametrize("osc", SYSTEMS, ids=["chatter", "two stops", "no impact"])
@pytest.mark.parametrize("limits", [{"impacts": 40}, {"periods": 12.5}], ids=["impacts", "periods"])
def test_events_are_those_of_each_alone(osc: vi.Oscillator, limits: dict[str, Any]) -> None:
    ds = vi.simulate_many(osc, starts=STARTS, **limits)
    for k in range(4):
        sim, row = alone(osc, k, **limits), ds.isel(sample=k)
        count = row["count"].item()
        assert count == len(sim) and ds.vibro.labels("end").values[k] == sim.end and row["end_time"].item() == sim.end_time
        assert ds.vibro.labels("kind").values[k, :count].tolist() == sim.kind.tolist()
        for name, of in (("time", sim.time), ("event_phase", sim.phase), ("velocity_before", np.where(sim.kind == "impact", sim.speed, np.nan)), ("side", np.where(sim.stop == "upper", 1, -1))):
            assert np.array_equal(row[name].values[:count], of, equal_nan=of.dtype.kind == "f")
        assert np.isnan(row["time"].values[count:]).all() and (ds.vibro.labels("kind").values[k, count:] == "").all()


def test_states_at_one_phase_and_one_position(u: vi.Oscillator) -> None:
    starts = {"x": [0.1, -1.0], "v": [0.2, 0.0]}
    strobes = vi.simulate_many(u, starts=starts, phase=1.5, periods=20)
    assert dict(strobes.sizes) == {"sample": 2, "state": 20} and np.unique(strobes["force_phase"]).tolist() == [1.5]
    for k in range(2):
        same = vi.simulate_many(u, starts={name: of[k] for name, of in starts.items()}, at=strobes["time"].values[k])
        np.testing.assert_allclose(same["position"].values, strobes["position"].values[k], rtol=0, atol=1e-11)
    section = vi.simulate_many(u, starts=starts, position=-1.0, periods=20)
    signs = np.sign(section["velocity"].values)
    for k in range(2):
        row = section.isel(sample=k).dropna("state")
        assert row.sizes["state"] > 10 and (signs[k, 1 : row.sizes["state"]] == -signs[k, : row.sizes["state"] - 1]).all()
        same = vi.simulate_many(u, starts={name: of[k] for name, of in starts.items()}, at=row["time"].values)
        np.testing.assert_allclose(same["position"].values, -1.0, rtol=0, atol=1e-12)
        np.testing.assert_allclose(same["velocity"].values, row["velocity"].values, rtol=0, atol=1e-11)


def test_of_many_systems_and_in_si() -> None:
    machine = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6)
    ds = vi.simulate_many(machine, over={"gap_m": [0.003, 0.004]}, impacts=5)
    one = vi.simulate(machine.replace(gap_m=0.004), impacts=5)
    assert ds["time"].values[1].tolist() == one.time.tolist() and machine.units is not None
    si = ds.vibro.si()
    np.testing.assert_allclose(si["time"].values[1], one.time * machine.units.time_s, rtol=1e-14)
    assert json.loads(ds.attrs["system"])["machine"]


def test_questions_that_make_no_sense(s: vi.Oscillator) -> None:
    for given, sentence in (
        ({"at": [1.0, 0.5]}, "at falls from 1.0 to 0.5"),
        ({"at": [-1.0]}, "at = -1.0 is no time"),
        ({"at": [0.0], "phase": 1.0}, "at and phase are two questions"),
        ({"at": [0.0], "impacts": 5}, "impacts has no meaning with at"),
        ({"at": [0.0], "periods": 5}, "periods has no meaning with at"),
        ({"phase": np.inf}, "phase = inf is not a finite number"),
        ({"position": 0.75}, "start x = 0.75 lies beyond the stop|0.75"),
        ({"periods": 0, "position": 0.5}, "periods = 0 lies outside"),
        ({"impacts": -3}, "impacts = -3 lies outside 1 <= impacts <= 10000000"),
    ):
        with pytest.raises(vi.QuestionError, match=sentence):
            vi.simulate_many(s, **given)


HAMMER = vi.Machine.named("two-mass-hammer")
OF_HAMMER = {"q.head": [0.1, -0.2], "qdot.frame": [0.3, 0.0]}


def test_states_of_machines_are_those_of_their_waveforms() -> None:
    times = np.linspace(0.0, 30.0, 61)
    ds = HAMMER.simulate_many(over={"frequency": [1.1, 1.2]}, starts=OF_HAMMER, at=times)
    assert dict(ds.sizes) == {"sample": 2, "time": 61} and ds["start.q.head"].values.tolist() == OF_HAMMER["q.head"]
    for k, frequency in enumerate((1.1, 1.2)):
        start = {"q": [0.0, OF_HAMMER["q.head"][k]], "qdot": [OF_HAMMER["qdot.frame"][k], 0.0]}
        motion = HAMMER.set({"frequency": frequency}).simulate(**start, periods=6)
        wave = motion.waveform(0.5, events=False)
        assert wave.time[:60].tolist() == times[:60].tolist()
        for number, path in enumerate(("q.frame", "q.head")):
            np.testing.assert_allclose(ds[path].values[k, : len(wave)], wave.q[:61, number], rtol=0, atol=1e-12)
        np.testing.assert_allclose(ds["force_phase"].values[k, :60], wave.phase[:60], rtol=0, atol=1e-12)


def test_sections_of_machines() -> None:
    strobes = HAMMER.simulate_many(starts=OF_HAMMER, phase=1.5, periods=20)
    assert dict(strobes.sizes) == {"sample": 2, "state": 20} and np.unique(strobes["force_phase"]).tolist() == [1.5]
    period = HAMMER.period
    assert period is not None
    np.testing.assert_allclose(strobes["time"].values[0], (1.5 / (2 * np.pi) + np.arange(20)) * period, rtol=1e-14)
    section = HAMMER.simulate_many(starts=OF_HAMMER, position={"q.frame": 0.05}, periods=20)
    for ds in (strobes, section):
        for k in range(2):
            row = ds.isel(sample=k).dropna("state")
            one = {name: of[k] for name, of in OF_HAMMER.items()}
            same = HAMMER.simulate_many(starts=one, at=row["time"].values)
            assert row.sizes["state"] > 10
            for path in ("q.frame", "q.head", "qdot.frame", "qdot.head"):
                np.testing.assert_allclose(same[path].values, row[path].values, rtol=0, atol=1e-11)
    np.testing.assert_allclose(section["q.frame"].values[0], 0.05, rtol=0, atol=1e-12)
    signs = np.sign(section["qdot.frame"].isel(sample=0).dropna("state").values)
    assert (signs[1:] == -signs[:-1]).all()
    free = vi.Machine(coordinates=["x"], mass=[1], stiffness=[1], stops={"wall": {"at": "x", "gap": 0.5, "restitution": 0.5}})
    assert free.simulate_many(starts={"qdot.x": [1.0]}, at=[0.1])["q.x"].item() == pytest.approx(np.sin(0.1), abs=1e-15)
    for machine, given, sentence in (
        (HAMMER, {"position": 0.1}, "position = 0.1 of which coordinate"),
        (HAMMER, {"position": {"q.tail": 0.1}}, "there are q.frame, q.head"),
        (free, {"phase": 0.0}, "no forcing"),
        (free, {"position": 0.1}, "no forcing"),
    ):
        with pytest.raises(vi.QuestionError, match=sentence):
            machine.simulate_many(**given)
