"""Machines of several coordinates with stops and friction joints, and their motions event by event."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact import _core, _machine_answers, _margins
from vibroimpact._axis import beside
from vibroimpact._core import QuestionError
from vibroimpact._machine_answers import (
    MachineAttractors,
    MachineAxes,
    MachineBasin,
    MachineBranch,
    MachineCurve,
    MachineLyapunov,
    MachineMap,
    MachineOrbits,
    MachineSettled,
)
from vibroimpact._margins import Margins
from vibroimpact._progress import Progress, watched
from vibroimpact._result import Result
from vibroimpact._whole import (
    BRANCH,
    BUDGET,
    FOLLOW,
    NUMBER,
    POINT_STARTS,
    SECTION,
    SEED,
    SIMULATED,
    STARTS,
    TRANSIENT,
    maybe,
    whole,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_Floats = NDArray[np.float64]
_Part = Mapping[str, Any]


def _plain(value: Any, path: str) -> Any:
    """Lists and numbers of Python for arrays and numbers of numpy; absent parts are left out. Paths are those of a file."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        raise QuestionError(f"{path}: {value} is not a finite number")
    if isinstance(value, Mapping):
        inner = {str(name): (part, f"{path}.{name}" if path else str(name)) for name, part in value.items()}
        return {name: _plain(part, where.removeprefix("machine.")) for name, (part, where) in inner.items()
                if part is not None}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(part, path) for part in value]
    return value


def _parts(parts: "Sequence[_Part] | Mapping[str, _Part] | None") -> list[_Part] | None:
    """A list of parts with names, from such a list or from a dict of parts by name."""
    if isinstance(parts, Mapping):
        return [{"name": name, **part} for name, part in parts.items()]
    return None if parts is None else list(parts)


def _vector(values: ArrayLike | None) -> list[float] | None:
    return None if values is None else np.atleast_1d(np.asarray(values, dtype=float)).tolist()


def _no_files(name: str) -> str:
    raise QuestionError("there is no folder to look in")


class Machine:
    """A linear structure with forces, rigid and compliant stops, and friction joints.

    M q'' + C q' + K q = constant + harmonics of the forcing + contact and friction forces

    All arguments are fields of the table `[machine]` of a machine file (docs/machines.md); arrays of numpy and numbers
    may be given, and expressions of `parameters` as texts. A machine is a value: `set` returns another one.

    Parameters
    ----------
    coordinates : list of str
        Names of the coordinates. Not needed with `bodies` or `modes`.
    mass, damping, stiffness : array
        Symmetric matrices, or the numbers on their diagonals.
    bodies : dict of numbers
        Masses of bodies by name, instead of `coordinates` and `mass`.
    links : list of dicts
        Springs and dampers: `{"between": ["a", "ground"], "stiffness": 1, "damping": 0.1}`.
    modes : list of dicts
        Modes of vibration: `{"frequency": 3, "damping_ratio": 0.01, "shape": {"tip": 2}}`.
    modal_damping : array
        Damping ratios of the modes of the matrices, instead of `damping`.
    constant : array or dict
        Constant force on each coordinate.
    frequency, frequency_hz : float
        Frequency of the forcing, in radians or in periods per unit of time.
    forces : list of dicts
        Harmonics of the force: `{"order": 1, "cos": [0, 1], "sin": [0, 0]}`; or `"at"` and one number.
    stops : list of dicts, or dict of dicts
        `{"name": "wall", "direction": [1, 0], "gap": 1, "restitution": 0.8}`; or with `stiffness`, `damping`, `preload`.
    joints : list of dicts, or dict of dicts
        Friction joints: `{"name": "guide", "direction": [0, 1], "sliding": 0.2, "static": 0.3}`.
    parameters : dict of float
        Numbers that expressions use.
    start : dict
        Where motions start if nothing else is asked: `{"q": [...], "qdot": [...], "phase": 0}`, or a whole state.
    title : str
        A title in a few words.

    Examples
    --------
    >>> import vibroimpact as vi
    >>> machine = vi.Machine(
    ...     coordinates=["body", "shoe"], mass=[1, 1], stiffness=[[1, -1], [-1, 2]],
    ...     frequency=0.66, forces=[{"at": "shoe", "cos": 0.1}],
    ...     stops={"wall": {"at": "body", "gap": 0.1, "restitution": 0.8}},
    ... )
    >>> machine
    <Machine of 2 coordinates: body, shoe; stops: wall>
    >>> machine.number("stop.wall.gap"), machine.set({"stop.wall.gap": 0.2}).number("stop.wall.gap")
    (0.1, 0.2)
    >>> motion = machine.simulate(impacts=3)
    >>> motion.kind.tolist(), motion.stop.tolist()
    (['impact', 'impact', 'impact'], ['wall', 'wall', 'wall'])
    """

    __slots__ = ("_file",)
    _file: _core.MachineFile

    def __init__(
        self,
        *,
        coordinates: Sequence[str] | None = None,
        mass: ArrayLike | None = None,
        damping: ArrayLike | None = None,
        stiffness: ArrayLike | None = None,
        bodies: Mapping[str, Any] | None = None,
        links: Sequence[_Part] | None = None,
        modes: Sequence[_Part] | None = None,
        modal_damping: ArrayLike | None = None,
        constant: Any = None,
        frequency: float | str | None = None,
        frequency_hz: float | str | None = None,
        forces: Sequence[_Part] | None = None,
        stops: Sequence[_Part] | Mapping[str, _Part] | None = None,
        joints: Sequence[_Part] | Mapping[str, _Part] | None = None,
        parameters: Mapping[str, float] | None = None,
        start: _Part | None = None,
        title: str | None = None,
    ) -> None:
        table = {
            "coordinates": coordinates, "bodies": bodies, "mass": mass, "damping": damping, "stiffness": stiffness,
            "modal_damping": modal_damping, "constant": constant, "frequency": frequency, "frequency_hz": frequency_hz,
            "mode": modes, "link": links, "force": forces, "stop": _parts(stops), "friction": _parts(joints),
        }
        whole = {"title": title, "parameters": parameters, "start": start, "machine": table}
        self._file = _core.MachineFile(json.dumps(_plain(whole, "")), _no_files)

    @classmethod
    def _of(cls, file: _core.MachineFile) -> "Machine":
        made = cls.__new__(cls)
        made._file = file
        return made

    @classmethod
    def named(cls, name: str) -> "Machine":
        """The machine of this name in the catalogue, as `vibro machine list` lists them.

        >>> import vibroimpact as vi
        >>> vi.Machine.named("two-mass-hammer").coordinates
        ('frame', 'head')
        """
        return cls._of(_core.MachineFile.named(name))

    @classmethod
    def from_toml(cls, source: str | PathLike[str]) -> "Machine":
        """The machine of a machine file: its text, or the path of the file. Text has a line `[machine]`.

        Files that it names, such as tables of modes, are read beside the file.
        """
        if isinstance(source, str) and "[machine" in source:
            return cls._of(_core.MachineFile(source, _no_files))
        path = Path(source)
        return cls._of(_core.MachineFile(path.read_text(), lambda name: (path.parent / name).read_text()))

    def set(self, changes: Mapping[str, float] | None = None, /, **parameters: float) -> "Machine":
        """The same machine with other numbers, by their paths; parameters may be given as keywords.

        >>> import vibroimpact as vi
        >>> vi.Machine.named("two-mass-hammer").set({"stop.anvil.restitution": 0.5}, b=0.1).number("stop.anvil.gap")
        0.1
        """
        given = {**(changes or {}), **parameters}
        return self._of(self._file.with_numbers([(path, float(value)) for path, value in given.items()]))

    def starting(self, state: Mapping[str, Any]) -> "Machine":
        """The same machine with another start: a state with its contacts, such as `MachineSimulation.state` and
        `MachineMotion.whole_state` return. A motion that goes on from the state of an event is the motion, to the last bit.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> machine = vi.Machine.named("two-mass-hammer")
        >>> motion = machine.simulate(impacts=6)
        >>> again = machine.starting(motion.state(2)).simulate(impacts=3)
        >>> bool((again.q == motion.q[3:]).all() and (again.qdot == motion.qdot[3:]).all())
        True
        """
        fields = ("q", "qdot", "phase", "contacts", "exact")
        return self._of(self._file.starting(json.dumps({name: state[name] for name in fields if name in state})))

    def number(self, path: str) -> float:
        """The number at a path, such as "stop.wall.gap"."""
        return self._file.number(path)

    @property
    def paths(self) -> list[str]:
        """The paths of all numbers: parameters, those of the file, and those of its expansion that are not zero."""
        return self._file.paths()

    def toml(self, *, expanded: bool = False) -> str:
        """The machine file, as it is written, or expanded to matrices and directions. It reads as the same machine."""
        return self._file.toml(expanded)

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The names of the coordinates."""
        return tuple(self._file.names()[0])

    @property
    def stops(self) -> tuple[str, ...]:
        """The names of the stops."""
        return tuple(self._file.names()[1])

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the friction joints."""
        return tuple(self._file.names()[2])

    @property
    def title(self) -> str | None:
        """The title, if it has one."""
        return self._file.texts()[0]

    @property
    def source(self) -> str | None:
        """Where the machine comes from, if it is said."""
        return self._file.texts()[1]

    @property
    def summary(self) -> str | None:
        """What it is, if it is said."""
        return self._file.texts()[2]

    @property
    def period(self) -> float | None:
        """The period of the forcing; None without forcing."""
        return self._file.period()

    def __repr__(self) -> str:
        coordinates, stops, joints = self._file.names()
        count = "1 coordinate" if len(coordinates) == 1 else f"{len(coordinates)} coordinates"
        shown = ", ".join(coordinates[:6]) + (", ..." if len(coordinates) > 6 else "")
        of = "".join(f"; {what}: {', '.join(names)}" for what, names in (("stops", stops), ("joints", joints)) if names)
        return f"<Machine of {count}: {shown}{of}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Machine) and self._file == other._file

    def __hash__(self) -> int:
        return hash(self.toml())

    def __reduce__(self) -> tuple[Any, ...]:
        return Machine.from_toml, (self.toml(),)

    def simulate(
        self,
        *,
        q: ArrayLike | None = None,
        qdot: ArrayLike | None = None,
        phase: float | None = None,
        impacts: int | None = None,
        periods: float | None = None,
        progress: Progress = None,
    ) -> "MachineSimulation":
        """Follow a motion event by event.

        Parameters
        ----------
        q, qdot : array
            Coordinates and velocities at the start. Default: those of `start`, or 0.
        phase : float
            Phase of the forcing at the start, radians. Default: likewise.
        impacts : int
            Stop after this number of events, 1 to 1e7. Default: 100, or 1e6 with `periods`.
        periods : float
            Stop after this number of forcing periods, up to 1e9.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> motion = vi.Machine.named("sdnd101").simulate(impacts=2)
        >>> motion.kind.tolist(), motion.time.round(6).tolist()
        (['close', 'open'], [0.0, 0.03126])
        >>> wave = motion.waveform(1e-4)
        >>> float(wave.force[:, 0].max().round())          # 9950.37 N in closed form
        9950.0
        """
        start = self.start_of(q, qdot, phase)
        with watched(progress, "events") as tell:
            fields = _core.simulate_machine(self._file, start, maybe("impacts", impacts, SIMULATED), periods, tell)
        kind, stop = (np.array(fields.pop(name), dtype=np.str_) for name in ("kind", "stop"))
        with_ = tuple(tuple(names) for names in fields.pop("with_"))
        tie = tuple(fields.pop("tie"))
        return MachineSimulation(machine=self, start=start, kind=kind, stop=stop, with_=with_, tie=tie, **fields)

    def start_of(
        self, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None
    ) -> tuple[list[float], list[float], float]:
        """Coordinates, velocities and phase of a start: what is given, and else those of the table `start`, or 0."""
        return self._file.start(_vector(q), _vector(qdot), None if phase is None else float(phase))

    def _answered(
        self, task: _Part, start: tuple[ArrayLike | None, ArrayLike | None, float | None], progress: Progress, what: str
    ) -> dict[str, Any]:
        """The answer of the command for a task of one motion."""
        return _machine_answers.answered(self._file, self.start_of(*start), task, progress=progress, what=what)

    def _ask(
        self, task: _Part, start: tuple[ArrayLike | None, ArrayLike | None, float | None], progress: Progress, what: str
    ) -> dict[str, Any]:
        """Its JSON object."""
        found: dict[str, Any] = self._answered(task, start, progress, what)["object"]
        return found

    def settle(
        self, *, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None,
        impacts: int | None = None, progress: Progress = None,
    ) -> MachineSettled:
        """Decide what a motion settles into: a cycle, chaos, no further event, or rest on a stop.

        Parameters
        ----------
        q, qdot, phase : array, array, float
            Start: coordinates, velocities and phase of the forcing. Default: those of `start`, or 0.
        impacts : int
            Budget of events, 1 to 1e6. A motion that has not settled by then is undecided. Default: 20 000.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> found = vi.Machine.named("two-mass-hammer").settle()
        >>> found.motion, found.motion.counts, len(found.motion.multipliers)
        (<MachineMotion 1/1, stable>, {'anvil': 1}, 4)
        """
        task = {"settle": {"impacts": maybe("impacts", impacts, BUDGET)}}
        return _machine_answers.settled(self._ask(task, (q, qdot, phase), progress, "motions"), self)

    def attractors(
        self, starts: int = 200, *, seed: int = 1, impacts: int | None = None, threads: int = 0,
        progress: Progress = None,
    ) -> MachineAttractors:
        """Find the steady motions to which scattered starts lead, and their shares of the starts.

        Parameters
        ----------
        starts : int
            Number of starts, 1 to 1e9.
        seed : int
            Seed of the sequence of starts.
        impacts : int
            Budget of events for each start, 1 to 1e6. Default: 20 000.
        threads : int
            Number of threads; 0 for one per core. The result does not depend on it.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> vi.Machine.named("two-mass-hammer").attractors(20)
        <MachineAttractors of 20 starts: 1/1 100 %>
        """
        starts = whole("starts", starts, STARTS)
        budget = maybe("impacts", impacts, BUDGET)
        task = {"attractors": {"starts": starts, "seed": whole("seed", seed, SEED), "impacts": budget}}
        found = _machine_answers.ask(self._file, self.start_of(), task, starts, threads, progress)
        return _machine_answers.attractors(found, self)

    def lyapunov(
        self, *, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None,
        impacts: int | None = None, transient: int | None = None, points: int | None = None, progress: Progress = None,
    ) -> MachineLyapunov:
        """All Lyapunov exponents of a motion, per unit of time, with error bars, and sections of its attractor.

        Parameters
        ----------
        q, qdot, phase : array, array, float
            Start: coordinates, velocities and phase of the forcing. Default: those of `start`, or 0.
        impacts : int
            Events to measure over, 25 to 1e7. Default: 20 000.
        transient : int
            Events to pass before; for the sections closings and forcing periods. Default: 1000.
        points : int
            Number of points of each section of the attractor, 1 to 100 000; by default no sections.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> found = vi.Machine.named("two-mass-hammer").lyapunov(impacts=2000)
        >>> len(found.exponents), found.exponents[0].value < 0, found.motion.label
        (4, True, '1/1')
        """
        task = {"lyapunov": {
            "impacts": maybe("impacts", impacts, SIMULATED), "transient": maybe("transient", transient, TRANSIENT),
            "points": maybe("points", points, SECTION),
        }}
        found = self._answered(task, (q, qdot, phase), progress, "motions")
        return _machine_answers.lyapunov(found["object"], self, found["section"])

    def orbit(self, label: str, *, progress: Progress = None) -> MachineOrbits:
        """The orbits with a label m/n, or m/T without forcing, stable or not, from many guesses; m counts closings of all stops.
        `progress` as for `branch`.

        >>> import vibroimpact as vi
        >>> vi.Machine.named("two-mass-hammer").orbit("1/1")[-1].stable
        True
        """
        task = {"orbit": {"label": label}}
        return _machine_answers.orbits(self._ask(task, (None, None, None), progress, "searches"), self)

    def branch(
        self, vary: str, to: float, *, label: str | None = None, also: Mapping[str, float] | None = None,
        orbit: int | None = None, follow: int = 0, points: int = 5000,
        q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
    ) -> MachineBranch:
        """Follow an orbit in one number of the machine through folds and grazing, from its value to another one.

        Parameters
        ----------
        vary : str
            The path of the number, such as "frequency" or "stop.wall.gap".
        to : float
            The other end of its range.
        label : str
            The label m/n, or m/T without forcing, of the orbit at the machine. Default: that of the motion from the start.
        also : dict
            A second number that varies in proportion to the first, and its value where the first is `to`:
            {"stop.anvil.gap": 0.6}. Its value at the beginning is that of the machine.
        orbit : int
            Number of the orbit, counted from 1 in the order of `orbit`. Default: the stable one, or else the fastest.
        follow : int
            Maximum number of branches, 0 to 100, to follow from flips, with twice the period, and from branch points.
        points : int
            The largest number of points of each branch, 2 to 100 000.
        q, qdot, phase : array, array, float
            Start: coordinates, velocities and phase of the forcing. Default: those of `start`, or 0.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> found = vi.Machine.named("two-mass-hammer").branch("frequency", 1.05)
        >>> found.event_kind.tolist(), found.event_stop.tolist()
        (['grazing', 'fold', 'end of range'], ['anvil', '', ''])
        """
        second = beside(also)
        task = {"branch": {
            "label": label, "orbit": maybe("orbit", orbit, NUMBER), "vary": vary, "to": float(to),
            "also": second and {"path": second[0], "to": float(second[1])},
            "follow": whole("follow", follow, FOLLOW), "points": whole("points", points, BRANCH),
        }}
        return _machine_answers.branch(self._ask(task, (q, qdot, phase), progress, "branches"), self)

    def curve(
        self, kind: str, vary: Mapping[str, tuple[float, float]], *, label: str | None = None, orbit: int | None = None,
        event: int | None = None, points: int = 5000,
        q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None, progress: Progress = None,
    ) -> MachineCurve:
        """Follow an event of an orbit in a plane of two numbers of the machine.

        The orbit is followed in the first number to both ends of its range, while it keeps its label. From an event of the
        kind the curve is followed in both directions.

        Parameters
        ----------
        kind : str
            "fold", "flip", "torus", "grazing", "corner", "sticking" or "holding". The last two are the begin and the end of
            sticking on a stop and of holding of a friction joint.
        vary : dict
            Two paths, each with its range (a, b). Both ranges contain the values of the machine.
        label : str
            The label m/n, or m/T without forcing, of the orbit at the machine. Default: that of the motion from the start.
        orbit : int
            Number of the orbit, counted from 1 in the order of `orbit`. Default: the stable one, or else the fastest.
        event : int
            Which of several events, counted from 1 from small values to large. Default: the nearest.
        points : int
            The largest number of points in each direction, 2 to 100 000.
        q, qdot, phase : array, array, float
            Start: coordinates, velocities and phase of the forcing. Default: those of `start`, or 0.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> hammer = vi.Machine.named("two-mass-hammer")
        >>> found = hammer.curve("grazing", {"frequency": (0.9, 1.3), "b": (0.4, 0.6)})
        >>> found.kind, found.event_kind.tolist()
        ('grazing', ['end of box', 'end of box'])
        """
        if not isinstance(vary, Mapping) or len(vary) != 2:
            raise TypeError("a curve varies two numbers: a dict of two paths, each with its range (a, b)")
        sides = []
        for path, ends in vary.items():
            try:
                first, last = (float(end) for end in ends)
            except (TypeError, ValueError):
                raise TypeError(f"the range of {path} is (a, b), not {ends!r}") from None
            sides.append({"path": path, "from": first, "to": last})
        task = {"curve": {
            "label": label, "orbit": maybe("orbit", orbit, NUMBER), "kind": kind, "vary": sides[0], "and": sides[1],
            "event": maybe("event", event, NUMBER), "points": whole("points", points, BRANCH),
        }}
        return _machine_answers.curve(self._ask(task, (q, qdot, phase), progress, "curves"))

    def margins(
        self, *, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None,
        label: str | None = None, vary: Sequence[str] | None = None, within: float = 2.0, progress: Progress = None,
    ) -> Margins:
        """Find how far a periodic motion is from the events that end or change it.

        The motion is followed in each number alone, up and down, to the nearest event: a fold, a flip, a grazing impact, the
        end of a rest.

        Parameters
        ----------
        q, qdot, phase : sequence, sequence, float
            The start, as in `simulate`.
        label : str
            "m/n" of the motion instead of a start: the stable orbit, or else the fastest one.
        vary : sequence of str
            The paths of the numbers that vary; by default the parameters of the file, and the numbers that are written as such
            and are not 0, without directions.
        within : float
            Events are looked for from each value divided by this number to the value times this number, above 1 and up to 100;
            a restitution from 0 to 1.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> vi.Machine.named("two-mass-hammer").margins(vary=["omega"])
        <Margins of 1/1, nearest grazing at omega 1.055>
        """
        if isinstance(vary, str):
            raise TypeError(f'vary = {vary!r} is not a list of paths, such as ["omega"]')
        task = {"margins": {"label": label, "vary": list(vary or []), "within": within}}
        found = self._ask(task, (q, qdot, phase), progress, "margins")
        return _margins.of_answer(found, self, _machine_answers.motion(found, self))

    def basin(
        self, axes: MachineAxes, *, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None,
        impacts: int | None = None, threads: int = 0, progress: Progress = None,
    ) -> MachineBasin:
        """Settle every start of a grid.

        Parameters
        ----------
        axes : dict
            One to four of "q.COORDINATE", "qdot.COORDINATE" and "phase", each with (a, b, n): n values from a to b.
        q, qdot, phase : array, array, float
            Start: coordinates, velocities and phase of the forcing. Default: those of `start`, or 0.
        impacts : int
            Budget of events for each start, 1 to 1e6. Default: 20 000.
        threads : int
            Number of threads; 0 for one per core. The result does not depend on it.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> found = vi.Machine.named("two-mass-hammer").basin({"q.head": (-1, 1, 5), "qdot.head": (-1, 1, 3)})
        >>> found.labels[:, 0].tolist()                     # the anvil is at 0.5
        ['1/1', '1/1', '1/1', '1/1', 'refused']
        >>> found.xarray().sel({"q.head": 0, "qdot.head": 1}).item()
        '1/1'
        """
        over = _machine_answers.spans(axes)
        task = {"basin": {"axes": over, "impacts": maybe("impacts", impacts, BUDGET)}}
        start, total = self.start_of(q, qdot, phase), _machine_answers.size(over)
        return _machine_answers.basin(_machine_answers.ask(self._file, start, task, total, threads, progress), self)

    def map(
        self, axes: MachineAxes, starts: int, *, seed: int = 1, impacts: int | None = None, threads: int = 0,
        progress: Progress = None,
    ) -> MachineMap:
        """Settle scattered starts at each point of a grid of numbers of the machine.

        Parameters
        ----------
        axes : dict
            One to four paths of numbers, each with (a, b, n): n values from a to b.
        starts : int
            Number of starts at each point.
        seed : int
            Seed of the sequence of starts.
        impacts : int
            Budget of events for each start, 1 to 1e6. Default: 20 000.
        threads : int
            Number of threads; 0 for one per core. The result does not depend on it.
        progress : bool or callable
            True for a progress bar, or a function called with the amounts done and in total; it stops the work by returning False.

        Examples
        --------
        >>> import vibroimpact as vi
        >>> found = vi.Machine.named("two-mass-hammer").map({"frequency": (0.8, 1.2, 3)}, starts=2)
        >>> found.labels[:, 0].tolist()
        ['3/1', '2/1', '1/1']
        """
        over, starts = _machine_answers.spans(axes), whole("starts", starts, POINT_STARTS)
        task = {"map": {"axes": over, "starts": starts, "seed": whole("seed", seed, SEED),
                        "impacts": maybe("impacts", impacts, BUDGET)}}
        total = _machine_answers.size(over)
        found = _machine_answers.answered(self._file, self.start_of(), task, total, threads, progress, "points")
        return _machine_answers.mapped(found["object"])


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineSimulation(Result):
    """The events of a motion of a machine as columns, and the reason why the list ends.

    Attributes
    ----------
    machine : Machine
        The machine.
    start : (list, list, float)
        Coordinates, velocities and phase of the start.
    kind : ndarray of str
        "impact", "close", "open", "stick", "release", "slip", "hold", "graze" or "collapse".
    stop : ndarray of str
        The name of the stop or joint.
    time, phase : ndarray
        Time and phase of each event; phases in radians in [0, 2 pi).
    speed : ndarray
        Speed of closing before the event; of an opening that of separation; of a slip the direction, 1 or -1.
    q, qdot : ndarray, events x coordinates
        Coordinates, and velocities after the event.
    with_ : tuple of tuples of str
        Other stops that take part at the same time.
    tie : tuple of bool
        Whether impacts at one time would lead elsewhere if one of the stops were struck first.
    end : str
        Why the list ends: "event_limit", "time_limit", "no_more_impacts", "stuck", "search_limit", "inconsistent" or
        "collapse".
    end_time : float
        The time at which the list ends.
    shown_until : float
        The time up to which a waveform is shown.
    plan : str
        The plan as JSON.
    """

    machine: Machine
    start: tuple[list[float], list[float], float]
    kind: NDArray[np.str_]
    stop: NDArray[np.str_]
    time: _Floats
    phase: _Floats
    speed: _Floats
    q: _Floats
    qdot: _Floats
    with_: tuple[tuple[str, ...], ...]
    tie: tuple[bool, ...]
    end: str
    end_time: float
    shown_until: float
    plan: str

    def __repr__(self) -> str:
        return f"<MachineSimulation of {len(self)} events, ends with {self.end} at time {self.end_time:.6g}>"

    def __len__(self) -> int:
        return len(self.time)

    def state(self, event: int = -1) -> dict[str, Any]:
        """The state from which the motion goes on after an event, the last by default: `q`, `qdot`, `phase`, what stops and
        joints do (`contacts`), and the digits that these leave out (`exact`). `Machine.starting` takes it.

        Parameters
        ----------
        event : int
            Number of the event, counted from 0, or from the end if it is negative.
        """
        number = range(len(self))[event]
        found: dict[str, Any] = json.loads(_core.machine_state(self.plan, number))
        return found

    def waveform(self, step: float | None = None, *, events: bool = False) -> "MachineWaveform":
        """The motion at equal steps of time, up to `shown_until`.

        Parameters
        ----------
        step : float
            Time between two points. Default: a thousandth of the whole time.
        events : bool
            Whether to add both sides of each event, at the same time, and the end.
        """
        step = self.shown_until / 1000 or 1.0 if step is None else float(step)
        fields = _core.machine_waveform(self.machine._file, self.start, self.shown_until, step, events)
        return MachineWaveform(machine=self.machine, **fields)

    def plot(self, axes: "Sequence[Axes] | None" = None) -> "NDArray[Any]":
        """Draw the coordinates over time with contacts and impacts, and below them the contact forces, if there are any.

        `axes` are one or two axes to draw into. Returns the axes.
        """
        from vibroimpact import _machine_figure

        return _machine_figure.draw(self, axes)

    def _table(self) -> dict[str, Any]:
        """One row for each event; coordinates and velocities by their paths."""
        columns = {name: getattr(self, name) for name in ("kind", "stop", "time", "phase", "speed")}
        return {**columns, **_by_name(self.machine, self.q, self.qdot)}

    def _draw(self, ax: Any) -> None:
        self.plot([ax])


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class MachineWaveform(Result):
    """A motion of a machine at equal steps of time.

    Attributes
    ----------
    machine : Machine
        The machine.
    time, phase : ndarray
        Time and phase of the forcing.
    q, qdot : ndarray, points x coordinates
        Coordinates and velocities.
    gap : ndarray, points x stops
        The gap of each stop; negative where a compliant stop is pushed in.
    force : ndarray, points x (stops and joints)
        The force of each stop, against its direction, and of each joint, against positive relative velocity. Forces of
        impacts are infinite and are not told.
    contact : ndarray of bool, points x stops
        Whether a stop is closed or rested on.
    """

    machine: Machine
    time: _Floats
    phase: _Floats
    q: _Floats
    qdot: _Floats
    gap: _Floats
    force: _Floats
    contact: NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<MachineWaveform of {len(self)} points>"

    def __len__(self) -> int:
        return len(self.time)

    def _table(self) -> dict[str, Any]:
        """One row for each point; coordinates, velocities, gaps and forces by their paths."""
        columns = {"time": self.time, "phase": self.phase, **_by_name(self.machine, self.q, self.qdot)}
        stops, contacts = self.machine.stops, self.machine.stops + self.machine.joints
        columns |= {f"gap.{name}": self.gap[:, k] for k, name in enumerate(stops)}
        return columns | {f"force.{name}": self.force[:, k] for k, name in enumerate(contacts)}


def _by_name(machine: Machine, q: _Floats, qdot: _Floats) -> dict[str, _Floats]:
    """Coordinates and velocities by their paths."""
    names = machine.coordinates
    return {f"q.{name}": q[:, k] for k, name in enumerate(names)} | {f"qdot.{name}": qdot[:, k] for k, name in enumerate(names)}
