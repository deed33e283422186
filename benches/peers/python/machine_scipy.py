"""SciPy on the machines: `solve_ivp` by DOP853 with rtol 1e-9, stops as terminal events, started anew at each event.

    machine_scipy.py PROBLEM SECONDS          prints {"rate": ...}, events per second
    machine_scipy.py PROBLEM --starts FILE    prints the first event times of each start
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from machine_problems import PROBLEMS, Problem, Wall
from scipy.integrate import solve_ivp

FIRST = 5
HORIZON = 60.0
DROPPED = 20
SHORTEST = 1e-10
"""A flight shorter than this has found the event it began from."""


def wall_motion(wall: Wall, w: float, t: float) -> tuple[float, float]:
    place = rate = 0.0
    for order, cos, sin in wall.motion:
        c, s = np.cos(order * w * t), np.sin(order * w * t)
        place += cos * c + sin * s
        rate += order * w * (sin * c - cos * s)
    return place, rate


class Motion:
    """A motion from event to event."""

    def __init__(self, problem: Problem, q: list[float], v: list[float]) -> None:
        self.problem, self.n, self.time = problem, problem.n, 0.0
        self.z = np.array([*q, *v], dtype=float)
        self.free = self.matrix(0.0)
        # all elastic stops are one here
        self.pressed = self.matrix(1.0)
        self.closed = False
        self.force = np.concatenate([np.zeros(self.n), problem.force])
        self.directions = [np.array(wall.direction) for wall in problem.walls]
        self.events = [self.event(wall) for wall in problem.walls]

    def matrix(self, closed: float) -> Any:
        n = self.n
        a = np.zeros((2 * n, 2 * n))
        a[:n, n:] = np.eye(n)
        a[n:, :n] = -np.array(self.problem.stiffness)
        a[n:, n:] = -np.array(self.problem.damping)
        for wall in self.problem.walls:
            w = np.array(wall.direction)
            a[n:, :n] -= closed * wall.stiffness * np.outer(w, w)
        return a

    def event(self, wall: Wall) -> Callable[[float, Any], float]:
        w, n = np.array(wall.direction), self.n

        def beyond(t: float, z: Any) -> float:
            return float(w @ z[:n]) + wall_motion(wall, self.problem.frequency, t)[0] - wall.gap

        beyond.terminal = True  # type: ignore[attr-defined]
        beyond.direction = 1.0  # type: ignore[attr-defined]
        return beyond

    def next_event(self, until: float) -> bool:
        """Goes on to the next event; false where there is none before `until`."""
        a, f, w = self.pressed if self.closed else self.free, self.force, self.problem.frequency
        for event, wall in zip(self.events, self.problem.walls):
            event.direction = -1.0 if self.closed and wall.stiffness else 1.0  # type: ignore[attr-defined]
        flight = solve_ivp(
            lambda t, z: a @ z + np.sin(w * t) * f,
            (self.time, until),
            self.z,
            method="DOP853",
            events=self.events,
            rtol=1e-9,
            atol=1e-12,
        )
        if flight.status != 1 or flight.t[-1] - self.time < SHORTEST:
            return False
        self.time, self.z = float(flight.t[-1]), flight.y[:, -1].copy()
        struck = next(i for i, times in enumerate(flight.t_events) if len(times))
        wall, direction = self.problem.walls[struck], self.directions[struck]
        if wall.stiffness:
            self.closed = not self.closed
        else:
            rate = wall_motion(wall, w, self.time)[1]
            speed = float(direction @ self.z[self.n :]) + rate
            self.z[self.n :] -= (1.0 + wall.restitution) * speed / float(direction @ direction) * direction
        return True


def main() -> None:
    problem = PROBLEMS[sys.argv[1]]
    if sys.argv[2] == "--starts":
        for line in open(sys.argv[3], encoding="utf-8"):
            start = list(map(float, line.split()))
            motion, times = Motion(problem, start[: problem.n], start[problem.n :]), list[float]()
            while len(times) < FIRST and motion.next_event(HORIZON):
                times.append(motion.time)
            print(*map(repr, times))
        return
    motion = Motion(problem, problem.q, problem.v)
    for _ in range(DROPPED):
        motion.next_event(motion.time + 1000.0)
    events, elapsed, clock = 0, 0.0, time.perf_counter()
    while elapsed < float(sys.argv[2]) and motion.next_event(motion.time + 1000.0):
        events += 1
        elapsed = time.perf_counter() - clock
    print(json.dumps({"rate": events / elapsed}))


if __name__ == "__main__":
    main()
