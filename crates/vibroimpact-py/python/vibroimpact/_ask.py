"""Questions about any system: where a motion starts, and the answer of the compiled module."""

import json
import math
from collections.abc import Mapping
from typing import Any, TypeAlias

from numpy.typing import ArrayLike

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._machine import Machine
from vibroimpact._oscillator import Oscillator
from vibroimpact._arguments import Progress, threads_of, watched

#: Coordinates, velocities and phase of a machine.
State: TypeAlias = tuple[list[float], list[float], float]


System: TypeAlias = Oscillator | Machine


class Start:
    """Where a motion starts: `x`, `v` and `phase` of an oscillator, `q`, `qdot` and `phase` of a machine."""

    def __init__(
        self,
        system: System,
        x: float | None = None,
        v: float | None = None,
        q: ArrayLike | None = None,
        qdot: ArrayLike | None = None,
        phase: float | None = None,
    ) -> None:
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


def _finite(value: Any, name: str) -> None:
    """Refuse numbers that JSON cannot write."""
    if isinstance(value, Mapping):
        for key, of in value.items():
            _finite(of, f"{name} {key}" if name == "start" else str(key))
    elif isinstance(value, list):
        for of in value:
            _finite(of, name)
    elif isinstance(value, float) and not math.isfinite(value):
        raise QuestionError(f"{name} = {'NaN' if math.isnan(value) else value} is not a finite number")


def answered(
    system: System, name: str, fields: Mapping[str, Any], start: Start, *, total: int = 1, threads: int = 1,
    progress: Progress = None, what: str = "motions",
) -> _core.Answer:
    """The answer to a task with these fields."""
    threads = threads_of(threads)
    _finite(fields, name)
    if progress is None:
        return _core.answer(system._file, start.of_machine, json.dumps({name: fields}), total, threads, None)
    with watched(progress, what) as tell:
        return _core.answer(system._file, start.of_machine, json.dumps({name: fields}), total, threads, tell)
