#!/usr/bin/env python3
"""bench.py PROGRAM [SECONDS [CLIENTS]]: what clients of the station cost the flight, and how old samples are for them.

Flies the same scenario without clients and with so many that subscribe to everything, on this machine, and prints a line
for each: the services' latency (image to setpoint), the clients' ages and rates, the station's memory and processor.
"""
import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LOAD = ROOT / "services/ground_station/web/probe/load.mjs"


def fly(program, seconds, clients):
    with tempfile.TemporaryDirectory() as folder:
        demo = subprocess.Popen([program, "demo", "--headless", "--for", str(seconds), "--out", f"{folder}/flight"],
                                stdout=subprocess.PIPE, text=True)
        page = next(m for m in (re.search(r"page: http://(.*?)/", line) for line in demo.stdout) if m)
        load = {}
        if clients:
            for line in demo.stdout:  # until it flies
                if "gate track" in line:
                    break
            out = subprocess.run(["node", LOAD, f"ws://{page[1]}/ws", str(clients), str(seconds - 20)],
                                 stdout=subprocess.PIPE, text=True, check=True).stdout
            load = json.loads(out)
        demo.stdout.read()
        demo.wait()
        summary = json.loads(Path(f"{folder}/flight/summary.json").read_text())
        return summary, load


def main():
    program = sys.argv[1]
    seconds = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    clients = int(sys.argv[3]) if len(sys.argv) > 3 else 20
    for count in (0, clients):
        summary, load = fly(program, seconds, count)
        station = summary["services"]["station"]
        print(json.dumps({"clients": count, "latency_ms": summary["latency_ms"], "plan_ms": summary["stage_ms"].get("plan"),
                          "station": station, "load": load}), flush=True)
        time.sleep(2)


if __name__ == "__main__":
    main()
