"""Verdicts on one motion and on many; shares of starts; exponents compared with exact values."""

import math
import pickle

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact._arguments import numbers


def test_the_motion_at_s_is_the_published_cycle(s: vi.Oscillator) -> None:
    motion = vi.settle(s)
    assert (motion.kind, motion.label, motion.impacts, motion.periods, motion.stable) == ("periodic", "2/1", 2, 1, True)
    # 40-digit arithmetic, rounded
    np.testing.assert_allclose(motion.cycle.phase, [0.82998967146192075, 3.19459089385777344], rtol=1e-14)
    np.testing.assert_allclose(motion.cycle.speed, [2.64401858778543508, 0.77762665463488177], rtol=1e-14)
    assert motion.multipliers is not None and motion.multipliers.dtype == np.complex128
    np.testing.assert_allclose(motion.multipliers, [0.443795500242, 0.140830630247], rtol=1e-10)
    np.testing.assert_allclose(motion.period, s.period, rtol=1e-15)


@pytest.mark.parametrize(
    ("osc", "kind", "label"),
    [
        (vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5), "chaotic", "chaotic"),
        (vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5), "stuck", "stuck"),
        (vi.Oscillator(beta=0.5, gap=40, restitution=0.5), "no_impact", "0"),
        (vi.Oscillator(inverse_beta=1.11, gap=-0.5, restitution=0.5), "periodic", "inf/1"),
    ],
)
def test_every_verdict_is_a_result(osc: vi.Oscillator, kind: str, label: str) -> None:
    motion = vi.settle(osc)
    assert (motion.kind, motion.label) == (kind, label)
    again = pickle.loads(pickle.dumps(motion))
    assert again == motion and again.to_dict() == motion.to_dict() and motion != vi.settle(osc.replace(damping=0.3))


def test_means_of_chaos_have_error_bars() -> None:
    motion = vi.settle(vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5))
    assert motion.quantities is not None and motion.quantities_error is not None
    errors = motion.quantities_error
    assert {"power", "impact_speed_mean", "displacement_rms"} <= set(errors) < set(motion.quantities)
    assert not {name for name in errors if name.endswith(("_max", "_min", "_amplitude"))}
    # no sticking and no damping: these means are exactly 0
    assert all((errors[name] == 0) == (motion.quantities[name] == 0) for name in errors)
    assert motion.to_dict()["motion"]["quantities_error"] == errors
    other = vi.settle(vi.Oscillator(inverse_beta=1.11, gap=1, restitution=0.5))
    assert other.quantities_error is None and "quantities_error" not in other.to_dict()["motion"]


def test_a_motion_closes_on_itself(n: vi.Oscillator) -> None:
    motion = vi.settle(n)
    sim = vi.simulate(n, **motion.start(), impacts=4)
    # 4/1: the fourth impact after the first one is the first one again
    assert abs(sim.phase[3] - motion.cycle.phase[0]) < 1e-12
    assert abs(sim.speed[3] - motion.cycle.speed[0]) < 1e-12
    wave = motion.waveform()
    t, xs, vs = wave.time, wave.q[:, 0], wave.qdot[:, 0]
    assert t[-1] == n.period and abs(xs[-1] - xs[0]) < 1e-12


def test_many_starts_are_settled_like_each_alone(s: vi.Oscillator) -> None:
    x, v = np.meshgrid(np.linspace(-4, 0.75, 9), np.linspace(-4, 4, 7))
    found = vi.settle_many(s, x, v, 0.5)
    alone = [[vi.settle(s, x=a, v=b, phase=0.5).label for a, b in zip(*row)] for row in zip(x, v)]
    assert found.labels.tolist() == alone and found.cells.shape == x.shape and found.cells.dtype == np.uint32
    assert sum(motion.starts for motion in found.motions) == x.size
    for k, motion in enumerate(found.motions):
        assert motion.share == np.mean(found.cells == k)


def test_the_number_of_threads_does_not_matter(s: vi.Oscillator) -> None:
    rng = np.random.default_rng(1)
    x, v, phase = rng.uniform(-4, 0.75, 20_000), rng.uniform(-4, 4, 20_000), rng.uniform(0, 7, 20_000)
    one = vi.settle_many(s, x, v, phase, threads=1)
    for threads in (2, 3):
        other = vi.settle_many(s, x, v, phase, threads=threads)
        assert other.cells.tobytes() == one.cells.tobytes() and other.motions == one.motions


def test_shapes_and_types_of_starts(s: vi.Oscillator) -> None:
    x = np.linspace(-4, 0.75, 12)
    plain = vi.settle_many(s, x).labels.tolist()
    assert vi.settle_many(s, x.reshape(3, 4)).labels.shape == (3, 4)
    for other in (x.tolist(), np.repeat(x, 2)[::2], x.astype(">f8"), x.reshape(3, 4).T.copy().T.reshape(-1)):
        assert vi.settle_many(s, other).labels.tolist() == plain
    single = x.astype(np.float32)
    assert vi.settle_many(s, single).cells.tolist() == vi.settle_many(s, single.astype(float)).cells.tolist()
    table = vi.settle_many(s, x[None, :], np.array([0.0, 1.0])[:, None])
    assert table.labels.shape == (2, 12) and table.labels[0].tolist() == plain
    assert vi.settle_many(s, 0.0, x).cells.shape == (12,)
    assert vi.settle_many(s, 0.25, 0.0).labels.shape == ()
    assert vi.settle_many(s, np.empty(0)).cells.shape == (0,)
    assert vi.settle_many(s, x[0], phase=np.array([0.0, 2 * np.pi])).labels.tolist() == [plain[0]] * 2


def test_doubles_are_read_where_they_are_and_results_are_handed_over(s: vi.Oscillator) -> None:
    x = np.linspace(-4, 0.75, 1000)
    assert np.shares_memory(numbers("x", x), x)
    cells = vi.settle_many(s, x).cells
    # the memory is owned by a Rust list
    assert not cells.flags.owndata and cells.flags.writeable


def test_two_motions_share_the_starts(s: vi.Oscillator) -> None:
    found = vi.attractors(s, starts=500)
    assert len(found) == 2 and {motion.label for motion in found} == {"1/1", "2/1"}
    assert found[0].share >= found[1].share and sum(motion.starts for motion in found) == 500
    assert sum(motion.share for motion in found) == pytest.approx(1)
    assert found.box["x"][1] == s.gap
    assert vi.attractors(s, starts=500, threads=3).motions == found.motions
    assert [m.starts for m in vi.attractors(s, starts=500, seed=7)] != [m.starts for m in found]


def test_shares_have_intervals(s: vi.Oscillator) -> None:
    """Wilson's interval and the share that may be missed, by their definitions."""
    found = vi.attractors(s, starts=100)
    z2 = 1.959963984540054**2 / 100
    for motion in found:
        p, (low, high) = motion.share, motion.share_interval
        # the ends of the interval are the shares from which the observed one is z standard errors away
        for end in (low, high):
            assert (p - end) ** 2 == pytest.approx(z2 * end * (1 - end), rel=1e-9)
        assert low < p < high
    assert found.missed_below == pytest.approx(1 - 0.05**0.01, rel=1e-14)
    data = found.to_dict()
    assert data["share_intervals"] == [list(m.share_interval) for m in found]
    assert data["missed_below"] == found.missed_below
    settled = vi.settle_many(s, x=[0.0] * 100, v=0.0, phase=0.0)
    assert settled.motions[0].share_interval == pytest.approx((1 / (1 + z2), 1.0), rel=1e-14)


def test_chaos_obeys_the_identity(u: vi.Oscillator) -> None:
    found = vi.lyapunov(u, impacts=20_000, points=500)
    one, two = found.exponents
    assert found.motion.label == "chaotic" and one.value > one.error > 0 > two.value
    rate = found.impacts_per_period.value / u.period
    assert abs(one.value + two.value - 2 * math.log(0.5) * rate) < 1e-9
    assert found.dimension is not None and abs(found.dimension.value - (1 + one.value / -two.value)) < 1e-12
    assert len(found.closings.phase) == len(found.strobes.q) == 500 and found.strobes.q.max() <= u.gap
    assert found.grounds["kind"] == "measured" and found.grounds["impacts"] >= 20_000


def test_a_periodic_motion_has_those_of_its_multipliers(s: vi.Oscillator) -> None:
    found = vi.lyapunov(s, impacts=10_000)
    assert found.motion.multipliers is not None
    for exponent, multiplier in zip(found.exponents_per_period, found.motion.multipliers):
        assert abs(exponent.value - math.log(abs(multiplier))) <= exponent.error


def test_exact_ones_have_no_error() -> None:
    stuck = vi.lyapunov(vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5))
    assert stuck.exponents[0] == (-math.inf, 0.0) and stuck.grounds["kind"] == "stuck"
    assert stuck.to_dict()["exponents"][0] == {"value": None, "error": None, "why": "minus_infinity"}
    free = vi.lyapunov(vi.Oscillator(beta=0.5, gap=9, restitution=0.5, damping=0.1))
    assert free.exponents[0] == (-0.1, 0.0) and np.isfinite(free.identity)
