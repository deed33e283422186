"""The events of a motion as columns."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Rows

_Floats = NDArray[np.float64]


def names_of(system: Any) -> tuple[list[str], list[str]]:
    """The names of the columns of coordinates and of velocities."""
    if isinstance(system, Oscillator):
        return ["x"], ["v"]
    return [f"q.{name}" for name in system.coordinates], [f"qdot.{name}" for name in system.coordinates]


def stops_of(system: Any) -> tuple[str, ...]:
    """The names of the stops."""
    if isinstance(system, Oscillator):
        return ("upper",) if system.second_gap is None else ("upper", "lower")
    stops: tuple[str, ...] = system.stops
    return stops


def named_columns(system: Any, q: _Floats, qdot: _Floats) -> dict[str, _Floats]:
    """Coordinates and velocities by their names."""
    positions, velocities = names_of(system)
    return {**dict(zip(positions, q.T)), **dict(zip(velocities, qdot.T))}


def columns_of(found: Mapping[str, Any], n: int) -> dict[str, Any]:
    """The columns of events of the compiled module, of a system with `n` coordinates."""
    time, phase, speed, *states = found["real"]
    kinds, stops = (np.array(found[name], dtype=np.str_) for name in ("kinds", "stops"))
    kind, stop = (names[codes] if len(names) else np.empty(0, np.str_) for names, codes in ((kinds, found["kind"]), (stops, found["stop"])))
    q, qdot = (np.stack(of, axis=1) for of in (states[:n], states[n:]))
    return {"kind": kind, "stop": stop, "time": time, "phase": phase, "speed": speed, "q": q, "qdot": qdot}


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Events(Rows):
    """The events of a cycle in order of time, beginning with the fastest closing of a stop.

    Attributes
    ----------
    kind, stop : ndarray of str
        Kind of each event: "impact", "close", "open", "stick", "release", "slip", "hold", "graze" or "collapse"; the name of the
        stop or joint, of an oscillator "upper" or "lower".
    time, phase, speed : ndarray
        Time since the first event, phase of the force in radians, speed of closing before the event.
    q, qdot : ndarray, events x coordinates
        Coordinates, and velocities after the event.
    """

    kind: NDArray[np.str_]
    stop: NDArray[np.str_]
    time: _Floats
    phase: _Floats
    speed: _Floats
    q: _Floats
    qdot: _Floats
    _names: tuple[list[str], list[str]]

    @classmethod
    def of(cls, events: Sequence[Mapping[str, Any]], system: Any) -> "Events":
        """The events of the JSON of the command."""
        names = names_of(system)

        def floats(name: str) -> _Floats:
            return np.array([event.get(name, math.nan) for event in events], dtype=np.float64)

        def rows(name: str) -> _Floats:
            return np.array([event[name] for event in events], dtype=np.float64).reshape(len(events), len(names[0]))

        kind, stop = (np.array([event[name] for event in events], dtype=np.str_) for name in ("kind", "stop"))
        return cls(kind, stop, floats("time"), floats("phase"), floats("speed"), rows("q"), rows("qdot"), names)

    @property
    def closes(self) -> NDArray[np.bool_]:
        """Whether each event is the closing of a stop: an impact, or the beginning of compliant contact."""
        closing: NDArray[np.bool_] = np.isin(self.kind, ("impact", "close"))
        return closing

    def _table(self) -> dict[str, Any]:
        """One row for each event."""
        columns = {name: getattr(self, name) for name in ("kind", "stop", "time", "phase", "speed")}
        for names, values in zip(self._names, (self.q, self.qdot)):
            columns |= dict(zip(names, values.T))
        return columns
