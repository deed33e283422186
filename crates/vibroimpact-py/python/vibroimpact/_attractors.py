"""The steady motions of a system, and the share of starts that lead to each."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from vibroimpact import _core
from vibroimpact._core import Oscillator
from vibroimpact._motion import Motion, fields_of
from vibroimpact._progress import Progress, watched
from vibroimpact._whole import SEED, STARTS, THREADS, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Attractor(Motion):
    """A motion, the share of starts that lead to it, and their number."""

    share: float
    count: int

    def _remark(self) -> str:
        return f", {100 * self.share:.4g} %"

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON, a number that is not finite as None."""
        return {**Motion.to_dict(self), "share": self.share, "count": self.count}


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Attractors:
    """Motions, the most frequent first; a sequence of `Attractor`.

    Attributes
    ----------
    osc : Oscillator
        The system.
    motions : list of Attractor
        The motions.
    starts, seed : int
        How many starts, and which sequence of them.
    box : dict
        Ranges "x", "v" and "phase" of the starts.
    plan : str
        The question as JSON.
    """

    osc: Oscillator
    motions: list[Attractor]
    starts: int
    seed: int
    box: dict[str, tuple[float, float]]
    plan: str

    def __repr__(self) -> str:
        return f"<Attractors of {self.starts} starts: {', '.join(m.label for m in self)}>"

    def __iter__(self) -> Iterator[Attractor]:
        return iter(self.motions)

    def __len__(self) -> int:
        return len(self.motions)

    def __getitem__(self, k: int) -> Attractor:
        return self.motions[k]

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """The shares as bars."""
        from vibroimpact import _figure

        return _figure.shares(self.osc, [(m.label, m.share) for m in self], ax)


def attractors(
    osc: Oscillator, *, starts: int = 200, seed: int = 1, threads: int = 0, progress: Progress = None
) -> Attractors:
    """Find the steady motions that many scattered starts lead to, and their shares.

    Starts are spread evenly over positions, velocities and phases of a box around the motion; the same starts on every
    machine. Two motions with one label are two if their impacts differ.

    Parameters
    ----------
    osc : Oscillator
        The system.
    starts : int
        How many starts, 1 to 1e9.
    seed : int
        Which sequence of them.
    threads : int
        0 for one per core; the answer does not depend on it.
    progress : bool or callable
        True for a bar, or a function of what is done and what there is to do.

    Examples
    --------
    >>> from vibroimpact import Oscillator, attractors
    >>> list(attractors(Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)))
    [<Attractor 2/1, stable, 64 %>, <Attractor 1/1, stable, 36 %>]
    """
    with watched(progress, "starts") as tell:
        found = _core.attractors(
            osc, whole("starts", starts, STARTS), whole("seed", seed, SEED), whole("threads", threads, THREADS), tell
        )
    motions = [
        Attractor(**fields_of(osc, fields), share=share, count=count) for fields, share, count in found["motions"]
    ]
    box = {name: found[name] for name in ("x", "v", "phase")}
    return Attractors(osc, motions, starts, seed, box, found["plan"])
