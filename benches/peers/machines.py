#!/usr/bin/env python3
"""Machines in vibroimpact, heyoka and SciPy: events per second, and starts with a wrong event among the first five.

    python3 benches/peers/machines.py [--rounds N] [--seconds S] [--starts N] [--python PATH] [--rates PATH] [--page]

It prints two tables in Markdown; with `--page` it writes docs/performance-machines.md, whose text is in
`performance-machines.md.in`. `--python` is an interpreter with heyoka and SciPy (that of run.py in target/peers by
default), `--rates` the example `machine_rates` of the core, built with --release. The contenders take turns.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import tempfile
from pathlib import Path
from statistics import median
from string import Template

SOURCES = Path(__file__).resolve().parent
ROOT = SOURCES.parent.parent
PROBLEMS = {
    "chain": "two bodies, rigid stop",
    "soft": "elastic stop",
    "beam": "cantilever, 6 modes",
    "ball": "ball between walls",
}
PEERS = {
    "heyoka, one motion": ["machine_heyoka.py", "scalar"],
    "heyoka, batch": ["machine_heyoka.py", "batch"],
    "SciPy, DOP853, rtol 1e-9": ["machine_scipy.py"],
}
OURS = "vibroimpact, one motion"
TOLERANCE = 1e-6
SETTINGS = {"default": [], "--tol 1e-9": ["--tol", "1e-9"], "--compact": ["--compact"]}


def call(command: list[object]) -> str:
    return subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True, timeout=1200).stdout


def rate(command: list[object]) -> float:
    return float(json.loads(call(command))["rate"])


def best_settings(python: Path) -> dict[tuple[str, str], list[str]]:
    """The fastest settings of heyoka for each problem, by a short run of each."""
    chosen = {}
    for name, command in PEERS.items():
        for problem in PROBLEMS:
            if name.startswith("SciPy"):
                chosen[name, problem] = []
                continue
            peer = [python, SOURCES / "python" / command[0], command[1]]
            rates = {key: rate([*peer, *words, problem, 0.3]) for key, words in SETTINGS.items()}
            chosen[name, problem] = SETTINGS[max(rates, key=rates.__getitem__)]
    return chosen


def rates_table(arguments: argparse.Namespace) -> str:
    settings = best_settings(arguments.python)
    rates: dict[tuple[str, str], list[float]] = {}
    for _ in range(arguments.rounds):
        for problem in PROBLEMS:
            for name, command in PEERS.items():
                peer = [arguments.python, SOURCES / "python" / command[0], *command[1:]]
                found = rate([*peer, *settings[name, problem], problem, arguments.seconds])
                rates.setdefault((name, problem), []).append(found)
            # about as long as the others
            events = max(2000, int(arguments.seconds * 2e5))
            found = float(re.findall(r"([0-9]+) per second", call([arguments.rates, events, problem]))[0])
            rates.setdefault((OURS, problem), []).append(found)
    lines = ["| | " + " | ".join(PROBLEMS.values()) + " |", "|---|" + "--:|" * len(PROBLEMS)]
    for name in [*PEERS, OURS]:
        cells = [f"{median(rates[name, problem]):,.0f}".replace(",", " ") for problem in PROBLEMS]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    for name in PEERS:
        # a round can be slow for all, so a ratio is that of one round
        ratios = [
            median(our / their for our, their in zip(rates[OURS, problem], rates[name, problem])) for problem in PROBLEMS
        ]
        lines.append(f"| *vibroimpact / {name}* | " + " | ".join(f"{ratio:.3g}" for ratio in ratios) + " |")
    return "\n".join(lines)


def wrong_table(arguments: argparse.Namespace) -> str:
    """Starts whose first five events have a time that is missing or off. The times of vibroimpact are the truth."""
    lines = ["| | " + " | ".join(f"{p} | {p}, near grazing" for p in PROBLEMS) + " |", "|---|" + "--:|" * 2 * len(PROBLEMS)]
    names = [name for name in PEERS if name != "heyoka, batch"]
    cells: dict[str, list[str]] = {name: [] for name in names}
    for problem in PROBLEMS:
        for grazing in ([], ["--grazing"]):
            answer = call([arguments.rates, "--starts", problem, arguments.starts, *grazing]).splitlines()
            if not answer:
                for name in names:
                    cells[name].append("-")
                continue
            starts, truths = zip(*(line.split("|") for line in answer))
            with tempfile.NamedTemporaryFile("w", suffix=".txt", delete=False) as file:
                file.write("\n".join(starts) + "\n")
            for name in names:
                command = PEERS[name]
                peer = [arguments.python, SOURCES / "python" / command[0], *command[1:], problem, "--starts", file.name]
                found = [list(map(float, line.split())) for line in call(peer).split("\n")[: len(starts)]]
                wrong = sum(
                    len(times) < 5 or any(abs(a - b) > TOLERANCE for a, b in zip(times, map(float, true.split())))
                    for times, true in zip(found, truths)
                )
                cells[name].append(str(wrong))
            os.unlink(file.name)
    lines += [f"| {name} | " + " | ".join(cells[name]) + " |" for name in names]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--starts", type=int, default=100)
    parser.add_argument("--python", type=Path, default=ROOT / "target/peers/venv/bin/python")
    parser.add_argument("--rates", type=Path, default=ROOT / "target/release/examples/machine_rates")
    parser.add_argument("--page", action="store_true")
    arguments = parser.parse_args()
    rates, wrong = rates_table(arguments), wrong_table(arguments)
    if not arguments.page:
        print(f"Events per second, medians, and medians of the ratios:\n\n{rates}\n")
        print(f"Starts with a wrong event among the first five, of {arguments.starts} each:\n\n{wrong}")
        return
    versions = call([arguments.python, "-c", VERSIONS]).strip()
    text = Template((SOURCES / "performance-machines.md.in").read_text(encoding="utf-8"))
    page = text.substitute(rates=rates, wrong=wrong, starts=arguments.starts, versions=versions, processor=processor())
    (ROOT / "docs/performance-machines.md").write_text(page, encoding="utf-8")


VERSIONS = "import heyoka, scipy, sys; print(f'heyoka {heyoka.__version__}, SciPy {scipy.__version__}, Python {sys.version.split()[0]}')"


def processor() -> str:
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0] if names else 'unknown'}, {os.cpu_count()} processors"


if __name__ == "__main__":
    main()
