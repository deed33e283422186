"""Types of the questions. Written by crates/vibroimpact-py/generate.py from the schema of plans: do not edit."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import SupportsIndex

import xarray as xr
from distributed import Client
from numpy.typing import ArrayLike
from vibroimpact._arguments import Axis, Interval, Progress
from vibroimpact._attractors import Attractors
from vibroimpact._edge import Edge
from vibroimpact._lyapunov import Lyapunov
from vibroimpact._motion import Settled
from vibroimpact._orbits import Orbits
from vibroimpact._simulation import Simulation
from vibroimpact._system import System

def simulate(
    system: System, *, impacts: SupportsIndex | None = None, periods: float | None = None, time: float | None = None,
    x: float | None = None, v: float | None = None, q: ArrayLike | None = None, qdot: ArrayLike | None = None,
    phase: float | None = None, progress: Progress = None,
) -> Simulation: ...
def settle(
    system: System, *, impacts: SupportsIndex | None = None, x: float | None = None, v: float | None = None,
    q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Settled: ...
def attractors(
    system: System, starts: SupportsIndex = 200, *, seed: SupportsIndex = 1, impacts: SupportsIndex | None = None,
    threads: SupportsIndex = 0, progress: Progress = None,
) -> Attractors: ...
def orbits(
    system: System, label: str, *, progress: Progress = None,
) -> Orbits: ...
def edge(
    system: System, other: Mapping[str, float], *, laps: SupportsIndex | None = None,
    impacts: SupportsIndex | None = None, x: float | None = None, v: float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Edge: ...
def lyapunov(
    system: System, *, impacts: SupportsIndex | None = None, transient: SupportsIndex | None = None,
    points: SupportsIndex | None = None, x: float | None = None, v: float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Lyapunov: ...
