"""Integer arguments. Values that do not fit the types of the compiled module are refused here, by name; it checks the others."""

import operator
from typing import Any, NamedTuple, SupportsIndex

from vibroimpact._core import QuestionError


class Range(NamedTuple):
    """The allowed range of an argument, as in the error messages of the compiled module."""

    least: int
    most: int | None = None


_UNSIGNED = 2**64 - 1

STARTS = Range(1, 1_000_000_000)
#: Starts at each point of a map.
POINT_STARTS = Range(1, 10_000_000)
SEED = Range(0, _UNSIGNED)
#: As for the command.
THREADS = Range(0, 65_535)
TILE = Range(1, 4096)
SHARD = Range(1, 1024)
REFINE = Range(2, 64)
KEEP = Range(1, 100_000)
TRANSIENT = Range(0, 1_000_000)
#: Impacts of a simulation, of each start of a grid, and of a measurement of exponents.
SIMULATED = Range(1, 10_000_000)
BUDGET = Range(1, 1_000_000)
MEASURED = Range(1000, 10_000_000)
#: Points of a section, and of a branch.
SECTION = Range(1, 100_000)
BRANCH = Range(2, 100_000)
FOLLOW = Range(0, 100)
GRID = Range(2, 400)
#: Orbits and events are numbered from 1; their number is not known in advance.
NUMBER = Range(1)
#: Number of tiles to compute again, and number of retries.
COUNT = Range(0, _UNSIGNED)
#: Lines to scattered points of the surface of a box.
LINES = Range(0, 100_000)
#: Tasks that a scheduler has at the same time.
AHEAD = Range(1, 1_000_000)
#: Blocks of points of an estimate.
BLOCKS = Range(1, 100_000)
#: Points of a sample.
SAMPLES = Range(1, 1_000_000_000)
#: Cells along a range, and rounds that halve them.
CELLS = Range(1, 4096)
ROUNDS = Range(0, 20)
#: Values of a range.
SPAN = Range(1)

#: The ranges of the whole numbers of tasks by name, and of those that are other ones in some tasks.
_RANGES = {
    "impacts": BUDGET, "starts": STARTS, "seed": SEED, "points": BRANCH, "orbit": NUMBER, "event": NUMBER, "follow": FOLLOW, "grid": GRID,
    "lines": LINES, "refine": REFINE, "transient": TRANSIENT, "keep": KEEP,
}
_OF_TASKS = {
    "simulate": {"impacts": SIMULATED}, "lyapunov": {"impacts": MEASURED, "points": SECTION}, "map": {"starts": POINT_STARTS},
}


def ranges(task: str, oscillator: bool) -> dict[str, Range]:
    """The ranges of the whole numbers of a task."""
    own = _OF_TASKS.get(task, {})
    return _RANGES | (own if oscillator or task != "lyapunov" else own | {"impacts": SIMULATED})


#: The largest number of 32 bits, the size of most counts in a plan.
_SMALL = 2**32 - 1


def outside(name: str, given: float, least: float, most: float | None, hint: str = "") -> QuestionError:
    """The error of a number outside its range."""
    upper = "" if most is None else f" <= {most}"
    error = QuestionError(f"{name} = {given} lies outside {least} <= {name}{upper}" + (hint and f"\nhint: {hint}"))
    error.name, error.given, error.least, error.most = name, given, least, most
    return error


def whole(name: str, value: SupportsIndex, allowed: Range, *, here: bool = False) -> int:
    """The number, if the compiled module can represent it, or, checked `here`, if it is allowed. Raises TypeError or QuestionError
    otherwise."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} = {value!r} is not a whole number") from None
    least, most = allowed
    # numbers that fit are checked by the compiled module, whose messages have hints; it does not check the number of threads
    largest = THREADS.most if allowed == THREADS else max(most or 0, _SMALL)
    if here:
        largest = most
    if number < (least if here else 0) or (largest is not None and number > largest):
        raise outside(name, number, least, most)
    return number


#: The number of threads where 0 are asked for; 0 for one per core.
_threads = 0


def set_threads(count: SupportsIndex) -> int:
    """Set the number of threads of all functions that are not told one, and return the number before; 0 for one per core.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> before = vi.set_threads(2)
    >>> vi.set_threads(before)
    2
    """
    global _threads
    before, _threads = _threads, whole("threads", count, THREADS)
    return before


def threads_of(threads: SupportsIndex) -> int:
    """The checked argument `threads`."""
    return whole("threads", threads, THREADS) or _threads


def maybe(name: str, value: SupportsIndex | None, allowed: Range) -> int | None:
    """As `whole`, for an optional argument."""
    return None if value is None else whole(name, value, allowed)


def part(given: Any) -> tuple[int, int]:
    """The checked argument `part`: (i, n)."""
    try:
        index, of = (operator.index(number) for number in given)
    except (TypeError, ValueError):
        raise TypeError(f"part = {given!r} is not (i, n), two whole numbers") from None
    if not 1 <= index <= of <= _UNSIGNED:
        raise QuestionError(f"tiles {index}/{of} is no part of a whole: I/N needs 1 <= I <= N")
    return index, of
