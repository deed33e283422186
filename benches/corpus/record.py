#!/usr/bin/env python3
"""Record what the command answers to a list of questions, to compare two versions byte by byte.

    cargo build --release -p vibroimpact-cli
    python3 benches/corpus/record.py target/release/vibro /tmp/before
    ...                                                            # change the code and build again
    python3 benches/corpus/record.py target/release/vibro /tmp/after
    diff -r /tmp/before /tmp/after

Each line of commands.txt runs in a shell, in an empty folder of its own, with `vibro` on the path. In the output every line has
a folder with the files that the line wrote, what it printed, and its exit status. Lines that begin with # are left out. Nothing
in the output depends on the time or the machine, so a difference is a difference of the program.
"""

import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).parent


def record(number: int, line: str, path: str, out: Path) -> None:
    folder = out / f"{number:03}"
    folder.mkdir(parents=True)
    env = {"PATH": f"{path}:/usr/bin:/bin", "HOME": str(folder), "LANG": "C.UTF-8", "COLUMNS": "100"}
    done = subprocess.run(["bash", "-c", line], cwd=folder, env=env, capture_output=True, timeout=600)
    (folder / "command").write_text(line + "\n")
    (folder / "stdout").write_bytes(done.stdout)
    (folder / "stderr").write_bytes(done.stderr)
    (folder / "status").write_text(f"{done.returncode}\n")


def main() -> None:
    program, out = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    lines = [line for line in (HERE / "commands.txt").read_text().splitlines() if line and not line.startswith("#")]
    with tempfile.TemporaryDirectory() as path, ThreadPoolExecutor(2) as pool:
        (Path(path) / "vibro").symlink_to(program)
        list(pool.map(lambda of: record(*of, path, out), enumerate(lines, 1)))
    print(f"{len(lines)} answers in {out}")


if __name__ == "__main__":
    main()
