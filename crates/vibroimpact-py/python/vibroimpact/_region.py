"""Where in a plane of two parameters a motion exists, and where it is stable."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._axis import Interval, numbers, plane
from vibroimpact._core import Oscillator
from vibroimpact._whole import GRID, THREADS, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Polygon:
    """A closed polygon; the last vertex is joined to the first.

    Attributes
    ----------
    vertices : ndarray, shape (n, 2)
        Values of the two parameters, the region to the left.
    bounds : list of str
        What bounds the region from each vertex to the next: "fold", "flip", "merging", "no speed", "touch", "frame".
    hole : bool
        Whether it is the edge of a hole.
    sheet : str
        "below" for orbits whose multipliers stay below +1, "above" for the others.
    """

    vertices: NDArray[np.float64]
    bounds: list[str]
    hole: bool
    sheet: str

    def __repr__(self) -> str:
        return f"<Polygon of {len(self.vertices)} vertices{', a hole' if self.hole else ''}>"

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON."""
        return {"hole": self.hole, "sheet": self.sheet, "vertices": self.vertices.tolist(), "bounds": self.bounds}


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Part:
    """Where a motion exists, or is stable.

    Attributes
    ----------
    polygons : list of Polygon
        Its edges; those of different sheets may overlap.
    unresolved : ndarray, shape (n, 2)
        Points of the grid where the search for orbits and the polygons do not agree.
    """

    polygons: list[Polygon]
    unresolved: NDArray[np.float64]

    def __repr__(self) -> str:
        return f"<Part of {len(self.polygons)} polygons>"

    def contains(self, first: ArrayLike, second: ArrayLike) -> NDArray[np.bool_]:
        """Whether points lie in it, in the shape of their values of both parameters."""
        p, q = np.broadcast_arrays(numbers("values", first), numbers("values", second))
        polygons = [(polygon.vertices, polygon.sheet == "below") for polygon in self.polygons]
        inside = _core.contains(polygons, np.ascontiguousarray(p).reshape(-1), np.ascontiguousarray(q).reshape(-1))
        return inside.reshape(p.shape)

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON."""
        return {"polygons": [p.to_dict() for p in self.polygons], "unresolved": self.unresolved.tolist()}


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Region:
    """Both regions of a motion in a plane.

    Attributes
    ----------
    osc : Oscillator
        The system; what varies counts for nothing.
    label : str
        m/n.
    parameters : (str, str)
        The parameters on the abscissa and the ordinate.
    ranges : ((float, float), (float, float))
        The frame.
    neutrally_stable : bool
        Whether nothing is lost at impacts or between them: the motion is stable nowhere then, and neutrally stable where it exists.
    existence, stability : Part
        Where it exists, and where it is stable.
    plan : str
        The question as JSON.
    """

    osc: Oscillator
    label: str
    parameters: tuple[str, str]
    ranges: tuple[tuple[float, float], tuple[float, float]]
    neutrally_stable: bool
    existence: Part
    stability: Part
    plan: str

    def __repr__(self) -> str:
        parts = f"existence {len(self.existence.polygons)}, stability {len(self.stability.polygons)} polygons"
        return f"<Region of {self.label} over {self.parameters[0]} and {self.parameters[1]}: {parts}>"

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Both regions, their edges in the colour of what bounds them."""
        from vibroimpact import _plane

        return _plane.region(self, ax)

    def to_dict(self) -> dict[str, Any]:
        """The fields of the command's JSON."""
        return {
            "label": self.label,
            "parameters": list(self.parameters),
            "neutrally_stable": self.neutrally_stable,
            "existence": self.existence.to_dict(),
            "stability": self.stability.to_dict(),
        }


def region(
    osc: Oscillator, label: str, over: Mapping[str, Interval], *, grid: int = 24, threads: int = 0
) -> Region:
    """Find where in a plane of two parameters the motion m/n exists, and where it is stable, as closed polygons.

    Orbits are looked for on a grid, and from each a walk goes round the part of the region it lies in, along the curves
    that bound it.

    Parameters
    ----------
    osc : Oscillator
        The system; its values of the two parameters count for nothing.
    label : str
        "m/n".
    over : mapping
        Two parameters and their ranges, the abscissa first: {"inverse_beta": (0.4, 2), "gap": (-1, 5)}.
    grid : int
        Points of the grid in each direction, 2 to 400: smaller parts may be missed.
    threads : int
        0 for one per core.

    Examples
    --------
    >>> from vibroimpact import Oscillator, region
    >>> osc = Oscillator(inverse_beta=1, gap=0, restitution=0.5)
    >>> found = region(osc, "1/1", {"inverse_beta": (0.6, 0.9), "gap": (1, 3)}, grid=6)
    >>> bool(found.stability.contains(0.8, 1.5))
    True
    """
    first, second = plane(over)
    grid, threads = whole("grid", grid, GRID), whole("threads", threads, THREADS)
    existence, stability, neutral, plan = _core.region(osc, label, first, second, grid, threads)
    parts = [
        Part([Polygon(v, b, hole, "below" if below else "above") for v, b, hole, below in polygons], unresolved)
        for polygons, unresolved in (existence, stability)
    ]
    return Region(
        osc, label.strip(), (first[0], second[0]), (first[1:], second[1:]), neutral, parts[0], parts[1], plan
    )
