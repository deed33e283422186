"""`python -m vibroimpact export STORE --format netcdf|parquet|csv FILE`: the formats that `vibro export` writes with Python.

The function `vibro` is the command `vibro` of this package.
"""

import argparse
import os
import shutil
import sys

from vibroimpact import _core
from vibroimpact._export import export


def main(words: list[str] | None = None) -> int:
    """Run the command. Returns the exit code: 0, or 1 after an error message on stderr."""
    parser = argparse.ArgumentParser("python -m vibroimpact")
    parser.add_argument("--version", action="version", version=f"vibroimpact {_core.__version__}")
    commands = parser.add_subparsers(dest="command", required=True)
    writer = commands.add_parser("export", help="write a store as NetCDF, Parquet or CSV")
    writer.add_argument("store", help="the store")
    writer.add_argument("file", help="the file to write; one that is there is replaced")
    writer.add_argument("--format", required=True, choices=("netcdf", "parquet", "csv"), help="how it is written")
    asked = parser.parse_args(words)
    try:
        export(asked.store, asked.file, asked.format)
    except (_core.QuestionError, ImportError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


def vibro() -> int:
    """Run the command `vibro` with the words of this process. Returns the exit code."""
    name, *words = sys.argv
    if words[:1] == ["export"] and not any(word.startswith("--python") for word in words):
        # it asks the Python of this package for the formats that Python writes
        words += ["--python", sys.executable]
    return _core.vibro(["vibro", *words], os.path.abspath(shutil.which(name) or name))


if __name__ == "__main__":
    sys.exit(main())
