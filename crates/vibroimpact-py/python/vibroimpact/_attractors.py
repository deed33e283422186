"""The steady motions to which scattered starts lead, and the share of the starts that lead to each."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._motion import Motion
from vibroimpact._result import Made, Sequence


class Attractor(Motion):
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


#: The columns of a table of motions.
NAMES = ("label", "kind", "stable", "stability", "seen_events", "impacts", "periods", "share", "starts")


def table(motions: "list[Attractor]") -> dict[str, Any]:
    """One row for each motion."""
    columns = {name: [getattr(motion, name) for motion in motions] for name in NAMES}
    return {**columns, "stop": [" ".join(motion.stops) for motion in motions]}


class Attractors(Sequence[Attractor]):
    """A sequence of `Attractor`, the most frequent first.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    motions : list of Attractor
        The motions.
    share : ndarray
        The share of the starts that lead to each.
    starts, seed : int
        The number of starts, and the seed of their sequence.
    box : dict or None
        Ranges of the starts of an oscillator in "x", "v" and "phase".
    missed_below : float
        Largest share of a motion that no start has shown, at a confidence of 95 %: 1 - 0.05^(1/starts).
    plan : str
        The plan as JSON.
    """

    starts: int
    seed: int
    box: dict[str, list[float]] | None
    missed_below: float
    motions: Made[list[Attractor]] = Made(
        lambda of: [Attractor(one, of.system, tuple(ends)) for one, ends in zip(of._of["motions"], of._of["share_intervals"])]
    )
    share: Made[NDArray[np.float64]] = Made(lambda of: np.array([motion.share for motion in of], dtype=np.float64))
    _items: Made[list[Attractor]] = Made(lambda of: of.motions)

    def __repr__(self) -> str:
        return f"<Attractors of {self.starts} starts: {', '.join(f'{m._words()}, {100 * m.share:.3g} %' for m in self)}>"

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        return table(self.motions)
