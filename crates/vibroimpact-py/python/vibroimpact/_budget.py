"""Times as arguments: seconds, or a text with units."""

import math
from typing import TypeAlias

from vibroimpact import _core

#: Seconds, or a text such as "90s", "30m", "8h", "2d" or "1h30m".
Budget: TypeAlias = float | str


def seconds(name: str, given: Budget) -> float:
    """The seconds of a time. Raises QuestionError for a time that is not positive."""
    if isinstance(given, str):
        try:
            return _core.seconds_of(given)
        except _core.QuestionError as error:
            raise _core.QuestionError(f"{name}: {error}") from None
    try:
        number = float(given)
    except (TypeError, ValueError):
        raise TypeError(f"{name} = {given!r} is neither seconds nor a text such as '8h'") from None
    if not (math.isfinite(number) and number > 0):
        raise _core.QuestionError(f"{name} = {given!r} lies outside 0 < {name}\nhint: seconds, or a text such as '8h'")
    return number
