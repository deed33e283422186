"""The impacts of a periodic orbit as columns."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Names of the two sides by their sign.
SIDES = {1: "upper", -1: "lower"}


@dataclass(frozen=True, eq=False, slots=True)
class Cycle:
    """Impacts in order of time, the fastest first (after a rest those that follow its release).

    Attributes
    ----------
    phase : ndarray
        Phase of the force at each impact, radians in [0, 2 pi).
    velocity_before : ndarray
        Speed of arrival, positive.
    interval : ndarray
        Time to the next impact; after the last one before a rest to the end of the chatter.
    side : ndarray of int8
        +1 for the first stop, -1 for the second.
    """

    phase: NDArray[np.float64]
    velocity_before: NDArray[np.float64]
    interval: NDArray[np.float64]
    side: NDArray[np.int8]

    def __len__(self) -> int:
        return len(self.phase)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Cycle):
            return NotImplemented
        return self.to_list() == other.to_list()

    __hash__ = None  # type: ignore[assignment]

    def to_list(self) -> list[dict[str, Any]]:
        """One dict an impact, as in the command's JSON."""
        rows = zip(self.phase.tolist(), self.velocity_before.tolist(), self.interval.tolist(), self.side.tolist())
        return [
            {"phase": phase, "velocity_before": velocity, "interval": interval, "side": SIDES[side]}
            for phase, velocity, interval, side in rows
        ]


@dataclass(frozen=True, eq=False, slots=True)
class Cycles:
    """Many cycles, one after another."""

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

    def fastest(self) -> NDArray[np.float64]:
        """The largest speed of arrival of each, 0 without impacts."""
        lists = (cycle.velocity_before for cycle in self)
        return np.array([speeds.max() if len(speeds) else 0.0 for speeds in lists], dtype=np.float64)


def finite(value: float | None) -> float | None:
    """As JSON has it: a number that is not finite is null."""
    return value if value is not None and np.isfinite(value) else None


def pairs(multipliers: NDArray[np.complex128]) -> list[list[float | None]]:
    """Real and imaginary parts, as in the command's JSON."""
    return [[finite(float(m.real)), finite(float(m.imag))] for m in multipliers]
