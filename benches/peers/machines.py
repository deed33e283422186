#!/usr/bin/env python3
"""Machines in vibroimpact, heyoka, SciPy and Siconos: events per second, and starts with a wrong event among the first five.

    python3 benches/peers/machines.py [--rounds N] [--seconds S] [--starts N] [--python PATH] [--rates PATH] [--page]

It prints two tables in Markdown; with `--page` it writes docs/performance-machines.md, whose text is in
`performance-machines.md.in`. `--python` is an interpreter with heyoka and SciPy (that of run.py in target/peers by
default), `--rates` the example `machine_rates` of the core, built with --release. Siconos takes part if its C++ headers are
installed and g++ is; the program lies in target/peers/bin. The contenders take turns.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
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
SICONOS = {
    "Siconos, EventDriven, rtol 1e-9": ["events", "1e-9"],
    "Siconos, EventDriven, rtol 1e-12": ["events", "1e-12"],
    "Siconos, time stepping, T/1000": ["steps", "1000"],
    "Siconos, time stepping, T/10000": ["steps", "10000"],
}
SICONOS_HEADERS = [Path("/usr/include/siconos"), Path("/usr/local/include/siconos")]
SICONOS_LIBRARIES = ["-lsiconos_kernel", "-lsiconos_numerics", "-lsiconos_externals"]
VERSIONS = "import heyoka, scipy, sys; print(f'heyoka {heyoka.__version__}, SciPy {scipy.__version__}, Python {sys.version.split()[0]}')"
COMPILE = "g++ -O3 -march=native -std=c++17 -Wall -Wextra"
OURS = "vibroimpact, one motion"
TOLERANCE = 1e-6
SETTINGS = {"default": [], "--tol 1e-9": ["--tol", "1e-9"], "--compact": ["--compact"]}

Command = list[object]


def call(command: Command) -> str:
    return subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True, timeout=1200).stdout


def rate(command: Command) -> float | None:
    """None where the peer does not treat the problem."""
    found = json.loads(call(command))["rate"]
    return None if found is None else float(found)


def build_siconos() -> Path | None:
    """The program that calls Siconos, or None where it cannot be compiled."""
    headers = next((folder for folder in SICONOS_HEADERS if (folder / "kernel/SiconosKernel.hpp").exists()), None)
    if headers is None or shutil.which("g++") is None:
        return None
    program = ROOT / "target/peers/bin/machine_siconos"
    program.parent.mkdir(parents=True, exist_ok=True)
    folders = [word for folder in (headers, headers / "kernel", headers / "numerics") for word in ("-isystem", folder)]
    call([*COMPILE.split(), *folders, "-o", program, SOURCES / "c/machine_siconos.cpp", *SICONOS_LIBRARIES])
    return program


def contenders(python: Path, siconos: Path | None) -> dict[str, Command]:
    peers: dict[str, Command] = {name: [python, SOURCES / "python" / file, *words] for name, (file, *words) in PEERS.items()}
    if siconos is not None:
        peers |= {name: [siconos, *words] for name, words in SICONOS.items()}
    return peers


def best_settings(peers: dict[str, Command]) -> dict[tuple[str, str], list[str]]:
    """The fastest settings of heyoka for each problem, by a short run of each."""
    chosen = {}
    for name, peer in peers.items():
        for problem in PROBLEMS:
            if not name.startswith("heyoka"):
                chosen[name, problem] = []
                continue
            rates = {key: rate([*peer, *words, problem, 0.3]) or 0.0 for key, words in SETTINGS.items()}
            chosen[name, problem] = SETTINGS[max(rates, key=rates.__getitem__)]
    return chosen


def rates_table(arguments: argparse.Namespace, peers: dict[str, Command]) -> str:
    settings = best_settings(peers)
    rates: dict[tuple[str, str], list[float]] = {(name, problem): [] for name in [*peers, OURS] for problem in PROBLEMS}
    for _ in range(arguments.rounds):
        for problem in PROBLEMS:
            for name, peer in peers.items():
                answer = rate([*peer, *settings[name, problem], problem, arguments.seconds])
                if answer is not None:
                    rates[name, problem].append(answer)
            # about as long as the others
            events = max(2000, int(arguments.seconds * 2e5))
            found = float(re.findall(r"([0-9]+) per second", call([arguments.rates, events, problem]))[0])
            rates[OURS, problem].append(found)

    def row(name: str, values: dict[str, list[float]], form: str) -> str:
        cells = [format(median(values[problem]), form).replace(",", " ") if values[problem] else "-" for problem in PROBLEMS]
        return f"| {name} | " + " | ".join(cells) + " |"

    lines = ["| | " + " | ".join(PROBLEMS.values()) + " |", "|---|" + "--:|" * len(PROBLEMS)]
    lines += [row(name, {problem: rates[name, problem] for problem in PROBLEMS}, ",.0f") for name in [*peers, OURS]]
    for name in peers:
        # a round can be slow for all, so a ratio is that of one round
        ratios = {
            problem: [our / their for our, their in zip(rates[OURS, problem], rates[name, problem])] for problem in PROBLEMS
        }
        lines.append(row(f"*vibroimpact / {name}*", ratios, ".3g"))
    return "\n".join(lines)


def wrong_table(arguments: argparse.Namespace, peers: dict[str, Command]) -> str:
    """Starts whose first five events have a time that is missing or off. The times of vibroimpact are the truth."""
    lines = ["| | " + " | ".join(f"{p} | {p}, near grazing" for p in PROBLEMS) + " |", "|---|" + "--:|" * 2 * len(PROBLEMS)]
    names = [name for name in peers if name != "heyoka, batch"]
    cells: dict[str, list[str]] = {name: [] for name in names}
    # median errors of the first event, of Siconos
    errors: dict[str, list[str]] = {name: [] for name in names if name in SICONOS}
    for problem, title in PROBLEMS.items():
        for grazing in ([], ["--grazing"]):
            answer = call([arguments.rates, "--starts", problem, arguments.starts, *grazing]).splitlines()
            if not answer:
                for name in names:
                    cells[name].append("-")
                continue
            starts, rest = zip(*(line.split("|") for line in answer))
            truths = [list(map(float, line.split())) for line in rest]
            with tempfile.NamedTemporaryFile("w", suffix=".txt", delete=False) as file:
                file.write("\n".join(starts) + "\n")
            for name in names:
                lines_found = call([*peers[name], problem, "--starts", file.name]).split("\n")[:-1]
                if not lines_found:
                    cells[name].append("-")
                    continue
                found = [list(map(float, line.split())) for line in lines_found[: len(starts)]]
                wrong = sum(
                    len(times) < 5 or any(abs(a - b) > TOLERANCE for a, b in zip(times, true))
                    for times, true in zip(found, truths)
                )
                cells[name].append(str(wrong))
                if name in errors and not grazing:
                    first = [abs(times[0] - true[0]) for times, true in zip(found, truths) if times]
                    errors[name].append(f"{median(first):.1e} ({title})")
            os.unlink(file.name)
    lines += [f"| {name} | " + " | ".join(cells[name]) + " |" for name in names]
    if errors:
        lines += ["", "Median error of the time of the first event, starts not near grazing:", ""]
        lines += [f"- {name}: {', '.join(of)}" for name, of in errors.items()]
    else:
        packages = "Debian: libsiconos-kernel-dev, libsiconos-numerics-dev"
        lines += ["", f"Siconos is left out: its C++ headers ({packages}) or g++ were not found."]
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
    peers = contenders(arguments.python, build_siconos())
    rates, wrong = rates_table(arguments, peers), wrong_table(arguments, peers)
    if not arguments.page:
        print(f"Events per second, medians, and medians of the ratios:\n\n{rates}\n")
        print(f"Starts with a wrong event among the first five, of {arguments.starts} each:\n\n{wrong}")
        return
    versions = call([arguments.python, "-c", VERSIONS]).strip()
    text = Template((SOURCES / "performance-machines.md.in").read_text(encoding="utf-8"))
    page = text.substitute(rates=rates, wrong=wrong, starts=arguments.starts, versions=versions, processor=processor())
    (ROOT / "docs/performance-machines.md").write_text(page, encoding="utf-8")


def processor() -> str:
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0] if names else 'unknown'}, {os.cpu_count()} processors"


if __name__ == "__main__":
    main()
