"""Types of the questions. Written by crates/vibroimpact-py/generate.py from the schema of plans: do not edit."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import SupportsIndex

import xarray as xr
from distributed import Client
from numpy.typing import ArrayLike
from vibroimpact._arguments import Axis, Interval, Progress
from vibroimpact._branch import Branch
from vibroimpact._curve import Curve
from vibroimpact._margins import Margins
from vibroimpact._region import Region
from vibroimpact._response import Response
from vibroimpact._system import System

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
def margins(
    system: System, *, label: str | None = None, vary: Sequence[str] | None = None,
    scale: Mapping[str, float] | None = None, within: float = 2.0, lines: SupportsIndex | None = None,
    x: float | None = None, v: float | None = None, q: ArrayLike | None = None, qdot: ArrayLike | None = None,
    phase: float | None = None, progress: Progress = None,
) -> Margins: ...
