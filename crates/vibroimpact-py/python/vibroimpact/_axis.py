"""Conversion of the values of an axis and the ranges of parameters, as users write them, to the form of plans."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._whole import SPAN, whole

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
    text = _text(float(first), float(last), whole("count", count, SPAN)) + (":log" if log else "")
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
        raise _core.QuestionError(_neither(over))
    array = numbers("values", over)
    if array.ndim != 1 or array.size == 0:
        raise _core.QuestionError(
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
        raise _core.QuestionError(f"fields = `{fields}` is one text\nhint: a list of names, fields=[\"{fields}\"]")
    return [str(name) for name in fields] or None


def interval(given: Interval) -> tuple[float, float]:
    """The two ends of a range, in the given order."""
    parts: Sequence[object] = given.split(":") if isinstance(given, str) else given
    try:
        low, high = (float(part) for part in parts)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise _core.QuestionError(f"`{given}` is not a range\nhint: (a, b) or \"A:B\" with finite a < b") from None
    return low, high


def plane(over: Mapping[str, Interval]) -> tuple[tuple[str, float, float], tuple[str, float, float]]:
    """Two parameters with their ranges."""
    if not isinstance(over, Mapping):
        raise TypeError('a plane is written {"gap": (0, 5), "inverse_beta": (0.4, 2)}')
    if len(over) != 2:
        raise _core.QuestionError(
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
