"""The motions to which many starts lead, and their shares of the starts."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._json import read
from vibroimpact._motion import Motion
from vibroimpact._result import Floats, Listed, Made

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
