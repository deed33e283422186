"""The steady motions to which scattered starts lead, and the share of the starts that lead to each."""

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._ask import System, ask
from vibroimpact._motion import Motion
from vibroimpact._progress import Progress
from vibroimpact._result import View
from vibroimpact._whole import BUDGET, SEED, STARTS, maybe, whole


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


class Attractors(View):
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

    @cached_property
    def motions(self) -> list[Attractor]:
        """The motions."""
        intervals = self._of["share_intervals"]
        return [Attractor(of, self.system, tuple(ends)) for of, ends in zip(self._of["motions"], intervals)]

    @property
    def share(self) -> NDArray[np.float64]:
        """The share of the starts that lead to each motion."""
        return np.array([motion.share for motion in self], dtype=np.float64)

    def __repr__(self) -> str:
        return f"<Attractors of {self.starts} starts: {', '.join(f'{m._words()}, {100 * m.share:.3g} %' for m in self)}>"

    def __iter__(self) -> Iterator[Attractor]:
        return iter(self.motions)

    def __len__(self) -> int:
        return len(self.motions)

    def __getitem__(self, k: int) -> Attractor:
        return self.motions[k]

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        return table(self.motions)


def attractors(
    system: System,
    starts: int = 200,
    *,
    seed: int = 1,
    impacts: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Attractors:
    """Find the steady motions to which many scattered starts lead, and their shares of the starts.

    The starts are spread evenly over a box of positions, velocities and phases that contains the motion. They are the
    same on every computer. Motions with the same label are distinguished if their events differ.

    Parameters
    ----------
    system : Oscillator or Machine
        The system.
    starts : int
        Number of starts, 1 to 1e9.
    seed : int
        Seed of the sequence of starts.
    impacts : int
        Budget of impacts for each start, of a machine of events. Motions that have not settled by then are undecided. Default: 20 000.
    threads : int
        Number of threads; 0 for one per core. The result does not depend on it.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> list(vi.attractors(vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)))
    [<Attractor 2/1, stable, 64 %>, <Attractor 1/1, stable, 36 %>]
    >>> vi.Machine.named("two-mass-hammer").attractors(20)
    <Attractors of 20 starts: 1/1, stable, 100 %>
    """
    starts = whole("starts", starts, STARTS)
    task = {"starts": starts, "seed": whole("seed", seed, SEED), "impacts": maybe("impacts", impacts, BUDGET)}
    found = ask(system, "attractors", task, total=starts, threads=threads, progress=progress, what="starts")
    return Attractors.answering(found, system)
