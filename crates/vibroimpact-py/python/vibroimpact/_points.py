"""The points of an orbit diagram as a table, with the columns and rows of `vibro diagram --csv` and `vibro export`."""

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from vibroimpact import _core

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Kinds of motion by their codes.
_MOTIONS = np.array(["none", "impact", "stuck", "undecided"], dtype=object)
#: Kind of a point, and its stop, by its code; negative codes (second stop) index from the end.
_POINTS = np.array([None, "impact", "chatter", "chatter", "impact"], dtype=object)
_SIDES = np.array([None, "upper", "upper", "lower", "lower"], dtype=object)
#: The variable of each column of numbers.
_NUMBERS = {
    "velocity": {"phase": "impact_phase", "speed": "velocity"},
    "x": {"x": "x", "v": "v"},
    "speed": {"phase": "closing_phase", "speed": "speed"},
}


def shown(ds: "xr.Dataset") -> dict[str, str]:
    """The columns of numbers, each with its variable."""
    return {name: name for name in _line(ds)} | _numbers(ds)


def _line(ds: "xr.Dataset") -> list[str]:
    """The parameter that varies, and on a line the second parameter."""
    vary = str(ds["kind"].dims[1])
    return [vary, *(str(name) for name, of in ds.coords.items() if of.dims == (vary,) and name != vary)]


def _numbers(ds: "xr.Dataset") -> dict[str, str]:
    known = [numbers for name, numbers in _NUMBERS.items() if name in ds]
    # what is shown of a machine, by its path
    path = shown_path(ds)
    return known[0] if known else {path: path}


def shown_path(ds: "xr.Dataset") -> str:
    """The path of the coordinate, velocity or quantity that a diagram of a machine shows; empty if it shows none."""
    task = json.loads(ds.attrs.get("plan", "{}")).get("task", {})
    shown = str(task.get("diagram", {}).get("show", ""))
    return shown if shown in ds.data_vars and shown not in _NUMBERS else ""


def _stops(ds: "xr.Dataset") -> "np.ndarray[Any, Any]":
    """The names of the stops of the machine of a Dataset."""
    plan = json.loads(ds.attrs["plan"])
    file = {name: part for name, part in plan.items() if name not in ("version", "task", "tile")}
    return np.array(_core.MachineFile(json.dumps(file), str).names()[1], dtype=object)


def table(ds: "xr.Dataset") -> "pd.DataFrame":
    """A table with a row for each point, in the order of computation. A motion without points has one row without numbers."""
    import pandas as pd

    motion = ds["kind"].values
    runs, vary = map(str, ds["kind"].dims)
    values = ds[vary].values
    # row and column of each computed motion, in the order of the command
    if runs == "start":
        at, run = (places.ravel() for places in np.indices(motion.shape[::-1]))
        names = np.array([f"start {k + 1}" for k in range(len(motion))], dtype=object)
    else:
        ways = ds[runs].values
        rising = np.argsort(values, kind="stable")
        at = np.concatenate([rising if way > 0 else rising[::-1] for way in ways])
        run = np.repeat(np.arange(len(ways)), len(values))
        names = np.where(ways > 0, "up", "down").astype(object)
    there = motion[run, at] >= 0
    run, at = run[there], at[there]

    columns = _numbers(ds)
    points = {name: ds[of].values[run, at] for name, of in columns.items()}
    side = ds["side"].values[run, at] if "side" in ds else None
    known = ~np.isnan(points[next(iter(columns))]) if side is None else side != 0
    alone = ~known.any(axis=1)
    known[alone, 0] = True
    row, _ = np.nonzero(known)
    kind = _MOTIONS[motion[run, at]][row]
    out: dict[str, Any] = {name: ds[name].values[at][row] for name in _line(ds)}
    out |= {"sweep": names[run][row], "kind": kind}
    if side is not None:
        side = side[known]
        out["kind"] = np.where(side == 0, kind, _POINTS[side])
        out["stop"] = _SIDES[side]
    if "stop" in ds:
        # a motion without points has no stop
        stop = ds["stop"].values[run, at][known]
        out["stop"] = _stops(ds)[stop].astype(object)
        out["stop"][stop < 0] = None
    out.update({name: of[known] for name, of in points.items()})
    rows: pd.DataFrame = pd.DataFrame(out)
    return rows
