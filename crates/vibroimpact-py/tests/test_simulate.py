"""Events compared with a numerical integrator."""

import math
import pickle

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi


def integrated(osc: vi.Oscillator, x: float, v: float, phase: float, impacts: int) -> list[tuple[float, float, int]]:
    """Times, speeds and sides of impacts by an adaptive integrator with event location."""
    beta, zeta = osc.beta, osc.damping
    stops = [(osc.gap, 1, osc.restitution)]
    if osc.second_gap is not None and osc.second_restitution is not None:
        stops.append((-osc.second_gap, -1, osc.second_restitution))

    def field(t: float, y: np.ndarray) -> list[float]:
        return [y[1], math.sin(beta * t + phase) - y[0] - 2 * zeta * y[1]]

    def reaches(at: float, sign: int):
        def distance(_t: float, y: np.ndarray) -> float:
            return sign * (y[0] - at)

        distance.terminal, distance.direction = True, 1
        return distance

    found, t, y = [], 0.0, [x, v]
    events = [reaches(at, sign) for at, sign, _ in stops]
    while len(found) < impacts:
        run = solve_ivp(field, (t, t + 100), y, "DOP853", events=events, rtol=1e-13, atol=1e-14, max_step=0.05)
        which = next(k for k, times in enumerate(run.t_events) if len(times))
        at, sign, restitution = stops[which]
        t, speed = float(run.t_events[which][0]), sign * float(run.y_events[which][0][1])
        found.append((t, speed, sign))
        # slightly off the stop, so that the event is not detected again
        y = [at - sign * 1e-15, -sign * restitution * speed]
    return found


@pytest.mark.parametrize(
    ("osc", "start"),
    [
        (vi.Oscillator(beta=0.77, gap=0.75, restitution=0.5), (-2.0, 0.5, 0.3)),
        (vi.Oscillator(beta=1.4, gap=0.2, restitution=0.9, damping=0.05), (0.0, 0.0, 2.0)),
        (vi.Oscillator(beta=1.0, gap=0.5, restitution=0.8, second_gap=0.7, second_restitution=0.6), (0.1, 0.0, 1.0)),
    ],
)
def test_impacts_as_an_integrator_finds_them(osc: vi.Oscillator, start: tuple[float, float, float]) -> None:
    x, v, phase = start
    sim = vi.simulate(osc, x=x, v=v, phase=phase, impacts=8)
    expected = integrated(osc, x, v, phase, 8)
    assert sim.kind.tolist() == ["impact"] * 8 and sim.end == "impact_limit"
    np.testing.assert_allclose(sim.time, [t for t, _, _ in expected], atol=1e-8)
    np.testing.assert_allclose(sim.speed, [u for _, u, _ in expected], atol=1e-8)
    wrapped = (osc.beta * sim.time + phase) % (2 * math.pi)
    np.testing.assert_allclose(sim.phase, wrapped, atol=1e-12)
    assert sim.stop.tolist() == ["upper" if side > 0 else "lower" for _, _, side in expected]
    side = np.where(sim.stop == "upper", 1, -1)
    restitution = np.where(side > 0, osc.restitution, osc.second_restitution or 0.0)
    np.testing.assert_array_equal(sim.qdot[:, 0], -side * restitution * sim.speed)


def test_waveform_obeys_the_equation_and_the_stop(n: vi.Oscillator) -> None:
    sim = vi.simulate(n, periods=6)
    wave = sim.waveform(n.period / 400)
    t, x, v = wave.time, wave.q[:, 0], wave.qdot[:, 0]
    # the time of each leg is a sum, so two legs may differ by a rounding error
    assert t[0] == 0 and t[-1] == sim.end_time and np.all(np.diff(t) > -1e-13) and x.max() <= n.gap + 1e-14
    # central differences in free flight, between events
    h = np.diff(t)
    flies = (x[:-2] < n.gap) | (x[1:-1] < n.gap) | (x[2:] < n.gap)
    smooth = (h[:-1] > 1e-6) & (np.abs(h[:-1] - h[1:]) < 1e-9) & flies
    force = np.sin(n.beta * t[1:-1]) - x[1:-1]
    acceleration = (v[2:] - v[:-2]) / (t[2:] - t[:-2])
    assert np.count_nonzero(smooth) > 1000
    assert np.max(np.abs(acceleration - force)[smooth]) < 1e-3


def test_chatter_sticking_and_release_are_events() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5)
    sim = vi.simulate(osc, periods=3)
    kinds = sim.kind.tolist()
    assert {"impact", "stick", "release"} == set(kinds) and sim.end == "time_limit" and sim.end_time == 3 * osc.period
    # it rests on the stop at the start, and later after a chatter
    assert kinds[0] == "stick" and not sim.chatter[0] and sim.error[0] == 0
    stick = kinds.index("stick", 1)
    assert sim.chatter[stick] and 0 < sim.error[stick] < 1e-9 and sim.speed[stick] == 0
    # released where the force no longer presses the mass: sin theta = gap, with falling magnitude
    release = kinds.index("release")
    assert math.isclose(math.sin(sim.phase[release]), osc.gap, abs_tol=1e-14)


def test_ends_that_are_no_limit() -> None:
    stuck = vi.simulate(vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5))
    assert stuck.end == "stuck"
    free = vi.simulate(vi.Oscillator(beta=0.5, gap=40, restitution=0.5))
    assert len(free) == 0 and free.end == "no_more_impacts" and free.horizon is not None
    assert free.horizon["why"] == "amplitude" and free.horizon["periods"] is None


def test_it_can_be_pickled(n: vi.Oscillator) -> None:
    sim = vi.simulate(n, x=-1, impacts=50)
    again = pickle.loads(pickle.dumps(sim))
    assert again.to_dict() == sim.to_dict() and again.plan == sim.plan and repr(again) == repr(sim)


def test_a_waveform_has_gaps_contacts_and_forces() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5)
    sim = vi.simulate(osc, periods=3)
    wave = sim.waveform()
    assert wave.q.shape == wave.gap.shape == wave.force.shape == (len(wave), 1) and len(wave.to_dataframe()) == len(wave)
    np.testing.assert_array_equal(wave.gap[:, 0], osc.gap - wave.q[:, 0])
    np.testing.assert_allclose(np.sin(wave.phase - osc.beta * wave.time), 0, atol=1e-12)
    rests = wave.contact[:, 0]
    # pressed by what force and spring leave, from each stick to the next release
    np.testing.assert_allclose(wave.force[rests, 0], np.sin(wave.phase[rests]) - osc.gap, atol=1e-12)
    assert rests.any() and not wave.force[~rests].any()
    even = sim.waveform(0.125, events=False)
    np.testing.assert_array_equal(even.time, 0.125 * np.arange(len(even)))
    assert even.time[-1] <= sim.end_time < even.time[-1] + 0.125
    np.testing.assert_allclose(even.q[:, 0], np.interp(even.time, wave.time, wave.q[:, 0]), atol=5e-3)
    # the same body as a machine
    machine = vi.Machine(
        coordinates=["x"], mass=[1], stiffness=[1], frequency=osc.beta, forces=[{"at": "x", "sin": 1}],
        stops={"stop": {"at": "x", "gap": -0.5, "restitution": 0.5}}, start={"q": [-0.5]},
    )
    other = machine.simulate(periods=3).waveform(0.125, events=False)
    for name in ("q", "qdot", "gap", "force"):
        np.testing.assert_allclose(getattr(even, name), getattr(other, name), atol=1e-9, err_msg=name)
    assert vi.simulate(osc, impacts=3).state(0)["q"] == [osc.gap]
