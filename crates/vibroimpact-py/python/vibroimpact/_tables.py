"""Colours of series, and groups of motions in the order of a legend.

Written by crates/vibroimpact-report/tests/tables.rs; do not edit.
"""

import math

SERIES = (
    "#0072b2",
    "#d55e00",
    "#009e73",
    "#cc79a7",
    "#e69f00",
    "#56b4e9",
    "#000000",
    "#f0e442",
)

CLASSES = {
    "0": "#f2eecb",
    "1/1": "#9ad6ee",
    "2/1": "#3fa0d0",
    "3/1": "#1a6fb0",
    "4/1": "#173f86",
    "m/1": "#2b1b57",
    "1/2": "#f2a71b",
    "1/3": "#d9601a",
    "1/n": "#9a2f0e",
    "k/k": "#d3e27a",
    "3/2": "#0b8f62",
    "m/n": "#7fd0a0",
    "inf/n": "#ee94bb",
    "chaotic": "#101010",
    "stuck": "#5e4636",
    "undecided": "#e8eaee",
    "other": "#8a8a80",
}

#: Further colours of groups: m/n has number (m + 2n) mod 5, where 0 is the colour of the group and infinitely many impacts count as 0.
SHADES = {
    "m/1": ("#bbacff", "#738dfb", "#5e4674", "#1c5ac0"),
    "1/n": ("#bf5c40", "#ab544e", "#b5531d", "#650b00"),
    "k/k": ("#bbca86", "#8ea035", "#bfcd55", "#ada95c"),
    "m/n": ("#54f1d8", "#789c5d", "#4df7b5", "#59b281"),
    "inf/n": ("#de75d3", "#9e668e", "#62394d", "#8a576b"),
}

#: The words of a legend.
LEGEND = {
    "0": "no impact",
    "1/1": "1/1",
    "2/1": "2/1",
    "3/1": "3/1",
    "4/1": "4/1",
    "m/1": "$m$/1, $m$ ≥ 5",
    "1/2": "1/2",
    "1/3": "1/3",
    "1/n": "1/$n$, $n$ ≥ 4",
    "k/k": "$k$/$k$, $k$ ≥ 2",
    "3/2": "3/2",
    "m/n": "other $m$/$n$",
    "inf/n": "∞/$n$ (chatter)",
    "chaotic": "chaotic",
    "stuck": "stuck",
    "undecided": "undecided",
    "other": "other",
}

#: The first row that holds for m/n names its group: m from and to, n from and to, whether m = n is asked.
GROUP_RULES = (
    ((0, 0), (1, math.inf), False, "0"),
    ((1, 1), (1, 1), False, "1/1"),
    ((2, 2), (1, 1), False, "2/1"),
    ((3, 3), (1, 1), False, "3/1"),
    ((4, 4), (1, 1), False, "4/1"),
    ((5, math.inf), (1, 1), False, "m/1"),
    ((1, 1), (2, 2), False, "1/2"),
    ((1, 1), (3, 3), False, "1/3"),
    ((1, 1), (4, math.inf), False, "1/n"),
    ((2, math.inf), (2, math.inf), True, "k/k"),
    ((3, 3), (2, 2), False, "3/2"),
    ((2, math.inf), (2, math.inf), False, "m/n"),
)
