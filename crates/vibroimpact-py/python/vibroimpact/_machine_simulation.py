"""The events of a motion of a machine, and its waveform."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._ask import MachineLike, State
from vibroimpact._events import names_of
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineSimulation(Result):
    """The events of a motion of a machine as columns, and the reason why the list ends.

    Attributes
    ----------
    machine : Machine
        The machine.
    start : (list, list, float)
        Coordinates, velocities and phase of the start.
    kind : ndarray of str
        "impact", "close", "open", "stick", "release", "slip", "hold", "graze" or "collapse".
    stop : ndarray of str
        The name of the stop or joint.
    time, phase : ndarray
        Time and phase of each event; phases in radians in [0, 2 pi).
    speed : ndarray
        Speed of closing before the event; of an opening that of separation; of a slip the direction, 1 or -1.
    q, qdot : ndarray, events x coordinates
        Coordinates, and velocities after the event.
    with_ : tuple of tuples of str
        Other stops that take part at the same time.
    tie : tuple of bool
        Whether impacts at one time would lead elsewhere if one of the stops were struck first.
    end : str
        Why the list ends: "event_limit", "time_limit", "no_more_impacts", "stuck", "search_limit", "inconsistent" or
        "collapse".
    end_time : float
        The time at which the list ends.
    shown_until : float
        The time up to which a waveform is shown.
    plan : str
        The plan as JSON.
    """

    machine: MachineLike
    start: tuple[list[float], list[float], float]
    kind: NDArray[np.str_]
    stop: NDArray[np.str_]
    time: _Floats
    phase: _Floats
    speed: _Floats
    q: _Floats
    qdot: _Floats
    with_: tuple[tuple[str, ...], ...]
    tie: tuple[bool, ...]
    end: str
    end_time: float
    shown_until: float
    plan: str

    def __repr__(self) -> str:
        return f"<MachineSimulation of {len(self)} events, ends with {self.end} at time {self.end_time:.6g}>"

    def __len__(self) -> int:
        return len(self.time)

    def state(self, event: int = -1) -> dict[str, Any]:
        """The state from which the motion goes on after an event, the last by default: `q`, `qdot`, `phase`, what stops and
        joints do (`contacts`), and the digits that these leave out (`exact`). `Machine.starting` takes it.

        Parameters
        ----------
        event : int
            Number of the event, counted from 0, or from the end if it is negative.
        """
        number = range(len(self))[event]
        found: dict[str, Any] = json.loads(_core.machine_state(self.plan, number))
        return found

    def waveform(self, step: float | None = None, *, events: bool = False) -> "MachineWaveform":
        """The motion at equal steps of time, up to `shown_until`.

        Parameters
        ----------
        step : float
            Time between two points. Default: a thousandth of the whole time.
        events : bool
            Whether to add both sides of each event, at the same time, and the end.
        """
        step = self.shown_until / 1000 or 1.0 if step is None else float(step)
        fields = _core.machine_waveform(self.machine._file, self.start, self.shown_until, step, events)
        return MachineWaveform(machine=self.machine, **fields)

    def plot(self, axes: "Sequence[Axes] | None" = None) -> "NDArray[Any]":
        """Draw the coordinates over time with contacts and impacts, and below them the contact forces, if there are any.

        `axes` are one or two axes to draw into. Returns the axes.
        """
        from vibroimpact import _machine_figure

        return _machine_figure.draw(self, axes)

    def _table(self) -> dict[str, Any]:
        """One row for each event; coordinates and velocities by their paths."""
        columns = {name: getattr(self, name) for name in ("kind", "stop", "time", "phase", "speed")}
        return {**columns, **_by_name(self.machine, self.q, self.qdot)}

    def _draw(self, ax: Any) -> None:
        self.plot([ax])


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineWaveform(Result):
    """A motion of a machine at equal steps of time.

    Attributes
    ----------
    machine : Machine
        The machine.
    time, phase : ndarray
        Time and phase of the forcing.
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

    machine: MachineLike
    time: _Floats
    phase: _Floats
    q: _Floats
    qdot: _Floats
    gap: _Floats
    force: _Floats
    contact: NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<MachineWaveform of {len(self)} points>"

    def __len__(self) -> int:
        return len(self.time)

    def _table(self) -> dict[str, Any]:
        """One row for each point; coordinates, velocities, gaps and forces by their paths."""
        columns = {"time": self.time, "phase": self.phase, **_by_name(self.machine, self.q, self.qdot)}
        stops, contacts = self.machine.stops, self.machine.stops + self.machine.joints
        columns |= {f"gap.{name}": self.gap[:, k] for k, name in enumerate(stops)}
        return columns | {f"force.{name}": self.force[:, k] for k, name in enumerate(contacts)}


def _by_name(machine: MachineLike, q: _Floats, qdot: _Floats) -> dict[str, _Floats]:
    """Coordinates and velocities by their paths."""
    positions, velocities = names_of(machine)
    return {**dict(zip(positions, q.T)), **dict(zip(velocities, qdot.T))}


def simulate(
    machine: MachineLike, start: State, impacts: int | None, periods: float | None, progress: Progress
) -> MachineSimulation:
    """Follow a motion of a machine event by event."""
    with watched(progress, "events") as tell:
        fields = _core.simulate_machine(machine._file, start, impacts, periods, tell)
    kind, stop = (np.array(fields.pop(name), dtype=np.str_) for name in ("kind", "stop"))
    with_ = tuple(tuple(names) for names in fields.pop("with_"))
    tie = tuple(fields.pop("tie"))
    return MachineSimulation(machine=machine, start=start, kind=kind, stop=stop, with_=with_, tie=tie, **fields)
