"""heyoka on the machines: one motion (`scalar`) or as many as it has lanes (`batch`), stops as terminal events.

    machine_heyoka.py scalar|batch [--compact] [--tol T] PROBLEM SECONDS    prints {"rate": ...}, events per second
    machine_heyoka.py scalar|batch PROBLEM --starts FILE                    prints the first event times of each start

An elastic stop is a parameter that its events switch on and off. The callbacks are Python, as the package allows no
others; they write through memoryviews.
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

import heyoka as hy
import numpy as np
from machine_problems import PROBLEMS, Problem, Wall

FIRST = 5
DROPPED = 200
ROUND = 2048
TOLERANCE = 1e-12
HORIZON = 60.0
"""Starts are followed so long."""


def total(terms: list[Any]) -> Any:
    return hy.sum(terms) if len(terms) > 1 else terms[0]


def wall_motion(wall: Wall, w: float) -> list[Any]:
    return [
        term
        for order, cos, sin in wall.motion
        for term in (
            *([cos * hy.cos(order * w * hy.time)] if cos else []),
            *([sin * hy.sin(order * w * hy.time)] if sin else []),
        )
    ]


def system(problem: Problem) -> tuple[list[tuple[Any, Any]], list[Any]]:
    """The equations, and w.q + r - d of each stop, which is positive beyond it. par[0] is 1 on an elastic stop."""
    n = problem.n
    q = hy.make_vars(*[f"q{i}" for i in range(n)])
    v = hy.make_vars(*[f"v{i}" for i in range(n)])
    q, v = (q, v) if isinstance(q, list) else ([q], [v])
    w = problem.frequency
    drive = hy.sin(w * hy.time)
    beyond = []
    for wall in problem.walls:
        terms = [q[i] if d == 1.0 else d * q[i] for i, d in enumerate(wall.direction) if d]
        terms += wall_motion(wall, w)
        beyond.append(total([*terms, hy.expression(-wall.gap)]) if wall.gap else total(terms))
    rows = []
    for i in range(n):
        terms = [-problem.stiffness[i][j] * q[j] for j in range(n) if problem.stiffness[i][j]]
        terms += [-problem.damping[i][j] * v[j] for j in range(n) if problem.damping[i][j]]
        if problem.force[i]:
            terms.append(problem.force[i] * drive)
        for wall, of in zip(problem.walls, beyond):
            if wall.stiffness:
                terms.append(-wall.stiffness * wall.direction[i] * hy.par[0] * of)
        rows.append(total(terms) if terms else hy.expression(0.0))
    return [*zip(q, v), *zip(v, rows)], beyond


def rebound(problem: Problem, wall: Wall, state: Any, now: float, lane: int, lanes: int) -> None:
    """The impact: v + (1 + e) g' w / w.w, unit masses."""
    n, w = problem.n, problem.frequency
    speed = 0.0
    for order, cos, sin in wall.motion:
        angle = order * w * now
        speed += order * w * (sin * np.cos(angle) - cos * np.sin(angle))
    square = 0.0
    for i, d in enumerate(wall.direction):
        if d:
            speed += d * state[(n + i) * lanes + lane]
            square += d * d
    push = (1.0 + wall.restitution) * speed / square
    for i, d in enumerate(wall.direction):
        if d:
            state[(n + i) * lanes + lane] -= push * d


class Motion:
    """An integrator whose events call `happened(lane, time)`; a true answer goes on."""

    def __init__(self, problem: Problem, lanes: int, compact: bool, tol: float, happened: Any) -> None:
        self.problem, self.lanes = problem, lanes
        equations, beyond = system(problem)
        batch = lanes > 1
        make = hy.t_event_batch if batch else hy.t_event
        events = []

        def impact(wall: Wall) -> Any:
            # the state and the parameters are rows of lanes
            if batch:

                def call(ta: Any, sign: bool, lane: int) -> bool:
                    now = ta.time[lane]
                    rebound(problem, wall, self.state, now, lane, lanes)
                    return happened(lane, now)

            elif len(wall.direction) == 1 and not wall.motion or sum(1 for d in wall.direction if d) == 1 and not wall.motion:
                place = problem.n + next(i for i, d in enumerate(wall.direction) if d)
                factor = -wall.restitution

                def call(ta: Any, sign: bool) -> bool:
                    self.state[place] *= factor
                    return happened(0, ta.time)

            else:

                def call(ta: Any, sign: bool) -> bool:
                    now = ta.time
                    rebound(problem, wall, self.state, now, 0, 1)
                    return happened(0, now)

            return call

        def switch() -> Any:
            if batch:

                def call(ta: Any, sign: bool, lane: int) -> bool:
                    self.pars[lane] = 1.0 - self.pars[lane]
                    return happened(lane, ta.time[lane])

            else:

                def call(ta: Any, sign: bool) -> bool:
                    self.pars[0] = 1.0 - self.pars[0]
                    return happened(0, ta.time)

            return call

        for wall, of in zip(problem.walls, beyond):
            if wall.stiffness:
                events.append(make(of, callback=switch()))
            else:
                events.append(make(of, callback=impact(wall), direction=hy.event_direction.positive))
        arguments = {"t_events": events, "tol": tol, "compact_mode": compact, "fast_math": True}
        rows = 2 * problem.n
        elastic = any(wall.stiffness for wall in problem.walls)
        if batch:
            self.ta = hy.taylor_adaptive_batch(equations, np.zeros((rows, lanes)), **({"pars": np.zeros((1, lanes))} if elastic else {}), **arguments)
        else:
            self.ta = hy.taylor_adaptive(equations, [0.0] * rows, **({"pars": [0.0]} if elastic else {}), **arguments)
        self.state = memoryview(self.ta.state).cast("B").cast("d")
        self.pars = memoryview(self.ta.pars).cast("B").cast("d") if elastic else memoryview(bytearray(8 * lanes)).cast("d")

    def put(self, lane: int, q: list[float], v: list[float]) -> None:
        for i, value in enumerate([*q, *v]):
            self.state[i * self.lanes + lane] = value
        self.pars[lane] = 0.0


def rate(problem: Problem, lanes: int, compact: bool, tol: float, seconds: float) -> float:
    count = 0

    def happened(lane: int, now: float) -> bool:
        nonlocal count
        count += 1
        return count % ROUND != 0

    motion = Motion(problem, lanes, compact, tol, happened)
    for lane in range(lanes):
        motion.put(lane, [x - 1e-3 * lane for x in problem.q], problem.v)
    far = [1e9] * lanes if lanes > 1 else 1e9
    motion.ta.propagate_until(far)
    first, elapsed, clock = count, 0.0, time.perf_counter()
    while elapsed < seconds:
        motion.ta.propagate_until(far)
        elapsed = time.perf_counter() - clock
    return (count - first) / elapsed


def first_times(problem: Problem, lanes: int, compact: bool, tol: float, starts: list[list[float]]) -> list[list[float]]:
    times: list[list[float]] = []

    def happened(lane: int, now: float) -> bool:
        times[lane].append(float(now))
        return len(times[lane]) < FIRST

    motion = Motion(problem, 1, compact, tol, happened)
    answers = []
    for start in starts:
        times = [[]]
        motion.ta.time = 0.0
        motion.ta.reset_cooldowns()
        motion.put(0, start[: problem.n], start[problem.n :])
        motion.ta.propagate_until(HORIZON)
        answers.append(times[0])
    return answers


def main() -> None:
    words = sys.argv[1:]
    compact = "--compact" in words
    tol = float(words[words.index("--tol") + 1]) if "--tol" in words else TOLERANCE
    if "--tol" in words:
        del words[words.index("--tol") : words.index("--tol") + 2]
    words = [word for word in words if word != "--compact"]
    lanes = 1 if words[0] == "scalar" else int(hy.recommended_simd_size())
    problem = PROBLEMS[words[1]]
    if words[2] == "--starts":
        starts = [list(map(float, line.split())) for line in open(words[3], encoding="utf-8")]
        for times in first_times(problem, lanes, compact, tol, starts):
            print(*map(repr, times))
        return
    print(json.dumps({"rate": rate(problem, lanes, compact, tol, float(words[2]))}))


if __name__ == "__main__":
    main()
