"""SciPy: `solve_ivp` with the stop as a terminal event, started anew at each impact.

The method and its tolerances are the first argument: `RK45` as it comes, or `DOP853` with rtol 1e-9 and atol 1e-12.
"""

from __future__ import annotations

import math
import sys
import time
from collections import Counter
from collections.abc import Sequence

from scipy.integrate import solve_ivp

from peer import (DROPPED, FIRST, FOLLOWED, OUTLOOK, TAU, Basin, Followed, Start, basin_start, label, main)

TOLERANCES: dict[str, dict[str, float]] = {"RK45": {}, "DOP853": {"rtol": 1e-9, "atol": 1e-12}}
SHORTEST = 1e-10
"""A flight shorter than this is no flight: the event has found the impact the flight began from."""


def slope(t: float, y: Sequence[float], beta: float, phase: float, gap: float) -> list[float]:
    """The equation of motion."""
    return [y[1], math.sin(beta * t + phase) - y[0]]


def contact(t: float, y: Sequence[float], beta: float, phase: float, gap: float) -> float:
    """Zero on the stop."""
    return y[0] - gap


contact.terminal = True  # type: ignore[attr-defined]
contact.direction = 1.0  # type: ignore[attr-defined]


class Motion:
    """A motion from impact to impact; `time` counts from its start."""

    def __init__(self, method: str, start: Start) -> None:
        self.method, self.start = method, start
        self.x, self.v, self.time = start.x, start.v, 0.0

    def next_impact(self, horizon: float = OUTLOOK) -> bool:
        """Goes on to the next impact; false where there is none."""
        beta, gap = self.start.beta, self.start.gap
        phase = math.fmod(self.start.phase + beta * self.time, TAU)
        flight = solve_ivp(
            slope,
            (0.0, horizon),
            (self.x, self.v),
            method=self.method,
            events=contact,
            args=(beta, phase, gap),
            **TOLERANCES[self.method],
        )
        if flight.status != 1 or flight.t[-1] < SHORTEST:
            return False
        self.x, self.v = gap, -self.start.restitution * float(flight.y[1, -1])
        self.time += float(flight.t[-1])
        return True


class Events:
    """Follows motions by one of SciPy's methods."""

    def __init__(self, method: str) -> None:
        self.method = method

    def follow(self, start: Start, seconds: float) -> Followed:
        motion = Motion(self.method, start)
        for _ in range(DROPPED):
            motion.next_impact()
        impacts, elapsed = 0, 0.0
        begin = time.perf_counter()
        while elapsed < seconds and motion.next_impact():
            impacts += 1
            elapsed = time.perf_counter() - begin
        return Followed(impacts / elapsed)

    def basin(self, seconds: float) -> Basin:
        """A start takes long here, so the last one counts by the part of it that was done."""
        labels: Counter[str] = Counter()
        starts, elapsed, k = 0.0, 0.0, 0
        begin = time.perf_counter()
        while elapsed < seconds:
            motion = Motion(self.method, basin_start(k))
            times: list[float] = []
            velocities: list[float] = []
            while len(times) < FOLLOWED and elapsed < seconds and motion.next_impact():
                times.append(motion.time)
                velocities.append(motion.v)
                elapsed = time.perf_counter() - begin
            if len(times) == FOLLOWED:
                labels[label(motion.start.beta, times, velocities)] += 1
                starts += 1.0
            elif elapsed < seconds:
                labels["stuck"] += 1
                starts += 1.0
                elapsed = time.perf_counter() - begin
            else:
                starts += len(times) / FOLLOWED
            k += 1
        return Basin(starts / elapsed, labels)

    def impacts(self, starts: Sequence[Start]) -> list[list[float]]:
        return [self.first_impacts(start) for start in starts]

    def first_impacts(self, start: Start) -> list[float]:
        """The first impact times of one start."""
        motion, times = Motion(self.method, start), list[float]()
        while len(times) < FIRST and motion.time < start.horizon and motion.next_impact(start.horizon - motion.time):
            times.append(motion.time)
        return times


if __name__ == "__main__":
    chosen = sys.argv.pop(1) if len(sys.argv) > 1 else ""
    if chosen not in TOLERANCES:
        sys.exit(f"the method is one of {', '.join(TOLERANCES)}, not `{chosen}`")
    main(Events(chosen))
