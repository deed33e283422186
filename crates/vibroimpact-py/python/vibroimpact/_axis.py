"""Values along an axis and ranges of parameters, as people write them."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core

#: `"A:B:N"`, `(a, b, n)`, or an array of evenly spaced values.
Axis: TypeAlias = "str | tuple[float, float, int] | Sequence[float] | NDArray[np.float64]"
#: `"A:B"` or `(a, b)`.
Interval: TypeAlias = "str | tuple[float, float]"

#: What spacing may be off by, relative to the values: the rounding of `numpy.linspace` and `numpy.arange`.
_EVEN = 1e-9


def numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Numbers as contiguous doubles, without a copy where they are that."""
    array = np.asarray(values)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} must be numbers, not {array.dtype}")
    return np.asarray(array, dtype=np.float64, order="C")


def span(over: Axis) -> str | tuple[float, float, int]:
    """First and last value and how many, for the compiled part."""
    if isinstance(over, str):
        return over
    if isinstance(over, tuple) and len(over) == 3:
        first, last, count = over
        return float(first), float(last), _whole(count)
    values = numbers("values", over)
    if values.ndim != 1 or values.size == 0:
        raise _core.QuestionError(
            f"an axis of shape {values.shape} is no list of values\n"
            'hint: "0:3:601", (0, 3, 601) or numpy.linspace(0, 3, 601)'
        )
    result = float(values[0]), float(values[-1]), int(values.size)
    even = _core.span_values(result)
    if not np.allclose(values, even, rtol=0, atol=_EVEN * float(np.max(np.abs(values)))):
        raise _core.QuestionError(
            f"the values from {values[0]} to {values[-1]} are not evenly spaced\nhint: numpy.linspace(a, b, n)"
        )
    return result


def _whole(count: float) -> int:
    if count != int(count):
        raise _core.QuestionError(f"{count} values: the number is not whole\nhint: (a, b, n) is n values from a to b")
    return int(count)


def _interval(given: Interval) -> tuple[float, float]:
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
    first, second = ((name, *_interval(range_)) for name, range_ in over.items())
    return first, second
