"""What all questions have in common: where a motion starts, whole numbers, progress, threads, and where a grid is computed."""

import inspect
import json
import math
from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from typing import Any

import numpy as np

from vibroimpact import _core
from vibroimpact._arguments import Progress, ranges, threads_of, watched, whole
from vibroimpact._core import QuestionError
from vibroimpact._documented import completed, fields_of, of_field
from vibroimpact._oscillator import Oscillator
from vibroimpact._plan import Plan, made as made_plan
from vibroimpact._result import Answer
from vibroimpact._system import Start, System

#: The parts of a start of any system, and those that only the start of a machine has beside a label.
START, STATE = ("x", "v", "q", "qdot", "phase"), ("q", "qdot", "phase")

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
POINTS = {
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


def documented(text: str, names: Sequence[str], task: str, words: Mapping[str, tuple[str, str]] = WORDS) -> str:
    """Documentation with an entry for each parameter that it does not describe: in common words, or in those of plans."""
    groups = {"x": "x, v, phase", "q": "q, qdot, phase"}
    grouped = {name for first in groups if first in names for name in groups[first].split(", ")}
    shown = [groups.get(name, name) for name in names if name in groups or name not in grouped]
    return completed(text, "Parameters", shown, lambda name: words.get(name) or of_field(fields_of(task)[name]))


def document(function: Callable[..., Any], task: str) -> None:
    """Complete the documentation of a function of many points as that of a question."""
    code = function.__code__
    names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    function.__doc__ = documented(function.__doc__ or "", names, task, WORDS | POINTS)


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


def _documented(made: Any, body: Callable[..., Any], further: Mapping[str, Any], task: str, returns: Any) -> Any:
    """A function with the documentation and the signature of `body`, with further keywords."""
    # as `inspect.signature`, which takes ten times as long
    code, kinds = body.__code__, inspect.Parameter
    own = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    first = own[: code.co_argcount]
    usual = {**further, **dict(zip(reversed(first), reversed(body.__defaults__ or ()))), **(body.__kwdefaults__ or {})}
    parameters = [
        kinds(name, kinds.POSITIONAL_OR_KEYWORD if name in first else kinds.KEYWORD_ONLY, default=usual.get(name, kinds.empty))
        for name in dict.fromkeys((*own, *further))
    ]
    made = wraps(body)(made)
    made.__doc__ = documented(body.__doc__ or "", [of.name for of in parameters], task)
    made.__signature__ = inspect.Signature(parameters, __validate_parameters__=False)
    del made.__wrapped__
    made.returns, made.task = returns, task
    return made


def question(
    result: type[Answer], task: str, start: tuple[str, ...], what: str, *, threads: bool = False,
    total: Callable[[System, Mapping[str, Any]], int] = lambda system, task: 1,
) -> Callable[[Callable[..., Mapping[str, Any]]], Any]:
    """A question with one answer: the view of the answer to a task, whose fields the function returns. `total` is the amount of work."""

    def of(body: Callable[..., Mapping[str, Any]]) -> Any:
        def ask(system: System, *given: Any, **options: Any) -> Any:
            place = Start(system, **{name: options.pop(name, None) for name in start})
            progress: Progress = options.pop("progress", None)
            count = options.pop("threads", 0) if threads else 1
            fields = given_fields(task, system, body(system, *given, **options))
            asked = place.within(fields) if start is START else fields
            finite(asked, task)
            with watched(progress, what) as tell:
                answer = _core.answer(
                    system._file, place.of_machine, json.dumps({task: asked}), total(system, fields), threads_of(count), tell
                )
            return result(None, system, answer, place)

        further = {**dict.fromkeys(start), **({"threads": 0} if threads else {}), "progress": None}
        return _documented(ask, body, further, task, result)

    return of


def plan_of(task: str) -> Callable[[Callable[..., tuple[Mapping[str, Any], Mapping[str, Any]]]], Any]:
    """A function that makes the plan of a grid. `body` returns the fields of its task, and the start where it is given."""

    def of(body: Callable[..., tuple[Mapping[str, Any], Mapping[str, Any]]]) -> Any:
        def make(system: System, *given: Any, tile: int | None = None, **options: Any) -> Plan:
            fields, start = body(system, *given, **options)
            place = Start(system, **start)
            return made_plan(system, task, given_fields(task, system, place.within(fields) if start else fields), tile, place)

        return _documented(make, body, {"tile": None}, task, Plan)

    return of


def grid(task: str) -> Callable[[Callable[..., tuple[Mapping[str, Any], Mapping[str, Any]]]], Any]:
    """A question whose answer is a Dataset over a grid; its plan is made by the attribute `plan`."""

    def of(body: Callable[..., tuple[Mapping[str, Any], Mapping[str, Any]]]) -> Any:
        make = plan_of(task)(body)

        def ask(
            system: System, *given: Any, store: Any = None, client: Any = None, threads: int = 0, progress: Progress = None,
            **options: Any,
        ) -> Any:
            from vibroimpact._store import computed

            return computed(make(system, *given, **options), store, client, threads, progress)

        further = {"store": None, "client": None, "tile": None, "threads": 0, "progress": None}
        made = _documented(ask, body, further, task, None)
        made.plan = make
        return made

    return of
