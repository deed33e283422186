"""Registers `ds.vibro` with xarray: at once if xarray is imported already, or else as soon as it is imported.

So the import of this package does not import xarray, and a Dataset has the accessor wherever both are imported.
"""

import importlib
import importlib.util
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType


class _AfterXarray(MetaPathFinder):
    """Lets the other finders find xarray, and imports the accessor after it."""

    def __init__(self) -> None:
        self._asking = False

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname != "xarray" or self._asking:
            return None
        self._asking = True
        try:
            spec = importlib.util.find_spec(fullname)
        finally:
            self._asking = False
        if spec is None or spec.loader is None:
            return spec
        execute = spec.loader.exec_module

        def then_register(module: ModuleType) -> None:
            execute(module)
            if self in sys.meta_path:
                sys.meta_path.remove(self)
            importlib.import_module("vibroimpact._accessor")

        spec.loader.exec_module = then_register  # type: ignore[method-assign]
        return spec


def register() -> None:
    """Registers the accessor, now or when xarray is imported."""
    if "xarray" in sys.modules:
        importlib.import_module("vibroimpact._accessor")
    elif not any(isinstance(finder, _AfterXarray) for finder in sys.meta_path):
        sys.meta_path.insert(0, _AfterXarray())
