"""The course of a motion in time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._events import columns
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Floats, Result
from vibroimpact._system import names_of, stops_of

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

    system: Any
    time: Floats
    phase: Floats
    q: Floats
    qdot: Floats
    gap: Floats
    force: Floats
    contact: NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<Waveform of {len(self)} points>"

    def __len__(self) -> int:
        return len(self.time)

    def _table(self) -> dict[str, Any]:
        """One row for each point; coordinates, velocities, gaps and forces by their paths."""
        found = columns(self, ("time", "phase"), names_of(self.system))
        found |= {f"gap.{name}": self.gap[:, k] for k, name in enumerate(stops_of(self.system))}
        joints = () if isinstance(self.system, Oscillator) else self.system.joints
        contacts = stops_of(self.system) + joints
        return found | {f"force.{name}": self.force[:, k] for k, name in enumerate(contacts)}


def waveform(system: Any, start: Any, until: float, step: float | None, events: bool) -> Waveform:
    """The motion from a start, as the compiled module takes it, until a time."""
    usual = until / _WHOLE or 1.0 if system.period is None else system.period / _PER_PERIOD
    asked = (start, until, usual if step is None else float(step), events)
    if not isinstance(system, Oscillator):
        return Waveform(system=system, **_core.machine_waveform(system._file, *asked))
    time, x, v = _core.waveform(system._file, *asked)
    phase = (start[2] + system.beta * time) % (2 * math.pi)
    walls = [(system.gap, 1.0)] + ([] if system.second_gap is None else [(system.second_gap, -1.0)])
    gap = np.stack([at - side * x for at, side in walls], axis=1)
    # where the mass rests, the stop takes what the force and the spring leave
    contact = (gap == 0.0) & (v == 0.0)[:, None]
    force = np.stack([side * (np.sin(phase) - x) for _, side in walls], axis=1)
    return Waveform(system, time, phase, x[:, None], v[:, None], gap, np.where(contact, np.maximum(force, 0.0), 0.0), contact)
