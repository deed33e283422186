"""The machines of `crates/vibroimpact/benches/speed/machine_problems.rs`, written as first-order systems.

Each has the form M = 1: q'' = -K q - C q' + f sin(w t), with a rigid or an elastic stop on w.q, or walls that move.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Wall:
    """A stop: its gap is `gap - direction.q - r(t)`, r a sum of (order, cosine, sine)."""

    direction: tuple[float, ...]
    gap: float
    restitution: float | None = None
    stiffness: float = 0.0
    motion: tuple[tuple[int, float, float], ...] = ()


@dataclass(frozen=True)
class Problem:
    """A machine with unit masses, and its usual start."""

    name: str
    stiffness: list[list[float]]
    damping: list[list[float]]
    force: list[float]
    frequency: float
    walls: list[Wall]
    q: list[float]
    v: list[float] = field(default_factory=list)

    @property
    def n(self) -> int:
        return len(self.stiffness)


WAVE_NUMBERS = [
    1.875104068711961,
    4.694091132974175,
    7.854757438237613,
    10.995540734875467,
    14.13716839104647,
    17.278759532088237,
]


def diagonal(values: list[float]) -> list[list[float]]:
    return [[value if i == j else 0.0 for j in range(len(values))] for i, value in enumerate(values)]


def chain() -> Problem:
    return Problem(
        "chain",
        [[1.0, -1.0], [-1.0, 2.0]],
        [[0.03, -0.03], [-0.03, 0.06]],
        [0.0, 1.0],
        1.8,
        [Wall((1.0, 0.0), 0.2, restitution=0.8)],
        [-0.5, 0.1],
        [0.0, 0.0],
    )


def soft() -> Problem:
    return Problem("soft", [[1.0]], [[0.04]], [1.0], 2.7, [Wall((1.0,), 0.0, stiffness=40.0)], [-0.5], [0.0])


def beam(modes: int = 6) -> Problem:
    stiffness, damping, force, tip = [], [], [], []
    for i in range(modes):
        k = WAVE_NUMBERS[i] if i < len(WAVE_NUMBERS) else math.pi * (i + 0.5)
        omega = (k / WAVE_NUMBERS[0]) ** 2
        stiffness.append(omega * omega)
        damping.append(0.02 * omega)
        sigma = (math.cosh(k) + math.cos(k)) / (math.sinh(k) + math.sin(k))
        force.append(0.5 * 2.0 * sigma / k)
        tip.append(2.0 if i % 2 == 0 else -2.0)
    wall = Wall(tuple(tip), 0.5, restitution=0.95)
    zero = [0.0] * modes
    return Problem("beam", diagonal(stiffness), diagonal(damping), force, 1.3, [wall], zero, zero)


def ball() -> Problem:
    walls = [
        Wall((-1.0,), 1.0, restitution=0.9, motion=((1, 0.0, -0.3),)),
        Wall((1.0,), 1.0, restitution=0.9, motion=((1, 0.2, 0.0), (2, 0.0, 0.1))),
    ]
    return Problem("ball", [[0.0]], [[0.0]], [0.0], 1.0, walls, [0.1], [0.9])


PROBLEMS = {problem.name: problem for problem in (chain(), soft(), beam(), ball())}
