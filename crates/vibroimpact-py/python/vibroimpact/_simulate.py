"""Simulation of a motion event by event."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._events import columns_of, named_columns, names_of
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import View
from vibroimpact._waveform import Waveform, waveform

_Floats = NDArray[np.float64]


class Simulation(View):
    """The events of a motion as columns, and the reason why the list ends.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    start : tuple
        The start: position (None: at rest, or on the stop), velocity and phase; of a machine coordinates, velocities and phase.
    kind : ndarray of str
        "impact", "close", "open", "stick", "release", "slip", "hold", "graze" or "collapse".
    stop : ndarray of str
        The name of the stop or joint; of an oscillator "upper" or "lower".
    time, phase : ndarray
        Time and phase of each event; phases in radians in [0, 2 pi).
    speed : ndarray
        Speed of closing before the event, 0 where nothing closes; of an opening that of separation; of a slip the direction, 1 or -1.
    q, qdot : ndarray, events x coordinates
        Coordinates, and velocities after the event.
    with_ : tuple of tuples of str
        Other stops of a machine that take part at the same time.
    tie : ndarray of bool
        Whether impacts at one time would lead elsewhere if one of the stops were struck first.
    depth : ndarray
        For a graze of an oscillator: the remaining distance to the stop, which is 0 within rounding. Otherwise nan.
    chatter : ndarray of bool
        For a stick of an oscillator: whether it is the end of a complete chatter.
    error : ndarray
        For a stick of an oscillator: the bound on the error of its time. Otherwise nan.
    end : str
        Why the list ends: "impact_limit", "event_limit", "time_limit", "no_more_impacts", "stuck", "search_limit", "inconsistent" or
        "collapse".
    end_time : float
        The time at which the list ends.
    horizon : dict or None
        Why an oscillator has no more impacts, if this is decided.
    shown_until : float
        The time up to which figures and waveforms show the motion.
    plan : str
        The plan as JSON.
    """

    start: tuple[Any, Any, float]
    kind: NDArray[np.str_]
    stop: NDArray[np.str_]
    time: _Floats
    phase: _Floats
    speed: _Floats
    q: _Floats
    qdot: _Floats
    with_: tuple[tuple[str, ...], ...]
    tie: NDArray[np.bool_]
    depth: _Floats
    chatter: NDArray[np.bool_]
    error: _Floats
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
        found: dict[str, Any] = json.loads(_core.machine_state(self.plan, number))
        return found

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

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json."""
        found: dict[str, Any] = json.loads(self._whole.json(False))
        return found

    def _painted(self, *how: Any) -> Any:
        # that of a machine may have two panels
        drawn = super()._painted(*how)
        return drawn if isinstance(self.system, Oscillator) else np.atleast_1d(drawn)

    def _table(self) -> dict[str, Any]:
        """One row for each event; coordinates and velocities by their paths."""
        columns = {name: getattr(self, name) for name in ("kind", "stop", "time", "phase", "speed")}
        columns |= named_columns(self.system, self.q, self.qdot)
        if isinstance(self.system, Oscillator):
            return columns | {"depth": self.depth, "chatter": self.chatter, "error": self.error}
        return columns | {"with": [", ".join(names) for names in self.with_], "tie": self.tie}
