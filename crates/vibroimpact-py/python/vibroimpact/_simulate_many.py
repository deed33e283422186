"""Simulation of many motions: their events, and their states at given times, at one phase and at one position."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core, _over
from vibroimpact._ask import State, System
from vibroimpact._axis import numbers
from vibroimpact._core import QuestionError
from vibroimpact._motion import names_of
from vibroimpact._machine import Machine
from vibroimpact._over import MachineOver, Over, Points
from vibroimpact._progress import Progress, watched
from vibroimpact._whole import SIMULATED, threads_of, whole

if TYPE_CHECKING:
    import xarray as xr

#: Kinds of events by their code.
_KINDS = {"impact": 0, "graze": 1, "stick": 2, "release": 3}


def simulate_many(
    system: "System | Points",
    *,
    over: "Points | None" = None,
    starts: "Points | None" = None,
    impacts: int | None = None,
    periods: float | None = None,
    time: float | None = None,
    at: ArrayLike | None = None,
    phase: float | None = None,
    position: float | Mapping[str, float] | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Follow many motions: their events, or their states where `at`, `phase` or `position` asks for them.

    Systems and starts are given as for `settle_many`. Rows of different lengths are filled up with nan. The result does not depend on
    the number of threads.

    Parameters
    ----------
    system : Oscillator, Machine, mapping, DataFrame or Dataset
        The system, or values of its parameters.
    over : mapping, DataFrame or Dataset
        Values of parameters instead of those of an oscillator; of the numbers of a machine by path.
    starts : mapping, DataFrame or Dataset
        Values of "x", "v" and "phase", of a machine of "q.NAME", "qdot.NAME" and "phase". Default: at rest, or on the stop, at
        phase 0; the start of the machine.
    impacts : int
        Stop after this number of impacts, of a machine of events, 1 to 1e7. Default: 100, or 1e6 with `periods` or `time`.
    periods : float
        Stop after this number of forcing periods, up to 1e9. Default for `phase` and `position`: 100.
    time : float
        Stop the events at this time, up to 1e10.
    at : array_like
        Times, 0 or more and rising: the states at these times, from the closed form of the flights. At the time of an event
        the state is that after it; while the last impacts of a chatter are summed, that of rest.
    phase : float
        A phase of the force, radians: the states at this phase, once in every period.
    position : float, or mapping
        A position between the stops: the states where the motion crosses it, upwards where the velocity is positive. Of a machine of
        several coordinates that of one of them: {"q.head": 0.1}.
    threads : int
        Number of threads; 0 for one per core.
    progress : bool or callable
        True for a progress bar, or a function called with the amounts done and in total.

    Returns
    -------
    xarray.Dataset
        Of events: `time`, `kind` (codes, which `ds.vibro.labels("kind")` converts to text), `event_phase`, `side`,
        `velocity_before` and `velocity_after`, with the dimension `event`; `count`, `end` and `end_time` of each motion.
        Of a machine: `time`, `kind`, `event_phase`, `stop` (codes), `speed`, and coordinates and velocities after the event
        by their paths.
        Of states: `time`, `position`, `velocity` and `force_phase`, with the dimension `time` for `at`, and `state`
        otherwise; of a machine coordinates and velocities by their paths.

    Examples
    --------
    >>> import numpy as np
    >>> from vibroimpact import Oscillator, simulate_many
    >>> osc = Oscillator(inverse_beta=1.8, gap=0.25, restitution=0.5)
    >>> ds = simulate_many(osc, starts={"x": [-1.0, 0.0], "v": 0.0}, impacts=20)
    >>> dict(ds.sizes), ds["time"].isel(sample=1, event=slice(3)).values.round(4).tolist()
    ({'sample': 2, 'event': 22}, [1.4598, 2.2409, 2.6025])
    >>> states = simulate_many(osc, starts={"x": [-1.0, 0.0]}, at=[0.0, 1.0])
    >>> states["position"].values[:, 0].tolist()
    [-1.0, 0.0]
    >>> import vibroimpact as vi
    >>> hammer = vi.Machine.named("two-mass-hammer")
    >>> strobes = hammer.simulate_many(over={"frequency": [1.1, 1.2]}, phase=0, periods=300).isel(state=-1)
    >>> strobes["q.head"].values.round(4).tolist()
    [-1.3879, -1.2446]
    >>> crossings = hammer.simulate_many(position={"q.head": 0.1}, periods=20)
    >>> crossings["q.head"].values[:3].round(12).tolist(), crossings["time"].values[:3].round(4).tolist()
    ([0.1, 0.1, 0.1], [1.3999, 4.1468, 7.6413])
    """
    given = [name for name, of in (("at", at), ("phase", phase), ("position", position)) if of is not None]
    if len(given) > 1:
        raise QuestionError(f"{given[0]} and {given[1]} are two questions\nhint: a call for each")
    for name, value, most in (("periods", periods, 1e9), ("time", time, 1e10)):
        if value is not None and not 0 < value <= most:
            raise QuestionError(f"{name} = {value} lies outside 0 < {name} <= {most:.0f}")
    for name, value in (("impacts", impacts), ("time", time)):
        if given and value is not None:
            raise QuestionError(f"{name} has no meaning with {given[0]}\nhint: periods limits the time")
    limit, threads = None if impacts is None else whole("impacts", impacts, SIMULATED, here=True), threads_of(threads)
    if at is not None and periods is not None:
        raise QuestionError("periods has no meaning with at\nhint: the last time limits the time")
    times = None if at is None else _times(at)
    turns = 100.0 if periods is None else float(periods)
    if phase is not None and turns < 1:
        raise QuestionError(f"periods = {periods} is less than one period, so there may be no state at the phase")
    strobes = None if phase is None else (_finite("phase", phase), math.floor(turns))
    of = system if isinstance(system, Machine) else None
    points: Over | MachineOver = _over.points(system, over, starts) if of is None else _over.machine_points(of, over, starts)  # type: ignore[arg-type]
    crossing = None if position is None else (*_place(points.osc if isinstance(points, Over) else points.machine, position), turns)
    section = times.tolist() if times is not None else strobes or crossing
    with watched(progress, "motions") as tell:
        if isinstance(points, MachineOver):
            asked = _asked(points)
            if section is None:
                return _events_of_machines(points, _core.simulate_machines(*asked, (limit, periods, time), threads, tell))
            return _states(points, times, _core.states_of_machines(*asked, section, threads, tell))
        common = (points.osc._file, points.columns, points.start)
        if section is None:
            return _events(points, _core.simulate_points(*common, (limit, periods, time), threads, tell))
        return _states(points, times, _core.states_of_points(*common, section, threads, tell))


def _place(system: System, position: float | Mapping[str, float]) -> tuple[str, float]:
    """The coordinate of a position, and its value."""
    names = names_of(system)[0]
    if not isinstance(position, Mapping):
        if len(names) > 1:
            raise QuestionError(f'position = {position} of which coordinate?\nhint: position={{"{names[0]}": {position}}}')
        position = {names[0]: position}
    if len(position) != 1 or not set(position) <= set(names):
        raise QuestionError(f"position is that of one coordinate; there are {', '.join(names)}")
    ((name, value),) = position.items()
    return name.removeprefix("q."), _finite("position", value)


def _finite(name: str, value: float) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise QuestionError(f"{name} = {number} is not a finite number")
    return number


def _times(at: ArrayLike) -> NDArray[np.float64]:
    times = np.atleast_1d(numbers("at", at))
    if times.ndim != 1 or times.size == 0:
        raise QuestionError(f"at of shape {times.shape} is no list of times")
    wrong = times[~(np.isfinite(times) & (times >= 0))]
    if len(wrong):
        raise QuestionError(f"at = {wrong[0]} is no time: times are finite and 0 or more")
    falls = np.flatnonzero(np.diff(times) < 0)
    if len(falls):
        k = falls[0]
        raise QuestionError(f"at falls from {times[k]} to {times[k + 1]}\nhint: numpy.sort")
    return times


def _variable(
    points: Over | MachineOver, values: NDArray[Any], further: tuple[str, int] | None, long_name: str, scale: str, unit: str = "1", **more: Any
) -> tuple[list[str], NDArray[Any], dict[str, Any]]:
    from vibroimpact import _many
    from vibroimpact._unit_names import described

    dims, of = _many.over_points(points, values, () if further is None else (further,))
    return dims, of, {**described(long_name, unit, scale), **more}


_TIME, _LENGTH, _VELOCITY = "1/omega_n", "F/k", "omega_n F/k"


def _flags(codes: dict[str, int]) -> dict[str, Any]:
    return {"flag_values": list(codes.values()), "flag_meanings": " ".join(codes)}


def _events(points: Over, found: dict[str, Any]) -> "xr.Dataset":
    """The Dataset of the events of motions."""
    from vibroimpact import _many

    event = ("event", found["room"])
    time, phase, before, after = found["real"].reshape(4, -1)
    ends = {name: code for code, name in enumerate(_core.end_reasons())}
    variables = {
        "time": _variable(points, time, event, "time of the event", _TIME),
        "kind": _variable(points, found["kind"], event, "kind of the event", "", **_flags(_KINDS)),
        "event_phase": _variable(points, phase, event, "phase of the force at the event", "", "rad"),
        "side": _variable(points, found["side"], event, "1 for the first stop, -1 for the second", ""),
        "velocity_before": _variable(points, before, event, "velocity before the impact", _VELOCITY),
        "velocity_after": _variable(points, after, event, "velocity after the impact", _VELOCITY),
        "count": _variable(points, found["count"], None, "number of events", ""),
        "end": _variable(points, found["end"], None, "why the list ends", "", **_flags(ends)),
        "end_time": _variable(points, found["end_time"], None, "time at which the list ends", _TIME),
    }
    # the further cells hold no events; without a copy
    used = {name: (dims, of[..., : found["width"]] if "event" in dims else of, attrs) for name, (dims, of, attrs) in variables.items()}
    return _many.dataset(points, "events of motions of an impact oscillator", used)


def _asked(points: MachineOver) -> tuple[_core.MachineFile, list[tuple[str, list[float]]], list[State]]:
    """The machine, the numbers that vary, and the start at each point."""
    positions, velocities = names_of(points.machine)
    columns = {name: values.tolist() for name, values in points.columns}
    count = len(points.columns[0][1])

    def column(name: str, value: float) -> list[float]:
        found: list[float] = columns.pop(name, [value] * count)
        return found

    q, qdot, phase = points.start
    rows = [np.array([column(name, of) for name, of in zip(names, values)]) for names, values in ((positions, q), (velocities, qdot))]
    phases = column("phase", phase)
    starts = [(rows[0][:, k].tolist(), rows[1][:, k].tolist(), phases[k]) for k in range(count)]
    return points.machine._file, list(columns.items()), starts


def _events_of_machines(points: MachineOver, found: dict[str, Any]) -> "xr.Dataset":
    """The Dataset of the events of motions of machines."""
    event, machine = ("event", found["width"]), points.machine
    events, stops = found["events"], machine.stops + machine.joints
    names, kinds, ends = ({name: code for code, name in enumerate(of)} for of in (stops, events["kinds"], found["ends"]))
    time, phase, speed, *states = events["real"]
    variables = {
        "time": _variable(points, time, event, "time of the event", "", ""),
        "kind": _variable(points, events["kind"], event, "kind of the event", "", **_flags(kinds)),
        "event_phase": _variable(points, phase, event, "phase of the forcing at the event", "", "rad"),
        "stop": _variable(points, events["stop"], event, "stop or joint of the event", "", **_flags(names)),
        "speed": _variable(points, speed, event, "speed of closing before the event", "", ""),
        "count": _variable(points, found["count"], None, "number of events", ""),
        "end": _variable(points, found["end"], None, "why the list ends", "", **_flags(ends)),
        "end_time": _variable(points, found["end_time"], None, "time at which the list ends", "", ""),
    }
    paths = [path for of in names_of(machine) for path in of]
    variables |= {path: _variable(points, values, event, f"{path} after the event", "", "") for path, values in zip(paths, states)}
    return _dataset_of_machines(points, variables, "events of motions")


def _states(
    points: Over | MachineOver, times: NDArray[np.float64] | None, found: tuple[int, list[NDArray[np.float64]]]
) -> "xr.Dataset":
    """The Dataset of states: at given times, or of a section."""
    from vibroimpact import _many
    from vibroimpact._unit_names import described

    width, (time, phase, *states) = found
    further = ("state" if times is None else "time", width)
    if isinstance(points, MachineOver):
        paths = [path for of in names_of(points.machine) for path in of]
        names, clock, forcing = [(path, path, ("", "")) for path in paths], ("", ""), "phase of the forcing"
    else:
        names = [("position", "position", (_LENGTH, "1")), ("velocity", "velocity", (_VELOCITY, "1"))]
        clock, forcing = (_TIME, "1"), "phase of the force"
    variables = {} if times is not None else {"time": _variable(points, time, further, "time since the start", *clock)}
    variables |= {name: _variable(points, of, further, words, *scale) for (name, words, scale), of in zip(names, states)}
    variables["force_phase"] = _variable(points, phase, further, forcing, "", "rad")
    title = "states of motions" if times is not None else "sections of motions"
    if isinstance(points, MachineOver):
        ds = _dataset_of_machines(points, variables, title)
    else:
        ds = _many.dataset(points, f"{title} of an impact oscillator", variables)
    at = {} if times is None else {"time": ("time", times, described("time since the start", clock[1], clock[0]))}
    whole: xr.Dataset = ds.assign_coords(at)
    return whole


def _dataset_of_machines(points: MachineOver, variables: dict[str, Any], title: str) -> "xr.Dataset":
    import xarray as xr

    from vibroimpact import _accessor  # registers ds.vibro

    # what varies has the name of a variable: it is that of the start
    starts = {name: f"start.{name}" for name in points.coords if name in variables}
    coords = {starts.get(name, name): of for name, of in points.coords.items()}
    attributes = {"title": f"{title}: {points.machine.title or 'a machine'}", "source": f"vibroimpact {_core.__version__}"}
    return xr.Dataset(variables, coords, attributes)
