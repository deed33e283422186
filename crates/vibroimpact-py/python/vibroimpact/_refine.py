"""Adaptively refined studies: points are added in rounds where the motions at neighbouring points differ."""

import os
from collections.abc import Mapping, Sequence
from itertools import product
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact._arguments import CELLS, ROUNDS, Interval, Progress, interval, whole
from vibroimpact._core import QuestionError
from vibroimpact._oscillator import Oscillator
from vibroimpact._plan import Plan
from vibroimpact._point_datasets import with_whole_numbers
from vibroimpact._stated import STARTS
from vibroimpact._store import computed

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from vibroimpact._points import Points

#: Most numbers that vary: a cell has a corner for each choice of ends.
_MOST_SIDES = 4


def refine(
    system: "Oscillator | Points", over: Mapping[str, Interval], store: str | PathLike[str], *, cells: int = 16,
    rounds: int = 4, starts: "Points | None" = None, fields: Sequence[str] = (), impacts: int | None = None,
    tile: int | None = None, client: "Client | None" = None, threads: int = 0, progress: Progress = None,
) -> "xr.Dataset":
    """Settle the motions at the points of a grid that becomes finer where the labels change.

    The first round computes the corners of `cells` cells along each range. Each further round halves, in all directions, the cells
    whose corners have different labels, and computes the new corners. So boundaries are resolved as by a grid of `cells` times 2 to
    the power of `rounds` cells; a feature that touches no corner of a cell is missed.

    Each round is a study of its own, `STORE/round-0.zarr` and so on, by this process or by the workers of a Dask cluster. What is there
    is not computed again, so a call that was stopped or killed goes on, and more rounds can be added later.

    Parameters
    ----------
    system : Oscillator, mapping, DataFrame or Dataset
        The system; parameters that vary have their values from `over`.
    over : mapping
        Ranges of 1 to 4 parameters and coordinates of the start: {"inverse_beta": (0.5, 2), "gap": (0, 3)}.
    store : path
        A folder for the stores of the rounds, or "s3://BUCKET/PREFIX".
    cells : int
        Number of cells along each range in the first round, 1 to 4096.
    rounds : int
        Number of further rounds, 0 to 20.
    starts, fields, impacts, tile, client, threads
        As for `settle_many`.
    progress : bool or callable
        True for a progress bar for each round, or a function called with the amounts done and in total in this round.

    Returns
    -------
    xarray.Dataset
        The points of all rounds along the dimension `sample`, with the number of their `round`; `ds.vibro.plot()` draws them.

    Examples
    --------
    >>> import tempfile
    >>> from vibroimpact import Oscillator, refine
    >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ds = refine(osc, {"inverse_beta": (1.1, 1.5), "gap": (0.5, 1)}, folder, cells=4, rounds=3).load()
    >>> full = (4 * 2**3 + 1) ** 2
    >>> int((ds["round"] == 0).sum()), ds.sizes["sample"] < full / 2
    (25, True)
    """
    import xarray as xr

    cells, rounds = whole("cells", cells, CELLS, here=True), whole("rounds", rounds, ROUNDS, here=True)
    if not isinstance(over, Mapping) or not 1 <= len(over) <= _MOST_SIDES:
        raise QuestionError(f'over has the ranges of 1 to {_MOST_SIDES} numbers: {{"inverse_beta": (0.5, 2), "gap": (0, 3)}}')
    sides = [(str(name), *interval(of)) for name, of in over.items()]
    if wrong := next((side for side in sides if not (np.isfinite(side[1:]).all() and side[1] < side[2])), None):
        raise QuestionError(f"{wrong[0]} from {wrong[1]:g} to {wrong[2]:g} is not a range\nhint: (a, b) or \"A:B\" with finite a < b")
    lattice = _Lattice(sides, cells << rounds)
    place = fspath(store).rstrip("/")

    def settled(new: NDArray[np.int64], number: int) -> xr.Dataset:
        """The Dataset of the points of one round."""
        values = lattice.values(new)
        given: Any = system
        given_starts: Any = starts or {}
        of_starts = {**given_starts, **{name: of for name, of in values.items() if name in STARTS}}
        of_systems = {name: of for name, of in values.items() if name not in STARTS}
        if not isinstance(given, Oscillator):
            given, of_systems = {**given, **of_systems}, {}
        plan = Plan.samples(given, over=of_systems or None, starts=of_starts or None, fields=fields, impacts=impacts, tile=tile)
        if not place.startswith("s3://"):
            os.makedirs(place, exist_ok=True)
        return with_whole_numbers(computed(plan, f"{place}/round-{number}.zarr", client, threads, progress))

    open_cells = _all_cells(len(sides), cells) << rounds
    side = 1 << rounds
    found: list[xr.Dataset] = []
    for number in range(rounds + 1):
        new = lattice.unknown(_corners(open_cells, side))
        if len(new):
            ds = settled(new, number)
            lattice.learn(new, ds["label"].values)
            found.append(ds.assign(round=("sample", np.full(len(new), number, dtype=np.int8), {"long_name": "round of the refinement", "units": "1"})))
        open_cells = open_cells[lattice.differ(_corners(open_cells, side))]
        if side == 1 or not len(open_cells):
            break
        side >>= 1
        open_cells = (open_cells[:, None, :] + side * _offsets(len(sides))[None]).reshape(-1, len(sides))
    # tables of cycles belong to one round
    kept = [ds.drop_dims([name for name in ds.dims if name != "sample"]).drop_vars("cycle", errors="ignore") for ds in found]
    joined: xr.Dataset = xr.concat(kept, "sample", combine_attrs="drop_conflicts", compat="equals", coords="minimal", data_vars="minimal", join="outer")
    return joined


class _Lattice:
    """The points of the finest grid, by their whole coordinates, and what is known of them."""

    def __init__(self, sides: list[tuple[str, float, float]], count: int) -> None:
        self.sides, self.count = sides, count
        self._keys = np.empty(0, dtype=np.int64)
        self._labels = np.empty(0, dtype=np.int32)

    def _key(self, points: NDArray[np.int64]) -> NDArray[np.int64]:
        keys = np.zeros(points.shape[:-1], dtype=np.int64)
        for k in range(len(self.sides)):
            keys = keys * (self.count + 1) + points[..., k]
        return keys

    def unknown(self, corners: NDArray[np.int64]) -> NDArray[np.int64]:
        """The points among these corners that are not known, in the order of their keys."""
        keys, places = np.unique(self._key(corners).reshape(-1), return_index=True)
        return corners.reshape(-1, len(self.sides))[places[~np.isin(keys, self._keys)]]

    def values(self, points: NDArray[np.int64]) -> dict[str, NDArray[np.float64]]:
        """The values of what varies at these points; the ends of the ranges are exact."""
        share = points / self.count
        return {name: np.where(points[:, k] == self.count, high, low + (high - low) * share[:, k]) for k, (name, low, high) in enumerate(self.sides)}

    def learn(self, points: NDArray[np.int64], labels: NDArray[np.int32]) -> None:
        keys = np.concatenate([self._keys, self._key(points)])
        order = np.argsort(keys)
        self._keys, self._labels = keys[order], np.concatenate([self._labels, labels])[order]

    def differ(self, corners: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Which cells have corners with different labels."""
        labels = self._labels[np.searchsorted(self._keys, self._key(corners))]
        different: NDArray[np.bool_] = (labels != labels[:, :1]).any(axis=1)
        return different


def _offsets(sides: int) -> NDArray[np.int64]:
    return np.array(list(product((0, 1), repeat=sides)), dtype=np.int64)


def _all_cells(sides: int, count: int) -> NDArray[np.int64]:
    """The low corners of all cells of the first round."""
    return np.stack(np.meshgrid(*[np.arange(count, dtype=np.int64)] * sides, indexing="ij"), axis=-1).reshape(-1, sides)


def _corners(low: NDArray[np.int64], side: int) -> NDArray[np.int64]:
    """The corners of cells, by cell and corner."""
    return low[:, None, :] + side * _offsets(low.shape[1])[None]
