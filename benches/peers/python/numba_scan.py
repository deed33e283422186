"""The 1971 paper's search, scan in steps of 0.1 and Newton's method, compiled by Numba. The twin of `../c/scan.c`."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Sequence

import numpy as np
from numba import njit

from peer import (DROPPED, FIRST, FOLLOWED, MOST_M, OUTLOOK, TAU, Basin, Followed, Start, basin_start, label, main)

STEP = 0.1
STUCK = -1.0
CONVERGED = 1e-13
MOST_ITERATIONS = 60


@njit(cache=True)
def first_contact(beta: float, gap: float, x: float, v: float, phase: float, horizon: float) -> tuple[float, float]:
    """Time of the next contact and velocity there; infinity where none was found, `STUCK` where there is no flight."""
    f = 1.0 / ((1.0 - beta) * (1.0 + beta))
    a = x - f * math.sin(phase)
    b = v - f * beta * math.cos(phase)
    k = 1
    while k * STEP < horizon:
        s = k * STEP
        if a * math.cos(s) + b * math.sin(s) + f * math.sin(beta * s + phase) > gap:
            break
        k += 1
    else:
        return math.inf, 0.0
    low, high, s = (k - 1) * STEP, k * STEP, k * STEP
    for _ in range(MOST_ITERATIONS):
        y = a * math.cos(s) + b * math.sin(s) + f * math.sin(beta * s + phase) - gap
        u = b * math.cos(s) - a * math.sin(s) + f * beta * math.cos(beta * s + phase)
        following = s - y / u
        if k == 1:
            # the flight began on the stop, which is a zero too: no bracket
            if not following > 1e-10:
                return STUCK, 0.0
        else:
            if y > 0.0:
                high = s
            else:
                low = s
            if not (low <= following <= high):
                following = 0.5 * (low + high)
        done = abs(following - s) <= CONVERGED * (1.0 + s)
        s = following
        if done:
            break
    return s, b * math.cos(s) - a * math.sin(s) + f * beta * math.cos(beta * s + phase)


@njit(cache=True)
def run(
    state: np.ndarray,
    beta: float,
    gap: float,
    restitution: float,
    horizon: float,
    times: np.ndarray,
    speeds: np.ndarray,
) -> int:
    """Follows the motion in `state` (x, v, phase, time) for as many impacts as `times` has room for; their number."""
    x, v, phase, now = state
    count = 0
    while count < times.size:
        s, u = first_contact(beta, gap, x, v, phase, horizon)
        if s == STUCK or not s < horizon:
            break
        x, v = gap, -restitution * u
        phase = (phase + beta * s) % TAU
        now += s
        times[count], speeds[count] = now, v
        count += 1
    state[:] = x, v, phase, now
    return count


class Scan:
    """Follows motions from impact to impact."""

    def __init__(self) -> None:
        self.times, self.speeds = np.empty(1000), np.empty(1000)

    def go_on(self, start: Start, state: np.ndarray, impacts: int, horizon: float = OUTLOOK) -> int:
        """Follows the motion for so many impacts, which are then in `times` and `speeds`; how many there were."""
        times, speeds = self.times[:impacts], self.speeds[:impacts]
        return int(run(state, start.beta, start.gap, start.restitution, horizon, times, speeds))

    def follow(self, start: Start, seconds: float) -> Followed:
        state = state_of(start)
        if self.go_on(start, state, DROPPED) < DROPPED:
            raise RuntimeError("the motion ended")
        impacts, elapsed = 0, 0.0
        begin = time.perf_counter()
        while elapsed < seconds:
            impacts += self.go_on(start, state, 1000)
            elapsed = time.perf_counter() - begin
        return Followed(impacts / elapsed)

    def basin(self, seconds: float) -> Basin:
        self.go_on(basin_start(0), state_of(basin_start(0)), FOLLOWED)  # compiled before the clock starts
        labels: Counter[str] = Counter()
        starts, elapsed = 0, 0.0
        begin = time.perf_counter()
        while elapsed < seconds:
            start = basin_start(starts)
            if self.go_on(start, state_of(start), FOLLOWED) < FOLLOWED:
                labels["stuck"] += 1
            else:
                last = slice(FOLLOWED - MOST_M - 1, FOLLOWED)
                labels[label(start.beta, self.times[last].tolist(), self.speeds[last].tolist())] += 1
            starts += 1
            elapsed = time.perf_counter() - begin
        return Basin(starts / elapsed, labels)

    def impacts(self, starts: Sequence[Start]) -> list[list[float]]:
        lists = []
        for start in starts:
            count = self.go_on(start, state_of(start), FIRST, start.horizon)
            lists.append([float(t) for t in self.times[:count] if t < start.horizon])
        return lists


def state_of(start: Start) -> np.ndarray:
    """x, v, phase and time of a start."""
    return np.array([start.x, start.v, start.phase, 0.0])


if __name__ == "__main__":
    main(Scan())
