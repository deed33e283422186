"""What the compiled part offers, checked against it by mypy's stubtest."""

from collections.abc import Callable
from typing import Any, TypeAlias, final

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Self

_Fields: TypeAlias = dict[str, Any]
_Start: TypeAlias = tuple[float | None, float, float]
_Span: TypeAlias = str | tuple[float, float, int]
_Stretch: TypeAlias = tuple[str, float, float]
_Progress: TypeAlias = Callable[[int, int], object] | None
_Array: TypeAlias = NDArray[np.float64]
_Part: TypeAlias = tuple[list[tuple[_Array, list[str], bool, bool]], _Array]

__all__ = [
    "attractors",
    "span_values",
    "branch",
    "curve",
    "orbit_diagram",
    "QuestionError",
    "StoppedError",
    "lyapunov",
    "orbits",
    "Oscillator",
    "Units",
    "contains",
    "region",
    "settle",
    "settle_many",
    "simulate",
    "waveform",
    "__version__",
]

__version__: str

class QuestionError(ValueError): ...
class StoppedError(Exception): ...

@final
class Units:
    def __new__(cls, *, length_m: float, time_s: float) -> Self: ...
    @property
    def length_m(self) -> float: ...
    @property
    def time_s(self) -> float: ...
    @property
    def velocity_m_per_s(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, float]]: ...

@final
class Oscillator:
    def __new__(
        cls,
        *,
        beta: float | None = None,
        inverse_beta: float | None = None,
        gap: float,
        restitution: float,
        damping: float = 0.0,
        second_gap: float | None = None,
        second_restitution: float | None = None,
        units: Units | None = None,
    ) -> Self: ...
    @classmethod
    def from_units(
        cls,
        *,
        mass: float,
        stiffness: float,
        force: float,
        gap: float,
        restitution: float,
        frequency: float | None = None,
        omega: float | None = None,
        damping: float = 0.0,
        second_gap: float | None = None,
        second_restitution: float | None = None,
    ) -> Oscillator: ...
    def replace(self, **changes: float | Units | None) -> Oscillator: ...
    @property
    def beta(self) -> float: ...
    @property
    def inverse_beta(self) -> float: ...
    @property
    def gap(self) -> float: ...
    @property
    def restitution(self) -> float: ...
    @property
    def damping(self) -> float: ...
    @property
    def second_gap(self) -> float | None: ...
    @property
    def second_restitution(self) -> float | None: ...
    @property
    def units(self) -> Units | None: ...
    @property
    def period(self) -> float: ...
    @property
    def free_amplitude(self) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, float | Units]]: ...

def simulate(osc: Oscillator, start: _Start, impacts: int | None, periods: float | None) -> _Fields: ...
def waveform(
    osc: Oscillator, start: _Start, until: float, points_per_period: float
) -> tuple[_Array, _Array, _Array]: ...
def settle(osc: Oscillator, start: _Start) -> tuple[_Fields, str]: ...
def settle_many(
    osc: Oscillator, x: _Array, v: _Array, phase: _Array, threads: int, progress: _Progress
) -> tuple[list[tuple[_Fields, int]], NDArray[np.uint32]]: ...
def attractors(osc: Oscillator, starts: int, seed: int, threads: int, progress: _Progress) -> _Fields: ...
def orbits(osc: Oscillator, label: str) -> list[tuple[_Fields, bool, tuple[int, str, float] | None]]: ...
def branch(
    osc: Oscillator, label: str, vary: str, to: float, orbit: int | None, follow: int, points: int
) -> _Fields: ...
def curve(
    osc: Oscillator, label: str, kind: str, vary: _Stretch, and_: _Stretch, orbit: int | None, event: int | None
) -> _Fields: ...
def region(
    osc: Oscillator, label: str, across: _Stretch, up: _Stretch, grid: int, threads: int
) -> tuple[_Part, _Part, str]: ...
def contains(polygons: list[tuple[_Array, bool]], p: _Array, q: _Array) -> NDArray[np.bool_]: ...
def lyapunov(osc: Oscillator, start: _Start, impacts: int, transient: int, points: int | None) -> _Fields: ...
def orbit_diagram(
    osc: Oscillator,
    vary: str,
    over: _Span,
    show: str,
    direction: str,
    starts: int | None,
    seed: int | None,
    transient: int,
    keep: int,
    threads: int,
    progress: _Progress,
) -> _Fields: ...
def span_values(over: _Span) -> _Array: ...
