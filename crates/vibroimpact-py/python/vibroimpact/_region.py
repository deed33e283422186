"""The regions of a plane of two parameters in which a motion exists and in which it is stable."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._axis import numbers
from vibroimpact._result import Field, Made, Result, View, pair


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Polygon(Result):
    """A closed polygon; the last vertex is joined to the first.

    Attributes
    ----------
    vertices : ndarray, shape (n, 2)
        Values of the two parameters; the region lies to the left of the polygon.
    bounds : list of str
        The kind of boundary from each vertex to the next: "fold", "flip", "merging", "no speed", "touch", "frame"; of
        a machine also "torus" and "change".
    hole : bool
        Whether it is the boundary of a hole.
    sheet : str
        "below" for orbits whose multipliers are below +1, "above" for the others.
    """

    vertices: NDArray[np.float64]
    bounds: list[str]
    hole: bool
    sheet: str

    def _table(self) -> dict[str, Any]:
        """One row for each vertex, with the boundary that begins there."""
        return {"first": self.vertices[:, 0], "second": self.vertices[:, 1], "bound": self.bounds}

    def __repr__(self) -> str:
        return f"<Polygon of {len(self.vertices)} vertices{', a hole' if self.hole else ''}>"

@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Part(Result):
    """The region where a motion exists, or where it is stable.

    Attributes
    ----------
    polygons : list of Polygon
        Its boundaries; those of different sheets may overlap.
    unresolved : ndarray, shape (n, 2)
        Points of the grid where the search for orbits contradicts the polygons.
    """

    polygons: list[Polygon]
    unresolved: NDArray[np.float64]

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

class Region(View):
    """The regions of existence and stability of a motion in a plane.

    Attributes
    ----------
    system : Oscillator or Machine
        The system; its values of the two parameters are ignored.
    label : str
        The label m/n of the motion.
    parameters : (str, str)
        The parameters on the abscissa and the ordinate; of a machine the paths of numbers.
    ranges : ((float, float), (float, float))
        The ranges of the two parameters.
    neutrally_stable : bool
        Whether no energy is lost, at impacts or between them. The motion is then neutrally stable wherever it exists.
    existence, stability : Part
        The region where it exists, and the region where it is stable.
    plan : str
        The plan as JSON.
    """

    label: str
    neutrally_stable: bool
    existence: Field[Part] = Field(lambda of: _part(of))
    stability: Field[Part] = Field(lambda of: _part(of))
    _sides: Field[list[dict[str, Any]]] = Field(lambda task: [task["across"], task["up"]], "plan.task.region")
    parameters: Made[tuple[str, str]] = Made(lambda of: pair(next(iter(side.values())) for side in of._sides))
    ranges: Made[tuple[tuple[float, float], tuple[float, float]]] = Made(
        lambda of: pair((side["from"], side["to"]) for side in of._sides)
    )

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


def _part(of: Mapping[str, Any]) -> Part:
    def pairs(given: Any) -> NDArray[np.float64]:
        return np.array(given, dtype=np.float64).reshape(-1, 2)

    polygons = [Polygon(pairs(one["vertices"]), one["bounds"], one["hole"], one["sheet"]) for one in of["polygons"]]
    return Part(polygons, pairs(of["unresolved"]))
