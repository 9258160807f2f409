# SPDX-License-Identifier: Apache-2.0
"""Makes report.html, report.md and plots/*.png of a bench: python3 bench_report.py FOLDER [COMMAND].

Reads summary.json, details.json and, if there are any, encounters.json. Exit status 3: matplotlib or jinja2 is missing.
"""

import base64
import itertools
import json
import pathlib
import re
import sys

try:
    import bench_plots as plots
    import jinja2
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit(3)


class Gallery:
    """Saves figures as PNG files and keeps them as data URIs."""

    def __init__(self, folder):
        self.folder = folder
        self.folder.mkdir(exist_ok=True)

    def add(self, name, figure):
        if figure is None:
            return None
        file = self.folder / (re.sub(r"[^A-Za-z0-9._-]+", "_", name) + ".png")
        figure.savefig(file, dpi=85, metadata={"Software": None})
        plt.close(figure)
        data = base64.b64encode(file.read_bytes()).decode()
        return {"name": name, "uri": "data:image/png;base64," + data}


def grouped(items, *keys):
    """{values of the keys: items}, in their order."""
    groups = {}
    for item in items:
        groups.setdefault(tuple(item[key] for key in keys), []).append(item)
    return groups


def base_of(experiment):
    return experiment.split("/")[0]


def draw_map(gallery, name, cells):
    """Plots of one experiment (or condition) on one kind of map; cells of details.json."""
    images = []
    for (speed,), group in grouped(cells, "target_speed_m_s").items():
        title = f"{name}, {speed:.1f} m/s"
        images.append(gallery.add(f"distance {title}", plots.curves(group, f"Distance: {title}")))
        images.append(gallery.add(f"places {title}", plots.heat(group, f"Target in the vehicle's frame: {title}")))
    ours = [cell for cell in cells if cell["method"] == "intention"]
    if any(cell["intention"]["bins"] for cell in ours):
        images.append(gallery.add(f"reliability {name}", plots.reliability(ours, f"Reliability: {name}")))
    return [image for image in images if image]


def draw_worst(gallery, cells):
    return [gallery.add(f"worst {c['experiment']} {c['method']} {c['map']} {c['target_speed_m_s']:.1f}",
                        plots.worst(c, f"{c['method']}, {c['map']} map, {c['target_speed_m_s']:.1f} m/s"))
            for c in cells]


def section(gallery, name, summary, details):
    """One experiment; a sweep has the plots of its conditions together."""
    cells = [c for c in summary["cells"] if base_of(c["experiment"]) == name]
    mine = [c for c in details["cells"] if base_of(c["experiment"]) == name]
    is_sweep = any("/" in cell["experiment"] for cell in cells)
    images, worst = [], []
    for (kind,), group in grouped(cells, "map").items():
        title = f"{name}, {kind} map"
        if is_sweep:
            conditions = {key[0].split("/", 1)[1]: value for key, value in grouped(group, "experiment").items()}
            images.append(gallery.add(f"failure {title}", plots.sweep(conditions, title)))
        else:
            images.append(gallery.add(f"success {title}", plots.success(group, title)))
            images += draw_map(gallery, title, [c for c in mine if c["map"] == kind])
    worst = draw_worst(gallery, mine)
    comparisons = [c for c in summary["comparisons"] if base_of(c["experiment"]) == name]
    scenes = [c for c in summary["scenes"] if base_of(c["experiment"]) == name]
    return {"name": name, "cells": list(zip(cells, mine)), "images": images, "worst": worst,
            "comparisons": comparisons, "scenes": scenes if len({s["world"] for s in scenes}) > 1 else [],
            "is_sweep": is_sweep}


def encounters_of(gallery, folder):
    """The part about encounters with people; none where none were staged."""
    file = folder / "encounters.json"
    if not file.exists():
        return None
    found = json.loads(file.read_text())
    images = [gallery.add(f"gaps {what} {method} {kind}", plots.encounter_gaps(group, f"{method}, {kind} map, {what}"))
              for what in ("by_kind", "by_place")
              for (method, kind), group in grouped(found[what], "method", "map").items()]
    return {"tables": [("kind", found["by_kind"]), ("place", found["by_place"])], "images": images}


def main(folder, command):
    summary = json.loads((folder / "summary.json").read_text())
    details = json.loads((folder / "details.json").read_text())
    gallery = Gallery(folder / "plots")
    encounters = encounters_of(gallery, folder)
    names = dict.fromkeys(base_of(cell["experiment"]) for cell in summary["cells"])
    names.pop("encounters", None)
    sections = [section(gallery, name, summary, details) for name in names]
    here = pathlib.Path(__file__).parent
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(here), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True)
    for template, file in (("bench_report.html.j2", "report.html"), ("bench_report.md.j2", "report.md")):
        environment.autoescape = template.endswith("html.j2")
        text = environment.get_template(template).render(sections=sections, encounters=encounters,
                                                                 command=command)
        (folder / file).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) == 3 else "")
