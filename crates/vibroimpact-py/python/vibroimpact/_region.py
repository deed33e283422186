"""The regions of a plane of two numbers in which a motion exists and is stable."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._arguments import numbers
from vibroimpact._result import Answer, Floats, Made, View, field, part, parts

T = TypeVar("T")


def pair(of: Iterable[T]) -> tuple[T, T]:
    """Two values."""
    one, two = of
    return one, two


def pairs(given: Any) -> Floats:
    return np.array(given, dtype=np.float64).reshape(-1, 2)


def ranges(first: Mapping[str, Any], second: Mapping[str, Any]) -> tuple[tuple[float, float], tuple[float, float]]:
    """The ranges of two numbers in a plan."""
    return (first["from"], first["to"]), (second["from"], second["to"])


class Polygon(View, schema="region PolygonObject"):
    """A closed polygon; the last vertex is joined to the first."""

    vertices = field(pairs)
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
    unresolved = field(pairs)

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
    ranges = field(lambda task: ranges(task["across"], task["up"]), "plan.task.region")

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
