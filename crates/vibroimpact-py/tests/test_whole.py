"""Integers out of range: the message of the command, with name, value and range."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

OVER = {"gap": "0.5:1:2"}
#: Call, argument, least and most; None where how many there are is not known beforehand.
ARGUMENTS: list[tuple[Callable[..., Any], str, int, int | None]] = [
    (lambda osc, **of: vi.simulate(osc, **of), "impacts", 1, 10_000_000),
    (lambda osc, **of: vi.settle(osc, **of), "impacts", 1, 1_000_000),
    (lambda osc, **of: vi.response(osc, "gap", "0.5:1.5:3", **of), "impacts", 1, 1_000_000),
    (lambda osc, **of: vi.attractors(osc, **of), "impacts", 1, 1_000_000),
    (lambda osc, **of: vi.attractors(osc, **of), "starts", 1, 1_000_000_000),
    (lambda osc, **of: vi.attractors(osc, **of), "seed", 0, 2**64 - 1),
    (lambda osc, **of: vi.attractors(osc, **of), "threads", 0, 65_535),
    (lambda osc, **of: vi.settle_many(osc, 0.0, **of), "threads", 0, 65_535),
    (lambda osc, **of: vi.lyapunov(osc, **of), "impacts", 1000, 10_000_000),
    (lambda osc, **of: vi.lyapunov(osc, **of), "transient", 0, 1_000_000),
    (lambda osc, **of: vi.lyapunov(osc, **of), "points", 1, 100_000),
    (lambda osc, **of: vi.branch(osc, "gap", 1.0, label="1/1", **of), "orbit", 1, None),
    (lambda osc, **of: vi.branch(osc, "gap", 1.0, label="1/1", **of), "follow", 0, 100),
    (lambda osc, **of: vi.branch(osc, "gap", 1.0, label="1/1", **of), "points", 2, 100_000),
    (lambda osc, **of: vi.curve(osc, "fold", {"gap": (0, 1), "beta": (0.5, 1)}, label="1/1", **of), "orbit", 1, None),
    (lambda osc, **of: vi.curve(osc, "fold", {"gap": (0, 1), "beta": (0.5, 1)}, label="1/1", **of), "event", 1, None),
    (lambda osc, **of: vi.region(osc, "1/1", {"gap": (0, 1), "beta": (0.5, 1)}, **of), "grid", 2, 400),
    (lambda osc, **of: vi.region(osc, "1/1", {"gap": (0, 1), "beta": (0.5, 1)}, **of), "threads", 0, 65_535),
    (lambda osc, **of: vi.region_map(osc, OVER, **of), "starts", 1, 10_000_000),
    (lambda osc, **of: vi.region_map(osc, OVER, **of), "seed", 0, 2**64 - 1),
    (lambda osc, **of: vi.region_map(osc, OVER, **of), "refine", 2, 64),
    (lambda osc, **of: vi.region_map(osc, OVER, **of), "impacts", 1, 1_000_000),
    (lambda osc, **of: vi.region_map(osc, OVER, **of), "tile", 1, 4096),
    (lambda osc, **of: vi.region_map(osc, OVER, **of), "threads", 0, 65_535),
    (lambda osc, **of: vi.basin(osc, x="-1:0:2", **of), "refine", 2, 64),
    (lambda osc, **of: vi.basin(osc, x="-1:0:2", **of), "impacts", 1, 1_000_000),
    (lambda osc, **of: vi.orbit_diagram(osc, "gap", "0:1:3", **of), "transient", 0, 1_000_000),
    (lambda osc, **of: vi.orbit_diagram(osc, "gap", "0:1:3", **of), "keep", 1, 100_000),
    (lambda osc, **of: vi.orbit_diagram(osc, "gap", "0:1:3", direction="scatter", **of), "starts", 1, 1_000_000_000),
    (lambda osc, **of: vi.orbit_diagram(osc, "gap", "0:1:3", direction="scatter", **of), "seed", 0, 2**64 - 1),
    (lambda osc, **of: vi.Plan.lyapunov(osc, OVER, **of), "impacts", 1000, 10_000_000),
    (lambda osc, **of: vi.Plan.lyapunov(osc, OVER, **of), "transient", 0, 1_000_000),
    (lambda osc, **of: vi.Plan.attractors(osc, 5, **of), "seed", 0, 2**64 - 1),
    (lambda osc, **of: vi.run(vi.Plan.attractors(osc, 5), "no-store", **of), "threads", 0, 65_535),
    (lambda osc, **of: vi.resume("no-store", **of), "threads", 0, 65_535),
    (lambda osc, **of: vi.verify("no-store", **of), "threads", 0, 65_535),
    (lambda osc, **of: vi.verify("no-store", **of), "sample", 0, 2**64 - 1),
    (lambda osc, **of: vi.verify("no-store", **of), "seed", 0, 2**64 - 1),
]


def ids(of: Any) -> str:
    return of if isinstance(of, str) else ""


@pytest.mark.parametrize(("ask", "name", "least", "most"), ARGUMENTS, ids=ids)
def test_f11_whole_numbers_are_refused_by_name(
    s: vi.Oscillator, ask: Callable[..., Any], name: str, least: int, most: int | None
) -> None:
    for value in (-1, -(2**70), 2**70, np.int64(-7)):
        upper = "" if most is None else f" <= {most}"
        with pytest.raises(vi.QuestionError) as refusal:
            ask(s, **{name: value})
        assert str(refusal.value) == f"{name} = {value} lies outside {least} <= {name}{upper}"
    with pytest.raises(TypeError, match=f"{name} = 2.5 is not a whole number"):
        ask(s, **{name: 2.5})
    # errors of the compiled module name the same range
    for value in (least - 1, None if most is None else most + 1):
        if value is None or value < 0 or (value == 0 and name in ("orbit", "event")):
            continue
        with pytest.raises(vi.QuestionError, match=f"^{name} = {value} lies outside {least} <= {name}{upper}") as refusal:
            ask(s, **{name: value})
        found = refusal.value
        assert (found.name, found.given, found.least) == (name, value, least) and found.most in (most, None)


def test_f11_parts_that_are_none(s: vi.Oscillator, tmp_path: Path) -> None:
    plan = vi.Plan.attractors(s, 5)
    for part in ((-1, 3), (1, -3), (4, 3), (0, 0), (1, 2**70)):
        with pytest.raises(vi.QuestionError, match=f"^tiles {part[0]}/{part[1]} is no part of a whole: I/N needs 1 <= I <= N$"):
            vi.run(plan, tmp_path / "store", part=part)
    for wrong in (3, (1,), (1.0, 3), ("1", "3")):
        with pytest.raises(TypeError, match=r"is not \(i, n\), two whole numbers"):
            vi.run(plan, tmp_path / "store", part=wrong)  # type: ignore[arg-type]
    assert not (tmp_path / "store").exists()
