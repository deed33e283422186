"""Points drawn from a box of parameters and starts, by Sobol's sequence or as a Latin hypercube."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact import _core
from vibroimpact._arguments import SAMPLES, SEED, Interval, interval, whole
from vibroimpact._core import QuestionError
from vibroimpact._json import read


class Sample(Mapping[str, NDArray[np.float64]]):
    """Points drawn from a box: a mapping of names to arrays, one value for each point. `sample` makes one.

    A plan or a store keeps how they are drawn, and not the points.
    """

    __slots__ = ("_columns", "_drawn")

    def __init__(self, drawn: dict[str, Any]) -> None:
        self._drawn = drawn
        self._columns: list[NDArray[np.float64]] | None = None

    def __repr__(self) -> str:
        ranges = ", ".join(f"{side['vary']} from {side['from']:g} to {side['to']:g}" for side in self._drawn["over"])
        return f"<Sample of {self._drawn['count']} points by {self._drawn['rule']}: {ranges}>"

    def __iter__(self) -> Iterator[str]:
        return (side["vary"] for side in self._drawn["over"])

    def __len__(self) -> int:
        return len(self._drawn["over"])

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        place = {side["vary"]: k for k, side in enumerate(self._drawn["over"])}[name]
        if self._columns is None:
            self._columns = _core.drawn_points(json.dumps(self._drawn))
        return self._columns[place]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sample) and self._drawn == other._drawn

    def to_dict(self) -> dict[str, Any]:
        """How they are drawn, as in a plan."""
        return read(json.dumps(self._drawn))

    def low(self) -> dict[str, float]:
        """The corner of the box with the smallest values."""
        return {side["vary"]: side["from"] for side in self._drawn["over"]}


def sample(rule: str, count: int, over: Mapping[str, Interval], *, seed: int = 0) -> Sample:
    """Draw points from a box of parameters and coordinates of the start. They are the same on every machine.

    Parameters
    ----------
    rule : str
        "sobol" for the low-discrepancy sequence of Sobol, for which powers of two are good numbers of points, or "lhs" for a
        Latin hypercube.
    count : int
        Number of points, 1 to 1e9.
    over : mapping
        The ranges of 1 to 16 parameters, and of "x", "v" and "phase": {"gap": (0, 3), "restitution": "0.3:0.8"}.
    seed : int
        Another sequence for each seed. For "sobol", 0 is the sequence itself and other seeds shift its digits.

    Examples
    --------
    >>> from vibroimpact import sample, settle_many
    >>> points = sample("sobol", 4, {"gap": (0, 2), "restitution": (0.4, 0.8)})
    >>> points["gap"].tolist()
    [0.0, 1.0, 1.5, 0.5]
    >>> ds = settle_many(sample("lhs", 100, {"inverse_beta": (1, 2), "gap": (0, 2)}, seed=3), over={"restitution": 0.5})
    >>> ds["label"].shape
    (100,)
    """
    if rule not in ("sobol", "lhs"):
        raise QuestionError(f"rule = `{rule}` is none of sobol, lhs")
    if not isinstance(over, Mapping):
        raise TypeError('ranges are written {"gap": (0, 3), "restitution": (0.3, 0.8)}')
    sides = [{"vary": str(name), **dict(zip(("from", "to"), interval(of)))} for name, of in over.items()]
    count = whole("count", count, SAMPLES)
    found = Sample({"rule": rule, "count": count, "seed": whole("seed", seed, SEED), "over": sides})
    if count <= _AT_ONCE:
        # what is wrong is said here
        found._columns = _core.drawn_points(json.dumps(found._drawn))
    return found


#: Up to this number of points they are drawn at once.
_AT_ONCE = 1_000_000
