"""The periodic orbits of a label, stable or not."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._core import Oscillator
from vibroimpact._motion import Motion, fields_of



class EarlierContact(NamedTuple):
    """Where an inadmissible solution meets a stop before its next impact."""

    #: After which of its impacts, counted from 1; None where it has no impacts.
    after_impact: int | None
    #: "upper" or "lower".
    side: str
    #: How long after that impact, or after phase 0.
    time: float


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Orbit(Motion):
    """A periodic orbit, and whether it is a possible motion."""

    #: False for a solution of the equations that passes through a stop on its way.
    physical: bool
    #: Where it does so first.
    earlier_contact: EarlierContact | None

    def _remark(self) -> str:
        return "" if self.physical else ", inadmissible"

    def waveform(
        self, points_per_period: float = 200, periods: float | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """As that of a Motion; an inadmissible solution has none."""
        if not self.physical:
            raise _core.QuestionError(f"this solution {self.label} is inadmissible: it passes through a stop on its way")
        return Motion.waveform(self, points_per_period, periods)

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON, a number that is not finite as None."""
        earlier = None if self.earlier_contact is None else self.earlier_contact._asdict()
        return {**Motion.to_dict(self), "physical": self.physical, "earlier_contact": earlier}


def orbits(osc: Oscillator, label: str) -> list[Orbit]:
    """Find all periodic orbits with m impacts in n forcing periods, stable or not, the fastest last.

    Looked for by Newton's method from many seeds, and in closed form for 1/n. An orbit that no seed leads to is not
    found. Solutions that pass through a stop on their way are inadmissible and marked; only some of them are found.

    Parameters
    ----------
    osc : Oscillator
        The system.
    label : str
        "m/n", "inf/n", or "0" for the steady motion without impacts.

    Examples
    --------
    >>> from vibroimpact import Oscillator, orbits
    >>> osc = Oscillator(inverse_beta=1.11, gap=2, restitution=0.5)
    >>> orbits(osc, "1/1")
    [<Orbit 1/1, unstable>]
    >>> [orbit for orbit in orbits(osc, "1/2") if orbit.physical and orbit.stable]
    [<Orbit 1/2, stable>]
    """
    found = _core.orbits(osc, label)
    return [
        Orbit(
            **fields_of(osc, fields),
            physical=physical,
            earlier_contact=None if earlier is None else EarlierContact(*earlier),
        )
        for fields, physical, earlier in found
    ]
