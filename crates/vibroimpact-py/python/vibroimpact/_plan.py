"""A plan: everything on which a study depends, and nothing else."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex

from vibroimpact import _core
from vibroimpact._arguments import BLOCKS, BUDGET, SHARD, TILE, Budget, maybe, names, seconds, threads_of, whole
from vibroimpact._json import read
from vibroimpact._machine import Machine
from vibroimpact._oscillator import Oscillator
from vibroimpact._points import Points, points
from vibroimpact._sample import Sample
from vibroimpact._system import Start, System

if TYPE_CHECKING:
    from vibroimpact import _grids


@dataclass(frozen=True, slots=True)
class Estimate:
    """What a study will cost."""

    #: Total numbers of points and tiles.
    points: int
    tiles: int
    #: Number of points that were computed for the estimate, and the processor time that they took.
    points_sampled: int
    seconds_sampled: float
    #: Expected processor time, and its interval of 90 % from resampling.
    processor_seconds: float
    processor_seconds_interval: tuple[float, float]
    #: Number of threads, and the expected time of a run with them.
    threads: int
    seconds: float
    #: Number of files or objects of the store, without the tables of a basin.
    files: int
    #: Expected size of the store, and the size of all numbers without compression.
    bytes: int
    bytes_raw: int
    #: Approximate memory of a run.
    memory_bytes: int


@dataclass(frozen=True, repr=False, slots=True)
class Plan:
    """A checked plan: a system and a task. It can be run on any machine, stored, and run again from its results.

    The command, a TOML file and Python build the same plans. The plans of this class fill a grid. They are made by `map`,
    `basin`, `samples`, `diagram`, `lyapunov` and `attractors`, or read from a file by `read`.

    Attributes
    ----------
    json : str
        The plan in the form in which it is stored. The argument may be JSON or TOML.
    hash : str
        An identifier of its content.
    title : str
        A title in words.
    points : int
        Number of points of its grid.

    Examples
    --------
    >>> from vibroimpact import Oscillator, Plan
    >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    >>> plan = Plan.basin(osc, {"x": "-4:0.75:100", "v": "-4:4:80"})
    >>> plan
    <Plan: motions an impact oscillator settles into over x, v; 8000 points>
    >>> plan == Plan(plan.json)
    True
    """

    json: str
    hash: str = field(init=False, compare=False)
    title: str = field(init=False, compare=False)
    points: int = field(init=False, compare=False)

    def __post_init__(self) -> None:
        self._set(_core.checked_plan(self.json))

    def _set(self, found: tuple[str, str, str, int]) -> None:
        for name, value in zip(("json", "hash", "title", "points"), found):
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        return f"<Plan: {self.title}; {self.points} points>"

    def to_dict(self) -> dict[str, Any]:
        """The fields of the plan."""
        return read(self.json)

    def with_tiles(self, tile: int | None = None, shard: int | None = None) -> "Plan":
        """The same plan with other sizes of its store.

        Parameters
        ----------
        tile : int
            Points of a tile along each axis; None for the default of the task.
        shard : int
            Tiles of a shard, which is one file for each field, along each axis; 1 for no shards. By default, stores of more than
            4096 tiles have shards.

        Examples
        --------
        >>> from vibroimpact import Oscillator, Plan
        >>> plan = Plan.map(Oscillator(beta=0.8, gap=1, restitution=0.5), {"gap": "0:2:300", "beta": "0.5:2:300"})
        >>> plan.with_tiles(tile=10, shard=5).to_dict()["shard"]
        5
        """
        sizes = {"tile": maybe("tile", tile, TILE), "shard": maybe("shard", shard, SHARD)}
        kept = {name: of for name, of in self.to_dict().items() if name not in sizes}
        return Plan(json.dumps(kept | {name: size for name, size in sizes.items() if size is not None}))

    def estimate(self, *, sample: int = 64, budget: Budget = "30s", threads: int = 0) -> "Estimate":
        """What the study will cost: processor time, time, files, bytes and memory. Nothing is written.

        Parameters
        ----------
        sample : int
            Number of blocks of points that are computed and timed: single points, tiles of a refined study, 256 starts of a
            basin of one system. They are spread evenly over the grid and always the same.
        budget : float or str
            Time after which the sample ends.
        threads : int
            Number of threads of the sample and of the run; 0 for one per core.

        Examples
        --------
        >>> from vibroimpact import Oscillator, Plan
        >>> osc = Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
        >>> cost = Plan.basin(osc, {"x": "-4:0.75:200", "v": "-4:4:100"}).estimate(sample=8, threads=2)
        >>> low, high = cost.processor_seconds_interval
        >>> cost.points, cost.threads, 0 < low <= cost.processor_seconds <= high
        (20000, 2, True)
        """
        blocks, threads = whole("sample", sample, BLOCKS, here=True), threads_of(threads)
        found = json.loads(_core.estimate_plan(self.json, blocks, seconds("budget", budget), threads))
        low, high = found.pop("processor_seconds_interval")
        return Estimate(**found, processor_seconds_interval=(low, high))

    @classmethod
    def read(cls, path: str | PathLike[str]) -> "Plan":
        """Read a plan from a .toml or .json file."""
        file = Path(path)
        try:
            return cls(file.read_text("utf-8"))
        except _core.QuestionError as error:
            raise _core.QuestionError(f"`{file}`: {error}") from None

    if TYPE_CHECKING:
        map = staticmethod(_grids.plan_map)
        basin = staticmethod(_grids.plan_basin)
        diagram = staticmethod(_grids.plan_diagram)
        lyapunov = staticmethod(_grids.plan_lyapunov)
        attractors = staticmethod(_grids.plan_attractors)

    @staticmethod
    def samples(
        system: "System | Points", *, over: "Points | None" = None, starts: "Points | None" = None,
        fields: Sequence[str] = (), transient: bool = False, impacts: int | None = None, tile: int | None = None,
    ) -> "Plan":
        """A plan for the motions at points of systems and starts; the arguments are those of `settle_many`.

        The plan of a `Sample` keeps how its points are drawn; that of arrays keeps them.
        """
        all_given: dict[str, Any] = {"system": system, "over": over, "starts": starts}
        drawn = {name: of for name, of in all_given.items() if isinstance(of, Sample)}
        if len(drawn) > 1:
            raise _core.QuestionError(f"{' and '.join(drawn)} are two samples\nhint: one sample of all that varies")
        asked: dict[str, Any] = {name: of.low() if isinstance(of, Sample) else of for name, of in all_given.items()}
        all_ = points(*asked.values())
        if drawn:
            if all_.sizes:
                raise _core.QuestionError("a sample and arrays are two sets of points\nhint: the arrays of the sample, dict(sample)")
            of_points: dict[str, Any] = {"drawn": next(iter(drawn.values())).to_dict()}
            varied = set(next(iter(drawn.values())))
        else:
            of_points = {"listed": [{"vary": name, "values": of.tolist()} for name, of in all_.columns]}
            varied = {name for name, _ in all_.columns}
        task = {"points": of_points, "impacts": maybe("impacts", impacts, BUDGET), "fields": names(fields)}
        if isinstance(all_.system, Machine):
            if transient:
                raise _core.QuestionError("transient counts the impacts of an oscillator")
            return made(all_.system, "settle_many", task, tile, Start(all_.system, None, None, *all_.start))
        start = {name: of for name, of in zip(("x", "v", "phase"), all_.start) if name not in varied}
        task |= {
            "start": {name: of for name, of in start.items() if of is not None},
            "transient": True if transient else None,
        }
        return made(all_.system, "basin", task, tile, Start(all_.system))


def made(system: System, task: str, fields: Mapping[str, Any], tile: SupportsIndex | None, start: Start) -> Plan:
    """The plan of a task with these fields, of which None are absent."""
    asked = json.dumps({task: {name: of for name, of in fields.items() if of is not None}})
    found = _core.plan_of(system._file, start.of_machine, asked, maybe("tile", tile, TILE))
    if isinstance(system, Oscillator) and system.units is not None:
        # the numbers of the plan are nondimensional; its results can be converted with these units
        return Plan(json.dumps({**json.loads(found[0]), "units": asdict(system.units)}))
    plan = object.__new__(Plan)
    plan._set(found)
    return plan
