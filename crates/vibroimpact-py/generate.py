"""Writes the types of the questions, `python/vibroimpact/_questions.pyi`, `_continuation.pyi` and `_grids.pyi`: their arguments are
those of the functions, and the types are those of the fields of their tasks in the schema of plans.

    target/python/bin/python crates/vibroimpact-py/generate.py

A field that no argument has, an argument that is no field, and a default that is not that of the plan are errors.
"""

import inspect
import json
import sys
import textwrap
from pathlib import Path
from types import ModuleType
from typing import Any

from vibroimpact import _continuation, _core, _grids, _questions

#: The modules of questions, and the files of their types.
FILES = {of: Path(__file__).parent / f"python/vibroimpact/{of.__name__.rpartition('.')[2]}.pyi" for of in (_questions, _continuation, _grids)}
#: Types of the arguments that questions have besides the fields of their tasks.
COMMON = {
    "system": "System", "x": "float", "v": "float", "phase": "float", "q": "ArrayLike", "qdot": "ArrayLike",
    "threads": "SupportsIndex", "progress": "Progress", "store": "str | PathLike[str]", "client": "Client", "tile": "SupportsIndex",
}
#: Arguments that stand for other fields of a task, and their types.
SPELLED: dict[tuple[str, str], tuple[tuple[str, ...], str]] = {
    ("branch", "to"): (("to", "back"), "float | tuple[float, float]"),
    ("curve", "over"): (("vary", "and"), "Mapping[str, Interval]"),
    ("region", "over"): (("across", "up"), "Mapping[str, Interval]"),
    ("edge", "other"): (("other",), "Mapping[str, float]"),
    ("margins", "vary"): (("vary",), "Sequence[str]"),
    ("margins", "scale"): (("vary",), "Mapping[str, float]"),
    ("diagram", "direction"): (("direction",), "str"),
    ("diagram", "starts"): (("direction",), "SupportsIndex"),
    ("diagram", "seed"): (("direction",), "SupportsIndex"),
    **{(task, "over"): (("axes",), "Mapping[str, Axis]") for task in ("basin", "map", "lyapunov")},
}
#: Fields that are arguments of other functions: points of `settle_many`, and the axes of a plan.
ELSEWHERE = {
    "basin": {"points", "transient"}, "plan_basin": {"points", "transient"}, "lyapunov": {"axes"}, "plan_lyapunov": {"points"},
}
#: Defaults that are those of the command: a plan in a file has others.
COMMANDS = {("map", "seed")}
HEAD = '''"""Types of the questions. Written by crates/vibroimpact-py/generate.py from the schema of plans: do not edit."""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import SupportsIndex

import xarray as xr
from distributed import Client
from numpy.typing import ArrayLike
{imports}
'''


def tasks(schema: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """The schema of each task by its name."""
    return {name: whole(schema, of) for one in schema["$defs"]["Task"]["oneOf"] for name, of in one["properties"].items()}


def whole(schema: dict[str, Any], of: dict[str, Any]) -> dict[str, Any]:
    """A schema to which another one refers."""
    return schema["$defs"][of["$ref"].rpartition("/")[2]] if "$ref" in of else of


def python_type(of: dict[str, Any]) -> str:
    """The type of a field; null is left out."""
    if "$ref" in of:
        return {"Target": "Mapping[str, float]", "Stretch": "Mapping[str, Interval]", "Values": "Axis"}.get(of["$ref"].rpartition("/")[2], "str")
    if "anyOf" in of:
        return python_type(next(one for one in of["anyOf"] if one.get("type") != "null"))
    kind = of.get("type", "string")
    kind = next(one for one in kind if one != "null") if isinstance(kind, list) else kind
    return {"integer": "SupportsIndex", "number": "float", "string": "str", "array": "Sequence[str]"}[kind]


def signature(name: str, function: Any, task: dict[str, Any]) -> str:
    """The lines of the stub of a function."""
    fields, seen, parts, star = task["properties"], {"start", *ELSEWHERE.get(name, ())}, [], False
    for argument, of in inspect.signature(function).parameters.items():
        spelled = SPELLED.get((function.task, argument))
        if argument in COMMON and argument not in fields:
            kind = COMMON[argument]
            if (function.task, argument) == ("basin", argument) and argument in ("x", "v", "phase"):
                kind = "Axis | float"
        elif spelled is not None:
            kind = spelled[1]
            seen.update(spelled[0])
        else:
            kind = python_type(fields[argument])
            seen.add(argument)
        if of.kind is of.KEYWORD_ONLY and not star:
            parts.append("*")
            star = True
        usual = fields.get(argument, {}).get("default", of.default)
        if (function.task, argument) not in COMMANDS and of.default not in (of.empty, None, usual, ()):
            raise SystemExit(f"{name}: {argument} = {of.default!r}, and {usual!r} in a plan")
        optional = " | None" if of.default is None and argument != "progress" else ""
        parts.append(f"{argument}: {kind}{optional}{'' if of.default is of.empty else f' = {of.default!r}'}")
    if missing := fields.keys() - seen:
        raise SystemExit(f"{name} has no argument for {', '.join(sorted(missing))}")
    result = function.returns.__name__ if function.returns is not None else "xr.Dataset"
    lines = textwrap.wrap(", ".join(part.replace(" ", "\0") for part in parts) + ",", 116)
    arguments = "".join(f"    {line}\n" for line in lines).replace("\0", " ")
    return f"def {name}(\n{arguments}) -> {result}: ...\n"


def text(module: ModuleType) -> str:
    """The stub of a module."""
    known = tasks(json.loads(_core.schema()))
    questions = {name: of for name, of in vars(module).items() if callable(of) and hasattr(of, "task")}
    results = {(of.returns.__module__, of.returns.__name__) for of in questions.values() if of.returns is not None}
    own = {("vibroimpact._system", "System"), ("vibroimpact._arguments", "Axis, Interval, Progress")}
    imports = "\n".join(f"from {module} import {names}" for module, names in sorted(results | own))
    lines = [signature(name, of, known[of.task]) for name, of in questions.items()]
    return HEAD.format(imports=imports) + "\n" + "".join(lines)


if __name__ == "__main__":
    for module, file in FILES.items():
        if "--check" not in sys.argv:
            file.write_text(text(module))
        elif file.read_text() != text(module):
            raise SystemExit(f"{file} is not current: run {__file__}")
