"""Oscillators and units: checked, equal, hashed, pickled, changed."""

import copy
import math
import pickle

import pytest

import vibroimpact as vi

ALL = [
    vi.Oscillator(beta=0.8, gap=1, restitution=0.5),
    vi.Oscillator(inverse_beta=1.8, gap=-0.25, restitution=0),
    vi.Oscillator(inverse_beta=1 / 3, gap=1e-300, restitution=1, damping=0.1),
    vi.Oscillator(beta=1, gap=2, restitution=0.5, second_gap=1),
    vi.Oscillator(beta=1, gap=2, restitution=0.5, second_gap=1, second_restitution=0.25),
    vi.Oscillator.from_units(mass=2, stiffness=800, force=4, frequency=2.5, gap=0.003, restitution=0.6, damping=1.5),
]


@pytest.mark.parametrize("osc", ALL, ids=repr)
def test_it_is_what_its_text_and_its_pickle_say(osc: vi.Oscillator) -> None:
    for other in (eval(repr(osc), vars(vi)), pickle.loads(pickle.dumps(osc)), copy.deepcopy(osc), osc.replace()):
        assert other == osc and hash(other) == hash(osc) and repr(other) == repr(osc)
        assert other.inverse_beta == osc.inverse_beta and other.units == osc.units
    assert len({*ALL, osc}) == len(ALL)
    assert osc != "oscillator" and osc != osc.replace(gap=osc.gap + 1, units=osc.units)


def test_properties_are_the_parameters() -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5, damping=0.02, second_gap=3, second_restitution=0.25)
    assert (osc.inverse_beta, osc.beta, osc.gap, osc.restitution) == (1.3, 1 / 1.3, 0.75, 0.5)
    assert (osc.damping, osc.second_gap, osc.second_restitution, osc.units) == (0.02, 3, 0.25, None)
    assert osc.period == 2 * math.pi / osc.beta
    amplitude = 1 / math.hypot(1 - osc.beta**2, 2 * 0.02 * osc.beta)
    assert math.isclose(osc.free_amplitude, amplitude, rel_tol=1e-14)
    assert math.isinf(vi.Oscillator(beta=1, gap=0, restitution=0.5).free_amplitude)


def test_nothing_can_be_changed_in_place() -> None:
    osc = vi.Oscillator(beta=1, gap=2, restitution=0.5)
    with pytest.raises(AttributeError):
        osc.gap = 3  # type: ignore[misc]
    with pytest.raises(AttributeError):
        osc.units = None  # type: ignore[misc]


def test_replace_takes_the_keywords_of_the_oscillator() -> None:
    osc = vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5, second_gap=3, second_restitution=0.25)
    assert osc.replace(beta=2).beta == 2 and osc.replace(beta=2).inverse_beta == 0.5
    assert osc.replace(inverse_beta=1.7).inverse_beta == 1.7
    assert osc.replace(second_gap=None) == vi.Oscillator(inverse_beta=1.3, gap=0.75, restitution=0.5)
    assert osc.replace(gap=1).second_restitution == 0.25
    with pytest.raises(TypeError, match="gup"):
        osc.replace(gup=1)


def test_units_lead_there_and_back() -> None:
    osc = vi.Oscillator.from_units(mass=2, stiffness=800, force=4, omega=25, gap=0.010, restitution=0.5, second_gap=0.02)
    # 25 rad/s over sqrt(800/2) = 20 rad/s; 10 mm over 4/800 m = 5 mm
    assert (osc.beta, osc.gap, osc.second_gap, osc.damping) == (1.25, 2.0, 4.0, 0.0)
    assert osc.units == vi.Units(length_m=0.005, time_s=0.05, mass_kg=2) and osc.units is not None
    assert osc.units.velocity_m_per_s == 0.005 / 0.05
    assert pickle.loads(pickle.dumps(osc.units)) == osc.units and len({osc.units, osc.replace(gap_m=0.005).units}) == 1
    hertz = vi.Oscillator.from_units(
        mass=2, stiffness=800, force=4, frequency=25 / (2 * math.pi), gap=0.010, restitution=0.5, damping=8
    )
    assert math.isclose(hertz.beta, 1.25, rel_tol=1e-15) and math.isclose(hertz.damping, 0.1, rel_tol=1e-15)
    assert osc != vi.Oscillator(beta=1.25, gap=2, restitution=0.5, second_gap=4)
