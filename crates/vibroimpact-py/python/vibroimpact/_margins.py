"""How far a periodic motion is from the events that end or change it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple


from vibroimpact._motion import Motion
from vibroimpact._result import Field, Part, View


@dataclass(frozen=True, slots=True)
class MarginEnd:
    """The nearest event of a motion in one direction of a parameter. Without an event all fields but `limit` are None."""

    #: The end of the range in which events are looked for.
    limit: float
    #: The value of the parameter at the event, its distance from the value of the system, and that relative to this value.
    at: float | None
    distance: float | None
    relative: float | None
    #: The event with the fields of the JSON of the command: "kind", "before", "after", "stop" and others.
    event: dict[str, Any] | None

@dataclass(frozen=True, slots=True)
class ParameterMargin:
    """The nearest events of a motion in one parameter."""

    parameter: str
    value: float
    #: The change of the parameter that counts as 1 in the box.
    scale: float
    down: MarginEnd
    up: MarginEnd

class Nearest(NamedTuple):
    """The event with the smallest change in units of the scale of its parameter."""

    parameter: str
    #: "down" or "up".
    direction: str
    #: The change in units of the scale.
    scaled: float


@dataclass(frozen=True, slots=True)
class MotionBox:
    """A box of parameters in which a motion was found by trying points. It is not proved that the motion exists between them."""

    #: Each parameter lies within this multiple of its scale from its value.
    size: float
    #: The largest size that was allowed: at the end of a range, or at an event in one parameter.
    largest: float
    #: The range of each parameter.
    ranges: dict[str, tuple[float, float]]
    #: Number of points in the box at which the motion was found, and of lines that were tried.
    points: int
    lines: int
    #: Why the motion was not found next to the box, and the values of the parameters there; None if the box ends at the end of a range.
    edge: tuple[str, dict[str, float]] | None

class Margins(View):
    """The distances of a motion from the events that end or change it, and a box of parameters in which it was found.

    Attributes
    ----------
    system : Oscillator or Machine
        The system.
    motion : Motion
        The motion.
    parameters : dict of ParameterMargin
        The nearest events in each parameter, by the name of the parameter; empty for a motion that is not periodic.
    nearest : Nearest or None
        The event with the smallest change in units of the scale of its parameter; None if there is none in the ranges.
    box : MotionBox or None
        The largest box in which the motion was found; None for a motion that is not periodic, or not stable, and of machines,
        for which no box is looked for.
    plan : str
        The plan as JSON.
    """

    motion = Part(Motion)
    parameters: Field[dict[str, ParameterMargin]] = Field(lambda of: {one["parameter"]: _margin(one) for one in of})
    nearest: Field[Nearest | None] = Field(lambda of: of and Nearest(**of))
    box: Field[MotionBox | None] = Field(lambda of: of and _box(of))

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


def _margin(of: dict[str, Any]) -> ParameterMargin:
    return ParameterMargin(**{**of, "down": MarginEnd(**of["down"]), "up": MarginEnd(**of["up"])})


def _box(of: dict[str, Any]) -> MotionBox:
    ranges = {one["parameter"]: (one["from"], one["to"]) for one in of["parameters"]}
    edge = of["edge"] and (of["edge"]["loss"], {one["parameter"]: one["value"] for one in of["edge"]["parameters"]})
    return MotionBox(of["size"], of["largest"], ranges, of["points"], of["lines"], edge)
