#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""picture_bench.py [BIN [RUNS [SECONDS [BLOCK_S [VIEWERS [FOLDER]]]]]]: what viewers of the picture cost the loop on board.

RUNS times the onboard services, on rendered images in real time (camera_loop_bench), with the station beside them. So many
viewers are connected throughout; in turns of BLOCK_S they read the ground's pictures, both kinds, and nothing, so that
what else changes on the machine meets both alike. Without them nothing is encoded. Of the wall time from an image's stamp
to the landmarks, the target, the plan and the setpoint that it caused it prints the quantiles with and without, and the
ratio with the interval that holds 95 % of 1000 resamplings of pairs of neighbouring blocks; of the
stages' process the processor's time, likewise. Pairs in which the person was lost are left out. FOLDER keeps what was measured: `picture_bench.py evaluate FOLDER...` puts several
together. Viewers run at a lower priority: they stand for other machines.
"""
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bench import LOAD, ROOT, SETTLE_S, cpu_s, memory_mb, quantile, start_station

LOST_MS = 1000.0  # a setpoint so late is one of a vehicle that had lost the person
START_S = 11.0  # of a run: services, networks, the person found
STAGES = ("landmarks", "target", "plan", "setpoint")
PICTURES = "camera/ground/(image|video)"


def stages_of(bench):
    """The process of the vehicle's services but for the gate, which the bench has started."""
    children = Path(f"/proc/{bench.pid}/task/{bench.pid}/children").read_text().split()
    return next(int(pid) for pid in children if "stages" in Path(f"/proc/{pid}/cmdline").read_text())


def alternate(load, stages, seconds, block_s):
    """The blocks: (with viewers, from, to, processor's seconds of the services)."""
    blocks = []
    for index in range(int(seconds / block_s)):
        on = index % 2 == 1
        load.stdin.write("on\n" if on else "off\n")
        load.stdin.flush()
        time.sleep(SETTLE_S)
        begin_s, before = time.time(), cpu_s(stages)
        time.sleep(block_s - SETTLE_S)
        blocks.append((on, begin_s, time.time(), cpu_s(stages) - before))
    return blocks


def fly(bench, domain, binaries, seconds, block_s, viewers):
    with tempfile.TemporaryDirectory() as folder:
        station, address = start_station(binaries, folder, domain)
        load = subprocess.Popen(["nice", "-n", "5", "node", LOAD, f"ws://{address}/ws", str(viewers), "-", PICTURES],
                                stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        time.sleep(START_S)
        blocks = alternate(load, stages_of(bench), seconds - START_S, block_s)
        print(json.dumps({"station_mb": round(memory_mb(station.pid)), "viewers": json.loads(load.communicate()[0])}),
              flush=True)
        station.terminate()
        station.wait()
    return blocks


def measure(binaries, runs, seconds, block_s, viewers, folder):
    delays = Path(folder, "delays")
    bench = subprocess.Popen([binaries / "camera_loop_bench", "--seconds", str(seconds), "--delays", delays, "--models",
                              *["full"] * runs], stdout=subprocess.PIPE, text=True)
    blocks = []
    for line in bench.stdout:
        if domain := re.match(r"domain (\d+)", line):
            blocks += fly(bench, domain[1], binaries, seconds, block_s, viewers)
        elif "of a core" in line or "looked at" in line:
            print(line, end="", flush=True)
    rows = [line.split() for line in delays.read_text().splitlines()]
    result = [{"on": on, "cpu_s": cpu, "seconds": end_s - begin_s,
               **{stage: [float(ms) for name, at_s, ms in rows if name == stage and begin_s <= float(at_s) < end_s]
                  for stage in STAGES}} for on, begin_s, end_s, cpu in blocks]
    Path(folder, "blocks.json").write_text(json.dumps(result))


def show(name, pairs, value):
    """The value of all blocks without and of all with viewers, and their ratio."""
    def both(chosen):
        return [value([pair[i] for pair in chosen]) for i in (0, 1)]
    ratios = sorted(b / a for a, b in (both(random.choices(pairs, k=len(pairs))) for _ in range(1000)))
    without, with_viewers = both(pairs)
    print(f"{name}: {without:.2f} without, {with_viewers:.2f} with viewers, ratio {with_viewers / without:.3f} "
          f"({ratios[25]:.3f} to {ratios[-26]:.3f}), {len(pairs)} pairs")


def evaluate(folders):
    pairs = []
    for folder in folders:
        blocks = [b for b in json.loads(Path(folder, "blocks.json").read_text())]
        pairs += [(a, b) for a, b in zip(blocks[::2], blocks[1::2]) if a["setpoint"] and b["setpoint"]]
    followed = [pair for pair in pairs if max(max(block["setpoint"]) for block in pair) < LOST_MS]
    print(f"{len(pairs) - len(followed)} of {len(pairs)} pairs left out: the person was lost in them")
    pairs = followed
    random.seed(1)
    for stage in STAGES:
        for share in (0.5, 0.95, 0.99):
            show(f"{stage} p{round(100 * share)}, ms", pairs,
                 lambda blocks: quantile([ms for block in blocks for ms in block[stage]], share))
    show("processor of perception, mapping, prediction and planning, % of a core", pairs,
         lambda blocks: 100 * sum(b["cpu_s"] for b in blocks) / sum(b["seconds"] for b in blocks))


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["evaluate"]:
        return evaluate(arguments[1:])
    binaries = Path(arguments[0] if arguments else ROOT / "build/bin").resolve()
    runs, seconds, block_s, viewers = (int(arguments[i]) if len(arguments) > i else default
                                       for i, default in ((1, 3), (2, 60), (3, 4), (4, 4)))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(arguments[5] if len(arguments) > 5 else temporary)
        folder.mkdir(parents=True, exist_ok=True)
        measure(binaries, runs, seconds, block_s, viewers, folder)
        evaluate([folder])


if __name__ == "__main__":
    main()
