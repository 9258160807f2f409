#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""soak.py PROGRAM MINUTES: flies all services in simulation and looks, every ten seconds, at each
process: memory, threads, open files, and how long its loop took at most.

Prints a row a process: at the start (after a minute, when all is warm), in the middle, at the end. Exit
code 1 if memory grew by more than 10 % and 8 MB between the middle and the end, or threads or open files did
at all, or a process was started again. `./run soak MINUTES` runs it.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

LOOK_S, WARM_S = 10, 60
GROWTH, GROWTH_MB = 1.10, 8
DOMAIN = "231"


def children(pid):
    with open(f"/proc/{pid}/task/{pid}/children", encoding="ascii") as file:
        return [int(word) for word in file.read().split()]


def name_of(pid):
    with open(f"/proc/{pid}/cmdline", "rb") as file:
        return file.read().split(b"\0")[1].decode()


def look(pid):
    """MB, threads, open files."""
    with open(f"/proc/{pid}/status", encoding="ascii") as file:
        rows = dict(line.split(":", 1) for line in file if ":" in line)
    return (int(rows["VmRSS"].split()[0]) / 1024, int(rows["Threads"]),
            len(os.listdir(f"/proc/{pid}/fd")))


def loops(program):
    """The longest loop of each service in the last second, ms."""
    done = subprocess.run([program, "monitor", "--domain", DOMAIN, "--json", "--for", "2"],
                          capture_output=True, text=True, check=False)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    services = json.loads(lines[-1])["services"] if lines else []
    return {service["service"]: service["loop_max_ms"] for service in services}


def fly(program, seconds, folder):
    """What was seen of each process, by its name, and the pids at the start."""
    seen, pids = {}, {}
    flight = subprocess.Popen([program, "up", "--scenario", "street_blocks", "--domain", DOMAIN, "--out",
                               folder], stdout=subprocess.DEVNULL)
    try:
        end = time.monotonic() + seconds
        time.sleep(min(WARM_S, seconds / 3))
        while time.monotonic() < end and flight.poll() is None:
            for pid in children(flight.pid):
                name = name_of(pid)
                pids.setdefault(name, set()).add(pid)
                seen.setdefault(name, []).append(look(pid))
            time.sleep(LOOK_S)
        return seen, pids, loops(program), flight.poll() is None
    finally:
        flight.terminate()
        flight.wait(10)


def faults_of(name, rows, pids):
    middle, last = rows[len(rows) // 2], rows[-1]
    if len(pids) > 1:
        yield f"{name} was started again {len(pids) - 1} times"
    if last[0] > GROWTH * middle[0] and last[0] > middle[0] + GROWTH_MB:
        yield f"{name}: memory grew from {middle[0]:.1f} to {last[0]:.1f} MB"
    for what, k in (("threads", 1), ("open files", 2)):
        if last[k] > middle[k]:
            yield f"{name}: {what} grew from {middle[k]} to {last[k]}"


def main():
    program, minutes = sys.argv[1], float(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        seen, pids, longest, flew = fly(program, 60 * minutes, folder)
    faults = [] if flew and seen else ["the flight ended"]
    print(f"{'process':<12} {'MB: start, middle, end':>26} {'threads':>14} {'files':>14} {'loop, ms':>9}")
    for name, rows in sorted(seen.items()):
        three = rows[0], rows[len(rows) // 2], rows[-1]
        columns = [", ".join(f"{row[k]:.{1 if k == 0 else 0}f}" for row in three) for k in range(3)]
        print(f"{name:<12} {columns[0]:>26} {columns[1]:>14} {columns[2]:>14} "
              f"{longest.get(name, float('nan')):>9.1f}")
        faults += faults_of(name, rows, pids[name])
    for fault in faults:
        print(f"FAULT: {fault}")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
