"""Objects in JSON."""

import json
from typing import Any


def read(text: str) -> dict[str, Any]:
    """The object of a text."""
    found: dict[str, Any] = json.loads(text)
    return found
