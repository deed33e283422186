"""The periodic orbits with a label, stable or not."""

from collections.abc import Iterator
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from vibroimpact._ask import System, ask
from vibroimpact._core import QuestionError
from vibroimpact._motion import Motion
from vibroimpact._progress import Progress
from vibroimpact._result import View
from vibroimpact._simulate import Simulation
from vibroimpact._waveform import Waveform


class EarlierContact(NamedTuple):
    """The first contact of an inadmissible solution with a stop before its next impact."""

    #: The number of the impact before the contact, counted from 1; None if the solution has no impacts.
    after_impact: int | None
    #: "upper" or "lower".
    stop: str
    #: Time from that impact, or from phase 0, to the contact.
    time: float


class Orbit(Motion):
    """A periodic orbit. `admissible` is False for a solution of the equations of an oscillator that passes through a stop."""

    admissible: bool

    @property
    def earlier_contact(self) -> EarlierContact | None:
        """For an inadmissible solution, its first contact with a stop before its next impact."""
        found = self._of["earlier_contact"]
        return None if found is None else EarlierContact(**found)

    def _remark(self) -> str:
        return "" if self.admissible else ", inadmissible"

    def waveform(self, step: float | None = None, *, periods: float | None = None, events: bool = True) -> Waveform:
        """As for a Motion. Raises QuestionError for an inadmissible solution."""
        self._check()
        return Motion.waveform(self, step, periods=periods, events=events)

    def _some_periods(self) -> Simulation:
        self._check()
        return Motion._some_periods(self)

    def _check(self) -> None:
        if not self.admissible:
            raise QuestionError(f"this solution {self.label} is inadmissible: it passes through a stop on its way")


class Orbits(View):
    """A sequence of `Orbit`, the fastest last.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    orbits : list of Orbit
        The orbits.
    plan : str
        The plan as JSON.
    """

    @cached_property
    def orbits(self) -> list[Orbit]:
        """The orbits."""
        return [Orbit(of, self.system) for of in self._of["orbits"]]

    def __repr__(self) -> str:
        return f"<Orbits: {', '.join(map(repr, self.orbits)) or 'none found'}>"

    def __iter__(self) -> Iterator[Orbit]:
        return iter(self.orbits)

    def __len__(self) -> int:
        return len(self.orbits)

    def __getitem__(self, k: int) -> Orbit:
        return self.orbits[k]

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


def orbits(system: System, label: str, *, progress: Progress = None) -> Orbits:
    """Find the periodic orbits with m closings of stops in n forcing periods, stable or not. The fastest one comes last.

    Orbits are searched by Newton's method from many seeds; orbits 1/n of an oscillator are also computed in closed form. An orbit
    to which no seed leads is not found. Solutions that pass through a stop are inadmissible and marked as such; only some of
    them are found, and none of a machine.

    Parameters
    ----------
    system : Oscillator or Machine
        The system.
    label : str
        "m/n", "inf/n", "m/T" without forcing, or "0" for the motion of an oscillator without impacts.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> osc = vi.Oscillator(inverse_beta=1.11, gap=2, restitution=0.5)
    >>> vi.orbits(osc, "1/1")
    <Orbits: <Orbit 1/1, unstable>>
    >>> [orbit for orbit in vi.orbits(osc, "1/2") if orbit.admissible and orbit.stable]
    [<Orbit 1/2, stable>]
    >>> vi.Machine.named("two-mass-hammer").orbits("1/1")[-1].stable
    True
    """
    return Orbits.answering(ask(system, "orbit", {"label": label}, progress=progress, what="searches"), system)
