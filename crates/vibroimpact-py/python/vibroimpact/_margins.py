"""How far a periodic motion is from the events that end or change it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

from vibroimpact import _core
from vibroimpact._ask import Start, System, ask, given
from vibroimpact._motion import Motion
from vibroimpact._oscillator import Oscillator
from vibroimpact._progress import Progress
from vibroimpact._result import View
from vibroimpact._whole import LINES, maybe


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

    @cached_property
    def motion(self) -> Motion:
        """The motion."""
        return Motion(self._of["motion"], self.system)

    @cached_property
    def parameters(self) -> dict[str, ParameterMargin]:
        """The nearest events in each parameter."""
        ends = [{**of, "down": MarginEnd(**of["down"]), "up": MarginEnd(**of["up"])} for of in self._of["parameters"]]
        return {of["parameter"]: ParameterMargin(**of) for of in ends}

    @property
    def nearest(self) -> Nearest | None:
        """The event with the smallest change."""
        found = self._of["nearest"]
        return None if found is None else Nearest(**found)

    @cached_property
    def box(self) -> MotionBox | None:
        """The largest box."""
        of = self._of["box"]
        if of is None:
            return None
        ranges = {one["parameter"]: (one["from"], one["to"]) for one in of["parameters"]}
        edge = of["edge"] and (of["edge"]["loss"], {one["parameter"]: one["value"] for one in of["edge"]["parameters"]})
        return MotionBox(of["size"], of["largest"], ranges, of["points"], of["lines"], edge)

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


def margins(
    system: System,
    *,
    x: float | None = None,
    v: float | None = None,
    q: ArrayLike | None = None,
    qdot: ArrayLike | None = None,
    phase: float | None = None,
    label: str | None = None,
    vary: Sequence[str] | None = None,
    scale: Mapping[str, float] | None = None,
    within: float = 2.0,
    lines: int | None = None,
    progress: Progress = None,
) -> Margins:
    """Find how far a periodic motion is from the events that end or change it.

    The motion is followed in each number alone, up and down, to the nearest event: a fold, a flip, a grazing impact, the end of a
    rest. Of an oscillator the largest box of all parameters together is looked for in which the motion is stable. It is found by
    trying points along lines from its centre, so events between the lines may be missed.

    Parameters
    ----------
    system : Oscillator or Machine
        The system.
    x, v, phase : float
        Start of an oscillator: position in units of F/k (default: at rest, or on the stop), velocity, phase of the force in radians.
    q, qdot, phase : array, array, float
        Start of a machine: coordinates, velocities and phase. Default: those of its `start`, or 0.
    label : str
        "m/n" of the motion instead of a start: the stable orbit, or else the fastest one.
    vary : sequence of str
        The numbers that vary; by default all of an oscillator, whose frequency is "beta" or "inverse_beta", and of a machine the
        parameters of the file, and the numbers that are written as such and are not 0, without directions.
    scale : dict
        The change of a parameter of an oscillator that counts as 1 in the box; by default its value.
    within : float
        Events are looked for from each value divided by this number to the value times this number, above 1 and up to 100;
        a restitution from 0 to 1.
    lines : int
        Number of lines to scattered points of the surface of the box, besides those to the centres of its faces and to its corners.
        Default: 200.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> found = vi.margins(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), vary=["gap"])
    >>> found
    <Margins of 1/1, nearest flip at gap 1.82901>
    >>> found.parameters["gap"].up.distance
    0.32900618968...
    >>> vi.Machine.named("two-mass-hammer").margins(vary=["omega"])
    <Margins of 1/1, nearest grazing at omega 1.055>
    """
    if isinstance(vary, str):
        raise TypeError(f'vary = {vary!r} is not a list of numbers, such as ["gap"]')
    start, scales, count = Start(system, x, v, q, qdot, phase), dict(scale or {}), maybe("lines", lines, LINES)
    if isinstance(system, Oscillator):
        names = list(vary) if vary is not None else _core.varied_parameters(system._file) if scales else []
        unknown = [name for name in scales if name not in names]
        if unknown:
            raise _core.QuestionError(f"the scale of {unknown[0]} has no effect: it does not vary\nhint: vary has its name")
        varied: list[Any] = [given(parameter=name, scale=scales.get(name)) for name in names]
    elif scales or lines is not None:
        raise _core.QuestionError("scale and lines belong to the box, which is not looked for in numbers of a machine")
    else:
        varied = list(vary or [])
    task = start.within(given(label=label, vary=varied, within=float(within), lines=count))
    return Margins.answering(ask(system, "margins", task, start, progress=progress, what="margins"), system)
