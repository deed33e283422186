"""Curves of an event of an orbit in a plane of two numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._branch import orbit_of, rows_of
from vibroimpact._events import Events
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Column, Field, Made, Parts, View, pair

class CurveEvent(View):
    """A point of codimension two on a curve, or an end of the curve.

    Attributes
    ----------
    kind : str
        "cusp", "resonant grazing", "double grazing", "1:1", "1:2", "fold-flip", "end of box" ...
    values : list of float
        Values of both numbers.
    point : int
        Index among the points of the curve.
    stop : str or None
        The stop or joint, if there is one.
    """

    kind: str
    values: list[float]
    point: int
    stop: str | None

    def __repr__(self) -> str:
        return f"<CurveEvent {self.kind} at {self.values[0]:.9g}, {self.values[1]:.9g}>"


class Curve(View):
    """A curve of an event of an orbit, from one end to the other.

    Attributes
    ----------
    system : Oscillator or Machine
        The system at which the orbit was searched.
    label, kind : str
        The label of the orbit; "fold", "flip", "grazing", of a machine also "torus", "corner", "sticking" or "holding".
    of : list of str or None
        The stop or joint of a curve of grazing, sticking or holding of a machine, or the stops and joints of a corner.
    parameters : (str, str)
        The two numbers.
    ranges : ((float, float), (float, float))
        Their ranges.
    values : ndarray, shape (points, 2)
        Values of the two numbers.
    admissible : ndarray of bool
        Whether the orbit is admissible.
    multipliers : ndarray of complex128
        Floquet multipliers; on a curve of grazing of a machine those of the cycle without the contact.
    residual : ndarray
        Of a machine: by how much the condition of the curve fails at each point. nan of an oscillator.
    cycles : list of Events
        The events at each point; on a grazing curve of an oscillator including the impact of speed zero.
    events : list of CurveEvent
        The events, in order along the curve.
    found_at : list of float
        Values of the first number at the events of this kind on the branch of the orbit.
    through : (int, int)
        The number, counted from 1, of the event through which the curve passes, and its index among the points.
    orbit : (int, int) or None
        The number of the orbit, and the number of orbits with its label; None for the motion from the start.
    plan : str
        The plan as JSON.
    """

    label: str
    kind: str
    of: list[str] | None
    found_at: list[float]
    orbit = Field(orbit_of)
    through: Field[tuple[int, int]] = Field(lambda of: (of["event"], of["point"]))
    parameters: Field[tuple[str, str]] = Field(pair)
    ranges: Field[tuple[tuple[float, float], tuple[float, float]]] = Field(
        lambda task: pair((task[side]["from"], task[side]["to"]) for side in ("vary", "and")), "plan.task.curve"
    )
    admissible, residual = Column(np.bool_), Column(np.float64)
    values: Made[NDArray[np.float64]] = Made(lambda of: np.array([at["values"] for at in of._rows], dtype=np.float64).reshape(-1, 2))
    multipliers: Made[NDArray[np.complex128]] = Made(lambda of: rows_of(of._rows))
    cycles: Made[list[Events]] = Made(lambda of: [Events.of(at["cycle"], of.system) for at in of._rows])
    events = Parts(CurveEvent)

    def __repr__(self) -> str:
        p, q = self.parameters
        return f"<Curve of {self.kind} of {self.label} over {p} and {q}, {len(self)} points, {len(self.events)} events>"

    def __len__(self) -> int:
        return len(self._rows)

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        p, q = self.parameters
        columns = {p: self.values[:, 0], q: self.values[:, 1], "admissible": self.admissible}
        return columns if isinstance(self.system, Oscillator) else {**columns, "residual": self.residual}
