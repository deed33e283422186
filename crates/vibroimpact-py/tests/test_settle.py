"""What is said of one motion and of many: the attributes of results, and starts of any shape."""

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact._arguments import numbers


def test_means_of_chaos_have_error_bars(u: vi.Oscillator, s: vi.Oscillator) -> None:
    motion = vi.settle(u)
    assert motion.quantities is not None and motion.quantities_error is not None
    errors = motion.quantities_error
    assert {"power", "impact_speed_mean", "displacement_rms"} <= set(errors) < set(motion.quantities)
    assert motion.to_dict()["motion"]["quantities_error"] == errors and vi.settle(s).quantities_error is None


def test_a_motion_closes_on_itself(n: vi.Oscillator) -> None:
    motion = vi.settle(n)
    assert (motion.kind, motion.label, motion.impacts, motion.periods, motion.stable) == ("periodic", "4/1", 4, 1, True)
    assert motion.multipliers.dtype == np.complex128 and motion.period == pytest.approx(n.period, rel=1e-15)
    sim = vi.simulate(n, **motion.start(), impacts=4)
    # 4/1: the fourth impact after the first one is the first one again
    assert abs(sim.phase[3] - motion.cycle.phase[0]) < 1e-12
    assert abs(sim.speed[3] - motion.cycle.speed[0]) < 1e-12
    wave = motion.waveform()
    t, xs = wave.time, wave.q[:, 0]
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


def test_shares_have_intervals(s: vi.Oscillator) -> None:
    found = vi.attractors(s, starts=100)
    data = found.to_dict()
    assert data["share_intervals"] == [list(m.share_interval) for m in found]
    assert all(motion.share_interval[0] < motion.share < motion.share_interval[1] for motion in found)
    assert found.missed_below == pytest.approx(1 - 0.05**0.01, rel=1e-14) and found.box["x"][1] == s.gap
    # Wilson's interval by its definition
    settled = vi.settle_many(s, x=[0.0] * 100, v=0.0, phase=0.0)
    z2 = 1.959963984540054**2 / 100
    assert settled.motions[0].share_interval == pytest.approx((1 / (1 + z2), 1.0), rel=1e-14)


def test_exact_ones_have_no_error() -> None:
    stuck = vi.lyapunov(vi.Oscillator(beta=0.9, gap=-1.5, restitution=0.5))
    assert stuck.exponents[0] == (-math.inf, 0.0) and stuck.grounds["kind"] == "stuck"
    assert stuck.to_dict()["exponents"][0] == {"value": None, "error": None, "why": "minus_infinity"}
    assert stuck.dimension is not None and stuck.flow_dimension is not None
    free = vi.lyapunov(vi.Oscillator(beta=0.5, gap=9, restitution=0.5, damping=0.1))
    assert free.exponents[0] == (-0.1, 0.0) and np.isfinite(free.identity)
