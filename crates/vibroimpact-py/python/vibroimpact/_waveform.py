"""The motion of any system over time: coordinates, gaps and contact forces."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._ask import System
from vibroimpact._events import named_columns, stops_of
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Result

_Floats = NDArray[np.float64]

#: Steps of a waveform in a forcing period, and in the whole time of a motion without forcing.
_PER_PERIOD, _WHOLE = 100, 1000


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Waveform(Result):
    """A motion over time.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    time, phase : ndarray
        Time, and phase of the force in radians in [0, 2 pi).
    q, qdot : ndarray, points x coordinates
        Coordinates and velocities.
    gap : ndarray, points x stops
        The gap of each stop; negative where a compliant stop is pushed in.
    force : ndarray, points x (stops and joints)
        The force of each stop, against its direction, and of each joint, against positive relative velocity. Forces of
        impacts are infinite and are not told.
    contact : ndarray of bool, points x stops
        Whether a stop is closed or rested on.
    """

    system: System
    time: _Floats
    phase: _Floats
    q: _Floats
    qdot: _Floats
    gap: _Floats
    force: _Floats
    contact: NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<Waveform of {len(self)} points>"

    def __len__(self) -> int:
        return len(self.time)

    def _table(self) -> dict[str, Any]:
        """One row for each point; coordinates, velocities, gaps and forces by their paths."""
        columns = {"time": self.time, "phase": self.phase, **named_columns(self.system, self.q, self.qdot)}
        columns |= {f"gap.{name}": self.gap[:, k] for k, name in enumerate(stops_of(self.system))}
        joints = () if isinstance(self.system, Oscillator) else self.system.joints
        contacts = stops_of(self.system) + joints
        return columns | {f"force.{name}": self.force[:, k] for k, name in enumerate(contacts)}


def waveform(system: System, start: Any, until: float, step: float | None, events: bool) -> Waveform:
    """The motion from a start, as the compiled module takes it, until a time."""
    if step is None:
        step = system.period / _PER_PERIOD if system.period is not None else until / _WHOLE or 1.0
    if not isinstance(system, Oscillator):
        return Waveform(system=system, **_core.machine_waveform(system._file, start, until, float(step), events))
    time, x, v = _core.waveform(system._file, start, until, float(step), events)
    phase = (start[2] + system.beta * time) % (2 * math.pi)
    walls = [(system.gap, 1.0)] + ([] if system.second_gap is None else [(system.second_gap, -1.0)])
    gap = np.stack([at - side * x for at, side in walls], axis=1)
    # where the mass rests, the stop takes what the force and the spring leave
    contact = (gap == 0.0) & (v == 0.0)[:, None]
    force = np.stack([side * (np.sin(phase) - x) for _, side in walls], axis=1)
    return Waveform(system, time, phase, x[:, None], v[:, None], gap, np.where(contact, np.maximum(force, 0.0), 0.0), contact)
