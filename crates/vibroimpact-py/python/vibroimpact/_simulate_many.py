"""Many motions: their events, and their states at given times, at one phase of the force and at one position."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core
from vibroimpact._arguments import Progress, numbers, threads_of, watched
from vibroimpact._core import QuestionError
from vibroimpact._machine import Machine
from vibroimpact._point_datasets import dataset
from vibroimpact._points import Over, Points, points
from vibroimpact._question import POINTS, document, finite, given_fields
from vibroimpact._stated import described
from vibroimpact._system import State, System, names_of

if TYPE_CHECKING:
    import xarray as xr

#: Kinds of events in the order of their codes.
_KINDS = ("impact", "graze", "stick", "release")


def simulate_many(
    system: "System | Points", *, over: "Points | None" = None, starts: "Points | None" = None,
    impacts: int | None = None, periods: float | None = None, time: float | None = None, at: ArrayLike | None = None,
    phase: float | None = None, position: float | Mapping[str, float] | None = None, threads: int = 0,
    progress: Progress = None,
) -> "xr.Dataset":
    """Follow many motions: their events, or their states where `at`, `phase` or `position` asks for them.

    Systems and starts are given as for `settle_many`. Rows of different lengths are filled up with nan.

    Parameters
    ----------
    periods : float
        The largest number of forcing periods, up to 1e9. Default for `phase` and `position`: 100.
    at : array_like
        Times, 0 or more and rising: the states at these times, from the closed form of the flights. At the time of an event
        the state is that after it; while the last impacts of a chatter are summed, that of rest.
    phase : float
        A phase of the force, radians: the states at this phase, once in every period.
    position : float, or mapping
        A position between the stops: the states where the motion crosses it, upwards where the velocity is positive. Of a machine of
        several coordinates that of one of them: {"q.head": 0.1}.

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
    sections = [name for name, of in (("at", at), ("phase", phase), ("position", position)) if of is not None]
    if len(sections) > 1:
        raise QuestionError(f"{sections[0]} and {sections[1]} are two questions\nhint: a call for each")
    for name, value in (("impacts", impacts), ("time", time)):
        if sections and value is not None:
            raise QuestionError(f"{name} has no meaning with {sections[0]}\nhint: periods limits the time")
    if at is not None and periods is not None:
        raise QuestionError("periods has no meaning with at\nhint: the last time limits the time")
    threads, times = threads_of(threads), None if at is None else _times(at)
    over_all = points(system, over, starts)
    of = over_all.system
    lengths = given_fields("simulate", of, {"impacts": impacts, "periods": periods, "time": time})
    finite(lengths, "simulate")
    turns, section = lengths.get("periods", 100.0), None if times is None else times.tolist()
    if phase is not None:
        finite(float(phase), "phase")
        if turns < 1:
            raise QuestionError(f"periods = {periods} is less than one period, so there may be no state at the phase")
        section = (float(phase), turns)
    elif position is not None:
        section = (*_place(of, position), turns)
    plan = json.dumps(lengths)
    with watched(progress, "motions") as tell:
        if isinstance(of, Machine):
            asked = _asked(over_all)
            if section is None:
                return _events(over_all, _core.simulate_machines(of._file, *asked, plan, threads, tell))
            return _states(over_all, times, _core.states_of_machines(of._file, *asked, section, threads, tell))
        if section is None:
            return _events(over_all, _core.simulate_points(of._file, over_all.columns, over_all.start, plan, threads, tell))
        return _states(over_all, times, _core.states_of_points(of._file, over_all.columns, over_all.start, section, threads, tell))



document(POINTS, simulate=[simulate_many])


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
    finite(float(value), "position")
    return name.removeprefix("q."), float(value)


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


def _variables(over: Over, further: Mapping[str, int], rows: Iterable[tuple[Any, ...]]) -> dict[str, Any]:
    """Variables over the points and further dimensions: each with its name, values, words, scale and unit, and codes, if it has some."""
    sizes, found = {**over.sizes, **further}, {}
    for name, values, words, (scale, unit), *codes in rows:
        flags = {"flag_values": list(codes[0].values()), "flag_meanings": " ".join(codes[0])} if codes else {}
        found[name] = (list(sizes), values.reshape(list(sizes.values())), {**described(words, unit, scale), **flags})
    return found


def _numbered(names: Iterable[str]) -> dict[str, int]:
    return {name: code for code, name in enumerate(names)}


def _title(over: Over, words: str) -> str:
    return f"{words}: {over.system.title or 'a machine'}" if isinstance(over.system, Machine) else f"{words} of an impact oscillator"


def _events(over: Over, found: dict[str, Any]) -> "xr.Dataset":
    """The Dataset of the events of motions."""
    own: list[tuple[Any, ...]]
    if isinstance(over.system, Machine):
        events, stops = found["events"], over.system.stops + over.system.joints
        time, phase, speed, *states = events["real"]
        room, kind, kinds, ends, clock, force = found["width"], events["kind"], events["kinds"], found["ends"], _OWN, "forcing"
        own = [
            ("stop", events["stop"], "stop or joint of the event", _COUNT, _numbered(stops)),
            ("speed", speed, "speed of closing before the event", _OWN),
        ]
        paths = [path for of in names_of(over.system) for path in of]
        own += [(path, values, f"{path} after the event", _OWN) for path, values in zip(paths, states)]
    else:
        time, phase, before, after = found["real"].reshape(4, -1)
        room, kind, kinds, ends, clock, force = found["room"], found["kind"], _KINDS, _core.end_reasons(), _TIME, "force"
        own = [
            ("side", found["side"], "1 for the first stop, -1 for the second", _COUNT),
            ("velocity_before", before, "velocity before the impact", _VELOCITY),
            ("velocity_after", after, "velocity after the impact", _VELOCITY),
        ]
    of_events = _variables(over, {"event": room}, [
        ("time", time, "time of the event", clock),
        ("kind", kind, "kind of the event", _COUNT, _numbered(kinds)),
        ("event_phase", phase, f"phase of the {force} at the event", _ANGLE),
        *own,
    ])
    # the further cells hold no events; without a copy
    shown = {name: (dims, of[..., : found["width"]], attrs) for name, (dims, of, attrs) in of_events.items()}
    of_motions = _variables(over, {}, [
        ("count", found["count"], "number of events", _COUNT),
        ("end", found["end"], "why the list ends", _COUNT, _numbered(ends)),
        ("end_time", found["end_time"], "time at which the list ends", clock),
    ])
    return dataset(over, _title(over, "events of motions"), shown | of_motions)


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
    if isinstance(over.system, Machine):
        names = [(path, _OWN) for of in names_of(over.system) for path in of]
        clock, forcing = _OWN, "phase of the forcing"
    else:
        names, clock, forcing = [("position", _LENGTH), ("velocity", _VELOCITY)], _TIME, "phase of the force"
    rows: list[tuple[Any, ...]] = [(name, values, name, scale) for (name, scale), values in zip(names, states)]
    rows.append(("force_phase", phase, forcing, _ANGLE))
    if times is None:
        rows.insert(0, ("time", time, "time since the start", clock))
        return dataset(over, _title(over, "sections of motions"), _variables(over, {"state": width}, rows))
    ds = dataset(over, _title(over, "states of motions"), _variables(over, {"time": width}, rows))
    whole: xr.Dataset = ds.assign_coords(time=("time", times, described("time since the start", clock[1], clock[0])))
    return whole
