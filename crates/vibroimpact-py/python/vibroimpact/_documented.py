"""Documentation in the words of the schemas of plans and answers: attributes of results, and parameters of questions."""

import re
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import Any

from vibroimpact import _core
from vibroimpact._json import read

#: Types of annotations, and those of documentation.
_TYPES = {
    "['\"]": "", r"^Made\[(.*)\]$": r"\1", r"NDArray\[np\.float64\]|Floats": "ndarray", r"NDArray\[np\.(\w+?)_?\]": r"ndarray of \1",
    r"dict\[[^\[\]]*(\[[^\[\]]*\])*[^\[\]]*\]": "dict", r"tuple\[(.*), \.\.\.\]": r"tuple of \1", r"tuple\[([^\[\]]*)\]": r"(\1)",
    r"list\[(.*)\]": r"list of \1", r" \| ": " or ",
}


def typed(annotation: str) -> str:
    """A type as documentation writes it."""
    for pattern, text in _TYPES.items():
        annotation = re.sub(pattern, text, annotation)
    return annotation


def completed(text: str, section: str, names: Iterable[str], told: Callable[[str], tuple[str, str]]) -> str:
    """Documentation whose section has an entry for each of these names: its own, or that with the type and the words of `told`."""
    rule = f"    {section}\n    {'-' * len(section)}\n"
    if rule in text:
        first, _, rest = text.partition(rule)
        body, _, rest = rest.partition("\n\n")
    else:
        first, examples, rest = text.partition("    Examples\n")
        body, rest = "", examples + rest
    entries: dict[str, str] = {}
    for head, lines in re.findall(r"^    (\S.*)\n((?:        .*\n?)+)", body, re.M):
        entries |= dict.fromkeys(head.partition(" : ")[0].split(", "), f"    {head}\n{lines.rstrip()}\n")
    parts = {name: name.split(", ") for name in names}
    names = [one for name in names for one in (parts[name] if entries.keys() >= set(parts[name]) else [name])]
    for name in names:
        if name not in entries:
            kind, words = told(name)
            lines = re.sub(r"(.{1,120})(?:\s|$)", r"        \1\n", " ".join(words.split()))
            entries[name] = f"    {name} : {kind}\n{lines}"
    whole = "".join(dict.fromkeys(entries[name] for name in dict.fromkeys((*names, *entries))))
    return f"{first.rstrip()}\n\n{rule}{whole}" + (f"\n{rest}" if rest.strip() else "    ")


@lru_cache
def schema(verb: str | None = None) -> dict[str, Any]:
    """The schema of the answer to a command, or else that of plans."""
    return read(_core.schema(verb))


@lru_cache
def fields_of(task: str) -> dict[str, Any]:
    """The schema of the fields of a task in a plan."""
    known = schema()["$defs"]
    of = next(one["properties"][task] for one in known["Task"]["oneOf"] if task in one["properties"])
    fields: dict[str, Any] = (known[of["$ref"].rpartition("/")[2]] if "$ref" in of else of)["properties"]
    return fields


def of_field(of: dict[str, Any]) -> tuple[str, str]:
    """The type of a field, and its words."""
    kinds = of.get("type", "string")
    kind = kinds if isinstance(kinds, str) else kinds[0]
    return {"integer": "int", "number": "float", "boolean": "bool", "array": "sequence of str"}.get(kind, "str"), of.get("description", "")


class Attributes:
    """The documentation of a view: that of its class, with its own attributes in the words of the schema of the answer."""

    def __init__(self, words: str) -> None:
        self._words = words

    def __get__(self, view: Any, owner: Any) -> str:
        kinds: dict[str, str] = {}
        for base in (owner, *(base for base in owner.__mro__[1:] if base.__name__.startswith("_"))):
            kinds |= {name: of.kind for name, of in vars(base).items() if getattr(of, "kind", "")} | base.__annotations__
        verb, *definitions = owner._schema or ("",)
        objects = [schema(verb)["$defs"][of] for of in definitions] + [schema(verb)] if verb else []

        def told(name: str) -> tuple[str, str]:
            if name == "system":
                return "Oscillator or Machine", "The system."
            words = (of["properties"][name].get("description", "") for of in objects if name in of["properties"])
            return typed(kinds[name]), re.sub(r"`?\bnull\b`?", "None", next(words, ""))

        names = [name for name in kinds if not name.startswith("_")]
        return completed(self._words, "Attributes", ("system", *names), told) if names else self._words
