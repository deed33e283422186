"""Motions followed event by event, and their course in time."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._events import OF_EVENTS, columns, columns_of
from vibroimpact._json import read
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Answer, Floats, Result
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


class Simulation(Answer, schema="simulate EventObject EndObject"):
    """The events of a motion as columns, and the reason why the list ends.

    Attributes
    ----------
    start : tuple
        The start: position (None: at rest, or on the stop), velocity and phase; of a machine coordinates, velocities and phase.
    q, qdot : ndarray, events x coordinates
        Coordinates, and velocities after the event.
    with_ : tuple of tuples of str
        Other stops of a machine that take part at the same time.
    end : str
        Why the list ends: "impact_limit", "event_limit", "time_limit", "no_more_impacts", "stuck", "search_limit", "inconsistent" or
        "collapse".
    end_time, shown_until : float
        The time at which the list ends, and that up to which figures and waveforms show the motion.
    """

    _brief = True
    start: tuple[Any, Any, float]
    kind: NDArray[np.str_]
    stop: NDArray[np.str_]
    time: Floats
    phase: Floats
    speed: Floats
    q: Floats
    qdot: Floats
    with_: tuple[tuple[str, ...], ...]
    tie: NDArray[np.bool_]
    depth: Floats
    chatter: NDArray[np.bool_]
    error: Floats
    end: str
    end_time: float
    horizon: dict[str, Any] | None
    shown_until: float

    def _read(self, answer: _core.Answer) -> dict[str, Any]:
        found = answer.columns() or {}
        found |= columns_of(found.pop("events"), len(names_of(self.system)[0]))
        horizon, with_ = found["horizon"], tuple(map(tuple, found["with_"]))
        of = {"horizon": horizon and json.loads(horizon), "with_": with_, "plan": json.loads(answer.plan)}
        return {**found, **of, "start": self._start.given}

    def __repr__(self) -> str:
        return f"<Simulation of {len(self)} events, ends with {self.end} at time {self.end_time:.6g}>"

    def __len__(self) -> int:
        return len(self.time)

    def state(self, event: int = -1) -> dict[str, Any]:
        """The state from which the motion goes on after an event, the last by default: `q`, `qdot`, `phase`; of a machine also what
        stops and joints do (`contacts`), and the digits that these leave out (`exact`). `Machine.starting` takes it.

        Parameters
        ----------
        event : int
            Number of the event, counted from 0, or from the end if it is negative.
        """
        number = range(len(self))[event]
        if isinstance(self.system, Oscillator):
            return {"q": self.q[number].tolist(), "qdot": self.qdot[number].tolist(), "phase": float(self.phase[number])}
        return read(_core.machine_state(self.plan, number))

    def waveform(self, step: float | None = None, *, events: bool = True) -> Waveform:
        """The motion over time, up to `shown_until`.

        Parameters
        ----------
        step : float
            Time between two points, at most. Default: a hundredth of a forcing period; without forcing a thousandth of the whole time.
        events : bool
            Whether to add both sides of each event, at the same time, and the end. Without them the steps are equal.
        """
        return waveform(self.system, self.start, self.shown_until, step, events)

    def _painted(self, *how: Any) -> Any:
        # that of a machine may have two panels
        drawn = super()._painted(*how)
        return drawn if isinstance(self.system, Oscillator) else np.atleast_1d(drawn)

    def _table(self) -> dict[str, Any]:
        """One row for each event; coordinates and velocities by their paths."""
        found = columns(self, OF_EVENTS, names_of(self.system))
        if isinstance(self.system, Oscillator):
            return found | {"depth": self.depth, "chatter": self.chatter, "error": self.error}
        return found | {"with": [", ".join(names) for names in self.with_], "tie": self.tie}
