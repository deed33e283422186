"""heyoka: Taylor integration, one motion at a time, the stop as a terminal event whose callback turns the velocity.

Set as its documentation advises for speed on small systems: no compact mode, no high-accuracy mode, fast_math, only
crossings towards the stop count, and the cool-down after an event is the automatic one. The tolerance is 1e-12 (the
default, 1e-16, is slower). The callbacks are Python, as the package allows no others; they write through a memoryview,
which costs least, and the loop from event to event stays inside heyoka.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence

import heyoka as hy

from peer import (DROPPED, FIRST, FOLLOWED, MOST_M, OUTLOOK, Basin, Followed, Start, basin_start, label, main)

TOLERANCE = 1e-12
RESTITUTION = 0.5
"""Of all the workloads."""
CHUNK = 1000.0
"""Time between two looks at the clock."""


def integrator(impact: Callable[[hy.taylor_adaptive_dbl, bool], bool]) -> hy.taylor_adaptive_dbl:
    """The oscillator with its stop; the parameters are beta, gap and phase."""
    x, v = hy.make_vars("x", "v")
    beta, gap, phase = hy.par[0], hy.par[1], hy.par[2]
    return hy.taylor_adaptive(
        [(x, v), (v, hy.sin(beta * hy.time + phase) - x)],
        [0.0, 0.0],
        pars=[0.5, 1.0, 0.0],
        t_events=[hy.t_event(x - gap, callback=impact, direction=hy.event_direction.positive)],
        tol=TOLERANCE,
        fast_math=True,
    )


def begin(ta: hy.taylor_adaptive_dbl, start: Start) -> None:
    """Puts the integrator at a start."""
    ta.time = 0.0
    ta.state[:] = start.x, start.v
    ta.pars[:] = start.beta, start.gap, start.phase
    ta.reset_cooldowns()


def seconds_per_call(call: Callable[..., object], *arguments: object) -> float:
    """How long a callback takes. What it takes heyoka to call it comes on top."""
    calls = 100_000
    clock = time.perf_counter()
    for _ in range(calls):
        call(*arguments)
    return (time.perf_counter() - clock) / calls


class Scalar:
    """Follows motions one after another."""

    def follow(self, start: Start, seconds: float) -> Followed:
        count = 0

        def impact(ta: hy.taylor_adaptive_dbl, sign: bool) -> bool:
            nonlocal count
            state[1] *= -RESTITUTION
            count += 1
            return True

        ta = integrator(impact)
        state = memoryview(ta.state).cast("B").cast("d")
        begin(ta, start)
        while count < DROPPED:
            ta.propagate_for(CHUNK)
        first, elapsed = count, 0.0
        clock = time.perf_counter()
        while elapsed < seconds:
            ta.propagate_for(CHUNK)
            elapsed = time.perf_counter() - clock
        rate = (count - first) / elapsed
        return Followed(rate, rate * seconds_per_call(impact, ta, True))

    def basin(self, seconds: float) -> Basin:
        run = recorder(FOLLOWED, FOLLOWED - MOST_M - 1)
        labels: Counter[str] = Counter()
        starts, elapsed = 0, 0.0
        clock = time.perf_counter()
        while elapsed < seconds:
            start = basin_start(starts)
            times, velocities = run(start, OUTLOOK)
            labels[label(start.beta, times, velocities) if len(times) > MOST_M else "stuck"] += 1
            starts += 1
            elapsed = time.perf_counter() - clock
        return Basin(starts / elapsed, labels)

    def impacts(self, starts: Sequence[Start]) -> list[list[float]]:
        run = recorder(FIRST, 0)
        return [list(run(start, start.horizon)[0]) for start in starts]


def recorder(limit: int, unrecorded: int) -> Callable[[Start, float], tuple[list[float], list[float]]]:
    """A function that follows a start for `limit` impacts or a time, and gives the times and velocities of its impacts
    but the first `unrecorded`."""
    count = 0
    times: list[float] = []
    velocities: list[float] = []

    def impact(ta: hy.taylor_adaptive_dbl, sign: bool) -> bool:
        nonlocal count
        state[1] *= -RESTITUTION
        count += 1
        if count > unrecorded:
            times.append(ta.time)
            velocities.append(state[1])
        return count < limit

    ta = integrator(impact)
    state = memoryview(ta.state).cast("B").cast("d")

    def run(start: Start, until: float) -> tuple[list[float], list[float]]:
        nonlocal count
        begin(ta, start)
        count = 0
        times.clear()
        velocities.clear()
        ta.propagate_until(until)
        return times, velocities

    return run


if __name__ == "__main__":
    main(Scalar())
