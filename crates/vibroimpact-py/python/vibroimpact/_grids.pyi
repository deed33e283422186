"""Types of the questions. Written by crates/vibroimpact-py/generate.py from the schema of plans: do not edit."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import SupportsIndex

import xarray as xr
from distributed import Client
from numpy.typing import ArrayLike
from vibroimpact._arguments import Axis, Interval, Progress
from vibroimpact._plan import Plan
from vibroimpact._system import System

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
