"""What all results have in common: equality of their values, a table, and a small picture in a notebook."""

import base64
import copy
import html
import io
import json
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

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


def answer(plan: str) -> dict[str, Any]:
    """The object that the command prints with --json for a plan, which is computed for it."""
    from vibroimpact import _core

    found: dict[str, Any] = json.loads(_core.answer_json(plan))
    return found


class Result:
    """The base of all results."""

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        return equal(self, other) if type(self) is type(other) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def _table(self) -> dict[str, Any]:
        """The columns of the table of the result."""
        raise NotImplementedError

    def to_dict(self) -> dict[str, Any]:
        """The object that the command prints with --json for the plan of the result, which is computed again for it."""
        return answer(self.plan)  # type: ignore[attr-defined]

    def to_dataframe(self) -> "pd.DataFrame":
        """The result as a table of pandas: one row for each event, motion, point or value."""
        import pandas as pd

        rows: pd.DataFrame = pd.DataFrame(self._table())
        return rows

    def to_xarray(self) -> "xr.Dataset":
        """The table as a Dataset of xarray over its rows, with the plan as an attribute, if there is one."""
        import xarray as xr

        from vibroimpact import _core

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

        from vibroimpact._core import QuestionError

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


class View(Result):
    """A part of the JSON object that the command prints for a system. Its attributes are the fields of the object; those that
    are declared and absent in it are None."""

    _declared: frozenset[str] = frozenset()
    #: The system: an `Oscillator` or a `Machine`.
    system: Any

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls._declared = cls._declared | cls.__annotations__.keys()

    def __init__(self, of: "dict[str, Any]", system: Any) -> None:
        self._of, self.system = of, system

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._of and name not in self._declared:
            raise AttributeError(f"`{type(self).__name__}` has no attribute `{name}`")
        return self._of.get(name)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, View) or type(self) is not type(other):
            return NotImplemented
        return equal(self._of, other._of) and bool(self.system == other.system)

    __hash__ = None

    @property
    def plan(self) -> str:
        """The plan as JSON."""
        return json.dumps(self._of["plan"])

    def to_dict(self) -> dict[str, Any]:
        """The object in the JSON of the command."""
        return copy.deepcopy(self._of)


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
