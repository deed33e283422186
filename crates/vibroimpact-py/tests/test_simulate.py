"""Motions event by event, and their waveforms."""

import numpy as np

import vibroimpact as vi


def test_chatter_sticking_and_ends() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5)
    sim = vi.simulate(osc, periods=3)
    kinds = sim.kind.tolist()
    assert {"impact", "stick", "release"} == set(kinds) and sim.end == "time_limit" and sim.end_time == 3 * osc.period
    # it rests on the stop at the start, and later after a chatter
    assert kinds[0] == "stick" and not sim.chatter[0] and sim.error[0] == 0
    stick = kinds.index("stick", 1)
    assert sim.chatter[stick] and 0 < sim.error[stick] < 1e-9 and sim.speed[stick] == 0
    free = vi.simulate(vi.Oscillator(beta=0.5, gap=40, restitution=0.5))
    assert len(free) == 0 and free.end == "no_more_impacts" and free.horizon["why"] == "amplitude"


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
