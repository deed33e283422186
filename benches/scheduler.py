"""The scheduler's side of a large study: tiles that only sleep, on a Dask cluster of one's own.

    target/python/bin/python benches/scheduler.py --tiles 100000 --workers 200 --threads 5

Scheduler, workers and client are processes of their own. The tiles are submitted by the function with which
`vibroimpact.dask.run` submits its tiles. Printed are the processor time that the scheduler and the client need for a tile,
which bound the rate of tiles of any cluster, the largest memory of the scheduler, and how many tasks it had at most.
docs/huge-studies.md quotes them.
"""

import argparse
import asyncio
import json
import logging
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import dask
from distributed import Client, Scheduler, Worker

from vibroimpact._rolling import rolling

#: Seconds of processor time in a tick of /proc.
TICK = 1 / os.sysconf("SC_CLK_TCK")
#: A profile of each worker would cost more than the sleeping tasks.
SETTINGS = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.system-monitor.interval": "10 s",
    # all processes share one machine, which may be busy
    "distributed.comm.timeouts.connect": "600 s",
    "distributed.comm.timeouts.tcp": "600 s",
    "distributed.scheduler.worker-ttl": None,
}


def sleep(tile: int, seconds: float) -> int:
    """A tile whose work is done elsewhere."""
    time.sleep(seconds)
    return tile


async def schedule(file: str) -> None:
    async with Scheduler(scheduler_file=file, dashboard=False, dashboard_address=":0", port=0, host="127.0.0.1") as scheduler:
        await scheduler.finished()


async def work(address: str, workers: int, threads: int) -> None:
    """Several workers in one process, because each needs little of it."""
    all_ = [Worker(address, nthreads=threads, dashboard=False, memory_limit=0, local_directory=tempfile.gettempdir()) for _ in range(workers)]
    await asyncio.gather(*all_)
    await asyncio.gather(*(worker.finished() for worker in all_))


@contextmanager
def process(*words: object) -> Iterator[subprocess.Popen[bytes]]:
    """This program as another process, ended afterwards."""
    with subprocess.Popen([sys.executable, __file__, *map(str, words)]) as of:
        try:
            yield of
        finally:
            of.kill()


def processor_time(number: int) -> float:
    """The processor time of a process in seconds."""
    fields = Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) * TICK


def memory(number: int) -> float:
    """The largest memory of a process so far in MB."""
    line = next(line for line in Path(f"/proc/{number}/status").read_text().splitlines() if line.startswith("VmHWM"))
    return int(line.split()[1]) / 1000


def wait_for(file: Path) -> str:
    while not file.exists() or not file.read_text().strip():
        time.sleep(0.05)
    return str(json.loads(file.read_text())["address"])


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--tiles", type=int, default=100_000)
    asked.add_argument("--workers", type=int, default=200)
    asked.add_argument("--threads", type=int, default=5, help="tiles that a worker computes at the same time")
    asked.add_argument("--processes", type=int, default=2, help="processes that hold the workers")
    asked.add_argument("--seconds", type=float, default=1.0, help="duration of a tile")
    asked.add_argument("--in-flight", type=int, default=2000)
    of = asked.parse_args()
    file = Path(tempfile.mkdtemp()) / "scheduler.json"
    with process("schedule", file) as scheduler:
        address, share = wait_for(file), of.workers // of.processes
        with process("work", address, share, of.threads), process("work", address, of.workers - share, of.threads):
            with Client(address) as client:
                client.wait_for_workers(of.workers, timeout=300)
                idle, most = memory(scheduler.pid), 0
                before, own, begun = processor_time(scheduler.pid), time.process_time(), time.monotonic()
                tasks = ((f"tile-{tile}", (tile, of.seconds)) for tile in range(of.tiles))
                done = 0
                for batch in rolling(client, sleep, tasks, of.in_flight, {"retries": 3}):
                    done += len(batch)
                    if done // 10_000 > (done - len(batch)) // 10_000 or done == of.tiles:
                        most = max(most, client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks)))
                        spent = (processor_time(scheduler.pid) - before, time.process_time() - own)
                        report(of, done, time.monotonic() - begun, spent)
                print(f"scheduler: {memory(scheduler.pid):.0f} MB at most, {idle:.0f} MB before the first tile, {most} tasks at most")


def report(of: argparse.Namespace, done: int, took: float, spent: tuple[float, float]) -> None:
    """Print what the tiles so far have cost."""
    costs = ", ".join(f"{who} {1e3 * cost / done:.2f} ms of processor time a tile ({done / cost:.0f} a second)" for who, cost in zip(("scheduler", "client"), spent))
    print(f"{done} tiles of {of.seconds} s on {of.workers} workers with {of.threads} threads in {took:.0f} s: {costs}", flush=True)


if __name__ == "__main__":
    logging.getLogger("distributed").setLevel(logging.ERROR)
    with dask.config.set(SETTINGS):
        if sys.argv[1:2] == ["schedule"]:
            asyncio.run(schedule(sys.argv[2]))
        elif sys.argv[1:2] == ["work"]:
            asyncio.run(work(sys.argv[2], int(sys.argv[3]), int(sys.argv[4])))
        else:
            main()
