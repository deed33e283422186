"""Colours of series, and of the groups of motions in the order of a legend.

Written by crates/vibroimpact-plot/tests/tables.rs; do not edit.
"""

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
    "0": "#e9e9e9",
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
    "inf/n": "#f29bc1",
    "chaotic": "#101010",
    "stuck": "#5e4636",
    "undecided": "#ffffff",
    "other": "#9a9a9a",
}
