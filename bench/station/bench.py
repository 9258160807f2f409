#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench.py [BIN [SECONDS [BLOCK_S [CLIENTS [FOLDER]]]]]: what clients of the station cost the services on board.

One flight with the station beside it. So many clients are connected throughout; in turns of BLOCK_S they subscribe to
everything and to nothing, so that what else changes on the machine meets both alike. Of the wall time from an
observation's delivery to the plan and to the setpoint that it caused (bench_dds_latency) it prints the quantiles with
and without, and the ratio with the interval that holds 95 % of 4000 resamplings of pairs of neighbouring blocks.
FOLDER keeps each block's delays: `bench.py evaluate FOLDER...` puts several runs together. The clients run at a lower
priority: they stand for other machines.
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

ROOT = Path(__file__).resolve().parents[2]
LOAD = ROOT / "services/ground_station/web/probe/load.mjs"
WARM_UP_S = 5  # as bench_dds_latency has it
SETTLE_S = 0.5  # of each block
STAGES = ("plan", "setpoint")


def cpu_s(pid):
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory_mb(pid):
    return int(re.search(r"VmHWM:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[1]) / 1024


def start_station(binaries, folder, domain):
    station = subprocess.Popen([binaries / "foretrack", "station", "--domain", domain, "--port", "0", "--token-file",
                                f"{folder}/tokens", "--audit-file", f"{folder}/audit"],
                               stdout=subprocess.PIPE, text=True, cwd=folder)
    return station, re.search(r"http://(.*?)/", station.stdout.readline())[1]


def alternate(load, station, seconds, block_s):
    """The blocks: (with clients, from, to, share of a core that the station took)."""
    blocks = []
    for index in range(int(seconds / block_s)):
        on = index % 2 == 1
        load.stdin.write("on\n" if on else "off\n")
        load.stdin.flush()
        time.sleep(SETTLE_S)
        begin_s, before = time.monotonic(), cpu_s(station.pid)
        time.sleep(block_s - SETTLE_S)
        end_s = time.monotonic()
        blocks.append((on, begin_s, end_s, (cpu_s(station.pid) - before) / (end_s - begin_s)))
    return blocks


def fly(binaries, seconds, block_s, clients, folder):
    flight = subprocess.Popen([binaries / "bench_dds_latency", "depth", str(seconds), "t_intersection",
                               f"{folder}/delays"], stdout=subprocess.PIPE, text=True)
    domain = re.search(r"domain (\d+)", flight.stdout.readline())[1]
    station, address = start_station(binaries, folder, domain)
    load = subprocess.Popen(["nice", "-n", "5", "node", LOAD, f"ws://{address}/ws", str(clients), "-"],
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    time.sleep(WARM_UP_S)
    blocks = alternate(load, station, seconds - 1, block_s)
    flight.communicate()
    mean = lambda on: sum(b[3] for b in blocks if b[0] == on) / sum(b[0] == on for b in blocks)
    report = {"station_mb": round(memory_mb(station.pid)),
              "station_cpu_percent": {"without": round(100 * mean(False), 1), "with": round(100 * mean(True), 1)},
              "load": json.loads(load.communicate()[0])}
    station.terminate()
    station.wait()
    delays = [line.split() for line in Path(folder, "delays").read_text().splitlines()]
    result = [{"on": on, **{stage: [float(ms) for name, at_s, ms in delays
                                    if name == stage and begin_s <= float(at_s) < end_s] for stage in STAGES}}
              for on, begin_s, end_s, _ in blocks]
    Path(folder, "blocks.json").write_text(json.dumps(result))
    return report


def quantile(values, share):
    return sorted(values)[int(share * (len(values) - 1))]


def evaluate(folders):
    pairs = []
    for folder in folders:
        blocks = json.loads(Path(folder, "blocks.json").read_text())
        pairs += [(blocks[i], blocks[i + 1]) for i in range(0, len(blocks) - 1, 2)]
    random.seed(1)
    for stage in STAGES:
        for share in (0.5, 0.95, 0.99):
            def both(chosen):
                without, with_clients = ([ms for pair in chosen for ms in pair[i][stage]] for i in (0, 1))
                return quantile(without, share), quantile(with_clients, share)
            ratios = sorted(b / a for a, b in (both(random.choices(pairs, k=len(pairs))) for _ in range(4000)))
            without, with_clients = both(pairs)
            print(f"{stage} p{round(100 * share)}: {without:.2f} ms without, {with_clients:.2f} ms with clients, ratio "
                  f"{with_clients / without:.3f} ({ratios[100]:.3f} to {ratios[-101]:.3f}), {len(pairs)} pairs")


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["evaluate"]:
        return evaluate(arguments[1:])
    binaries = Path(arguments[0] if arguments else ROOT / "build/bin").resolve()
    seconds, block_s, clients = (int(arguments[i]) if len(arguments) > i else default
                                 for i, default in ((1, 200), (2, 5), (3, 20)))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(arguments[4] if len(arguments) > 4 else temporary)
        folder.mkdir(parents=True, exist_ok=True)
        print(json.dumps(fly(binaries, seconds, block_s, clients, folder)), flush=True)
        evaluate([folder])


if __name__ == "__main__":
    main()
