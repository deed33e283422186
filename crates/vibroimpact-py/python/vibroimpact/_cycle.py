"""The impacts of a periodic orbit as columns."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._result import Result


@dataclass(frozen=True, eq=False, slots=True)
class Cycle(Result):
    """The impacts of a cycle in order of time. The first is the fastest one or, after sticking, the first one after the release.

    Attributes
    ----------
    phase : ndarray
        Phase of the force at each impact, radians in [0, 2 pi).
    velocity_before : ndarray
        Speed before each impact, positive.
    interval : ndarray
        Time to the next impact; for the last impact before sticking, time to the end of the chatter.
    side : ndarray of int8
        +1 for the first stop, -1 for the second.
    """

    phase: NDArray[np.float64]
    velocity_before: NDArray[np.float64]
    interval: NDArray[np.float64]
    side: NDArray[np.int8]

    def __len__(self) -> int:
        return len(self.phase)

    def _table(self) -> dict[str, Any]:
        """One row for each impact."""
        names = ("phase", "velocity_before", "interval", "side")
        return {name: getattr(self, name) for name in names}


@dataclass(frozen=True, eq=False, slots=True)
class Cycles(Result):
    """Several cycles in one set of columns. Cycle `k` has the impacts `offsets[k]` to `offsets[k + 1]`."""

    offsets: NDArray[np.int64]
    impacts: Cycle
    multipliers: NDArray[np.complex128]
    rests: list[list[dict[str, Any]]] | None

    @classmethod
    def of(cls, fields: dict[str, Any]) -> "Cycles":
        return cls(fields["offsets"], Cycle(**fields["impacts"]), fields["multipliers"], fields["rests"])

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, k: int) -> Cycle:
        if not -len(self) <= k < len(self):
            raise IndexError(f"cycle {k} of {len(self)}")
        k %= len(self)
        at = slice(int(self.offsets[k]), int(self.offsets[k + 1]))
        all_ = self.impacts
        return Cycle(all_.phase[at], all_.velocity_before[at], all_.interval[at], all_.side[at])

    def __iter__(self) -> Iterator[Cycle]:
        return (self[k] for k in range(len(self)))

    def _table(self) -> dict[str, Any]:
        """One row for each impact of each cycle."""
        return {"cycle": np.repeat(np.arange(len(self)), np.diff(self.offsets)), **self.impacts._table()}

    def fastest(self) -> NDArray[np.float64]:
        """The largest speed before an impact of each cycle; 0 without impacts."""
        lists = (cycle.velocity_before for cycle in self)
        return np.array([speeds.max() if len(speeds) else 0.0 for speeds in lists], dtype=np.float64)
