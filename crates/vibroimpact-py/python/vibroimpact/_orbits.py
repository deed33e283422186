"""The periodic orbits with a label, stable or not."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import Oscillator
from vibroimpact._motion import Motion, fields_of
from vibroimpact._progress import Progress, watched



class EarlierContact(NamedTuple):
    """The first contact of an inadmissible solution with a stop before its next impact."""

    #: The number of the impact before the contact, counted from 1; None if the solution has no impacts.
    after_impact: int | None
    #: "upper" or "lower".
    stop: str
    #: Time from that impact, or from phase 0, to the contact.
    time: float


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Orbit(Motion):
    """A periodic orbit, admissible or not."""

    #: Whether it is admissible; False for a solution of the equations that passes through a stop.
    physical: bool
    #: For an inadmissible solution, its first contact with a stop before its next impact.
    earlier_contact: EarlierContact | None

    def _remark(self) -> str:
        return "" if self.physical else ", inadmissible"

    def waveform(
        self, points_per_period: float = 200, periods: float | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """As for a Motion. Raises QuestionError for an inadmissible solution."""
        if not self.physical:
            raise _core.QuestionError(f"this solution {self.label} is inadmissible: it passes through a stop on its way")
        return Motion.waveform(self, points_per_period, periods)

    def to_dict(self) -> dict[str, Any]:
        """The object of the orbit in the JSON of the command."""
        earlier = None if self.earlier_contact is None else self.earlier_contact._asdict()
        return {**Motion.to_dict(self), "admissible": self.physical, "earlier_contact": earlier}


def orbits(osc: Oscillator, label: str, *, progress: Progress = None) -> list[Orbit]:
    """Find the periodic orbits with m impacts in n forcing periods, stable or not. The fastest one comes last.

    Orbits are searched by Newton's method from many seeds; orbits 1/n are also computed in closed form. An orbit to which
    no seed leads is not found. Solutions that pass through a stop are inadmissible and marked as such; only some of them
    are found.

    Parameters
    ----------
    osc : Oscillator
        The system.
    label : str
        "m/n", "inf/n", or "0" for the motion without impacts.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> from vibroimpact import Oscillator, orbits
    >>> osc = Oscillator(inverse_beta=1.11, gap=2, restitution=0.5)
    >>> orbits(osc, "1/1")
    [<Orbit 1/1, unstable>]
    >>> [orbit for orbit in orbits(osc, "1/2") if orbit.physical and orbit.stable]
    [<Orbit 1/2, stable>]
    """
    with watched(progress, "searches") as tell:
        found = _core.orbits(osc, label, tell)
    return [
        Orbit(
            **fields_of(osc, fields),
            physical=physical,
            earlier_contact=None if earlier is None else EarlierContact(*earlier),
        )
        for fields, physical, earlier in found
    ]
