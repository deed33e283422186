"""The border between the starts that lead to two motions, and the unstable motion on it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from vibroimpact._motion import Motion
from vibroimpact._result import Column, Made, Parts, View


class Edge(View):
    """The border between two motions, and the motion on it.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    sides : list of Motion
        The motion of the first start, and that beyond the border.
    part : float
        Where the border crosses the way from the first start to the second: 0 at the first, 1 at the second.
    saddle : Motion or None
        The periodic motion to which the motion on the border leads; None if it came back to none of its earlier states.
    time : ndarray
        The times of the states on the border, one a lap.
    q, qdot : ndarray, shape (len(time), coordinates)
        Their coordinates and velocities.
    phase : ndarray
        Their phases.
    apart : ndarray
        The distances of the two states between which the border passes, relative to their sizes.
    plan : str
        The plan as JSON.
    """

    part: float
    sides = Parts(Motion)
    saddle: Made[Motion | None] = Made(lambda of: of._of["saddle"] and Motion(of._of["saddle"], of.system))
    time = Column(np.float64)
    phase = Column(np.float64)
    apart = Column(np.float64)
    q: Made[NDArray[np.float64]] = Made(lambda of: np.array([row["q"] for row in of._rows]))
    qdot: Made[NDArray[np.float64]] = Made(lambda of: np.array([row["qdot"] for row in of._rows]))
    _rows: Made[list[dict[str, Any]]] = Made(lambda of: of._of["track"])

    def __repr__(self) -> str:
        one, other = (side.label for side in self.sides)
        saddle = "no saddle" if self.saddle is None else f"saddle {self.saddle.label}"
        return f"<Edge of {one} and {other}, {saddle}>"

    def _table(self) -> dict[str, Any]:
        """One row for each state on the border."""
        names = self._of["system"]["coordinates"]
        states = {f"{kind}.{name}": getattr(self, kind)[:, k] for kind in ("q", "qdot") for k, name in enumerate(names)}
        return {"time": self.time, **states, "phase": self.phase, "apart": self.apart}
