"""Motions followed in numbers of the system: branches, curves, regions, responses and margins, as views of the JSON of the command."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vibroimpact import _core
from vibroimpact._arguments import numbers
from vibroimpact._motion import Events, Motion, complex_of
from vibroimpact._oscillator import Oscillator
from vibroimpact._result import Answer, Made, View, column, field, part, parts

T = TypeVar("T")

_Floats = NDArray[np.float64]


def pair(of: Iterable[T]) -> tuple[T, T]:
    """Two values."""
    one, two = of
    return one, two


def _orbit(found: Mapping[str, Any] | None) -> tuple[int, int] | None:
    """The number of an orbit, and how many there are."""
    return None if found is None else (found["number"], found["count"])


def _pairs(given: Any) -> _Floats:
    return np.array(given, dtype=np.float64).reshape(-1, 2)


def _ranges(first: Mapping[str, Any], second: Mapping[str, Any]) -> tuple[tuple[float, float], tuple[float, float]]:
    """The ranges of two numbers in a plan."""
    return (first["from"], first["to"]), (second["from"], second["to"])


def _multipliers(points: list[dict[str, Any]]) -> NDArray[np.complex128]:
    """The multipliers of all points, in rows."""
    each = len(points[0]["multipliers"]) if points else 0
    return complex_of([of for point in points for of in point["multipliers"]]).reshape(len(points), each)


class _Followed(Answer):
    """What branches and curves have in common: a cycle at each point, and the orbit at which they begin."""

    orbit = field(_orbit)
    multipliers: Made[NDArray[np.complex128]] = Made(lambda of: _multipliers(of._rows))
    cycles: Made[list[Events]] = Made(lambda of: [Events.of(at["cycle"], of.system) for at in of._rows])

    def __len__(self) -> int:
        return len(self._rows)


class BranchEvent(View, schema="branch BranchEventObject"):
    """An event at a point of a branch, or the reason why the branch ends.

    Attributes
    ----------
    kind : str
        "fold", "flip", "torus", "branch point", "grazing", "loss of contact", "stick", "soft landing", "chatter", ..., or the reason
        why the branch ends: "end of range", "closed", "halving", "step limit", "impact limit", "no convergence".
    ends : bool
        Whether the branch ends there.
    """

    kind: str
    parameter: float
    values: list[float] | None
    point: int
    ends: bool
    before: str
    after: str | None
    stop: str | None
    appears: bool | None
    turns: bool | None
    impact: int | None
    phase: float | None
    also: dict[str, Any] | None

    def __repr__(self) -> str:
        return f"<BranchEvent {self.kind} at {self.parameter:.9g}>"


class Origin(NamedTuple):
    """The event at which a further branch begins."""

    kind: str
    parameter: float
    #: Number of the branch on which the event lies, counted from 1; the branch of the chosen orbit is number 1.
    branch: int


class Branch(_Followed, schema="branch BranchObject PointObject"):
    """A branch of periodic orbits; each point is one step along it.

    Attributes
    ----------
    ends : (float, float)
        The ends of the range of the number that varies.
    second : ndarray or None
        The value of the number that varies with it, at each point.
    speed : ndarray
        The largest speed of a closing at each point; 0 without closings.
    quantity, value : str or None, ndarray or None
        Of a machine without stops the path of the quantity that the figure shows, and its value at each point.
    cycles : list of Events
        The events at each point.
    origin : Origin or None
        The event at which it begins; None for the branch of the chosen orbit.
    followed : list of Branch
        The branches that begin on it, the branches that begin on those, and so on.
    number : int
        The number of the branch: 0 for that of the chosen orbit, from 1 for those that begin on it.
    """

    vary: str
    period, parameter, label = column(np.float64), column(np.float64), column(np.str_)
    stable, admissible, stability = column(np.bool_), column(np.bool_), column(np.str_)
    _one: Made[dict[str, Any]] = Made(lambda of: of._of["branches"][of.number])
    _rows: Made[list[dict[str, Any]]] = Made(lambda of: of._one["points"])
    #: Whose branch it is: 0 for that of the chosen orbit.
    number: int
    ends: Made[tuple[float, float]] = Made(lambda of: (of._of["from"], of._of["to"]))
    start: Made[int] = Made(lambda of: of._one.get("start", 0))
    also: Made[tuple[str, float, float] | None] = field(lambda of: of and (of["parameter"], of["from"], of["to"]))
    second: Made[_Floats | None] = Made(lambda of: None if of.also is None else np.array([at["values"][1] for at in of._rows]))
    origin: Made[Origin | None] = Made(lambda of: of._one["from"] and Origin(**{"branch": 1, **of._one["from"]}))
    events: Made[list[BranchEvent]] = Made(lambda of: [BranchEvent(one, of.system) for one in of._one["events"]])
    speed: Made[_Floats] = Made(lambda of: np.array([cycle.speed[cycle.closes].max(initial=0.0) for cycle in of.cycles]))
    drift: Made[_Floats] = Made(lambda of: np.array([of._drift(at) for at in of._rows], dtype=np.float64))
    quantity: Made[str | None] = Made(lambda of: next((next(iter(at["quantities"])) for at in of._rows if "quantities" in at), None))
    value: Made[_Floats | None] = Made(lambda of: of.quantity and np.array([at["quantities"][of.quantity] for at in of._rows]))

    def __init__(
        self, of: dict[str, Any] | None, system: Any, answer: _core.Answer | None = None, start: Any = None, number: int = 0
    ) -> None:
        super().__init__(of, system, answer)
        self.number = number

    def _drift(self, point: Mapping[str, Any]) -> list[float]:
        return list(point["drift"].values()) if "drift" in point else [0.0] * len(self._of["system"]["coordinates"])

    @cached_property
    def followed(self) -> "list[Branch]":
        """The branches that begin on it."""
        further = range(1, len(self._of["branches"])) if self.number == 0 else range(0)
        return [Branch(self._of, self.system, self._answer, None, k) for k in further]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Branch) and self.number == other.number and super().__eq__(other)

    def __repr__(self) -> str:
        more = f", {len(self.followed)} more begin on it" if self.followed else ""
        along = f" and {self.also[0]}" if self.also else ""
        return f"<Branch of {self.label[0]} over {self.vary}{along}, {len(self)} points, {len(self.events)} events{more}>"

    def plot(
        self, ax: Any = None, *, diagram: bool = True, inadmissible: bool = False, si: bool = False, legend: bool = True,
        title: str | None = None, **line: Any,
    ) -> Any:
        """Draw the bifurcation diagram: speeds of closings, or of a machine without stops the `quantity`, solid if stable, dashed and
        dotted if neutral, dashed if unstable, with the events.

        Parameters
        ----------
        ax : matplotlib Axes
            The axes to draw on; by default those of a new figure.
        diagram : bool
            Whether to draw the orbit diagram from simulation in grey behind the branch.
        inadmissible : bool
            Whether to draw inadmissible solutions too, as dotted lines.
        si : bool
            Whether to draw in metres and seconds, for an oscillator with units.
        """
        figure = self._figure(si=si, diagram=diagram, inadmissible=inadmissible, branch=self.number or None)
        return self._painted(figure, ax, legend, title, line)

    def _draw(self, ax: Any) -> None:
        self.plot(ax, diagram=False)

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        second = {} if self.also is None or self.second is None else {self.also[0]: self.second}
        shown = {} if self.quantity is None or self.value is None else {self.quantity: self.value}
        modulus = np.abs(self.multipliers).max(axis=1) if len(self) else np.empty(0)
        return {
            self.vary: self.parameter, **second, "label": self.label, "period": self.period, "stable": self.stable,
            "stability": self.stability, "admissible": self.admissible, "speed": self.speed, **shown, "multiplier": modulus,
        }

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json; of a branch that begins on another one, its part of it."""
        return copy.deepcopy(self._of if self.number == 0 else self._one)


class CurveEvent(View, schema="curve CurveEventObject"):
    """A point of codimension two on a curve, or an end of the curve."""

    kind: str
    values: list[float]
    point: int
    stop: str | None

    def __repr__(self) -> str:
        return f"<CurveEvent {self.kind} at {self.values[0]:.9g}, {self.values[1]:.9g}>"


class Curve(_Followed, schema="curve PointObject"):
    """A curve of an event of an orbit, from one end to the other.

    Attributes
    ----------
    ranges : ((float, float), (float, float))
        The ranges of both numbers.
    values : ndarray, shape (points, 2)
        Values of the two numbers.
    cycles : list of Events
        The events at each point; on a grazing curve of an oscillator including the impact of speed zero.
    """

    label: str
    kind: str
    of: list[str] | None
    found_at: list[float]
    through: Made[tuple[int, int]] = field(lambda of: (of["event"], of["point"]))
    parameters: Made[tuple[str, str]] = field(pair)
    ranges = field(lambda task: _ranges(task["vary"], task["and"]), "plan.task.curve")
    admissible, residual = column(np.bool_), column(np.float64)
    values: Made[_Floats] = Made(lambda of: _pairs([at["values"] for at in of._rows]))
    events = parts(CurveEvent)

    def __repr__(self) -> str:
        p, q = self.parameters
        return f"<Curve of {self.kind} of {self.label} over {p} and {q}, {len(self)} points, {len(self.events)} events>"

    def _table(self) -> dict[str, Any]:
        """One row for each point."""
        p, q = self.parameters
        columns = {p: self.values[:, 0], q: self.values[:, 1], "admissible": self.admissible}
        return columns if isinstance(self.system, Oscillator) else {**columns, "residual": self.residual}


class Polygon(View, schema="region PolygonObject"):
    """A closed polygon; the last vertex is joined to the first."""

    vertices = field(_pairs)
    bounds: list[str]
    hole: bool
    sheet: str

    def _table(self) -> dict[str, Any]:
        """One row for each vertex, with the boundary that begins there."""
        return {"first": self.vertices[:, 0], "second": self.vertices[:, 1], "bound": self.bounds}

    def __repr__(self) -> str:
        return f"<Polygon of {len(self.vertices)} vertices{', a hole' if self.hole else ''}>"


class Part(View, schema="region RegionObject"):
    """The region where a motion exists, or where it is stable."""

    polygons = parts(Polygon)
    unresolved = field(_pairs)

    def __repr__(self) -> str:
        return f"<Part of {len(self.polygons)} polygons>"

    def _table(self) -> dict[str, Any]:
        """One row for each vertex of each polygon."""
        return _vertices([("", self)], ("first", "second"))

    def contains(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.bool_]:
        """Whether points lie in the region. The arguments are the values of the two parameters; the result has their shape."""
        p, q = np.broadcast_arrays(numbers("values", first), numbers("values", second))
        polygons = [(polygon.vertices, polygon.sheet == "below") for polygon in self.polygons]
        inside = _core.contains(polygons, np.ascontiguousarray(p).reshape(-1), np.ascontiguousarray(q).reshape(-1))
        return inside.reshape(p.shape)


class Region(Answer, schema="region"):
    """The regions of existence and stability of a motion in a plane.

    Attributes
    ----------
    ranges : ((float, float), (float, float))
        The ranges of the two parameters.
    """

    label: str
    neutrally_stable: bool
    existence, stability = part(Part), part(Part)
    parameters: Made[tuple[str, str]] = field(pair)
    ranges = field(lambda task: _ranges(task["across"], task["up"]), "plan.task.region")

    def __repr__(self) -> str:
        parts = f"existence {len(self.existence.polygons)}, stability {len(self.stability.polygons)} polygons"
        return f"<Region of {self.label} over {self.parameters[0]} and {self.parameters[1]}: {parts}>"

    def _table(self) -> dict[str, Any]:
        """One row for each vertex of the polygons of both regions."""
        return _vertices([("existence", self.existence), ("stability", self.stability)], self.parameters)


def _vertices(parts: "list[tuple[str, Part]]", names: tuple[str, str]) -> dict[str, Any]:
    """The vertices of all polygons as columns."""
    table: dict[str, list[Any]] = {name: [] for name in ("region", "polygon", "hole", *names, "bound")}
    for region_, part in parts:
        for k, polygon in enumerate(part.polygons):
            for (p, q), bound in zip(polygon.vertices.tolist(), polygon.bounds):
                for name, value in zip(table, (region_, k, polygon.hole, p, q, bound)):
                    table[name].append(value)
    return table


class ResponseCurve(View, schema="response PointObject"):
    """The motions of a sweep, or the points of a branch from one end to the other.

    Attributes
    ----------
    quantities : dict of ndarray
        All quantities by name; nan where one is not defined.
    """

    parameter, label, stability = column(np.float64), column(np.str_), column(np.str_)
    stable, admissible = column(np.bool_), column(np.bool_)
    quantities: dict[str, _Floats]

    def __len__(self) -> int:
        return len(self._rows)

    def _table(self) -> dict[str, Any]:
        """One row for each motion."""
        names = ("parameter", "label", "stable", "stability", "admissible")
        return {name: getattr(self, name) for name in names} | self.quantities

    def __repr__(self) -> str:
        return f"<ResponseCurve with {len(self)} points: {', '.join(dict.fromkeys(self.label.tolist()))}>"


class Response(Answer, schema="response"):
    """A quantity of all motions over one parameter.

    Attributes
    ----------
    up, down : ResponseCurve
        The motions of the sweeps with rising and with falling values.
    branches : list of ResponseCurve
        The branches on which their cycles lie.
    units : dict of str
        The unit of each quantity; those of SI over a number of a body.
    """

    vary: str
    quantity: str
    up: ResponseCurve
    down: ResponseCurve
    branches: list[ResponseCurve]
    units: dict[str, str]

    def _read(self, answer: _core.Answer) -> dict[str, Any]:
        found, all_ = super()._read(answer), answer.columns() or {}
        columns = [dict(zip(all_["names"], values.T)) for values in all_["curves"]]
        curves = [{**of, "quantities": own} for of, own in zip((*found["sweeps"], *found["branches"]), columns)]
        up, down, *branches = [ResponseCurve(of, self.system) for of in curves]
        units = dict(zip(all_["names"], all_["units"]))
        return {**found, "up": up, "down": down, "branches": branches, "units": units}

    def __repr__(self) -> str:
        count = len(self.branches)
        return f"<Response of {self.quantity} over {self.vary}: {len(self.up)} values, {count} branch{'' if count == 1 else 'es'}>"

    def _table(self) -> dict[str, Any]:
        """One row for each motion of the sweeps and each point of the branches."""
        curves = [("up", self.up), ("down", self.down), *((f"branch {k + 1}", of) for k, of in enumerate(self.branches))]
        tables = [(name, of._table()) for name, of in curves]
        joined = {name: np.concatenate([table[name] for _, table in tables]) for name in tables[0][1]}
        of = np.repeat([name for name, _ in tables], [len(curve) for _, curve in curves])
        return {"curve": of, self.vary: joined.pop("parameter"), **joined}

    def plot(
        self, ax: Any = None, *, quantity: str | None = None, si: bool = False, legend: bool = True, title: str | None = None, **line: Any
    ) -> Any:
        """Draw a quantity over the parameter: stable branches solid, neutral ones dashed and dotted, unstable ones dashed, the motions of the sweeps as dots.

        Parameters
        ----------
        ax : Axes
            The axes to draw in; new ones by default.
        quantity : str
            Another quantity than that of the response.
        si : bool
            Whether to draw in metres and seconds, for an oscillator with units; over a number in SI units this is always so.
        """
        if quantity is not None and quantity not in self.up.quantities:
            known = ", ".join(self.up.quantities)
            raise _core.QuestionError(f"`{quantity}` is no quantity; there are {known}")
        return self._painted(self._figure(si=si or any(self.units.values()), quantity=quantity), ax, legend, title, line)

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json."""
        found: dict[str, Any] = json.loads(self._whole.json(False))
        return found


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
