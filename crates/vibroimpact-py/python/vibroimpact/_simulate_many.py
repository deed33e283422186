"""Simulation of many motions: their events, and their states at given times, at one phase and at one position."""

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._ask import State, System
from vibroimpact._axis import numbers
from vibroimpact._core import QuestionError
from vibroimpact._many import Over, Points, dataset, over_points, points
from vibroimpact._motion import names_of
from vibroimpact._machine import Machine
from vibroimpact._progress import Progress, watched
from vibroimpact._unit_names import described
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
    over_all = points(system, over, starts)
    of, limits = over_all.system, (limit, periods, time)
    crossing = None if position is None else (*_place(of, position), turns)
    section = times.tolist() if times is not None else strobes or crossing
    with watched(progress, "motions") as tell:
        if isinstance(of, Machine):
            asked = _asked(over_all)
            if section is None:
                return _events(over_all, _core.simulate_machines(of._file, *asked, limits, threads, tell))
            return _states(over_all, times, _core.states_of_machines(of._file, *asked, section, threads, tell))
        if section is None:
            return _events(over_all, _core.simulate_points(of._file, over_all.columns, over_all.start, limits, threads, tell))
        return _states(over_all, times, _core.states_of_points(of._file, over_all.columns, over_all.start, section, threads, tell))


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


#: The scales of times, lengths and velocities of an oscillator, and their units; those of machines are their own.
_TIME, _LENGTH, _VELOCITY, _OWN = ("1/omega_n", "1"), ("F/k", "1"), ("omega_n F/k", "1"), ("", "")
#: No scale, of counts and angles.
_COUNT, _ANGLE = ("", "1"), ("", "rad")


class _Variables:
    """The variables of a Dataset, by name; those with a further dimension have `further`, its name and length."""

    def __init__(self, over: Over, further: tuple[str, int]) -> None:
        self.found: dict[str, Any] = {}
        self._over, self._further = over, further

    def add(
        self, name: str, values: NDArray[Any], words: str, of: tuple[str, str], codes: Mapping[str, int] | None = None, *, each: bool = True
    ) -> None:
        """A variable with its description; `each` tells whether it has a value for each event or state."""
        dims, array = over_points(self._over, values, (self._further,) if each else ())
        scale, unit = of
        flags = {} if codes is None else {"flag_values": list(codes.values()), "flag_meanings": " ".join(codes)}
        self.found[name] = (dims, array, {**described(words, unit, scale), **flags})


def _numbered(names: Iterable[str]) -> dict[str, int]:
    return {name: code for code, name in enumerate(names)}


def _title(over: Over, words: str) -> str:
    return f"{words}: {over.system.title or 'a machine'}" if isinstance(over.system, Machine) else f"{words} of an impact oscillator"


def _events(over: Over, found: dict[str, Any]) -> "xr.Dataset":
    """The Dataset of the events of motions."""
    machine = over.system if isinstance(over.system, Machine) else None
    if machine is None:
        time, phase, before, after = found["real"].reshape(4, -1)
        width, kind, kinds, ends, clock = found["room"], found["kind"], _KINDS, _core.end_reasons(), _TIME
    else:
        events = found["events"]
        time, phase, speed, *states = events["real"]
        width, kind, kinds, ends, clock = found["width"], events["kind"], _numbered(events["kinds"]), found["ends"], _OWN
    all_ = _Variables(over, ("event", width))
    all_.add("time", time, "time of the event", clock)
    all_.add("kind", kind, "kind of the event", _COUNT, kinds)
    all_.add("event_phase", phase, f"phase of the {'force' if machine is None else 'forcing'} at the event", _ANGLE)
    if machine is None:
        all_.add("side", found["side"], "1 for the first stop, -1 for the second", _COUNT)
        all_.add("velocity_before", before, "velocity before the impact", _VELOCITY)
        all_.add("velocity_after", after, "velocity after the impact", _VELOCITY)
    else:
        all_.add("stop", events["stop"], "stop or joint of the event", _COUNT, _numbered(machine.stops + machine.joints))
        all_.add("speed", speed, "speed of closing before the event", _OWN)
        for path, values in zip((path for of in names_of(machine) for path in of), states):
            all_.add(path, values, f"{path} after the event", _OWN)
    all_.add("count", found["count"], "number of events", _COUNT, each=False)
    all_.add("end", found["end"], "why the list ends", _COUNT, _numbered(ends), each=False)
    all_.add("end_time", found["end_time"], "time at which the list ends", clock, each=False)
    # the further cells hold no events; without a copy
    last = slice(None, found["width"])
    used = {name: (dims, of[..., last] if "event" in dims else of, attrs) for name, (dims, of, attrs) in all_.found.items()}
    return dataset(over, _title(over, "events of motions"), used)


def _asked(over: Over) -> tuple[list[tuple[str, list[float]]], list[State]]:
    """The numbers of a machine that vary, and the start at each point."""
    columns = {name: values.tolist() for name, values in over.columns}
    count = len(over.columns[0][1])

    def column(name: str, value: float) -> list[float]:
        found: list[float] = columns.pop(name, [value] * count)
        return found

    q, qdot, phase = over.start
    rows = [np.array([column(*of) for of in zip(names, values)]) for names, values in zip(names_of(over.system), (q, qdot))]
    phases = column("phase", phase)
    starts = [(rows[0][:, k].tolist(), rows[1][:, k].tolist(), phases[k]) for k in range(count)]
    return list(columns.items()), starts


def _states(over: Over, times: NDArray[np.float64] | None, found: tuple[int, list[NDArray[np.float64]]]) -> "xr.Dataset":
    """The Dataset of states: at given times, or of a section."""
    width, (time, phase, *states) = found
    all_ = _Variables(over, ("state" if times is None else "time", width))
    if isinstance(over.system, Machine):
        names = [(path, _OWN) for of in names_of(over.system) for path in of]
        clock, forcing = _OWN, "phase of the forcing"
    else:
        names, clock, forcing = [("position", _LENGTH), ("velocity", _VELOCITY)], _TIME, "phase of the force"
    if times is None:
        all_.add("time", time, "time since the start", clock)
    for (name, scale), values in zip(names, states):
        all_.add(name, values, name, scale)
    all_.add("force_phase", phase, forcing, _ANGLE)
    ds = dataset(over, _title(over, "states of motions" if times is not None else "sections of motions"), all_.found)
    at = {} if times is None else {"time": ("time", times, described("time since the start", clock[1], clock[0]))}
    whole: xr.Dataset = ds.assign_coords(at)
    return whole
