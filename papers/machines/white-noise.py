"""Impacts per unit time of an oscillator that white noise drives against an elastic stop, compared with the closed form.

    python white-noise.py [SAMPLES [FIGURE]]

The noise is a sum of harmonics of one low frequency with equal amplitudes and random phases. Each sample is one period of it, after
another one in which the start is forgotten. Needs numpy and vibroimpact, and matplotlib for the figure.
"""

import math
import sys

import numpy as np

import vibroimpact as vi

SAMPLES = int(sys.argv[1]) if len(sys.argv) > 1 else 100
DAMPING = 0.05  # the damping ratio; mass and stiffness are 1
SPACING, HIGHEST = 0.01, 16.0  # frequencies of the harmonics
orders = np.arange(1, round(HIGHEST / SPACING) + 1)
rates = SPACING * orders
# the standard deviation of the motion without a stop is 1
gain = 1 / np.hypot(1 - rates**2, 2 * DAMPING * rates)
amplitude = math.sqrt(2 / np.sum(gain**2))
period = 2 * math.pi / SPACING


def impacts(distance: float, seed: int) -> int:
    """Impacts with the stop in one period of the noise."""
    phases = np.random.default_rng(seed).uniform(0, 2 * math.pi, len(orders))
    machine = vi.Machine(
        coordinates=["mass"],
        mass=[1],
        stiffness=[1],
        damping=[2 * DAMPING],
        frequency=SPACING,
        forces=[
            {"order": int(order), "cos": [amplitude * math.cos(phase)], "sin": [amplitude * math.sin(phase)]}
            for order, phase in zip(orders, phases)
        ],
        stops={"stop": {"direction": [1], "gap": distance, "restitution": 1}},
    )
    start = min(0.0, distance - 1)
    motion = machine.simulate(q=[start], periods=2)
    return int(np.sum((motion.kind == "impact") & (motion.time > period)))


def closed_form(distance: float) -> float:
    density = math.exp(-(distance**2) / 2) / math.sqrt(2 * math.pi)
    share = 0.5 * (1 + math.erf(distance / math.sqrt(2)))
    return density / (share * math.sqrt(2 * math.pi))


print("distance  impacts  per unit time      closed form")
found = []
for distance in (-0.5, 0.0, 0.5, 1.0, 2.0):
    counts = [impacts(distance, seed) for seed in range(SAMPLES)]
    rate = np.mean(counts) / period
    error = np.std(counts, ddof=1) / math.sqrt(SAMPLES) / period
    found.append((distance, rate, error))
    print(f"{distance:8} {sum(counts):8}  {rate:.4f} +- {error:.4f}  {closed_form(distance):.4f}")

if len(sys.argv) > 2:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(5, 3.2), layout="constrained")
    distances = np.linspace(-1, 2.5, 200)
    axes.plot(distances, [closed_form(float(distance)) for distance in distances], label="closed form", color="#777777")
    x, y, error = np.transpose(found)
    axes.errorbar(x, y, 2 * error, fmt="o", markersize=4, capsize=3, color="#0072b2", label="simulation, two standard errors")
    axes.set(xlabel="distance of the stop / standard deviation", ylabel="impacts per unit time", ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(sys.argv[2], dpi=120)
