"""Types of the questions. Written by crates/vibroimpact-py/generate.py from the schema of plans: do not edit."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import SupportsIndex

import xarray as xr
from distributed import Client
from numpy.typing import ArrayLike
from vibroimpact._arguments import Axis, Interval, Progress
from vibroimpact._ask import System
from vibroimpact._continued import Branch
from vibroimpact._continued import Curve
from vibroimpact._continued import Margins
from vibroimpact._continued import Region
from vibroimpact._continued import Response
from vibroimpact._lyapunov import Lyapunov
from vibroimpact._motion import Attractors
from vibroimpact._motion import Edge
from vibroimpact._motion import Orbits
from vibroimpact._motion import Settled
from vibroimpact._motion import Simulation
from vibroimpact._plan import Plan

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
def branch(
    system: System, vary: str, to: float | tuple[float, float], *, label: str | None = None,
    also: Mapping[str, float] | None = None, orbit: SupportsIndex | None = None, follow: SupportsIndex = 0,
    points: SupportsIndex = 5000, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None,
    progress: Progress = None,
) -> Branch: ...
def curve(
    system: System, kind: str, over: Mapping[str, Interval], *, label: str | None = None,
    orbit: SupportsIndex | None = None, event: SupportsIndex | None = None, points: SupportsIndex | None = None,
    q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Curve: ...
def region(
    system: System, label: str, over: Mapping[str, Interval], *, grid: SupportsIndex = 24, threads: SupportsIndex = 0,
    progress: Progress = None,
) -> Region: ...
def response(
    system: System, vary: str, over: Axis, *, quantity: str | None = None, impacts: SupportsIndex | None = None,
    progress: Progress = None,
) -> Response: ...
def edge(
    system: System, other: Mapping[str, float], *, laps: SupportsIndex | None = None,
    impacts: SupportsIndex | None = None, x: float | None = None, v: float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Edge: ...
def margins(
    system: System, *, label: str | None = None, vary: Sequence[str] | None = None,
    scale: Mapping[str, float] | None = None, within: float = 2.0, lines: SupportsIndex | None = None,
    x: float | None = None, v: float | None = None, q: ArrayLike | None = None, qdot: ArrayLike | None = None,
    phase: float | None = None, progress: Progress = None,
) -> Margins: ...
def lyapunov(
    system: System, *, impacts: SupportsIndex | None = None, transient: SupportsIndex | None = None,
    points: SupportsIndex | None = None, x: float | None = None, v: float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
) -> Lyapunov: ...
def basin(
    system: System, over: Mapping[str, Axis] | None = None, *, x: Axis | float | None = None,
    v: Axis | float | None = None, phase: Axis | float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, refine: SupportsIndex | None = None, impacts: SupportsIndex | None = None,
    fields: Sequence[str] = (), store: str | PathLike[str] | None = None, client: Client | None = None,
    tile: SupportsIndex | None = None, threads: SupportsIndex = 0, progress: Progress = None,
) -> xr.Dataset: ...
def region_map(
    system: System, over: Mapping[str, Axis], *, starts: SupportsIndex = 8, seed: SupportsIndex = 1,
    refine: SupportsIndex | None = None, impacts: SupportsIndex | None = None, fields: Sequence[str] = (),
    store: str | PathLike[str] | None = None, client: Client | None = None, tile: SupportsIndex | None = None,
    threads: SupportsIndex = 0, progress: Progress = None,
) -> xr.Dataset: ...
def orbit_diagram(
    system: System, vary: str, over: Axis, *, also: Mapping[str, Interval] | None = None, show: str | None = None,
    direction: str = 'both', starts: SupportsIndex | None = None, seed: SupportsIndex | None = None,
    transient: SupportsIndex = 500, keep: SupportsIndex = 64, store: str | PathLike[str] | None = None,
    client: Client | None = None, tile: SupportsIndex | None = None, threads: SupportsIndex = 0,
    progress: Progress = None,
) -> xr.Dataset: ...
def plan_map(
    system: System, over: Mapping[str, Axis], *, starts: SupportsIndex = 8, seed: SupportsIndex = 1,
    refine: SupportsIndex | None = None, impacts: SupportsIndex | None = None, fields: Sequence[str] = (),
    tile: SupportsIndex | None = None,
) -> Plan: ...
def plan_basin(
    system: System, over: Mapping[str, Axis] | None = None, *, x: Axis | float | None = None,
    v: Axis | float | None = None, phase: Axis | float | None = None, q: ArrayLike | None = None,
    qdot: ArrayLike | None = None, refine: SupportsIndex | None = None, impacts: SupportsIndex | None = None,
    fields: Sequence[str] = (), tile: SupportsIndex | None = None,
) -> Plan: ...
def plan_diagram(
    system: System, vary: str, over: Axis, *, also: Mapping[str, Interval] | None = None, show: str | None = None,
    direction: str = 'both', starts: SupportsIndex | None = None, seed: SupportsIndex | None = None,
    transient: SupportsIndex = 500, keep: SupportsIndex = 64, tile: SupportsIndex | None = None,
) -> Plan: ...
def plan_lyapunov(
    system: System, over: Mapping[str, Axis], *, x: float | None = None, v: float | None = None,
    q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None,
    impacts: SupportsIndex | None = None, transient: SupportsIndex = 1000, tile: SupportsIndex | None = None,
) -> Plan: ...
def plan_attractors(
    system: System, starts: SupportsIndex, *, seed: SupportsIndex = 1, impacts: SupportsIndex | None = None,
    tile: SupportsIndex | None = None,
) -> Plan: ...
