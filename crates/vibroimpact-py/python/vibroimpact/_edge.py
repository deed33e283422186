"""The border between two motions."""

from __future__ import annotations

from typing import Any

import numpy as np

from vibroimpact._events import columns
from vibroimpact._motion import Motion
from vibroimpact._result import Answer, Made, column, parts


class Edge(Answer, schema="edge TrackObject"):
    """The border between two motions, and the motion on it.

    Attributes
    ----------
    q, qdot : ndarray, shape (len(time), coordinates)
        The coordinates and velocities of the states.
    """

    part: float
    sides = parts(Motion)
    saddle: Made[Motion | None] = Made(lambda of: of._of["saddle"] and Motion(of._of["saddle"], of.system))
    time, phase, apart = column(np.float64), column(np.float64), column(np.float64)
    q, qdot = column(np.float64), column(np.float64)
    _rows: Made[list[dict[str, Any]]] = Made(lambda of: of._of["track"])

    def __repr__(self) -> str:
        one, other = (side.label for side in self.sides)
        saddle = "no saddle" if self.saddle is None else f"saddle {self.saddle.label}"
        return f"<Edge of {one} and {other}, {saddle}>"

    def _table(self) -> dict[str, Any]:
        """One row for each state on the border."""
        names = self._of["system"]["coordinates"]
        states = tuple([f"{kind}.{name}" for name in names] for kind in ("q", "qdot"))
        return {**columns(self, ("time",), states), "phase": self.phase, "apart": self.apart}  # type: ignore[arg-type]
