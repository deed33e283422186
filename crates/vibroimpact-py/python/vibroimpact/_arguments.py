"""Arguments as users write them: whole numbers, values of axes and ranges, times, and reports of progress.

Values that do not fit the types of the compiled module are refused here, by name; it checks the others.
"""

import math
import operator
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple, SupportsIndex, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._core import QuestionError


class Range(NamedTuple):
    """The allowed range of an argument, as in the error messages of the compiled module."""

    least: int
    most: int | None = None


_UNSIGNED = 2**64 - 1

STARTS = Range(1, 1_000_000_000)
SEED = Range(0, _UNSIGNED)
#: As for the command.
THREADS = Range(0, 65_535)
TILE = Range(1, 4096)
SHARD = Range(1, 1024)
#: Impacts of each start of a grid.
BUDGET = Range(1, 1_000_000)
#: Number of tiles to compute again, and number of retries.
COUNT = Range(0, _UNSIGNED)
#: Tasks that a scheduler has at the same time.
AHEAD = Range(1, 1_000_000)
#: Blocks of points of an estimate.
BLOCKS = Range(1, 100_000)
#: Points of a sample.
SAMPLES = Range(1, 1_000_000_000)
#: Cells along a range, and rounds that halve them.
CELLS = Range(1, 4096)
ROUNDS = Range(0, 20)

#: The ranges of the whole numbers of tasks by name, and of those that are other ones in some tasks. Orbits and events are numbered from 1.
_RANGES = {
    "impacts": BUDGET, "starts": STARTS, "seed": SEED, "points": Range(2, 100_000), "orbit": Range(1), "event": Range(1),
    "follow": Range(0, 100), "grid": Range(2, 400), "lines": Range(0, 100_000), "refine": Range(2, 64), "transient": Range(0, 1_000_000),
    "keep": Range(1, 100_000),
}
_MOST_IMPACTS = 10_000_000
_OF_TASKS = {
    "simulate": {"impacts": Range(1, _MOST_IMPACTS)}, "map": {"starts": Range(1, 10_000_000)},
    "lyapunov": {"impacts": Range(1000, _MOST_IMPACTS), "points": Range(1, 100_000)},
}


def ranges(task: str, oscillator: bool) -> dict[str, Range]:
    """The ranges of the whole numbers of a task."""
    own = _OF_TASKS.get(task, {})
    return _RANGES | (own if oscillator or task != "lyapunov" else own | {"impacts": Range(1, _MOST_IMPACTS)})


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


def part_of(given: Any) -> tuple[int, int]:
    """The checked argument `part`: (i, n)."""
    try:
        index, of = (operator.index(number) for number in given)
    except (TypeError, ValueError):
        raise TypeError(f"part = {given!r} is not (i, n), two whole numbers") from None
    if not 1 <= index <= of <= _UNSIGNED:
        raise QuestionError(f"tiles {index}/{of} is no part of a whole: I/N needs 1 <= I <= N")
    return index, of


#: A range, `"A:B:N"`, `"A:B:N:log"` or `span(a, b, n)`, or a list or an array of values.
Axis: TypeAlias = str | list[float] | Sequence[float] | NDArray[np.float64]
#: `"A:B"` or `(a, b)`.
Interval: TypeAlias = str | tuple[float, float]

_T = TypeVar("_T")

#: Allowed deviation from even spacing, relative to the values: the rounding of `numpy.linspace` and `numpy.arange`.
_EVEN = 1e-14


class Span(str):
    """A range of values as text, "A:B:N" or "A:B:N:log"; `span` makes one of numbers."""

    __slots__ = ()

    def values(self) -> NDArray[np.float64]:
        """Its values, exactly the numbers that are used in the computation."""
        return _core.span_values(self)


def span(first: float, last: float, count: int, *, log: bool = False) -> Span:
    """A range for an axis: `count` values from `first` to `last`, both included.

    Parameters
    ----------
    first, last : float
        Its ends.
    count : int
        Number of values.
    log : bool
        Whether the values are in equal ratios, and not at equal distances.

    Examples
    --------
    >>> from vibroimpact import span
    >>> span(0, 3, 601), span(0.1, 10, 3, log=True).values().round(9).tolist()
    ('0.0:3.0:601', [0.1, 1.0, 10.0])
    """
    text = _text(float(first), float(last), whole("count", count, Range(1))) + (":log" if log else "")
    # refused here, and not later where it is used
    _core.span_values(text)
    return Span(text)


def numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Numbers as contiguous doubles; an array that is one already is not copied."""
    array = np.asarray(values)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} must be numbers, not {array.dtype}")
    return np.asarray(array, dtype=np.float64, order="C")


def sweep(over: Axis) -> str | list[float]:
    """Values of a sweep in the form of a plan: a range as text if an array is evenly spaced to rounding, or else a list."""
    given = values(over)
    if isinstance(given, str) or len(given) > 1 and given[0] == given[-1] or not np.all(np.isfinite(given)):
        return given
    text = _text(given[0], given[-1], len(given))
    spread = _core.span_values(text)
    return text if np.allclose(given, spread, rtol=0, atol=_EVEN * float(np.max(np.abs(given)))) else given


def values(over: Axis) -> str | list[float]:
    """Values of an axis in the form of a plan: a range as text, or a list."""
    if isinstance(over, str):
        return str(over)
    if isinstance(over, tuple):
        raise QuestionError(_neither(over))
    array = numbers("values", over)
    if array.ndim != 1 or array.size == 0:
        raise QuestionError(
            f"an axis of shape {array.shape} is no list of values\n"
            'hint: "0:3:601" or numpy.linspace(0, 3, 601)'
        )
    listed: list[float] = array.tolist()
    if len(listed) == 1 or listed[0] == listed[-1] or not np.all(np.isfinite(array)):
        return listed
    # the short form is used only if it gives exactly the same numbers
    text = _text(listed[0], listed[-1], len(listed))
    return text if np.array_equal(array, _core.span_values(text)) else listed


def _text(first: float, last: float, count: int) -> str:
    return f"{first!r}:{last!r}:{count}"


def axes(over: Mapping[str, Axis]) -> list[dict[str, object]]:
    """The axes of a plan; the first one is the abscissa."""
    if not isinstance(over, Mapping):
        raise TypeError('axes are written {"inverse_beta": "0.4:2:33", "gap": "0:5:41"}')
    return [{"vary": name, "over": values(of)} for name, of in over.items()]


def _neither(over: tuple[object, ...]) -> str:
    """The message about a tuple, which may be meant as a list or as a range."""
    listed = ", ".join(map(str, over))
    if len(over) == 3:
        a, b, c = over
        return (
            f"({listed}) may be three values or {c} values from {a} to {b}\n"
            f'hint: [{listed}] is a list; "{a}:{b}:{c}" or vibroimpact.span({listed}) is a range'
        )
    hint = f"[{listed}] is a list"
    if len(over) == 4 and over[3] == "log":
        a, b, n, _ = over
        hint = f'"{a}:{b}:{n}:log" or vibroimpact.span({a}, {b}, {n}, log=True) is a range'
    return f"({listed}) is a tuple, which may be a list or a range\nhint: {hint}"


def names(fields: Sequence[str]) -> list[str] | None:
    """A list of names of quantities, or None if it is empty."""
    if isinstance(fields, str):
        raise QuestionError(f"fields = `{fields}` is one text\nhint: a list of names, fields=[\"{fields}\"]")
    return [str(name) for name in fields] or None


def interval(given: Interval) -> tuple[float, float]:
    """The two ends of a range, in the given order."""
    parts: Sequence[object] = given.split(":") if isinstance(given, str) else given
    try:
        low, high = (float(part) for part in parts)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise QuestionError(f"`{given}` is not a range\nhint: (a, b) or \"A:B\" with finite a < b") from None
    return low, high


def plane(over: Mapping[str, Interval]) -> tuple[tuple[str, float, float], tuple[str, float, float]]:
    """Two parameters with their ranges."""
    if not isinstance(over, Mapping):
        raise TypeError('a plane is written {"gap": (0, 5), "inverse_beta": (0.4, 2)}')
    if len(over) != 2:
        raise QuestionError(
            f"a plane has two parameters, and {len(over)} are given\n"
            'hint: {"gap": (0, 5), "inverse_beta": (0.4, 2)}'
        )
    first, second = ((name, *interval(range_)) for name, range_ in over.items())
    return first, second


def beside(also: Mapping[str, _T] | None) -> tuple[str, _T] | None:
    """The second parameter of a line, with its value or range."""
    if also is None:
        return None
    if not isinstance(also, Mapping) or len(also) != 1:
        raise TypeError('also is one parameter with its values, as {"gap": (0.5, 1.5)} for a diagram, {"gap": 1.5} for a branch')
    return next(iter(also.items()))


#: Seconds, or a text such as "90s", "30m", "8h", "2d" or "1h30m".
Budget: TypeAlias = float | str


def seconds(name: str, given: Budget) -> float:
    """The seconds of a time. Raises QuestionError for a time that is not positive."""
    if isinstance(given, str):
        try:
            return _core.seconds_of(given)
        except QuestionError as error:
            raise QuestionError(f"{name}: {error}") from None
    try:
        number = float(given)
    except (TypeError, ValueError):
        raise TypeError(f"{name} = {given!r} is neither seconds nor a text such as '8h'") from None
    if not (math.isfinite(number) and number > 0):
        raise QuestionError(f"{name} = {given!r} lies outside 0 < {name}\nhint: seconds, or a text such as '8h'")
    return number


#: `None`, `True` for a progress bar, or a function called with the amounts done and in total. It stops the work by returning False.
Progress: TypeAlias = "bool | Callable[[int, int], object] | None"


@contextmanager
def watched(progress: Progress, what: str) -> Iterator[Callable[[int, int], object] | None]:
    """The function to call with progress; a progress bar is closed afterwards."""
    if progress is None or progress is False:
        yield None
        return
    if progress is not True:
        if not callable(progress):
            raise TypeError("progress is True, or a function of what is done and what there is to do")
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        warnings.warn("progress=True needs tqdm: pip install tqdm", stacklevel=3)
        yield None
        return
    with tqdm(desc=what, unit_scale=True) as bar:

        def advance(done: int, total: int) -> None:
            bar.total = total
            bar.update(done - bar.n)

        yield advance
