"""Curves of events of orbits in two numbers of the system."""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact._branch import _Followed
from vibroimpact._oscillator import Oscillator
from vibroimpact._region import pair, pairs, ranges
from vibroimpact._result import Floats, Made, View, column, field, parts


class CurveEvent(View, schema="curve CurveEventObject"):
    """A point of codimension two on a curve, or an end of the curve."""

    kind: str
    values: list[float]
    point: int
    stop: str | None

    def __repr__(self) -> str:
        return f"<CurveEvent {self.kind} at {self.values[0]:.9g}, {self.values[1]:.9g}>"


class Curve(_Followed, schema="curve PointObject"):
    """A curve of an event of an orbit, from one end to the other.

    Attributes
    ----------
    ranges : ((float, float), (float, float))
        The ranges of both numbers.
    values : ndarray, shape (points, 2)
        Values of the two numbers.
    cycles : list of Events
        The events at each point; on a grazing curve of an oscillator including the impact of speed zero.
    """

    label: str
    kind: str
    of: list[str] | None
    found_at: list[float]
    through: Made[tuple[int, int]] = field(lambda of: (of["event"], of["point"]))
    parameters: Made[tuple[str, str]] = field(pair)
    ranges = field(lambda task: ranges(task["vary"], task["and"]), "plan.task.curve")
    admissible, residual = column(np.bool_), column(np.float64)
    values: Made[Floats] = Made(lambda of: pairs([at["values"] for at in of._rows]))
    events = parts(CurveEvent)

    def __repr__(self) -> str:
        p, q = self.parameters
        return f"<Curve of {self.kind} of {self.label} over {p} and {q}, {len(self)} points, {len(self.events)} events>"

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        p, q = self.parameters
        columns = {p: self.values[:, 0], q: self.values[:, 1], "admissible": self.admissible}
        return columns if isinstance(self.system, Oscillator) else {**columns, "residual": self.residual}
