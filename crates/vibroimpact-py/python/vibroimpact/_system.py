"""What any system has: names of its coordinates and stops, and where a motion starts."""

from collections.abc import Mapping
from typing import Any, TypeAlias

from numpy.typing import ArrayLike

from vibroimpact._core import QuestionError
from vibroimpact._machine import Machine
from vibroimpact._oscillator import Oscillator

#: Coordinates, velocities and phase of a machine.
State: TypeAlias = tuple[list[float], list[float], float]
System: TypeAlias = Oscillator | Machine


def names_of(system: System) -> tuple[list[str], list[str]]:
    """The names of the columns of coordinates and of velocities."""
    if isinstance(system, Oscillator):
        return ["x"], ["v"]
    return [f"q.{name}" for name in system.coordinates], [f"qdot.{name}" for name in system.coordinates]


def stops_of(system: System) -> tuple[str, ...]:
    """The names of the stops."""
    if isinstance(system, Oscillator):
        return ("upper",) if system.second_gap is None else ("upper", "lower")
    return system.stops


def numbered(system: System) -> str:
    """How a plan calls the name of a number of a system."""
    return "parameter" if isinstance(system, Oscillator) else "path"


class Start:
    """Where a motion starts: `x`, `v` and `phase` of an oscillator, `q`, `qdot` and `phase` of a machine."""

    def __init__(
        self, system: System, x: float | None = None, v: float | None = None, q: ArrayLike | None = None,
        qdot: ArrayLike | None = None, phase: float | None = None,
    ) -> None:
        self.system = system
        self.of_machine: State | None = None
        self.of_oscillator: dict[str, float] = {}
        if isinstance(system, Oscillator):
            _absent("an oscillator has x and v", q=q, qdot=qdot)
            found = {"x": x, "v": v, "phase": phase}
            self.of_oscillator = {name: float(value) for name, value in found.items() if value is not None}
        elif not hasattr(system, "start_of"):
            raise TypeError(f"{system!r} is no Oscillator and no Machine")
        else:
            _absent("a machine has q and qdot", x=x, v=v)
            self.of_machine = system.start_of(q, qdot, phase)
        #: As `Simulation.start` is.
        self.given = self.of_machine or (x, v or 0.0, phase or 0.0)

    def within(self, task: Mapping[str, Any]) -> dict[str, Any]:
        """A task with the start, where it belongs to the task."""
        return dict(task) if self.of_machine is not None else {**task, "start": self.of_oscillator}


def _absent(hint: str, **given: object) -> None:
    """Refuse parts of a start that the system does not have."""
    for name, value in given.items():
        if value is not None:
            raise QuestionError(f"{name} is no part of the start of this system\nhint: {hint}")
