"""Long work: the lock of the interpreter is released, Ctrl-C stops it, progress is reported."""

import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi


def test_other_threads_go_on(u: vi.Oscillator) -> None:
    ticks, over = 0, threading.Event()

    def tick() -> None:
        nonlocal ticks
        while not over.is_set():
            ticks += 1
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        before, begin = ticks, time.perf_counter()
        vi.lyapunov(u, impacts=1_000_000)
        during, seconds = ticks - before, time.perf_counter() - begin
    finally:
        over.set()
        thread.join()
    # the work must take some time; if the lock were held, there would be no tick at all
    assert seconds > 0.1 and during > 20 * seconds


@pytest.mark.parametrize(
    "question",
    [
        "vi.lyapunov(u, impacts=10_000_000)",
        "vi.attractors(u, starts=10_000_000)",
        "vi.settle_many(u, np.linspace(-4, 3, 3_000_000))",
        "vi.simulate(u, impacts=10_000_000)",
        "vi.orbit_diagram(u, 'gap', '0:3:20000', transient=100_000)",
    ],
)
def test_ctrl_c_is_heard(question: str) -> None:
    program = f"""
import time
import numpy as np
import signal
import vibroimpact as vi
u = vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5)
print("ready", flush=True)
# where the tests run in the background of a shell, Ctrl-C would be ignored
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    {question}
    print("done", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    print(vi.settle(u).label, flush=True)
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None and run.stdout.readline() == "ready\n"
        time.sleep(0.3)
        begin = time.perf_counter()
        run.send_signal(signal.SIGINT)
        answer, seconds = run.stdout.readline(), time.perf_counter() - begin
        rest = run.stdout.read()
        assert (answer, rest, run.wait(60)) == ("interrupted\n", "chaotic\n", 0)
        assert seconds < 5


def test_progress_rises_to_the_end(s: vi.Oscillator) -> None:
    seen: list[tuple[int, int]] = []
    vi.settle_many(s, np.linspace(-4, 0.75, 200_000), progress=lambda done, total: seen.append((done, total)))
    done = [k for k, _ in seen]
    assert done == sorted(done) and seen[-1] == (200_000, 200_000) and {total for _, total in seen} == {200_000}


def test_a_callback_may_stop_the_work(u: vi.Oscillator) -> None:
    with pytest.raises(vi.StoppedError, match=r"stopped after \d+ of 1000000 points"):
        vi.attractors(u, starts=1_000_000, progress=lambda done, total: False)

    def fails(done: int, total: int) -> None:
        raise ZeroDivisionError("mine")

    with pytest.raises(ZeroDivisionError, match="mine"):
        vi.settle_many(u, np.linspace(-4, 3, 1_000_000), progress=fails)


def test_a_bar_of_tqdm(s: vi.Oscillator, capfd: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    vi.attractors(s, starts=5000, progress=True)
    assert "5.00k/5.00k" in capfd.readouterr().err


def test_without_tqdm_there_is_a_word(s: vi.Oscillator, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with pytest.warns(UserWarning, match="pip install tqdm"):
        assert len(vi.attractors(s, progress=True)) == 2


def test_questions_from_many_threads_at_once(s: vi.Oscillator) -> None:
    expected = vi.attractors(s, starts=2000).motions
    found: list[object] = []
    threads = [threading.Thread(target=lambda: found.append(vi.attractors(s, starts=2000).motions)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


def test_there_is_one_door(root: Path) -> None:
    sources = (root / "crates/vibroimpact-py/src").glob("*.rs")
    words = (".detach(", "thread::", "check_signals")
    assert {file.name for file in sources if any(word in file.read_text() for word in words)} == {"door.rs"}
