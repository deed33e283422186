"""The attractors of a system, and the share of starts that lead to each."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from vibroimpact import _core
from vibroimpact._core import Oscillator
from vibroimpact._motion import Motion, fields_of
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result
from vibroimpact._whole import BUDGET, SEED, STARTS, THREADS, maybe, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Attractor(Motion):
    """A motion, with the share (0 to 1) and the number of the starts that lead to it.

    `share_interval` is Wilson's interval of the share at a confidence of 95 %, for random starts. Starts of a sequence of
    low discrepancy, which these are, are more even.
    """

    share: float
    count: int
    share_interval: tuple[float, float]

    def _remark(self) -> str:
        return f", {100 * self.share:.4g} %"

    def to_dict(self) -> dict[str, Any]:
        """The object of the motion in the JSON of the command."""
        return {**Motion.to_dict(self), "share": self.share, "starts": self.count}


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Attractors(Result):
    """A sequence of `Attractor`, the most frequent first.

    Attributes
    ----------
    osc : Oscillator
        The system.
    motions : list of Attractor
        The motions.
    starts, seed : int
        The number of starts, and the seed of their sequence.
    box : dict
        Ranges of the starts in "x", "v" and "phase".
    missed_below : float
        Largest share of a motion that no start has shown, at a confidence of 95 %: 1 - 0.05^(1/starts).
    plan : str
        The plan as JSON.
    """

    osc: Oscillator
    motions: list[Attractor]
    starts: int
    seed: int
    box: dict[str, tuple[float, float]]
    missed_below: float
    plan: str

    def __repr__(self) -> str:
        return f"<Attractors of {self.starts} starts: {', '.join(m.label for m in self)}>"

    def __iter__(self) -> Iterator[Attractor]:
        return iter(self.motions)

    def __len__(self) -> int:
        return len(self.motions)

    def __getitem__(self, k: int) -> Attractor:
        return self.motions[k]

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        names = ("label", "kind", "stable", "stability", "impacts", "periods", "share", "count")
        return {name: [getattr(motion, name) for motion in self] for name in names}

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the shares as bars."""
        from vibroimpact import _figure

        return _figure.shares(_figure.title(self.osc), [(m.label, m.share) for m in self], ax)


def attractors(
    osc: Oscillator,
    *,
    starts: int = 200,
    seed: int = 1,
    impacts: int | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Attractors:
    """Find the attractors to which many scattered starts lead, and their shares of the starts.

    The starts are spread evenly over a box of positions, velocities and phases that contains the motion. They are the
    same on every machine. Motions with the same label are distinguished if their impacts differ.

    Parameters
    ----------
    osc : Oscillator
        The system.
    starts : int
        Number of starts, 1 to 1e9.
    seed : int
        Seed of the sequence of starts.
    impacts : int
        Budget of impacts for each start. Motions that have not settled by then are undecided. Default: 20 000.
    threads : int
        Number of threads; 0 for one per core. The result does not depend on it.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Examples
    --------
    >>> from vibroimpact import Oscillator, attractors
    >>> list(attractors(Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)))
    [<Attractor 2/1, stable, 64 %>, <Attractor 1/1, stable, 36 %>]
    """
    with watched(progress, "starts") as tell:
        found = _core.attractors(
            osc,
            whole("starts", starts, STARTS),
            whole("seed", seed, SEED),
            maybe("impacts", impacts, BUDGET),
            whole("threads", threads, THREADS),
            tell,
        )
    motions = [
        Attractor(
            **fields_of(osc, fields), share=share, count=count, share_interval=_core.share_interval(count, starts)
        )
        for fields, share, count in found["motions"]
    ]
    box = {name: found[name] for name in ("x", "v", "phase")}
    return Attractors(osc, motions, starts, seed, box, _core.missed_share(starts), found["plan"])
