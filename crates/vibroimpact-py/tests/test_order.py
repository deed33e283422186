"""No modules of the package import each other in a circle. Imports for types count too."""

import ast
from pathlib import Path

import vibroimpact as vi


def imports(folder: Path) -> dict[str, set[str]]:
    """The modules of the package that each module imports, at its head or in a function."""
    names = {path.stem for path in folder.glob("*.py")}
    found: dict[str, set[str]] = {}
    for path in folder.glob("*.py"):
        taken = found.setdefault(path.stem, set())
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "vibroimpact":
                module = (node.module or "").removeprefix("vibroimpact").lstrip(".")
                # `from vibroimpact import _core` imports a module, `from vibroimpact import Plan` the whole package
                modules = {name if name[0] == "_" or name in names else "__init__" for name in (a.name for a in node.names)}
                taken |= {module} if module else modules
    return {name: taken & names - {name} for name, taken in found.items()}


def circle(of: dict[str, set[str]]) -> list[str]:
    """The modules that remain when modules without imports of remaining ones are repeatedly removed."""
    left = dict(of)
    while ends := [name for name, taken in left.items() if not taken & left.keys()]:
        for name in ends:
            del left[name]
    # modules that only import from a circle are not part of it
    while starts := [name for name in left if not any(name in taken for taken in left.values())]:
        for name in starts:
            del left[name]
    return sorted(left)


def test_no_modules_import_each_other_in_a_circle() -> None:
    assert vi.__file__ is not None
    found = imports(Path(vi.__file__).parent)
    assert len(found) > 30 and found["_branch"]
    assert circle(found) == []
    assert circle({**found, "_whole": {"_branch"}}) != []
