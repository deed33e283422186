"""Machines of several coordinates with stops and friction joints, and their motions event by event."""

import json
import math
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._oscillator import Questions

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


class Machine(Questions):
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
        self, *, coordinates: Sequence[str] | None = None, mass: ArrayLike | None = None,
        damping: ArrayLike | None = None, stiffness: ArrayLike | None = None, bodies: Mapping[str, Any] | None = None,
        links: Sequence[_Part] | None = None, modes: Sequence[_Part] | None = None,
        modal_damping: ArrayLike | None = None, constant: Any = None, frequency: float | str | None = None,
        frequency_hz: float | str | None = None, forces: Sequence[_Part] | None = None,
        stops: Sequence[_Part] | Mapping[str, _Part] | None = None,
        joints: Sequence[_Part] | Mapping[str, _Part] | None = None, parameters: Mapping[str, float] | None = None,
        start: _Part | None = None, title: str | None = None,
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
        """The same machine with another start: a state with its contacts, such as `Simulation.state` returns and
        `Motion.state` is. A motion that goes on from the state of an event is the motion, to the last bit.

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

    def start_of(
        self, q: ArrayLike | None = None, qdot: ArrayLike | None = None, phase: float | None = None
    ) -> tuple[list[float], list[float], float]:
        """Coordinates, velocities and phase of a start: what is given, and else those of the table `start`, or 0."""
        return self._file.start(_vector(q), _vector(qdot), None if phase is None else float(phase))
