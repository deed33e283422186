"""Answers with several motions: attractors and their shares of starts, periodic orbits, and the border between two motions."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._events import columns
from vibroimpact._json import read
from vibroimpact._motion import Motion
from vibroimpact._result import Answer, Floats, Listed, Made, column, field, parts

#: The columns of a table of motions.
_OF_MOTIONS = ("label", "kind", "stable", "stability", "seen_events", "impacts", "periods", "share", "starts")


class Attractor(Motion, schema="attractors SharedMotion"):
    """A motion, with the share (0 to 1) and the number of the `starts` that lead to it.

    `share_interval` is Wilson's interval of the share at a confidence of 95 %, for random starts. Starts of a sequence of
    low discrepancy, which these are, are more even.
    """

    share: float
    starts: int

    def __init__(self, of: dict[str, Any], system: Any, interval: tuple[float, float]) -> None:
        super().__init__(of, system)
        self.share_interval = interval

    def _remark(self) -> str:
        return f", {100 * self.share:.4g} %"


class Attractors(Listed[Attractor], schema="attractors"):
    """A sequence of `Attractor`, the most frequent first.

    Attributes
    ----------
    share : ndarray
        The share of the starts that lead to each.
    """

    starts: int
    seed: int
    box: dict[str, list[float]] | None
    missed_below: float
    motions: Made[list[Attractor]] = Made(
        lambda of: [Attractor(one, of.system, tuple(ends)) for one, ends in zip(of._of["motions"], of._of["share_intervals"])]
    )
    share: Made[Floats] = Made(lambda of: np.array([motion.share for motion in of], dtype=np.float64))
    _items: Made[list[Attractor]] = Made(lambda of: of.motions)

    def __repr__(self) -> str:
        return f"<Attractors of {self.starts} starts: {', '.join(f'{m._words()}, {100 * m.share:.3g} %' for m in self)}>"

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        columns = {name: [getattr(motion, name) for motion in self] for name in _OF_MOTIONS}
        return {**columns, "stop": [" ".join(motion.stops) for motion in self]}


class Settlement(Attractors):
    """The motions to which many starts lead, in the order of their first start, with their shares.

    Attributes
    ----------
    cells : ndarray of uint32
        The motion of each start as an index into `motions`, in the shape of the starts.
    labels : ndarray of str
        The label of the motion of each start, in the shape of the starts.
    """

    cells: NDArray[np.uint32]

    def __repr__(self) -> str:
        return f"<Settlement of {self.cells.size} starts: {', '.join(m.label for m in self)}>"

    def to_dict(self) -> dict[str, Any]:
        """The motions as in the JSON of the command, and the number of the motion of each start."""
        return {"motions": [motion.to_dict() for motion in self], "cells": self.cells.tolist()}

    def _figure(self, **shown: Any) -> dict[str, Any]:
        return read(_core.shares_figure(self.system._file, [(motion.label, motion.share) for motion in self]))

    labels: Made[NDArray[np.str_]] = Made(lambda of: np.array([motion.label for motion in of], dtype=np.str_)[of.cells])


class EarlierContact(NamedTuple):
    """The first contact of an inadmissible solution with a stop before its next impact."""

    #: The number of the impact before the contact, counted from 1; None if the solution has no impacts.
    after_impact: int | None
    #: "upper" or "lower".
    stop: str
    #: Time from that impact, or from phase 0, to the contact.
    time: float


class Orbit(Motion, schema="orbit OrbitObject"):
    """A periodic orbit. `admissible` is False for a solution of the equations of an oscillator that passes through a stop;
    `earlier_contact` is its first contact with a stop before its next impact.
    """

    admissible: bool
    earlier_contact: Made[EarlierContact | None] = field(lambda of: of and EarlierContact(**of))

    def _remark(self) -> str:
        return "" if self.admissible else ", inadmissible"

    def _begin(self, lacking: str) -> tuple[Any, dict[str, Any]]:
        if not self.admissible:
            raise QuestionError(f"this solution {self.label} is inadmissible: it passes through a stop on its way")
        return super()._begin(lacking)


class Orbits(Listed[Orbit], schema="orbit"):
    """A sequence of `Orbit`, the fastest last."""

    orbits = parts(Orbit)
    _items: Made[list[Orbit]] = Made(lambda of: of.orbits)

    def __repr__(self) -> str:
        return f"<Orbits: {', '.join(map(repr, self)) or 'none found'}>"

    def _table(self) -> dict[str, Any]:
        """One row for each event of each orbit."""
        tables = [of.cycle._table() for of in self]
        names = tables[0] if tables else {}
        number = np.repeat(np.arange(1, len(self) + 1), [len(of.cycle) for of in self])
        return {"orbit": number, **{name: np.concatenate([table[name] for table in tables]) for name in names}}

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draw the speed and the phase of each closing of a stop, for all orbits; options as for other results."""
        if not len(self):
            raise QuestionError("there are no orbits to draw")
        return super().plot(ax, **options)


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
