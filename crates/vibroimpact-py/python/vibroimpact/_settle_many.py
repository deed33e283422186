"""Where many motions settle: from many starts, of many systems."""

from __future__ import annotations

import json
from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact import _core
from vibroimpact._arguments import BUDGET, Progress, maybe, names, numbers, threads_of, watched
from vibroimpact._machine import Machine
from vibroimpact._motions import Settlement
from vibroimpact._oscillator import Oscillator
from vibroimpact._point_datasets import dataset, in_shape, whole_numbers, with_whole_numbers
from vibroimpact._points import Over, Points, points
from vibroimpact._question import POINTS, document
from vibroimpact._sample import Sample
from vibroimpact._stated import variable
from vibroimpact._system import System

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


@overload
def settle_many(
    system: Oscillator, x: ArrayLike, v: ArrayLike = 0.0, phase: ArrayLike = 0.0, *, threads: int = 0,
    progress: Progress = None,
) -> Settlement: ...


@overload
def settle_many(
    system: "System | Points", *, over: "Points | None" = None, starts: "Points | None" = None,
    fields: Sequence[str] = (), transient: bool = False, impacts: int | None = None,
    store: str | PathLike[str] | None = None, client: "Client | None" = None, tile: int | None = None, threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset": ...


def settle_many(
    system: "System | Points", x: ArrayLike | None = None, v: ArrayLike = 0.0, phase: ArrayLike = 0.0, *,
    over: "Points | None" = None, starts: "Points | None" = None, fields: Sequence[str] = (), transient: bool = False,
    impacts: int | None = None, store: str | PathLike[str] | None = None, client: "Client | None" = None,
    tile: int | None = None, threads: int = 0, progress: Progress = None,
) -> "Settlement | xr.Dataset":
    """Follow many motions until they have settled: from many starts, of many systems.

    Systems and starts are names with arrays that broadcast against each other, tables of pandas or Datasets of xarray,
    whose dimensions are kept. Starts of one system are followed side by side. Positions `x` as the second argument give a
    `Settlement` with the motions of one system, and no Dataset.

    Parameters
    ----------
    x, v, phase : array_like
        Positions, velocities and phases, broadcast to one shape.
    store, client, tile
        As for `basin`. In a store the points are one dimension, `sample`, whatever shape the arrays have.

    Returns
    -------
    xarray.Dataset
        `label` (codes, which `ds.vibro.labels()` converts to text), `impacts` m and `periods` n of the motion m/n, the
        `reason` of the verdict, and what `fields` and `transient` ask for. For several systems the Floquet multipliers of
        each motion, `multiplier_1_re`, `multiplier_1_im` and `multiplier_2_...`, the larger first; for one system `cycle`,
        and the cycles in the tables `cycle_...`, as of `basin`. Of a machine there are `label`, `impacts`, `periods`, the largest
        `speed` of a closing, the largest modulus of the multipliers as `multiplier`, and `fields`; where a start lies beyond a
        stop, or the numbers are not allowed, there is no motion.

    Examples
    --------
    >>> import numpy as np
    >>> import vibroimpact as vi
    >>> from vibroimpact import Oscillator, settle_many
    >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> ds = settle_many({"inverse_beta": [1.3, 1.8], "gap": [0.75, 0.25], "restitution": 0.5}, starts={"v": 0.5})
    >>> ds.vibro.labels().values.tolist(), ds["impacts"].values.tolist()
    (['2/1', '4/1'], [2.0, 4.0])
    >>> found = settle_many(osc, np.linspace(-4, 0.75, 5), 0.0)
    >>> found.labels.tolist()
    ['1/1', '1/1', '1/1', '1/1', '2/1']
    >>> machine = vi.Machine.named("two-mass-hammer")
    >>> machine.settle_many(over={"frequency": [1.0, 1.2]}).vibro.labels().values.tolist()
    ['2/1', '1/1']
    """
    threads = threads_of(threads)
    if x is None:
        if any(np.ndim(of) > 0 or of != 0.0 for of in (v, phase)):
            raise TypeError('velocities and phases without positions are written starts={"v": ..., "phase": ...}')
        if store is None and client is None and tile is None and not isinstance(system, Machine):
            options = (maybe("impacts", impacts, BUDGET), names(fields) or [], bool(transient))
            return _of_points(points(system, over, starts), options, threads, progress)
        from vibroimpact import _store
        from vibroimpact._plan import Plan

        plan = Plan.samples(
            system, over=over, starts=starts, fields=fields, transient=transient, impacts=impacts, tile=tile
        )
        ds = with_whole_numbers(_store.computed(plan, store, client, threads, progress))
        if not isinstance(system, Machine) or store is not None or any(isinstance(of, Sample) for of in (over, starts)):
            return ds
        return in_shape(ds, points(system, over, starts))
    if over is not None or starts is not None or len(fields) or transient or impacts is not None or store is not None:
        raise TypeError("x as the second argument has no over, starts, fields, transient, impacts and store: write starts={\"x\": ...}")
    if not isinstance(system, Oscillator):
        raise TypeError("x as the second argument is for one Oscillator: write starts={\"x\": ...}")
    return _of_starts(system, (x, v, phase), threads, progress)



document(POINTS, basin=[settle_many])


def _of_points(over: Over, options: tuple[int | None, list[str], bool], threads: int, progress: Progress) -> "xr.Dataset":
    """The motions of oscillators at points of parameters and starts."""
    osc: Any = over.system
    with watched(progress, "starts") as tell:
        found = _core.settle_points(osc._file, over.columns, over.start, options, threads, tell)
    variables = {}
    for of in found:
        dims, values, _ = variables[of["name"]] = variable(of, over.sizes)
        if of["name"] == "label":
            variables |= whole_numbers(dims, values)
    return dataset(over, "motions an impact oscillator settles into", variables)


def _of_starts(
    osc: Oscillator, given: tuple[ArrayLike, ArrayLike, ArrayLike], threads: int, progress: Progress
) -> Settlement:
    """The motions of one system from arrays of starts. Arrays of doubles are not copied."""
    columns = [numbers(name, of) for name, of in zip(("x", "v", "phase"), given)]
    shape = np.broadcast_shapes(*(column.shape for column in columns))
    size = int(np.prod(shape))
    # the compiled module accepts one number or a full column; only partly broadcast arrays must be expanded
    flat = [
        column.reshape(-1)
        if column.size in (1, size) and (column.size == 1 or column.shape == shape)
        else np.ascontiguousarray(np.broadcast_to(column, shape)).reshape(-1)
        for column in columns
    ]
    if size > 0 and all(column.size == 1 for column in flat):
        flat[0] = np.ascontiguousarray(np.broadcast_to(flat[0], (size,)))
    with watched(progress, "starts") as tell:
        found, cells = _core.settle_many(osc._file, flat[0], flat[1], flat[2], threads, tell)
    motions = [{**json.loads(told), "share": count / max(size, 1), "starts": count} for told, count in found]
    intervals = [_core.share_interval(count, size) for _, count in found]
    return Settlement({"motions": motions, "share_intervals": intervals, "starts": size, "cells": cells.reshape(shape)}, osc)
