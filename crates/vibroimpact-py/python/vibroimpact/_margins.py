"""How far a motion is from the events that end or change it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from vibroimpact._motion import Motion
from vibroimpact._result import Answer, Made, View, field, part


class MarginEnd(View, schema="margins EndObject"):
    """The nearest event of a motion in one direction of a parameter. Without an event all fields but `limit` are None.

    Attributes
    ----------
    event : dict or None
        The event with the fields of the JSON of the command: "kind", "before", "after", "stop" and others.
    """

    limit: float
    at: float | None
    distance: float | None
    relative: float | None
    event: dict[str, Any] | None


class ParameterMargin(View, schema="margins ParameterObject"):
    """The nearest events of a motion in one parameter."""

    parameter: str
    value: float
    scale: float
    down, up = part(MarginEnd), part(MarginEnd)


class Nearest(NamedTuple):
    """The event with the smallest change in units of the scale of its parameter."""

    parameter: str
    #: "down" or "up".
    direction: str
    #: The change in units of the scale.
    scaled: float


def _edge(of: Mapping[str, Any] | None) -> tuple[str, dict[str, float]] | None:
    return None if of is None else (of["loss"], {one["parameter"]: one["value"] for one in of["parameters"]})


class MotionBox(View, schema="margins BoxObject"):
    """A box of parameters in which a motion was found by trying points. It is not proved that the motion exists between them.

    Attributes
    ----------
    ranges : dict
        The range of each parameter.
    """

    size: float
    largest: float
    points: int
    lines: int
    ranges = field(lambda of: {one["parameter"]: (one["from"], one["to"]) for one in of}, "parameters")
    edge = field(_edge)


class Margins(Answer, schema="margins"):
    """The distances of a motion from the events that end or change it, and a box of parameters in which it was found."""

    motion = part(Motion)
    parameters: Made[dict[str, ParameterMargin]] = Made(
        lambda of: {one["parameter"]: ParameterMargin(one, of.system) for one in of._of["parameters"]}
    )
    nearest: Made[Nearest | None] = field(lambda of: of and Nearest(**of))
    box: Made[MotionBox | None] = Made(lambda of: of._of["box"] and MotionBox(of._of["box"], of.system))

    def __repr__(self) -> str:
        if self.nearest is None:
            return f"<Margins of {self.motion.label}, no event>"
        name, direction, _ = self.nearest
        end = getattr(self.parameters[name], direction)
        return f"<Margins of {self.motion.label}, nearest {end.event['kind']} at {name} {end.at:.6g}>"

    def _table(self) -> dict[str, Any]:
        """One row for each direction of each parameter."""
        ends = [(of, name, getattr(of, name)) for of in self.parameters.values() for name in ("down", "up")]
        return {
            "parameter": [of.parameter for of, _, _ in ends],
            "value": [of.value for of, _, _ in ends],
            "direction": [name for _, name, _ in ends],
            **{name: [getattr(end, name) for _, _, end in ends] for name in ("limit", "at", "distance", "relative")},
            "event": [None if end.event is None else end.event["kind"] for _, _, end in ends],
        }
