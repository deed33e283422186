"""Margins: their attributes and their figure."""

import pytest

import vibroimpact as vi


def test_the_bars_end_at_the_events() -> None:
    found = vi.margins(vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5), label="1/1", lines=4)
    ax = found.plot()
    ends = [(of, end) for of in found.parameters.values() for end in (of.down, of.up)]
    changes = [((end.limit if end.at is None else end.at) - of.value) / of.scale for of, end in ends]
    bars = [path.vertices[:, 0] for of in ax.collections for path in of.get_paths()]
    assert sorted(max(xs.min(), xs.max(), key=abs) for xs in bars) == pytest.approx(sorted(changes))
    assert [text.get_text() for text in ax.texts] == [f"{end.at:.6g}" for _, end in ends if end.at is not None]
    sides = [line.get_xdata()[0] for line in ax.get_lines() if line.get_linestyle() == "--" and len(line.get_xdata())]
    assert found.box is not None and sides == [-found.box.size, found.box.size]
    chaotic = vi.margins(vi.Oscillator(inverse_beta=1.11, gap=3, restitution=0.5))
    with pytest.raises(vi.QuestionError, match="the motion `chaotic` is not periodic, so it has no margins to draw"):
        chaotic.plot()
    assert "<img" not in chaotic._repr_html_()


def test_scales_and_refusals() -> None:
    osc = vi.Oscillator(beta=0.9, gap=1.5, restitution=0.5)
    found = vi.margins(osc, scale={"gap": 0.1})
    assert found.parameters["gap"].scale == 0.1 and found.parameters["beta"].scale == 0.9
    assert vi.margins(osc.replace(gap=3.0, inverse_beta=1.11)).box is None
    with pytest.raises(TypeError, match="is not a list of numbers"):
        vi.margins(osc, vary="gap")


def test_margins_of_a_machine_are_those_of_the_oscillator() -> None:
    osc = vi.Oscillator(inverse_beta=1.11, gap=1.5, restitution=0.5, damping=0.01)
    gap = "stop.anvil.gap"
    machine = vi.Machine(
        coordinates=["x"], mass=[1], damping=[0.02], stiffness=[1], frequency=1 / 1.11,
        forces=[{"at": "x", "sin": 1}], stops={"anvil": {"at": "x", "gap": 1.5, "restitution": 0.5}},
    )
    alone, found = vi.margins(osc, label="1/1", vary=["gap"]), machine.margins(label="1/1", vary=[gap])
    for way in ("down", "up"):
        one, two = getattr(alone.parameters["gap"], way), getattr(found.parameters[gap], way)
        assert (one.event is None) == (two.event is None) and one.limit == two.limit, way
        if one.event is not None:
            assert one.event["kind"] == two.event["kind"] and abs(one.at - two.at) < 1e-9
    assert found.box is None and found.system == machine and found.motion.label == "1/1"
    assert found.nearest is not None and found.nearest.parameter == gap
    ax = found.plot()
    assert "1/1" in ax.get_title() and len(found.to_dataframe()) == 2
    with pytest.raises(TypeError, match="not a list of numbers"):
        machine.margins(vary=gap)
