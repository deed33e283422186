"""Job scripts and Dask workers on a real Slurm: a cluster of one node, which the tests start and stop."""

import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import vibroimpact as vi

PROGRAMS = ("slurmctld", "slurmd", "munged", "sbatch", "scancel", "scontrol", "sinfo")
#: Seconds that anything here may take.
PATIENCE = 120

CONF = """
ClusterName=vibro
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={home}/munge.socket,cred_expire=5
SlurmctldPort={controller}
SlurmdPort={node}
StateSaveLocation={home}/state
SlurmdSpoolDir={home}/spool
SlurmctldPidFile={home}/slurmctld.pid
SlurmdPidFile={home}/slurmd.pid
SlurmctldLogFile={home}/slurmctld.log
SlurmdLogFile={home}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
NodeName={host} NodeAddr=127.0.0.1 CPUs=3 RealMemory={memory} State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_port() -> int:
    with socket.socket() as of:
        of.bind(("127.0.0.1", 0))
        port: int = of.getsockname()[1]
        return port


def wait(what: str, reached: Callable[[], object], log: Path) -> None:
    end = time.monotonic() + PATIENCE
    while not reached():
        if time.monotonic() > end:
            told = "".join(file.read_text(errors="replace")[-2000:] for file in sorted(log.glob("*.log")))
            pytest.fail(f"{what}: not within {PATIENCE} s\n{told}")
        time.sleep(0.1)


@dataclass(frozen=True)
class Slurm:
    """The cluster, used through its commands."""

    home: Path

    def ask(self, *words: object) -> str:
        return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout

    def submit(self, script: str) -> str:
        """Submit a script as printed. Returns the number of the job."""
        file = self.home / "job.sh"
        file.write_text(script)
        done = subprocess.run(["sbatch", "--parsable", file], cwd=self.home, check=True, capture_output=True, text=True)
        return done.stdout.strip()

    def states(self, job: str) -> dict[int, str]:
        """The state of each task of an array. Waiting tasks have a common entry, which is left out."""
        lines = self.ask("scontrol", "--oneliner", "show", "job", job).splitlines()
        told = [dict(word.partition("=")[::2] for word in line.split()) for line in lines]
        return {int(of["ArrayTaskId"]): of["JobState"] for of in told if of.get("ArrayTaskId", "").isdigit()}

    def wait_for(self, job: str, tasks: int) -> dict[int, str]:
        over = {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL"}
        wait(f"job {job}", lambda: len(of := self.states(job)) == tasks and set(of.values()) <= over, self.home)
        return self.states(job)


@pytest.fixture(scope="module")
def slurm() -> Iterator[Slurm]:
    missing = [name for name in PROGRAMS if shutil.which(name) is None]
    if missing:
        pytest.skip(f"there is no Slurm here ({', '.join(missing)}): apt-get install slurmctld slurmd munge slurm-client")
    if os.geteuid() != 0:
        pytest.skip("a Slurm of one's own needs root")
    with ExitStack() as ends, pytest.MonkeyPatch.context() as patch:
        # a short name, because the path of a socket is limited to about a hundred bytes
        home = Path(ends.enter_context(tempfile.TemporaryDirectory(prefix="slurm-", ignore_cleanup_errors=True)))
        for name in ("state", "spool"):
            (home / name).mkdir()
        host = socket.gethostname().partition(".")[0]
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20
        words = {"host": host, "home": home, "controller": free_port(), "node": free_port(), "memory": memory}
        (home / "slurm.conf").write_text(CONF.format(**words))
        (home / "cgroup.conf").write_text("IgnoreSystemd=yes\n")
        (home / "munge.key").write_bytes(os.urandom(128))
        (home / "munge.key").chmod(0o600)
        patch.setenv("SLURM_CONF", str(home / "slurm.conf"))

        def begin(*command: object) -> subprocess.Popen[bytes]:
            log = ends.enter_context((home / f"{command[0]}-said.log").open("wb"))
            run = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=log, stderr=log)
            ends.callback(end, run)
            return run

        def end(run: "subprocess.Popen[bytes]") -> None:
            run.terminate()
            try:
                run.wait(20)
            except subprocess.TimeoutExpired:
                run.kill()
                run.wait()

        begin("munged", "--foreground", "--force", f"--key-file={home}/munge.key", f"--socket={home}/munge.socket",
              f"--pid-file={home}/munged.pid", f"--log-file={home}/munged.log", f"--seed-file={home}/munge.seed")
        wait("munged", (home / "munge.socket").exists, home)
        begin("slurmctld", "-D", "-i")
        begin("slurmd", "-D")
        cluster = Slurm(home)

        def idle() -> bool:
            told = subprocess.run(["sinfo", "--noheader", "-o", "%T"], capture_output=True, text=True, check=False)
            return told.stdout.strip() == "idle"

        wait("an idle node", idle, home)
        yield cluster
        # jobs must not outlive the cluster
        subprocess.run(["scancel", "--user=root"], check=False)
        wait("no job is left", lambda: not cluster.ask("squeue", "--noheader").strip(), home)


def contents(store: Path) -> dict[str, bytes]:
    return {str(file.relative_to(store)): file.read_bytes() for file in sorted(store.rglob("*")) if file.is_file()}


def script(vibro: Callable[..., Any], plan: Path, store: Path) -> str:
    done = vibro("slurm", plan, "--store", store, "--jobs", 3, "--cpus", 1)
    assert done.returncode == 0, done.stderr
    text: str = done.stdout
    return text


def logs(slurm: Slurm, job: str) -> str:
    return "".join(file.read_text() for file in sorted(slurm.home.glob(f"vibro-{job}_*.log")))


@pytest.mark.parametrize(("tile", "shard"), [(3, None), (1, 3)], ids=["tiles", "shards"])
def test_the_script_runs_as_it_stands(
    slurm: Slurm, vibro: Callable[..., Any], s: vi.Oscillator, tmp_path: Path, tile: int, shard: int | None
) -> None:
    plan = vi.Plan.map(s, {"inverse_beta": "1:1.5:11", "gap": "0:2:9"}, starts=4).with_tiles(tile, shard)
    (tmp_path / "study.toml").write_text(plan.json)
    vi.run(plan, tmp_path / "here.zarr")
    place = tmp_path / "there, too.zarr"
    job = slurm.submit(script(vibro, tmp_path / "study.toml", place))
    assert slurm.wait_for(job, 3) == {1: "COMPLETED", 2: "COMPLETED", 3: "COMPLETED"}, logs(slurm, job)
    assert vi.status(place).complete and contents(place) == contents(tmp_path / "here.zarr")
    # each task has its own log; that of the task that concluded the store has its summary
    said = [file.read_text() for file in slurm.home.glob(f"vibro-{job}_*.log")]
    assert len(said) == 3 and sum("99 points: 11 inverse_beta by 9 gap" in text for text in said) >= 1, said


@pytest.mark.skipif("VIBROIMPACT_LONG" not in os.environ, reason="Slurm lets a task wait for a minute; VIBROIMPACT_LONG=1 runs it")
def test_a_task_puts_itself_into_the_queue_again(
    slurm: Slurm, vibro: Callable[..., Any], s: vi.Oscillator, tmp_path: Path
) -> None:
    plan = vi.Plan.attractors(s, 300, tile=150)
    (tmp_path / "study.toml").write_text(plan.json)
    place = tmp_path / "there.zarr"
    done = vibro("slurm", tmp_path / "study.toml", "--store", place, "--jobs", 1, "--cpus", 1, "--time", "00:10:00",
                 "--memory", "200M", "--throttle", 1, "--setup", "echo begun", "--requeue")
    assert "--budget 540s" in done.stdout, done.stderr
    # each run computes one of the two tiles
    job = slurm.submit(done.stdout.replace("--budget 540s", "--budget 0.000001s"))
    assert slurm.wait_for(job, 1) == {1: "COMPLETED"}, logs(slurm, job)
    assert vi.status(place).complete and logs(slurm, job).count("begun\n") == 2
    vi.run(plan, tmp_path / "here.zarr")
    assert contents(place) == contents(tmp_path / "here.zarr")


@pytest.mark.parametrize("how", [[], ["--signal=KILL", "--full"]], ids=["cancelled", "killed"])
def test_a_task_that_was_ended_is_submitted_again(
    slurm: Slurm, vibro: Callable[..., Any], u: vi.Oscillator, tmp_path: Path, how: list[str]
) -> None:
    plan = vi.Plan.lyapunov(u, {"gap": "2.5:3:60"}, impacts=150_000, tile=1)
    (tmp_path / "study.toml").write_text(plan.json)
    place = tmp_path / "there.zarr"
    text = script(vibro, tmp_path / "study.toml", place)
    job = slurm.submit(text)

    def begun() -> bool:
        if not (place / "zarr.json").exists():
            return False
        missing = vi.status(place).missing
        return any(tile not in missing for tile in range(1, 60, 3))

    wait("a tile of the second task", begun, slurm.home)
    slurm.ask("scancel", *how, f"{job}_2")
    states = slurm.wait_for(job, 3)
    assert (states[1], states[3]) == ("COMPLETED", "COMPLETED") and states[2] != "COMPLETED", logs(slurm, job)
    far = vi.status(place)
    assert not far.complete and far.missing and {tile % 3 for tile in far.missing} == {1}
    again = slurm.submit(text)
    assert set(slurm.wait_for(again, 3).values()) == {"COMPLETED"}, logs(slurm, again)
    vi.run(plan, tmp_path / "here.zarr")
    assert vi.status(place).complete and contents(place) == contents(tmp_path / "here.zarr")


@pytest.mark.filterwarnings("ignore")
def test_workers_of_dask_jobqueue(slurm: Slurm, s: vi.Oscillator, tmp_path: Path) -> None:
    jobqueue = pytest.importorskip("dask_jobqueue")
    distributed = pytest.importorskip("distributed")
    plan = vi.Plan.map(s, {"inverse_beta": "1:1.5:11", "gap": "0:2:9"}, starts=4, tile=3)
    vi.run(plan, tmp_path / "here.zarr")
    with jobqueue.SLURMCluster(
        cores=1, processes=1, memory="500MB", walltime="00:10:00", python=sys.executable, interface="lo",
        local_directory=str(tmp_path), log_directory=str(slurm.home), scheduler_options={"dashboard_address": ":0"},
    ) as cluster:
        cluster.scale(jobs=2)
        with distributed.Client(cluster) as client:
            client.wait_for_workers(2, timeout=PATIENCE)
            inside = client.run(lambda: os.environ.get("SLURM_JOB_ID"))
            assert len(set(inside.values())) == 2 and None not in inside.values()
            ran = vi.dask.run(plan, tmp_path / "there.zarr", client)
    assert (ran.computed, ran.left) == (12, 0) and contents(tmp_path / "there.zarr") == contents(tmp_path / "here.zarr")
