"""Whether points lie in a region, of an oscillator and of machines."""

import numpy as np

import vibroimpact as vi


def test_a_machine_that_is_an_oscillator_has_its_regions() -> None:
    machine = vi.Machine.named("fukaya-irie-1971")
    found = machine.region("1/1", {"inverse_beta": (0.6, 0.95), "delta": (0.5, 3)}, grid=5)
    osc = vi.Oscillator(beta=1, gap=0, restitution=0.5)
    known = vi.region(osc, "1/1", {"inverse_beta": (0.6, 0.95), "gap": (0.5, 3)}, grid=5)
    inverses, gaps = np.meshgrid(np.linspace(0.607, 0.943, 20), np.linspace(0.53, 2.97, 20))
    for own, other in ((found.existence, known.existence), (found.stability, known.stability)):
        np.testing.assert_array_equal(own.contains(inverses, gaps), other.contains(inverses, gaps))
    assert found.parameters == ("inverse_beta", "delta") and found.system is machine
    assert found.existence.contains(inverses[:1].T, gaps[:, 0]).shape == (20, 20)
    hammer = vi.Machine.named("two-mass-hammer")
    # a plane in which it is stable everywhere: the outline of an edge takes ten seconds
    other = hammer.region("1/1", {"frequency": (1.1, 1.2), "stop.anvil.gap": (0.48, 0.52)}, grid=2)
    assert other.stability.contains(1.15, 0.5) and not other.stability.contains(1.02, 0.5)
