"""What all results have in common: equality of their values, a table, and a small picture in a notebook."""

import base64
import copy
import html
import io
import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from vibroimpact import _core
from vibroimpact._core import QuestionError
from vibroimpact._styled import styled

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

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

    __hash__ = None  # type: ignore[assignment]

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
        text = f"<pre>{html.escape(repr(self))}</pre>"
        picture = self._picture() if hasattr(self, "plot") else None
        return text if picture is None else f'{text}<img alt="{html.escape(repr(self))}" src="data:image/png;base64,{picture}">'

    def _picture(self) -> str | None:
        """The figure as a small PNG in base64; None for a result that has no figure."""
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


class _Lazy(Generic[R]):
    """An attribute of a view that is made of its object when it is first used."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, view: Any, owner: object = None) -> R:
        found = self._value(view)
        view.__dict__[self._name] = found
        return found

    def _value(self, view: Any) -> R:
        raise NotImplementedError


class Made(_Lazy[R]):
    """One that a function makes of the view."""

    def __init__(self, make: Callable[[Any], R]) -> None:
        self._make = make

    def _value(self, view: Any) -> R:
        return self._make(view)


class View(Result):
    """An object, or a part of one, that the command prints for a system. Its attributes are the fields of the object; those that are
    declared and absent in it are None."""

    _declared: frozenset[str] = frozenset()
    #: The system: an `Oscillator` or a `Machine`.
    system: Any

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls._declared = cls._declared | cls.__annotations__.keys()

    def __init__(
        self, of: dict[str, Any] | None, system: Any, answer: _core.Answer | None = None, start: Any = None
    ) -> None:
        self.system, self._answer, self._start = system, answer, start
        if of is not None:
            self.__dict__["_of"] = of

    #: The object, and the rows of its columns.
    _of: Made[dict[str, Any]] = Made(lambda view: view._read(view._answer))
    _rows: Made[list[dict[str, Any]]] = Made(lambda view: view._of.get("points", []))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._of and name not in self._declared:
            raise AttributeError(f"`{type(self).__name__}` has no attribute `{name}`")
        return self._of.get(name)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, View) or type(self) is not type(other):
            return NotImplemented
        return equal(self._of, other._of) and bool(self.system == other.system)

    __hash__ = None

    def __getstate__(self) -> dict[str, Any]:
        # what the compiled module keeps is computed again where it is needed
        return {**self.__dict__, "_of": self._of, "_answer": None, "_start": None}

    def _read(self, answer: _core.Answer) -> dict[str, Any]:
        """The object of an answer."""
        found: dict[str, Any] = json.loads(answer.json(True))
        return found

    @property
    def plan(self) -> str:
        """The plan as JSON."""
        return json.dumps(self._of["plan"])

    @property
    def _whole(self) -> _core.Answer:
        """The answer of the compiled module."""
        if self._answer is None:
            self._answer = _core.Answer(self.plan)
        return self._answer

    def to_dict(self) -> dict[str, Any]:
        """The object in the JSON of the command."""
        return copy.deepcopy(self._of)

    def _figure(
        self, *, si: bool = False, diagram: bool = False, inadmissible: bool = False, branch: int | None = None,
        quantity: str | None = None,
    ) -> dict[str, Any]:
        """The figure that the command draws."""
        units = getattr(self.system, "units", None) if si else None
        if si and units is None:
            raise QuestionError("si=True needs the system in physical units\nhint: Oscillator.from_units")
        scales = units and (units.length_m, units.time_s, units.mass_kg)
        found: dict[str, Any] = json.loads(self._whole.figure(scales, (diagram, inadmissible, branch), quantity) or "null")
        return found

    def plot(self, ax: Any = None, *, si: bool = False, legend: bool = True, title: str | None = None, **line: Any) -> Any:
        """Draw the figure that the command draws with `--plot`.

        `ax` is the axes to draw into, or an array of them for a figure of several panels; by default those of a new figure. Returns the
        axes. `si` selects metres and seconds for an oscillator with units, `line` are properties of the lines.
        """
        return self._painted(self._figure(si=si), ax, legend, title, line)

    def _painted(
        self, figure: dict[str, Any], ax: Any, legend: bool, title: str | None, line: dict[str, Any], /
    ) -> Any:
        from vibroimpact._paint import paint

        return styled(lambda ax: paint(figure, ax), ax, legend, title, line)


class Column(_Lazy[NDArray[N]]):
    """One that is a column: the field of its name, or at a path, of each row of the view; nan where a row lacks it."""

    def __init__(self, kind: type[N], field: str | None = None) -> None:
        self._kind, self._field = kind, field

    def _value(self, view: Any) -> NDArray[N]:
        name = self._field or self._name
        return np.array([row.get(name, np.nan) for row in view._rows], dtype=self._kind)


class Field(_Lazy[R]):
    """One that is a field of the object, or of an object in it, converted; it is named by its path."""

    def __init__(self, convert: Callable[[Any], R], path: str | None = None) -> None:
        self._convert, self._path = convert, path

    def _value(self, view: Any) -> R:
        of: Any = view._of
        for name in (self._path or self._name).split("."):
            of = None if of is None else of.get(name)
        return self._convert(of)


class Part(_Lazy[V]):
    """One that is a view of an object in the object."""

    def __init__(self, kind: "type[V]", path: str | None = None) -> None:
        self._kind, self._path = kind, path

    def _value(self, view: Any) -> V:
        return self._kind(view._of[self._path or self._name], view.system)


class Parts(_Lazy[list[V]]):
    """One that is a list of views of the objects in a list."""

    def __init__(self, kind: "type[V]", path: str | None = None) -> None:
        self._kind, self._path = kind, path

    def _value(self, view: Any) -> list[V]:
        return [self._kind(of, view.system) for of in view._of[self._path or self._name]]


class Rows(Result):
    """The base of results that are columns of one length: a dataclass, each of whose arrays is one or more columns."""

    __slots__ = ()

    def __len__(self) -> int:
        return len(getattr(self, fields(self)[0].name))  # type: ignore[arg-type]

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)}>"

    def _table(self) -> dict[str, Any]:
        """One row for each row of the columns."""
        return {of.name: getattr(self, of.name) for of in fields(self) if not of.name.startswith("_")}  # type: ignore[arg-type]


class Sequence(View, Generic[V]):
    """The base of answers that are sequences of views, which are the attribute `_items`."""

    _items: Made[list[V]]

    def __iter__(self) -> "Iterator[V]":
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __getitem__(self, k: int) -> V:
        return self._items[k]


def pair(of: Iterable[R]) -> tuple[R, R]:
    """Two values."""
    one, two = of
    return one, two


def flat(of: dict[str, Any]) -> dict[str, Any]:
    """The fields of an object as one row: objects in it by path, lists as JSON."""
    row: dict[str, Any] = {}
    for name, value in of.items():
        if isinstance(value, dict):
            row |= {f"{name}.{key}": entry for key, entry in flat(value).items()}
        elif isinstance(value, (list, tuple)):
            row[name] = json.dumps(value)
        else:
            row[name] = value
    return row


def rows(of: "list[dict[str, Any]]") -> dict[str, Any]:
    """Objects as columns: one row each, None where an object lacks a field."""
    all_ = [flat(one) for one in of]
    names = dict.fromkeys(name for one in all_ for name in one)
    return {name: [one.get(name) for one in all_] for name in names}
