#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reliability of the intention probabilities, from the report of `predict_bench --json`.

Usage: plot_reliability.py REPORT.json OUT.png
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

TITLES = {
    "passages": "Simulated passages",
    "open_worlds": "Simulated open worlds",
    "recorded": "Recorded pedestrians",
}
CURVES = {"reliability": "most probable intention", "turn_reliability": "turn left, turn right"}


def plot(report, out_path):
    sets = [name for name in TITLES if name in report]
    figure, axes = plt.subplots(1, len(sets), figsize=(4.2 * len(sets), 4.2), squeeze=False,
                                layout="constrained")
    for axis, name in zip(axes[0], sets):
        intention = report[name]["intention"]
        axis.plot([0, 1], [0, 1], color="0.7", linewidth=1)
        for key, label in CURVES.items():
            rows = intention[key]
            axis.plot([r[0] for r in rows], [r[1] for r in rows], "o-", markersize=4, label=label)
        axis.set_title(f"{TITLES[name]}\nskill {intention['brier_skill']:.2f}, "
                       f"ECE {intention['ece']:.3f}, n = {intention['windows']}")
        axis.set_xlabel("probability")
        axis.set_ylabel("share that came true")
        axis.set_aspect("equal")
        axis.legend(loc="upper left", fontsize=8)
    figure.savefig(out_path, dpi=110)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        plot(json.load(file), sys.argv[2])


if __name__ == "__main__":
    main()
