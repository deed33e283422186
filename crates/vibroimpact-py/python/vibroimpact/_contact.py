"""The contact of a mass with a spring and a damper."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from vibroimpact import _core
from vibroimpact._json import read
from vibroimpact._result import Answer, Made, column


class Contact(Answer, schema="contact ContactObject"):
    """Contacts in closed form, a row for each way to open. Numbers are in SI units."""

    speed: float
    #: A contact is no task of a plan.
    plan = None  # type: ignore[assignment]
    _rows: Made[list[dict[str, Any]]] = Made(lambda view: view._of["contacts"])
    opening = column(np.str_)
    restitution, damping_ratio, mass, stiffness, damping, frequency = (column(np.float64) for _ in range(6))
    contact_time, depth_max, force_max, residual_depth = (column(np.float64) for _ in range(4))

    def __init__(self, asked: str) -> None:
        answer, self._drawn = _core.contact(asked)
        super().__init__(json.loads(answer), None)

    def __repr__(self) -> str:
        return f"<Contact: {', '.join(f'restitution {e:.6g} opening by {of}' for e, of in zip(self.restitution, self.opening))}>"

    def _table(self) -> dict[str, Any]:
        """One row for each way to open."""
        names = dict.fromkeys(name for row in self._rows for name in row)
        return {name: [row.get(name) for row in self._rows] for name in names}

    def _figure(self, **options: Any) -> dict[str, Any]:
        return read(self._drawn)


def contact(
    *, mass: float | None = None, stiffness: float | None = None, frequency: float | None = None, contact_time: float | None = None,
    restitution: float | None = None, damping: float | None = None, damping_ratio: float | None = None, speed: float = 1.0,
    opening: str | None = None,
) -> Contact:
    """Convert between restitution, stiffness and damping of the contact of a free mass with a spring and a damper beside it.

    Parameters
    ----------
    mass, stiffness, frequency, contact_time : float
        Two of mass (kg), stiffness (N/m) and frequency (Hz), or the frequency alone, or the mass and the contact time (s).
    restitution, damping, damping_ratio : float
        What the contact loses: one of restitution, above 0 and up to 1, damping (N s/m), and damping ratio.
    speed : float
        Speed of approach in m/s.
    opening : str
        "force" or "position"; by default both.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> found = vi.contact(restitution=0.6, mass=0.8, stiffness=2e5)
    >>> found.opening.tolist(), found.damping.round(3).tolist()
    (['force', 'position'], [144.687, 128.394])
    >>> vi.contact(restitution=0.6, mass=0.8, contact_time=found.contact_time[0], opening="force").stiffness.round(3).tolist()
    [200000.0]
    """
    numbers = {name: float(value) for name, value in locals().items() if value is not None and name != "opening"}
    return Contact(json.dumps(numbers | ({"opening": opening} if opening else {})))
