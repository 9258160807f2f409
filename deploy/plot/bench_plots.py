# SPDX-License-Identifier: Apache-2.0
"""The plots of a bench report, each a matplotlib figure."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Ellipse, Rectangle, Wedge

COLOURS = {"intention": "#1f77b4", "single-path": "#2ca02c", "unaware": "#d62728", "cv": "#ff7f0e"}
SPARE = ["#9467bd", "#8c564b", "#e377c2", "#17becf", "#bcbd22"]
BAND, NEAR, HALF_FOV_DEG = (1.5, 2.5), 1.0, 45.0
CHI2_OF_90 = 4.605


def colour(method):
    return COLOURS.get(method, SPARE[sum(map(ord, method)) % len(SPARE)])


def success(cells, title):
    """Share of events that succeeded, with Wilson 95 % intervals, by speed and method."""
    figure, axes = plt.subplots(figsize=(6, 3.4), constrained_layout=True)
    methods = list(dict.fromkeys(cell["method"] for cell in cells))
    for k, method in enumerate(methods):
        mine = [c for c in cells if c["method"] == method and c["events"]]
        x = [c["target_speed_m_s"] + 0.02 * (k - (len(methods) - 1) / 2) for c in mine]
        y = [100 * c["successes"] / c["events"] for c in mine]
        low = [max(0.0, v - 100 * c["success_low"]) for v, c in zip(y, mine)]
        high = [max(0.0, 100 * c["success_high"] - v) for v, c in zip(y, mine)]
        axes.errorbar(x, y, [low, high], fmt="o-", capsize=3, color=colour(method), label=method)
    axes.set(xlabel="target speed [m/s]", ylabel="success [%]", title=title)
    speeds = sorted({cell["target_speed_m_s"] for cell in cells})
    axes.set_xticks(speeds, [f"{speed:.1f}" for speed in speeds])
    axes.set_xlim(speeds[0] - 0.25, speeds[-1] + 0.25)
    axes.set_ylim(top=101)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    return figure


def encounter_gaps(cells, title):
    """Quantiles of the least gaps by speed, one panel for each kind: cells of encounters.json."""
    names = list(dict.fromkeys(cell["name"] for cell in cells))
    figure, panels = plt.subplots(1, len(names), figsize=(2.3 * len(names) + 0.8, 3.2), sharey=True, squeeze=False,
                                  constrained_layout=True)
    for axes, name in zip(panels[0], names):
        mine = [c for c in cells if c["name"] == name and c["encounters"]]
        speeds = [c["speed_m_s"] for c in mine]
        axes.fill_between(speeds, [c["gap_p05_m"] for c in mine], [c["gap_p75_m"] for c in mine], alpha=0.2,
                          color="#1f77b4", label="5–75 %")
        axes.plot(speeds, [c["gap_p50_m"] for c in mine], "-", color="#1f77b4", label="median")
        axes.plot(speeds, [c["gap_min_m"] for c in mine], "o", color="black", markersize=3, label="least")
        axes.plot([0.5, 1.5, 1.5, 2.0], [0.5, 0.5, 0.3, 0.3], color="#9467bd", linewidth=1.0, label="floor")
        axes.axhline(0.0, color="#d62728", linewidth=1.0)
        axes.set(title=name.replace("_", " "), xlabel="speed [m/s]")
        axes.grid(alpha=0.3)
    panels[0][0].set_ylabel("least gap [m]")
    panels[0][0].legend(fontsize=7)
    figure.suptitle(title)
    return figure


def sweep(groups, title):
    """Failure rate of each condition of a sweep: {condition: [cells]}."""
    figure, axes = plt.subplots(figsize=(9, 3.8), constrained_layout=True)
    names = list(groups)
    methods = list(dict.fromkeys(cell["method"] for cells in groups.values() for cell in cells))
    for method in methods:
        rates = []
        for name in names:
            found = [c for c in groups[name] if c["method"] == method]
            rates.append(100 * found[0]["failure_rate"] if found else math.nan)
        axes.plot(range(len(names)), rates, "o-", color=colour(method), label=method)
    axes.set_xticks(range(len(names)), names, rotation=60, ha="right", fontsize=8)
    axes.set(ylabel="failure rate [%]", title=title)
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    return figure


def curves(cells, title):
    """Distance around the events: median, 5–95 % band, and the nearest single ones."""
    cells = [c for c in cells if c["curves"]["count"]]
    if not cells:
        return None
    figure, all_axes = plt.subplots(1, len(cells), figsize=(3.1 * len(cells), 3.0), sharey=True,
                                    constrained_layout=True, squeeze=False)
    for axes, cell in zip(all_axes[0], cells):
        c = cell["curves"]
        number = lambda values: np.array([math.nan if v is None else v for v in values])
        t = c["from_s"] + c["step_s"] * np.arange(len(c["p50"]))
        axes.axhspan(*BAND, color="#2ca02c", alpha=0.12)
        axes.axhline(NEAR, color="#9467bd", linewidth=0.8)
        axes.fill_between(t, number(c["p05"]), number(c["p95"]), color=colour(cell["method"]), alpha=0.25)
        axes.plot(t, number(c["p50"]), color=colour(cell["method"]))
        for single in c["nearest"][:3]:
            axes.plot(t, number(single), color="0.5", linewidth=0.6)
        axes.set_title(f"{cell['method']} ({c['count']})", fontsize=9)
        axes.set_xlabel("time after the onset [s]")
        axes.grid(alpha=0.3)
    all_axes[0][0].set_ylabel("distance [m]")
    all_axes[0][0].set_ylim(0, 4)
    figure.suptitle(title, fontsize=10)
    return figure


def heat(cells, title):
    """Where the target was in the vehicle's frame, with the ellipse of 90 %."""
    figure, all_axes = plt.subplots(1, len(cells), figsize=(3.1 * len(cells), 3.3), sharey=True,
                                    constrained_layout=True, squeeze=False)
    for axes, cell in zip(all_axes[0], cells):
        p = cell["places"]
        n, size = p["cells_per_side"], p["cell_m"]
        counts = np.array(p["cells"], dtype=float).reshape(n, n)
        x0, y0 = p["min_m"]
        # Forward is up, left is left.
        axes.imshow(np.ma.masked_equal(np.log1p(counts.T), 0.0), origin="lower", cmap="viridis_r",
                    extent=(y0, y0 + n * size, x0, x0 + n * size), aspect="equal")
        xx, xy, yy = p["covariance_m2"]
        values, vectors = np.linalg.eigh(np.array([[yy, xy], [xy, xx]]))
        angle = math.degrees(math.atan2(vectors[1, 1], vectors[0, 1]))
        width, height = 2 * np.sqrt(np.maximum(values[::-1], 0) * CHI2_OF_90)
        mean = (p["mean_m"][1], p["mean_m"][0])
        axes.add_patch(Ellipse(mean, width, height, angle=angle, fill=False, color="#1f77b4"))
        axes.add_patch(Wedge((0, 0), 8, 90 - HALF_FOV_DEG, 90 + HALF_FOV_DEG, fill=False, color="#d62728",
                             linewidth=0.8))
        axes.add_patch(Circle((0, 0), NEAR, fill=False, color="#9467bd", linewidth=0.8))
        axes.plot(0, 0, "k^", markersize=5)
        axes.set(xlim=(2.5, -2.5), ylim=(-0.8, 4.5), xlabel="left [m]")
        axes.set_title(f"{cell['method']}: {p['ellipse_90_area_m2']:.2f} m²", fontsize=9)
    all_axes[0][0].set_ylabel("forward [m]")
    figure.suptitle(title, fontsize=10)
    return figure


def reliability(cells, title):
    figure, axes = plt.subplots(figsize=(3.6, 3.6), constrained_layout=True)
    axes.plot([0, 1], [0, 1], color="0.6", linewidth=0.8)
    for cell in cells:
        bins = cell["intention"]["bins"]
        if bins:
            axes.plot([b[0] for b in bins], [b[1] for b in bins], "o-", markersize=3,
                      label=f"{cell['target_speed_m_s']:.1f} m/s, ECE {cell['intention']['ece']:.3f}")
    axes.set(xlabel="probability said", ylabel="how often it was so", title=title, xlim=(0, 1), ylim=(0, 1))
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7)
    return figure


def worst(cell, title):
    """The worst flight of a cell from above."""
    w = cell["worst"]
    view = np.array(w["view"])
    figure, axes = plt.subplots(figsize=(5, 4.4), constrained_layout=True)
    shape = {"facecolor": "0.85", "edgecolor": "0.6", "linewidth": 0.5}
    for x0, y0, x1, y1 in w["shapes"]["boxes"]:
        axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, **shape))
    for x, y, radius in w["shapes"]["cylinders"]:
        axes.add_patch(Circle((x, y), radius, **shape))
    axes.plot(view[:, 3], view[:, 4], color="#e6850e", linewidth=1.2, label="target")
    axes.plot(view[:, 1], view[:, 2], color="#1f77b4", linewidth=1.2, label="vehicle")
    lost = view[view[:, 5] == 0]
    axes.plot(lost[:, 1], lost[:, 2], ".", color="#d62728", markersize=4, label="not visible")
    for begin_s, ok in w["events"]:
        i = int(np.argmin(np.abs(view[:, 0] - begin_s)))
        axes.plot(view[i, 3], view[i, 4], "^" if ok else "v", color="#2ca02c" if ok else "#d62728",
                  markersize=7, markeredgecolor="white")
    both = np.vstack([view[:, 1:3], view[:, 3:5]])
    axes.set(xlim=(both[:, 0].min() - 2, both[:, 0].max() + 2), ylim=(both[:, 1].min() - 2, both[:, 1].max() + 2),
             aspect="equal", xlabel="x [m]", ylabel="y [m]")
    axes.set_title(f"{title}\n{w['world']}, seed {w['seed']}: failure rate {100 * w['failure_rate']:.1f} %",
                   fontsize=8)
    axes.legend(fontsize=7)
    return figure
