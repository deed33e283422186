"""Motions followed event by event."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._events import OF_EVENTS, columns, columns_of
from vibroimpact._json import read
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Answer, Floats
from vibroimpact._system import names_of
from vibroimpact._waveform import Waveform, waveform


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
