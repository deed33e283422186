"""Events of motions as columns, measured numbers and complex numbers: parts of the JSON of the command that many results have."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact._result import Floats, Result
from vibroimpact._system import names_of

#: The columns of a table of events before those of the states.
OF_EVENTS = ("kind", "stop", "time", "phase", "speed")


def columns(of: Any, first: Sequence[str], states: tuple[list[str], list[str]]) -> dict[str, Any]:
    """Columns of a result, and then its coordinates and velocities by these names."""
    positions, velocities = states
    own = {name: getattr(of, name) for name in first}
    return {**own, **dict(zip(positions, of.q.T)), **dict(zip(velocities, of.qdot.T))}


def columns_of(found: Mapping[str, Any], n: int) -> dict[str, Any]:
    """The columns of events of the compiled module, of a system with `n` coordinates."""
    time, phase, speed, *states = found["real"]
    kinds, stops = (np.array(found[name], dtype=np.str_) for name in ("kinds", "stops"))
    kind, stop = (names[codes] if len(names) else np.empty(0, np.str_) for names, codes in ((kinds, found["kind"]), (stops, found["stop"])))
    q, qdot = (np.stack(of, axis=1) for of in (states[:n], states[n:]))
    return {"kind": kind, "stop": stop, "time": time, "phase": phase, "speed": speed, "q": q, "qdot": qdot}


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Events(Result):
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
    time: Floats
    phase: Floats
    speed: Floats
    q: Floats
    qdot: Floats
    _names: tuple[list[str], list[str]]

    def __repr__(self) -> str:
        return f"<Events: {len(self)}>"

    def __len__(self) -> int:
        return len(self.kind)

    @classmethod
    def of(cls, events: Sequence[Mapping[str, Any]], system: Any) -> "Events":
        """The events of the JSON of the command."""
        names = names_of(system)

        def floats(name: str) -> Floats:
            return np.array([event.get(name, math.nan) for event in events], dtype=np.float64)

        def rows(name: str) -> Floats:
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
        return columns(self, OF_EVENTS, self._names)


class Measured(NamedTuple):
    """A number and its error bar, which is three standard errors; 0 if the number is exact."""

    value: float
    error: float


def measured(given: Mapping[str, Any]) -> Measured:
    """Of the JSON object; null stands for an infinite or an undefined number."""
    value, error = given["value"], given["error"]
    if value is None:
        value = {"minus_infinity": -math.inf, "infinity": math.inf}.get(given.get("why", ""), math.nan)
    # an infinite number is exact
    return Measured(value, error if error is not None else 0.0 if math.isinf(value) else math.nan)


def maybe_measured(given: Mapping[str, Any] | None) -> Measured | None:
    """Of the JSON object; None if there is none."""
    return None if given is None else measured(given)


def all_measured(given: Sequence[Mapping[str, Any]] | None) -> tuple[Measured, ...] | None:
    """Of a list of them; None if there is none."""
    return None if given is None else tuple(measured(one) for one in given)


def complex_of(pairs: Sequence[Sequence[float | None]] | None) -> NDArray[np.complex128]:
    """Complex numbers of pairs; null is infinite."""
    numbers = [complex(*(math.inf if part is None else part for part in pair)) for pair in pairs or ()]
    return np.array(numbers, dtype=np.complex128)
