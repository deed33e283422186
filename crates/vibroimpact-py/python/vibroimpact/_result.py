"""What all results have in common: equality of their values, a table, and a small picture in a notebook."""

import copy
import json
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray
from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._documented import Attributes
from vibroimpact._json import read

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

Floats: TypeAlias = NDArray[np.float64]
N = TypeVar("N", bound=np.generic)
R = TypeVar("R")
V = TypeVar("V", bound="View")

#: Size of the picture in inches, and its dots per inch.
_SIZE, _DOTS = (5.6, 2.6), 80


def equal(a: object, b: object) -> bool:
    """Whether two values are equal; arrays and numbers are compared by value, and not-a-number equals itself."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        one, other = np.asarray(a), np.asarray(b)
        if one.shape != other.shape or one.dtype.kind != other.dtype.kind:
            return False
        return bool(np.array_equal(one, other, equal_nan=one.dtype.kind in "fc"))
    if isinstance(a, float) and isinstance(b, float):
        return a == b or (a != a and b != b)
    if type(a) is not type(b):
        return a == b
    if is_dataclass(a) and not isinstance(a, type):
        return all(equal(getattr(a, of.name), getattr(b, of.name)) for of in fields(a))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(equal(value, b[key]) for key, value in a.items())
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(map(equal, a, b))
    return a == b


class Result:
    """The base of all results."""

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        return equal(self, other) if type(self) is type(other) else NotImplemented

    def _table(self) -> dict[str, Any]:
        """The columns of the table of the result."""
        raise NotImplementedError

    def to_dataframe(self) -> "pd.DataFrame":
        """The result as a table of pandas: one row for each event, motion, point or value."""
        import pandas as pd

        rows: pd.DataFrame = pd.DataFrame(self._table())
        return rows

    def to_xarray(self) -> "xr.Dataset":
        """The table as a Dataset of xarray over its rows, with the plan as an attribute, if there is one."""
        import xarray as xr

        plan = {} if getattr(self, "plan", None) is None else {"plan": self.plan}  # type: ignore[attr-defined]
        columns = {name: ("row", np.asarray(values)) for name, values in self._table().items()}
        return xr.Dataset(columns, attrs={"source": f"vibroimpact {_core.__version__}", **plan})

    def _repr_html_(self) -> str:
        import html

        text = f"<pre>{html.escape(repr(self))}</pre>"
        picture = self._picture() if hasattr(self, "plot") else None
        return text if picture is None else f'{text}<img alt="{html.escape(repr(self))}" src="data:image/png;base64,{picture}">'

    def _picture(self) -> str | None:
        """The figure as a small PNG in base64; None for a result that has no figure."""
        import base64
        import io

        from matplotlib.figure import Figure

        figure = Figure(figsize=_SIZE, dpi=_DOTS, layout="constrained")
        try:
            self._draw(figure.subplots())
        except QuestionError:
            return None
        file = io.BytesIO()
        figure.savefig(file, format="png")
        return base64.b64encode(file.getvalue()).decode("ascii")

    def _draw(self, ax: Any) -> None:
        """Draw the picture into one axes; a quick one, where the figure takes long."""
        self.plot(ax)  # type: ignore[attr-defined]


class Made(Generic[R]):
    """An attribute of a view that a function makes of it when it is first used. `kind` is its type in documentation."""

    name: str

    def __init__(self, make: Callable[[Any], R], kind: str = "") -> None:
        self._make, self.kind = make, kind

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, view: Any, owner: object = None) -> R:
        found = self._make(view)
        view.__dict__[self.name] = found
        return found


def column(kind: type[N]) -> Made[NDArray[N]]:
    """One that is a column: the field of its name of each row of the view; nan where a row lacks it."""
    made: Made[NDArray[N]] = Made(
        lambda view: np.array([row.get(made.name, np.nan) for row in view._rows], dtype=kind), f"NDArray[np.{kind.__name__}]"
    )
    return made


def field(convert: Callable[[Any], R], path: str = "") -> Made[R]:
    """One that is a field of the object, or of an object in it, converted; it is named by its path."""

    def value(view: Any) -> R:
        of: Any = view._of
        for name in (path or made.name).split("."):
            of = None if of is None else of.get(name)
        return convert(of)

    made: Made[R] = Made(value, str(getattr(convert, "__annotations__", {}).get("return", "")))
    return made


def part(kind: type[V]) -> Made[V]:
    """One that is a view of an object in the object."""
    made: Made[V] = Made(lambda view: kind(view._of[made.name], view.system), kind.__name__)
    return made


def parts(kind: type[V]) -> Made[list[V]]:
    """One that is a list of views of the objects in a list."""
    made: Made[list[V]] = Made(lambda view: [kind(of, view.system) for of in view._of[made.name]], f"list of {kind.__name__}")
    return made


class View(Result):
    """An object, or a part of one, that the command prints for a system. Its attributes are the fields of the object; those that are
    declared and absent in it are None."""

    _declared: frozenset[str] = frozenset()
    #: Where the words of its attributes are: a command, and definitions in the schema of its answer.
    _schema: tuple[str, ...] = ()
    #: The system: an `Oscillator` or a `Machine`.
    system: Any

    def __init_subclass__(cls, schema: str = "") -> None:
        super().__init_subclass__()
        cls._declared = cls._declared | cls.__annotations__.keys()
        cls._schema = tuple(schema.split()) or cls._schema
        cls.__doc__ = Attributes(cls.__doc__ or "")  # type: ignore[assignment]

    def __init__(self, of: dict[str, Any], system: Any) -> None:
        self.__dict__["_of"], self.system = of, system

    #: The object, and the rows of its columns.
    _of: Made[dict[str, Any]]
    _rows: Made[list[dict[str, Any]]] = Made(lambda view: view._of.get("points", []))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._of and name not in self._declared:
            raise AttributeError(f"`{type(self).__name__}` has no attribute `{name}`")
        return self._of.get(name)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, View) or type(self) is not type(other):
            return NotImplemented
        return equal(self._of, other._of) and bool(self.system == other.system)

    def to_dict(self) -> dict[str, Any]:
        """The object in the JSON of the command."""
        return copy.deepcopy(self._of)

    def _painted(self, figure: dict[str, Any], ax: Any, legend: bool, title: str | None, line: dict[str, Any], /) -> Any:
        from vibroimpact._paint import paint

        return paint(figure, ax, legend, title, line)


class Answer(View):
    """The object that the command prints for a question; it is read when it is used."""

    _of: Made[dict[str, Any]] = Made(lambda view: view._read(view._answer))
    #: Whether the object is without a part of what the command prints.
    _brief = False

    def __init__(
        self, of: dict[str, Any] | None, system: Any, answer: _core.Answer | None = None, start: Any = None
    ) -> None:
        self.system, self._answer, self._start = system, answer, start
        if of is not None:
            self.__dict__["_of"] = of

    def __getstate__(self) -> dict[str, Any]:
        # what the compiled module keeps is computed again where it is needed
        return {**self.__dict__, "_of": self._of, "_answer": None, "_start": None}

    def _read(self, answer: _core.Answer) -> dict[str, Any]:
        """The object of an answer."""
        return read(answer.json(True))

    @property
    def plan(self) -> str:
        """The plan as JSON."""
        return json.dumps(self._of["plan"])

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json."""
        if not self._brief:
            return super().to_dict()
        return read(self._whole.json(False))

    @property
    def _whole(self) -> _core.Answer:
        """The answer of the compiled module."""
        if self._answer is None:
            self._answer = _core.Answer(self.plan)
        return self._answer

    def _figure(
        self, *, si: bool = False, diagram: bool = False, inadmissible: bool = False, branch: int | None = None,
        quantity: str | None = None,
    ) -> dict[str, Any]:
        """The figure that the command draws."""
        units = getattr(self.system, "units", None) if si else None
        if si and units is None:
            raise QuestionError("si=True needs the system in physical units\nhint: Oscillator.from_units")
        scales = units and (units.length_m, units.time_s, units.mass_kg)
        return read(self._whole.figure(scales, (diagram, inadmissible, branch), quantity) or "null")

    def plot(self, ax: Any = None, *, si: bool = False, legend: bool = True, title: str | None = None, **line: Any) -> Any:
        """Draw the figure that the command draws with `--plot`.

        `ax` is the axes to draw into, or an array of them for a figure of several panels; by default those of a new figure. Returns the
        axes. `si` selects metres and seconds for an oscillator with units, `line` are properties of the lines.
        """
        return self._painted(self._figure(si=si), ax, legend, title, line)


class Listed(Answer, Generic[V]):
    """The base of answers that are sequences of views, which are the attribute `_items`."""

    _items: Made[list[V]]

    def __iter__(self) -> "Iterator[V]":
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __getitem__(self, k: int) -> V:
        return self._items[k]
