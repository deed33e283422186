"""Measured numbers and complex numbers of the JSON of the command."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Measured(NamedTuple):
    """A number and its error bar, which is three standard errors; 0 if the number is exact."""

    value: float
    error: float


def measured(given: Mapping[str, Any]) -> Measured:
    """Of the JSON object; null stands for an infinite or an undefined number."""
    value, error = given["value"], given["error"]
    if value is None:
        value = {"minus_infinity": -math.inf, "infinity": math.inf}.get(given.get("why", ""), math.nan)
    # an infinite number is exact
    return Measured(value, error if error is not None else 0.0 if math.isinf(value) else math.nan)


def maybe_measured(given: Mapping[str, Any] | None) -> Measured | None:
    """Of the JSON object; None if there is none."""
    return None if given is None else measured(given)


def all_measured(given: Sequence[Mapping[str, Any]] | None) -> tuple[Measured, ...] | None:
    """Of a list of them; None if there is none."""
    return None if given is None else tuple(measured(one) for one in given)


def complex_of(pairs: Sequence[Sequence[float | None]] | None) -> NDArray[np.complex128]:
    """Complex numbers of pairs; null is infinite."""
    numbers = [complex(*(math.inf if part is None else part for part in pair)) for pair in pairs or ()]
    return np.array(numbers, dtype=np.complex128)
