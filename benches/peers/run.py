#!/usr/bin/env python3
"""Run vibroimpact and other programs on the same workloads, and write docs/performance.md.

    python3 benches/peers/run.py --help

Every number of the page is measured by the run that writes it; its text is in performance.md.in. README.md says how a peer is
called. What is built and installed lies in target/peers.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, astuple, dataclass, field, replace
from itertools import product
from pathlib import Path
from statistics import median
from string import Template
from typing import Any

from python.peer import FIRST, OUTLOOK_PERIODS, Start

SOURCES = Path(__file__).resolve().parent
ROOT = SOURCES.parent.parent
COMPILE = "gcc -O3 -march=native"
WORKLOADS = ("chaos", "regular", "basin")
GRACE = 120.0  # seconds that a program may take beyond the time asked for, to start and to compile itself
IMPACTS_LIMIT = 1800.0  # seconds that a peer may take for all starts of the accuracy table

POINTS = [(1.8, 0.25), (0.6, 0.75), (0.7, 2.5), (1.7, 2.25), (1.3, 0.75), (1.11, 2.0), (1.11, 3.0)]  # N, P, Q to U
TOLERANCE = 1e-6  # difference in time that makes an impact wrong


class Failure(Exception):
    """A sentence that says which program failed, and how."""


def call(command: list[Any], folder: Path | None = None, limit: float | None = None) -> str:
    """What a program prints to its standard output. It is stopped after `limit` seconds."""
    name = Path(command[0]).name
    try:
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, timeout=limit)
    except OSError as error:
        raise Failure(f"`{name}` cannot be run: {error.strerror}") from error
    except subprocess.TimeoutExpired as error:
        raise Failure(f"`{name}` took more than {limit:.0f} s and was stopped") from error
    if done.returncode != 0:
        raise Failure(f"`{name}` ended with status {done.returncode}")
    return done.stdout


@dataclass
class Contender:
    """A program that fills a row of the tables. vibroimpact can fill two: its answer has two rates, `scalar` and `lanes`."""

    rows: list[str]
    command: list[Any]
    rates: list[str] = field(default_factory=list)  # of vibroimpact: which rate goes into which row
    missing: str = ""  # why it could not be built or installed

    def call(self, *arguments: Any, limit: float) -> str:
        try:
            return call([*self.command, *arguments], limit=limit)
        except Failure as why:
            raise Failure(f"{self.rows[0]}: {why}") from why


def install(folder: Path) -> None:
    """Makes a Python environment with what the peers need, unless one with the same requirements is there."""
    requirements, installed, python = SOURCES / "requirements.txt", folder / "installed.txt", folder / "bin/python"
    if python.exists() and installed.exists() and installed.read_text() == requirements.read_text():
        return
    call([sys.executable, "-m", "venv", folder])
    call([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement", requirements])
    installed.write_text(requirements.read_text())


def prepare(folder: Path, python: Path, vibro: Path) -> list[Contender]:
    """Builds and installs the contenders: the baseline is the first, vibroimpact the last."""
    call(["cargo", "build", "--release", "--package", "vibroimpact-cli"], ROOT)
    not_installed = ""
    try:
        install(folder / "venv")
    except Failure as why:
        not_installed = f"the peers in Python, which need Python 3.11 or later with venv, and access to PyPI: {why}"

    def c_peer(row: str, name: str) -> Contender:
        peer = Contender([row], [folder / "bin" / name])
        peer.command[0].parent.mkdir(parents=True, exist_ok=True)
        try:
            # this takes a second, so it is done in every run
            call([*COMPILE.split(), "-Wall", "-Wextra", "-o", *peer.command, "main.c", f"{name}.c", "-lm"], SOURCES / "c")
        except Failure as why:
            peer.missing = f"{name}.c is not compiled: {why}"
        return peer

    def python_peer(row: str, file: str, *method: str) -> Contender:
        return Contender([row], [python, SOURCES / "python" / file, *method], missing=not_installed)

    bench = [vibro, "bench", "--json", "--quiet", "--threads", "1"]
    return [
        c_peer("C, scan (baseline)", "scan"),
        c_peer("C, scan with a table of sines", "table"),
        c_peer("C, safe search", "safe"),
        python_peer("Numba, scan", "numba_scan.py"),
        python_peer("heyoka, one motion", "heyoka_scalar.py"),
        python_peer("heyoka, batch", "heyoka_batch.py"),
        python_peer("SciPy, RK45 as it comes", "scipy_events.py", "RK45"),
        python_peer("SciPy, DOP853, rtol 1e-9", "scipy_events.py", "DOP853"),
        Contender(["vibroimpact, lanes held to AVX2"], [*bench, "--width", "avx2"], ["lanes"]),
        Contender(["vibroimpact, one motion", "vibroimpact, lanes"], bench, ["scalar", "lanes"]),
    ]


@dataclass
class Row:
    """What all rounds together gave for one row."""

    rates: dict[str, list[float]] = field(default_factory=lambda: {workload: [] for workload in WORKLOADS})
    labels: Counter[str] = field(default_factory=Counter)
    callback_share: float = 0.0  # the largest part of the time that was spent in a Python callback


def ask(contender: Contender, workload: str, seconds: float) -> list[dict[str, Any]]:
    """The answers of a contender, one for each of its rows, each with a `rate`."""
    limit = GRACE + 4.0 * seconds
    if not contender.rates:
        return [json.loads(contender.call(workload, str(seconds), limit=limit))]
    answer = json.loads(contender.call("--workload", workload, "--seconds", str(seconds), limit=limit))
    if workload == "basin":
        rates = {"lanes": answer["starts_per_second"]["basin"], "scalar": answer["starts_per_second"]["basin_scalar"]}
    else:
        rates = answer["impacts_per_second"][workload]
    return [{"rate": rates[name]} for name in contender.rates]


def measure(contenders: list[Contender], rounds: int, seconds: float) -> tuple[dict[str, Row], list[str]]:
    """The rows, and a sentence for each thing that was not measured. A peer that is there must not fail."""
    rows = {row: Row() for contender in contenders for row in contender.rows}
    missing = [contender.missing for contender in contenders if contender.missing]
    for number, workload in product(range(1, rounds + 1), WORKLOADS):
        print(f"round {number} of {rounds}, {workload}", flush=True)
        # the contenders take turns, so that what else happens on the machine affects all of them
        for contender in contenders:
            if contender.missing:
                continue
            try:
                answers = ask(contender, workload, seconds)
            except Failure as why:
                if not contender.rates:
                    raise
                missing.append(str(why))  # for instance on a processor without AVX2
                continue
            for name, answer in zip(contender.rows, answers):
                print(f"  {name:31} {answer['rate']:12.0f} per second", flush=True)
                rows[name].rates[workload].append(answer["rate"])
                rows[name].labels.update(answer.get("labels", {}))
                rows[name].callback_share = max(rows[name].callback_share, answer.get("callback_share", 0.0))
    return rows, list(dict.fromkeys(missing))


def flight(start: Start, s: float) -> tuple[float, float]:
    """Position and velocity after the time `s`, without the stop."""
    beta, f = start.beta, 1.0 / ((1.0 - start.beta) * (1.0 + start.beta))
    a, b = start.x - f * math.sin(start.phase), start.v - f * beta * math.cos(start.phase)
    sin, cos, angle = math.sin(s), math.cos(s), beta * s + start.phase
    return a * cos + b * sin + f * math.sin(angle), b * cos - a * sin + f * beta * math.cos(angle)


def random_numbers(state: int) -> Iterator[float]:
    """Numbers from 0 to 1, the same everywhere: SplitMix64 of Steele, Lea and Flood, https://doi.org/10.1145/2660193.2660195."""
    mask = 2**64 - 1
    while True:
        state = (state + 0x9E3779B97F4A7C15) & mask
        z = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        yield ((z ^ (z >> 31)) >> 11) / 2**53


def random_start(numbers: Iterator[float], inverse_beta: float, gap: float) -> Start:
    """A start with x in [-4, gap], v in [-4, 4] and any phase."""
    x, v, phase = (4.0 + gap) * next(numbers) - 4.0, 8.0 * next(numbers) - 4.0, math.tau * next(numbers)
    return Start(inverse_beta, gap, 0.5, x, v, phase)


def near_grazing(numbers: Iterator[float]) -> Start:
    """A start at the frequency of T and U whose first maximum lies 1e-6 to 1e-4 beyond the stop, which is put there."""
    while True:
        start = random_start(numbers, 1.11, 1.0)
        depth = 10.0 ** (2.0 * next(numbers) - 6.0)
        height = first_maximum(start)
        # a gap like those of T and U, and a start that is not close to it
        if 1.5 <= height < 3.5 and start.x < height - 0.1:
            return replace(start, gap=height - depth)


def first_maximum(start: Start) -> float:
    """The position at the first local maximum of the flight; infinite where none lies within two forcing periods."""
    step = 0.01
    rises = [flight(start, step * k)[1] > 0.0 for k in range(1400)]
    low = next((step * k for k in range(1399) if rises[k] and not rises[k + 1]), None)
    if low is None:
        return math.inf
    high = low + step
    for _ in range(50):
        middle = 0.5 * (low + high)
        if flight(start, middle)[1] > 0.0:
            low = middle
        else:
            high = middle
    return flight(start, low)[0]


def random_starts(number: int) -> list[Start]:
    """So many starts at each point of the paper, and as many near grazing; the same ones in every run."""
    numbers = random_numbers(1971)
    starts = [random_start(numbers, *point) for point in POINTS for _ in range(number)]
    return starts + [near_grazing(numbers) for _ in range(number)]


def truth(vibro: Path, start: Start) -> tuple[list[float], bool]:
    """The true times of the first impacts, by `vibro simulate`, and whether a peer may find more than these."""
    switches = [f"--{name.replace('_', '-')}={value!r}" for name, value in asdict(start).items()]
    answer = call([vibro, "simulate", "--json", "--quiet", "--impacts", str(FIRST), *switches], limit=60.0)
    times: list[float] = []
    for event in json.loads(answer)["events"]:
        if event["time"] > start.horizon:
            return times, False
        if event["kind"] in ("stick", "release"):
            # the peers do not know that a mass can stick
            return times, True
        if event["kind"] == "impact":
            times.append(event["time"])
    return times, len(times) == FIRST


def is_wrong(times: list[float], true: list[float], goes_on: bool) -> bool:
    """Whether an impact is missing, off or one too many."""
    enough = len(times) >= len(true) if goes_on else len(times) == len(true)
    return not enough or any(abs(a - b) > TOLERANCE for a, b in zip(times, true))


def compare(peers: list[Contender], vibro: Path, number: int) -> list[list[Any]]:
    """For each peer, how many starts of each group have a wrong impact; in the last row, how many impacts were compared."""
    starts = random_starts(number)
    print(f"accuracy: {len(starts)} starts, their true impacts from `vibro simulate`", flush=True)
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # on all cores, since nothing is timed here
        truths = list(pool.map(lambda start: truth(vibro, start), starts))
    file = Path("starts.txt").resolve()
    file.write_text("".join(" ".join(map(repr, astuple(start))) + "\n" for start in starts))

    def in_groups(counts: list[int]) -> list[int]:
        return [sum(counts[first : first + number]) for first in range(0, len(counts), number)]

    rows: list[list[Any]] = []
    for peer in peers:
        found = [list(map(float, text.split())) for text in peer.call("impacts", file, limit=IMPACTS_LIMIT).splitlines()]
        if len(found) != len(starts):
            raise Failure(f"{peer.rows[0]} answers {len(found)} starts of {len(starts)}")
        wrong = in_groups([is_wrong(times, *true) for times, true in zip(found, truths)])
        print(f"  {peer.rows[0]:31} {wrong} wrong", flush=True)
        rows.append([peer.rows[0], *wrong])
    return [*rows, ["*impacts compared*", *in_groups([len(times) for times, _ in truths])]]


def short(number: float) -> str:
    """A number to three digits, with at most five decimals."""
    if number <= 0.0:
        return "-"
    return f"{number:.{min(max(2 - math.floor(math.log10(number)), 0), 5)}f}"


def grouped(rate: float) -> str:
    """A rate to three digits, its digits in groups of three."""
    return short(rate) if rate < 100.0 else f"{float(f'{rate:.3g}'):,.0f}".replace(",", " ")


def table(rows: list[list[Any]]) -> str:
    """Lines of a table in Markdown."""
    return "\n".join(f"| {' | '.join(map(str, row))} |" for row in rows)


def rate_table(rows: dict[str, Row], rounds: int) -> str:
    """Medians of the rounds, where none is missing, and of the ratios to the first row."""
    lines = []
    baseline = next(iter(rows.values()))
    for name, row in rows.items():
        cells = [name]
        for workload in WORKLOADS:
            rates, base = row.rates[workload], baseline.rates[workload]
            complete = len(rates) == rounds
            # a round can be slow for all contenders, so a ratio is that of one round
            ratios = [rate / of for rate, of in zip(rates, base)] if complete and len(base) == rounds else []
            cells += [grouped(median(rates)) if complete else "-", short(median(ratios)) if ratios else "-"]
        lines.append(cells)
    return table(lines)


def spread_sentence(rows: dict[str, Row]) -> str:
    """How far the rounds of one contender were apart."""
    spread, name = max(((max(r) - min(r)) / median(r), name) for name, row in rows.items() for r in row.rates.values() if r)
    return f"The rounds of one contender were apart by up to {100.0 * spread:.0f} % of its median ({name})."


def label_table(rows: dict[str, Row]) -> str:
    """The two usual labels in per cent, the others by their number."""
    lines = []
    for name, row in rows.items():
        if total := sum(row.labels.values()):
            usual = [f"{100.0 * row.labels[label] / total:.1f} %" for label in ("1/1", "2/1")]
            other = [f"{count} {label}" for label, count in sorted(row.labels.items()) if label not in ("1/1", "2/1")]
            lines.append([name, total, *usual, ", ".join(other) or 0])
    return table(lines)


def callback_share(row: Row) -> str:
    return f"{short(100.0 * row.callback_share)} %" if row.callback_share > 0.0 else "a part"


def first_line(*command: Any) -> str:
    """The first line that a program prints, or `unknown`."""
    try:
        return call([*command]).splitlines()[0].strip()
    except (Failure, IndexError):
        return "unknown"


def machine_table(python: Path, vibro: Path) -> str:
    """The machine and the versions."""
    model = first_line("sed", "-n", "s/^model name.*: //p", "/proc/cpuinfo")
    version = "import importlib.metadata as m; print(m.version('{}'))"
    return table([
        ["processor", model if model != "unknown" else first_line("sysctl", "-n", "machdep.cpu.brand_string")],
        ["cores visible", os.cpu_count()],
        ["system", " ".join([platform.system(), platform.machine(), *platform.libc_ver()])],
        ["vibroimpact", first_line(vibro, "--version")],
        ["Rust", first_line("rustc", "--version")],
        ["C", first_line("gcc", "--version")],
        ["Python", first_line(python, "-c", "import platform; print(platform.python_version())")],
        ["NumPy", first_line(python, "-c", version.format("numpy"))],
        ["SciPy", first_line(python, "-c", version.format("scipy"))],
        ["Numba", first_line(python, "-c", version.format("numba"))],
        ["heyoka (Python package)", first_line(python, "-c", version.format("heyoka"))],
        ["lanes heyoka recommends", first_line(python, "-c", "import heyoka; print(heyoka.recommended_simd_size())")],
    ])


def options() -> argparse.Namespace:
    """What to run, from the command line."""
    parser = argparse.ArgumentParser(description="Compare vibroimpact with other programs.", allow_abbrev=False)
    parser.add_argument("--rounds", type=int, metavar="N", help="rounds of all contenders, 1 to 1000 (5, with --quick 2)")
    parser.add_argument("--seconds", type=float, metavar="S", help="time of each workload, 0.01 to 600 (1, with --quick 0.2)")
    parser.add_argument("--quick", action="store_true", help="a short run, into target/peers/performance.md")
    quick = "--quick" in sys.argv
    parser.set_defaults(rounds=2 if quick else 5, seconds=0.2 if quick else 1.0, starts=30 if quick else 300)
    asked = parser.parse_args()
    if not (1 <= asked.rounds <= 1000 and 0.01 <= asked.seconds <= 600.0):
        parser.error(f"{asked.rounds} rounds of {asked.seconds} s lie outside 1 to 1000 rounds of 0.01 to 600 s")
    return asked


def main() -> None:
    asked = options()
    target = Path(json.loads(call(["cargo", "metadata", "--no-deps", "--format-version", "1"], ROOT))["target_directory"])
    folder, vibro = target / "peers", target / "release/vibro"
    python = folder / "venv/bin/python"
    contenders = prepare(folder, python, vibro)

    # one thread for each program, and its caches under target
    os.environ.update(dict.fromkeys(["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"], "1"))
    os.environ.update(PYTHONPYCACHEPREFIX=str(folder / "pycache"), NUMBA_CACHE_DIR=str(folder / "numba"))
    os.chdir(folder)
    machine = machine_table(python, vibro)
    rows, missing = measure(contenders, asked.rounds, asked.seconds)
    accuracy = compare([peer for peer in contenders if not peer.rates and not peer.missing], vibro, asked.starts)

    path = folder / "performance.md" if asked.quick else ROOT / "docs/performance.md"
    asked_for = {"rounds": asked.rounds, "seconds": f"{asked.seconds:g}", "starts": asked.starts}
    fixed = {"compile": COMPILE, "first": FIRST, "periods": OUTLOOK_PERIODS, "tolerance": f"{TOLERANCE:g}".replace("e-0", "e-")}
    page = Template((SOURCES / "performance.md.in").read_text()).substitute(
        asked_for | fixed,
        rates=rate_table(rows, asked.rounds),
        spread=spread_sentence(rows),
        missing="".join(f"\nNot measured: {why}.\n" for why in missing),
        labels=label_table(rows),
        accuracy=table(accuracy),
        one_motion=callback_share(rows["heyoka, one motion"]),
        batch=callback_share(rows["heyoka, batch"]),
        machine=machine,
    )
    path.write_text(page)
    print(f"{path} written", *missing, sep="\n")


if __name__ == "__main__":
    try:
        main()
    except Failure as why:
        sys.exit(str(why))
