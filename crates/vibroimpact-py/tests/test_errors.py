"""Invalid questions are refused with a QuestionError with the message of the command, or with a TypeError."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi

GOOD = {"inverse_beta": 1.3, "gap": 0.75, "restitution": 0.5}
MACHINE = {"mass": 2, "stiffness": 800, "force": 4, "omega": 25, "gap": 0.01, "restitution": 0.5}
BALL, HAMMER = (vi.Machine.named(name) for name in ("bouncing-ball", "two-mass-hammer"))


@pytest.mark.parametrize(
    ("change", "flags"),
    [
        ({"restitution": 1.4}, ["--restitution", 1.4]),
        ({"inverse_beta": 0.0}, ["--inverse-beta", 0]),
        ({"inverse_beta": math.nan}, ["--inverse-beta", "nan"]),
        ({"inverse_beta": None, "beta": -2.0}, ["--beta", -2]),
        ({"gap": math.inf}, ["--gap", "inf"]),
        ({"damping": -0.1}, ["--damping", -0.1]),
        ({"second_gap": -0.75}, ["--second-gap", -0.75]),
        ({"inverse_beta": None}, []),
    ],
)
def test_oscillators_in_the_words_of_the_command(
    vibro: Callable[..., Any], change: dict[str, Any], flags: list[Any]
) -> None:
    with pytest.raises(vi.QuestionError) as refusal:
        vi.Oscillator(**{**GOOD, **change})
    given = {**{f"--{name.replace('_', '-')}": value for name, value in {**GOOD, **change}.items()}}
    words = [word for flag, value in given.items() if value is not None and flag not in flags for word in (flag, value)]
    said = vibro("settle", *words, *flags)
    # the message is the same; a hint names flags in the command and arguments in Python
    sentence, _, hint = str(refusal.value).partition("\nhint: ")
    assert said.returncode == 2 and said.stderr.strip().partition("\nhint: ")[0] == f"error: {sentence}"
    assert "--" not in hint


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda osc: vi.Oscillator(beta=1, inverse_beta=1, gap=0, restitution=0.5), "the frequency is given twice"),
        (lambda osc: vi.Oscillator(**GOOD, second_restitution=0.5), "the second stop has a restitution but no gap"),
        (lambda osc: vi.Units(length_m=0, time_s=1, mass_kg=1), "length_m = 0 lies outside"),
        (lambda osc: vi.Oscillator.from_units(**{**MACHINE, "mass": -1}), "mass m = -1 kg lies outside"),
        (lambda osc: vi.Oscillator.from_units(**MACHINE, frequency=3), "the frequency is given twice"),
        (lambda osc: vi.Oscillator.from_units(**{**MACHINE, "omega": None}), "the frequency is given nowhere"),
        (lambda osc: vi.simulate(osc).waveform(0), "step = 0 gives"),
        (lambda osc: vi.simulate(osc).waveform(1e-9), "points over a time of .* between 0 and 10000000 are allowed"),
        (lambda osc: vi.settle_many(osc, [0.0, 3.0]), r"start x = 3 lies beyond the stop.*\(start 1\)"),
        (lambda osc: vi.branch(osc, "gup", 1, label="1/1"), "`gup` is no parameter; there are beta, inverse_beta, gap"),
        (lambda osc: vi.curve(osc, "fald", {"gap": (0, 1), "beta": (0.5, 1)}, label="1/1"), "unknown variant `fald`, expected one of `fold`"),
        (lambda osc: vi.curve(osc, "fold", {"gap": (0, 1)}, label="1/1"), "a plane has two parameters, and 1 are given"),
        (lambda osc: vi.region(osc, "1/1", {"gap": "0-1", "beta": (0.5, 1)}), "`0-1` is not a range"),
        (lambda osc: vi.region(osc, "1/1", {"gap": (1, 0), "beta": (0.5, 1)}), "gap from 1 to 0 is no range"),
        (lambda osc: vi.lyapunov(osc, impacts=1000).plot_sections(), "there are no points of the sections"),
        (lambda osc: vi.orbit_diagram(osc, "gap", "0:1"), "range `0:1` is not A:B:N"),
        (lambda osc: vi.response(osc, "gap", np.array([0, 1, 1, 3])), "none of them twice, not 1"),
        (lambda osc: vi.orbit_diagram(osc, "gap", np.zeros((2, 2))), "an axis of shape"),
        (lambda osc: vi.orbit_diagram(osc, "gap", "0:1:3", direction="left"), "direction = `left` is none of up, down, both, scatter"),
        (lambda osc: vi.orbit_diagram(osc, "gap", "0:1:3", show="all"), "show = `all` is none of velocity, strobe"),
        (lambda osc: vi.orbit_diagram(osc, "gap", "0:1:3", seed=1), "starts and seed belong to"),
        (lambda osc: vi.orbit_diagram(osc, "gup", "0:1:3"), "`gup` is no parameter; there are beta"),
        (lambda osc: vi.basin(osc, {"gap": "0.75:1:3"}), "a basin"),
        (lambda osc: vi.basin(osc, x=[0.0, 0.0]), "values"),
        (lambda osc: vi.region_map(osc, {"x": "0:1:3"}), "x"),
        (lambda osc: vi.region_map(osc, {"gup": "0:1:3"}), "`gup` cannot vary; what can is beta"),
        (lambda osc: vi.basin(osc, x="-4:0:5", client="some"), "a client needs a store"),
        (lambda osc: vi.Plan("{}"), "missing field `version`"),
        (lambda osc: vi.Plan('{"version": 1, "system": {"gip": 1}, "task": {}}'), "unknown field `gip`"),
        (lambda osc: vi.simulate(osc).plot(si=True), "si=True needs the system in physical units"),
        (lambda osc: vi.settle(vi.Oscillator(beta=0.5, gap=9, restitution=0.5)).plot(), "has no events to start from"),
        (lambda osc: vi.orbit_diagram(osc, "gap", "0:3:5").vibro.plot(colour="velocity"), "only basins and maps have colours"),
        (lambda osc: BALL.curve("fold", {"Gamma": (0.2, 3)}), "a plane has two"),
        (lambda osc: BALL.curve("folds", {"Gamma": (0.2, 3), "e": (0.3, 0.8)}), "unknown variant"),
        (lambda osc: vi.Plan.basin(HAMMER, {"q.head": "0:1:2"}, x=0.5), "x is no part of the start"),
        (lambda osc: vi.basin(HAMMER, {"q.tail": "0:1:3"}), "q.NAME, qdot.NAME or phase"),
        (lambda osc: vi.Plan.lyapunov(HAMMER, {"frequency": "0.8:1.2:3"}, x=1), "x is no part of the start"),
        (lambda osc: vi.Plan.lyapunov(HAMMER, {"q.tail": "0:1:3"}), "q.tail"),
        (lambda osc: vi.orbit_diagram(HAMMER, "frequency", "1:1.2:5", show="velocity"), "nothing that a diagram of a machine shows"),
        (lambda osc: HAMMER.settle_many(starts={"q.tail": [0, 1]}), "starts has no coordinate `q.tail`"),
        (lambda osc: HAMMER.settle_many(over={"stop.anvil.gup": [0, 1]}), "no such number"),
        (lambda osc: vi.settle_many(osc, over={"gap": [0.5, 1.0]}).vibro.plot(), "the points differ in gap only"),
        (lambda osc: vi.margins(osc, vary=["gap"], scale={"damping": 1.0}), "the scale of damping has no effect"),
        (lambda osc: vi.margins(osc, vary=["mass"]), "`mass` is no parameter"),
        (lambda osc: vi.region_map(osc, {"gap": [0.5, 0.75]}, fields="power"), "a list of names"),
        (lambda osc: vi.region_map(osc, {"gap": [0.5, 0.75]}, fields=["speed"]), "`speed` is no quantity"),
        (lambda osc: vi.Oscillator.from_units(**MACHINE).replace(mass_kg=-1), "mass m = -1 kg lies outside"),
        (lambda osc: vi.Oscillator.from_units(**MACHINE, damping=1, damping_ratio=0.1), "two forms of one number"),
        (lambda osc: vi.response(osc, "force_n", "1:2:3"), "nondimensional"),
        (lambda osc: vi.span(0, 1, 0), "asks for 0 values"),
        (lambda osc: vi.span(0, 1, -1), "count = -1 lies outside 1 <= count"),
        (lambda osc: osc.replace(gap_m=0.004), "gap_m needs the system in physical units"),
    ],
)
def test_questions_that_make_no_sense(s: vi.Oscillator, ask: Callable[[vi.Oscillator], Any], sentence: str) -> None:
    with pytest.raises(vi.QuestionError, match=sentence):
        ask(s)
    assert issubclass(vi.QuestionError, ValueError)


def test_what_an_error_knows() -> None:
    with pytest.raises(vi.QuestionError) as refusal:
        vi.Oscillator(**{**GOOD, "restitution": 1.4})
    found = refusal.value
    assert (found.name, found.given, found.least, found.most) == ("restitution", 1.4, 0.0, 1.0)
    assert found.hint == "eps is the ratio of velocities, not of energies"
    with pytest.raises(vi.QuestionError) as refusal:
        vi.Oscillator.from_units(**{**MACHINE, "mass": -1})
    found = refusal.value
    assert (found.given, found.least, found.most) == (-1.0, 0.0, math.inf) and found.name is not None and "mass" in found.name
    with pytest.raises(vi.QuestionError) as refusal:
        vi.Oscillator(gap=1, restitution=0.5)
    assert refusal.value.name is None and refusal.value.least is None and refusal.value.hint


@pytest.mark.parametrize(
    "ask",
    [
        lambda osc: vi.Oscillator(**GOOD, gup=1),
        lambda osc: vi.Oscillator(1.3, 0.75, 0.5),
        lambda osc: vi.Oscillator(inverse_beta=1.3, gap="0.75", restitution=0.5),
        lambda osc: vi.Oscillator(inverse_beta=1.3, gap=0.75),
        lambda osc: vi.settle("osc"),
        lambda osc: vi.settle(osc, 0.5),
        lambda osc: vi.settle_many(osc, ["a"]),
        lambda osc: vi.settle_many(osc, [1j]),
        lambda osc: vi.attractors(osc, starts=2.5),
        lambda osc: vi.attractors(osc, progress=3),
        lambda osc: vi.region(osc, "1/1", [("gap", 0, 1)]),
    ],
)
def test_wrong_types_and_keywords(s: vi.Oscillator, ask: Callable[[vi.Oscillator], Any]) -> None:
    with pytest.raises(TypeError):
        ask(s)
