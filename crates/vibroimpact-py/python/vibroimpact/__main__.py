"""`python -m vibroimpact export STORE --format netcdf|parquet|csv FILE`: the formats that `vibro export` writes with Python."""

import argparse
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


if __name__ == "__main__":
    sys.exit(main())
