# SPDX-License-Identifier: Apache-2.0
"""Draws flight.png from a flight's log.csv and scenario.json: python3 plot_flight.py FOLDER.

Exit status 3: matplotlib is missing.
"""

import csv
import json
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Circle, Rectangle
except ImportError:
    sys.exit(3)

SHAPE = {"facecolor": "0.82", "edgecolor": "0.55", "linewidth": 0.6}
LOST, HIDDEN, NEAR = "#d62728", "#ff7f0e", "#9467bd"
MODES = {"fresh": "#2ca02c", "kept": "#bcbd22", "search": "#17becf", "hold": "#7f7f7f", "none": "white"}


def read_log(path):
    """Columns by name: numbers where they are numbers, else text."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {}
    for name in rows[0]:
        values = [row[name] for row in rows]
        try:
            columns[name] = [float(value) for value in values]
        except ValueError:
            columns[name] = values
    return columns


def draw_world(axes, scenario):
    for box in scenario["boxes"]:
        low, high = box["min_m"], box["max_m"]
        axes.add_patch(Rectangle(low[:2], high[0] - low[0], high[1] - low[1], **SHAPE))
    for cylinder in scenario["cylinders"]:
        axes.add_patch(Circle(cylinder["center_m"], cylinder["radius_m"], **SHAPE))


def draw_path(axes, x, y, t, cmap):
    step = max(1, len(x) // 3000)
    points = list(zip(x[::step], y[::step]))
    segments = [[a, b] for a, b in zip(points, points[1:])]
    lines = LineCollection(segments, cmap=cmap, linewidths=1.8)
    lines.set_array(t[::step][:-1])
    lines.set_clim(-0.4 * t[-1], t[-1])
    axes.add_collection(lines)
    return lines


def where(values, condition):
    return [i for i, value in enumerate(values) if condition(value)]


def draw_top_view(axes, log, scenario):
    draw_world(axes, scenario)
    t = log["now_s"]
    draw_path(axes, log["target_x"], log["target_y"], t, "Oranges")
    lines = draw_path(axes, log["vehicle_x"], log["vehicle_y"], t, "Blues")
    hidden = where(log["unhidden"], lambda v: v == 0.0)
    outside = where(log["in_view"], lambda v: v == 0.0)
    for marks, colour, label in ((hidden, HIDDEN, "occluded"), (outside, LOST, "out of view")):
        if marks:
            axes.plot([log["vehicle_x"][i] for i in marks], [log["vehicle_y"][i] for i in marks], ".",
                      color=colour, markersize=4, label=label)
    for turn in scenario["turns"]:
        i = min(range(len(t)), key=lambda k: abs(t[k] - turn["begin_s"]))
        axes.plot(log["target_x"][i], log["target_y"][i], "^" if turn["success"] else "v",
                  color="#2ca02c" if turn["success"] else LOST, markersize=7, markeredgecolor="white")
    for cmap, label in (("Oranges", "target"), ("Blues", "vehicle")):
        axes.plot([], [], color=matplotlib.colormaps[cmap](0.75), label=label)
    for marker, colour, label in (("^", "#2ca02c", "turn kept in view"), ("v", LOST, "turn lost")):
        axes.plot([], [], marker, color=colour, label=label)
    xs, ys = log["target_x"] + log["vehicle_x"], log["target_y"] + log["vehicle_y"]
    axes.set_xlim(min(xs) - 3, max(xs) + 3)
    axes.set_ylim(min(ys) - 3, max(ys) + 3)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.06), ncol=6, fontsize=8, frameon=False)
    bar = axes.figure.colorbar(lines, ax=axes, label="time [s]", fraction=0.03, pad=0.01)
    bar.ax.set_ylim(0, t[-1])


def draw_distance(axes, log, scenario):
    t = log["now_s"]
    axes.axhspan(*scenario["band_m"], color="#2ca02c", alpha=0.15)
    axes.axhline(scenario["near_m"], color=NEAR, linewidth=0.8)
    axes.plot(t, log["distance"], color="black", linewidth=1.0)
    axes.set_ylim(0.0, max(4.0, min(8.0, 1.05 * max(log["distance"]))))
    axes.set_ylabel("distance [m]")
    for turn in scenario["turns"]:
        axes.axvline(turn["begin_s"], color="#2ca02c" if turn["success"] else LOST, linewidth=0.8)


def draw_intentions(axes, log, intentions):
    for intention in intentions[1:]:  # the first is what is left of 1
        name = intention["name"]
        axes.plot(log["now_s"], log["p_" + name], color=intention["color"], linewidth=0.9,
                  label=name.replace("_", " "))
    axes.set_ylim(0.0, 1.0)
    axes.set_ylabel("probability")
    axes.legend(loc="upper right", fontsize=7, ncol=3)


def draw_strip(axes, log):
    """One band of colour a line: in view, not hidden, near, and what is flown."""
    t = log["now_s"]
    rows = [("in view", [v == 0.0 for v in log["in_view"]], LOST),
            ("not hidden", [v == 0.0 for v in log["unhidden"]], HIDDEN),
            ("not near", [d < 1.0 for d in log["distance"]], NEAR)]
    for level, (_, bad, colour) in enumerate(rows):
        axes.fill_between(t, level + 0.1, level + 0.9, color="#2ca02c", alpha=0.25, linewidth=0)
        axes.fill_between(t, level + 0.1, level + 0.9, where=bad, color=colour, linewidth=0)
    for status, colour in MODES.items():
        axes.fill_between(t, 3.1, 3.9, where=[s == status for s in log["plan_status"]], color=colour, linewidth=0)
    axes.set_yticks([0.5, 1.5, 2.5, 3.5], [name for name, _, _ in rows] + ["plan"], fontsize=8)
    axes.set_ylim(0, 4)
    axes.set_xlabel("time [s]")


def main(folder):
    log = read_log(folder / "log.csv")
    scenario = json.loads((folder / "scenario.json").read_text())
    figure = plt.figure(figsize=(11, 13), constrained_layout=True)
    grid = figure.add_gridspec(4, 1, height_ratios=[6, 1.6, 1.2, 1.2])
    top = figure.add_subplot(grid[0])
    draw_top_view(top, log, scenario)
    wins = sum(turn["success"] for turn in scenario["turns"])
    top.set_title(f"{scenario['name']}, seed {scenario['seed']}, {scenario['map']} map: "
                  f"failure rate {100 * scenario['failure_rate']:.1f} %, "
                  f"turns {wins} of {len(scenario['turns'])}")
    distance = figure.add_subplot(grid[1])
    draw_distance(distance, log, scenario)
    draw_intentions(figure.add_subplot(grid[2], sharex=distance), log, scenario["intentions"])
    draw_strip(figure.add_subplot(grid[3], sharex=distance), log)
    distance.set_xlim(0, log["now_s"][-1])
    figure.savefig(folder / "flight.png", dpi=100)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
