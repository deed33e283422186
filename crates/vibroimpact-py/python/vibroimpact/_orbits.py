"""Periodic orbits, stable or not."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from vibroimpact._core import QuestionError
from vibroimpact._motion import Motion
from vibroimpact._result import Listed, Made, field, parts


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
