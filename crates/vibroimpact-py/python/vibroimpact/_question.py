"""What all questions have in common: documentation, whole numbers, progress and threads."""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, SupportsIndex, TypeVar

import numpy as np

from vibroimpact import _core
from vibroimpact._arguments import Progress, ranges, threads_of, watched, whole
from vibroimpact._core import QuestionError
from vibroimpact._documented import completed, fields_of, of_field
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Answer
from vibroimpact._system import Start, System

A = TypeVar("A", bound=Answer)

#: What questions say alike of their parameters: types and words.
WORDS = {
    "system": ("Oscillator or Machine", "The system."),
    "x, v, phase": (
        "float",
        "Start of an oscillator: position in units of F/k, not beyond a stop (default: at rest, or on the stop), velocity, phase of the "
        "force in radians.",
    ),
    "q, qdot, phase": (
        "array, array, float", "Start of a machine: coordinates, velocities and phase. Default: those of its `start`, or 0.",
    ),
    "vary": (
        "str",
        'The number that varies: "beta", "inverse_beta", "gap", "restitution", "damping", "second_gap" or "second_restitution"; of an '
        'oscillator from `Oscillator.from_units` also one of the body, as "frequency_hz", "force_n", "mass_kg" or "gap_m", over which '
        'quantities are in SI units; of a machine the path of a number, as "frequency" or "stop.wall.gap".',
    ),
    "over": ("str or array", 'Its values: a range ("0.5:1.5:201" has 201 values), or a list or an array of values.'),
    "fields": (
        "sequence of str",
        'Quantities of each motion as further variables: ["impact_speed_max", "power"]. `Motion.quantities` has the names.',
    ),
    "store": ("path", "The store for the results; tiles that it already contains are not computed again."),
    "client": ("distributed.Client", "A Dask client, whose workers fill the store."),
    "tile": ("int", "Points of a tile along each axis."),
    "threads": ("int", "Number of threads; 0 for one per core. The result does not depend on it."),
    "progress": (
        "bool or callable",
        "True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.",
    ),
}

#: What functions of many points say alike of theirs.
POINTS = WORDS | {
    "system": (
        "Oscillator, Machine, mapping, DataFrame or Dataset",
        'The system, or values of "inverse_beta" or "beta", "gap", "restitution", "damping", "second_gap", "second_restitution"; of "x", '
        '"v" and "phase" too.',
    ),
    "over": (
        "mapping, DataFrame or Dataset",
        'Values of parameters instead of those of an oscillator, in physical units also "force_n" and others; of the numbers of a machine '
        "by path.",
    ),
    "starts": (
        "mapping, DataFrame or Dataset",
        'Values of "x", "v" and "phase", of a machine of "q.NAME", "qdot.NAME" and "phase". Default: at rest, or on the stop, at phase 0; '
        "the start of the machine.",
    ),
}


def document(words: Mapping[str, tuple[str, str]] = WORDS, **of_tasks: Sequence[Callable[..., Any]]) -> None:
    """Completes the documentation of the functions that ask for each task: an entry for each parameter that they do not describe, in
    common words, or in those of plans. A function without any has that of the one before it."""
    groups = {"x": "x, v, phase", "q": "q, qdot, phase"}
    for task, functions in of_tasks.items():
        text = ""
        for function in functions:
            code = function.__code__
            names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
            grouped = {name for first in groups if first in names for name in groups[first].split(", ")}
            shown = [groups.get(name, name) for name in names if name in groups or name not in grouped]
            text, known = function.__doc__ or text, fields_of(task)
            function.__doc__ = completed(text, "Parameters", shown, lambda name: words.get(name) or of_field(known[name]))


def known(what: str, given: str | None, allowed: tuple[str | None, ...]) -> None:
    """Refuse a word that is none of those that are allowed."""
    if given not in allowed:
        raise QuestionError(f"{what} = `{given}` is none of {', '.join(filter(None, allowed))}")


def given_fields(task: str, system: System, given: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a task that are not None; whole numbers are checked."""
    allowed = ranges(task, isinstance(system, Oscillator))
    found = {}
    for name, value in given.items():
        if value is not None:
            plain = value.item() if isinstance(value, np.generic) else value
            found[name] = whole(name, plain, allowed[name]) if name in allowed else plain
    return found


def finite(value: Any, name: str) -> None:
    """Refuse numbers that JSON cannot write."""
    if isinstance(value, Mapping):
        for key, of in value.items():
            finite(of, f"{name} {key}" if name == "start" else str(key))
    elif isinstance(value, list):
        for of in value:
            finite(of, name)
    elif isinstance(value, float) and not math.isfinite(value):
        raise QuestionError(f"{name} = {'NaN' if math.isnan(value) else value} is not a finite number")


def ask(
    result: type[A], place: Start, task: str, given: Mapping[str, Any], what: str, progress: Progress,
    total: Callable[[Mapping[str, Any]], int] = lambda fields: 1, threads: SupportsIndex = 1,
) -> A:
    """The answer to a task with these fields, of a system and its start. `total` is the amount of work, in the words of `what`."""
    fields = given_fields(task, place.system, given)
    finite(fields, task)
    with watched(progress, what) as tell:
        answer = _core.answer(place.system._file, place.of_machine, json.dumps({task: fields}), total(fields), threads_of(threads), tell)
    return result(None, place.system, answer, place)
