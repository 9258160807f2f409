#!/usr/bin/env python3
"""bench.py [BIN [ROUNDS [SECONDS [CLIENTS]]]]: what clients of the station cost the services on board, and how old
samples are for them.

Flies on this machine, in turns without clients and with so many that subscribe to everything; the station runs in both.
Prints a line for each flight: wall time from an observation's delivery to the plan and to the setpoint that it caused
(bench_dds_latency), the station's processor and memory, the clients' ages and rates. At the end the ratios of each pair.
The clients run at a lower priority: they stand for other machines.
"""
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LOAD = ROOT / "services/ground_station/web/probe/load.mjs"
WARM_UP_S = 5  # as bench_dds_latency has it


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


def fly(binaries, seconds, clients, folder):
    flight = subprocess.Popen([binaries / "bench_dds_latency", "depth", str(seconds)], stdout=subprocess.PIPE, text=True)
    domain = re.search(r"domain (\d+)", flight.stdout.readline())[1]
    station, address = start_station(binaries, folder, domain)
    load = None
    if clients:
        load = subprocess.Popen(["nice", "-n", "5", "node", LOAD, f"ws://{address}/ws", str(clients),
                                 str(seconds + WARM_UP_S - 6)], stdout=subprocess.PIPE, text=True)
    before = cpu_s(station.pid)
    text = flight.stdout.read()
    result = {"clients": clients, "station_cpu_percent": round(100 * (cpu_s(station.pid) - before) / (seconds + WARM_UP_S), 1),
              "station_mb": round(memory_mb(station.pid))}
    station.terminate()
    station.wait()
    for stage in ("plan", "setpoint"):
        row = re.search(rf"^{stage} +\d+ +(\S+) +(\S+) +(\S+)", text, re.M)
        result[stage] = dict(zip(("p50", "p95", "p99"), map(float, row.groups())))
    if load:
        result["load"] = json.loads(load.stdout.read())
    return result


def main():
    arguments = sys.argv[1:]
    binaries = Path(arguments[0] if arguments else ROOT / "build/bin").resolve()
    rounds, seconds, clients = (int(arguments[i]) if len(arguments) > i else default
                                for i, default in ((1, 5), (2, 30), (3, 20)))
    ratios = {}
    for _ in range(rounds):
        pair = []
        for count in (0, clients):
            with tempfile.TemporaryDirectory() as folder:
                pair.append(fly(binaries, seconds, count, folder))
            print(json.dumps(pair[-1]), flush=True)
        for stage in ("plan", "setpoint"):
            for quantile in ("p50", "p99"):
                ratios.setdefault(f"{stage} {quantile}", []).append(pair[1][stage][quantile] / pair[0][stage][quantile])
    for name, values in ratios.items():
        print(f"{name}: with clients / without: median {statistics.median(values):.3f}, "
              f"{min(values):.3f} to {max(values):.3f}")


if __name__ == "__main__":
    main()
