"""The regions of a plane of two parameters in which a motion exists and in which it is stable."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._ask import System, ask
from vibroimpact._axis import Interval, numbers, plane
from vibroimpact._oscillator import Oscillator
from vibroimpact._progress import Progress
from vibroimpact._result import Field, Result, View
from vibroimpact._whole import GRID, whole


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

    @property
    def parameters(self) -> tuple[str, str]:
        """The two parameters."""
        return tuple(next(iter(side.values())) for side in self._sides)

    @property
    def ranges(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Their ranges."""
        return tuple((side["from"], side["to"]) for side in self._sides)  # type: ignore[return-value]

    @property
    def _sides(self) -> list[dict[str, Any]]:
        task = self._of["plan"]["task"]["region"]
        return [task["across"], task["up"]]

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


def region(
    system: System,
    label: str,
    over: Mapping[str, Interval],
    *,
    grid: int = 24,
    threads: int = 0,
    progress: Progress = None,
) -> Region:
    """Find the regions of a plane of two parameters in which the motion m/n exists and is stable, as closed polygons.

    Orbits are searched on a grid. From each orbit the boundary of its part of the region is followed along the curves of
    events that form it.

    Parameters
    ----------
    system : Oscillator or Machine
        The system; its values of the two parameters are ignored. A machine must have one coordinate on a spring, forcing of
        order 1, no friction, and one rigid stop or two on opposite sides.
    label : str
        The label "m/n" of the motion.
    over : mapping
        Two parameters and their ranges, the abscissa first: {"inverse_beta": (0.4, 2), "gap": (-1, 5)}. With
        physical units also two of them: {"mass_kg": (0.7, 0.95), "force_n": (10, 60)}. Of a machine paths:
        {"frequency": (0.5, 1.5), "stop.wall.gap": (0, 2)}.
    grid : int
        Number of points of the grid in each direction, 2 to 400. Parts of the region between its points may be missed.
    threads : int
        Number of threads; 0 for one per core.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

    Examples
    --------
    >>> from vibroimpact import Oscillator, region
    >>> osc = Oscillator(inverse_beta=1, gap=0, restitution=0.5)
    >>> found = region(osc, "1/1", {"inverse_beta": (0.6, 0.9), "gap": (1, 3)}, grid=6)
    >>> bool(found.stability.contains(0.8, 1.5))
    True
    """
    first, second = plane(over)
    kind = "parameter" if isinstance(system, Oscillator) else "path"
    sides = [{kind: name, "from": low, "to": high} for name, low, high in (first, second)]
    task = {"label": label, "across": sides[0], "up": sides[1], "grid": whole("grid", grid, GRID)}
    found = ask(system, "region", task, total=2, threads=threads, progress=progress, what="regions")
    return Region.answering(found, system)


def _part(of: Mapping[str, Any]) -> Part:
    def pairs(given: Any) -> NDArray[np.float64]:
        return np.array(given, dtype=np.float64).reshape(-1, 2)

    polygons = [Polygon(pairs(one["vertices"]), one["bounds"], one["hole"], one["sheet"]) for one in of["polygons"]]
    return Part(polygons, pairs(of["unresolved"]))
