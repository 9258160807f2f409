#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether services/common/px4_releases.cpp says what PX4's published message definitions say.

    px4_definitions.py FOLDER      a clone of PX4's px4_msgs with its branches release/1.15 to release/1.18
    px4_definitions.py FOLDER print    the rows of the table, as they should be

Without FOLDER it is $FORETRACK_PX4_MSGS. Exit code 0: the same; 1: not, with a line for each difference;
77: there is no such folder.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

TABLE = Path(__file__).resolve().parents[2] / "services/common/px4_releases.cpp"
RELEASES = (15, 16, 17, 18)
MESSAGES = ("VehicleStatus", "BatteryStatus", "VehicleLocalPosition", "FailsafeFlags", "VehicleOdometry",
            "VehicleControlMode", "VehicleCommand", "VehicleCommandAck", "ManualControlSetpoint",
            "OffboardControlMode", "TrajectorySetpoint", "TimesyncStatus", "HomePosition",
            "RegisterExtComponentRequest", "RegisterExtComponentReply", "UnregisterExtComponent",
            "ArmingCheckRequest", "ArmingCheckReply", "Event", "ModeCompleted")


def show(folder, release, message):
    branches = [f"{remote}release/1.{release}" for remote in ("", "origin/")]
    for branch in branches:
        for place in ("msg", "msg/versioned"):
            got = subprocess.run(["git", "-C", folder, "show", f"{branch}:{place}/{message}.msg"],
                                 capture_output=True, text=True)
            if got.returncode == 0:
                return got.stdout
    sys.exit(f"{folder}: no {message}.msg on {branches[0]}")


def definition(text):
    """(version, "type name" of each field)"""
    lines = [line.split("#")[0].strip() for line in text.splitlines()]
    version = 0
    fields = []
    for line in filter(None, lines):
        if match := re.match(r"uint32 MESSAGE_VERSION *= *(\d+)", line):
            version = int(match[1])
        elif "=" not in line:
            fields.append(" ".join(line.split()))
    return version, tuple(fields)


def published(folder):
    return {(message, release): definition(show(folder, release, message))
            for message in MESSAGES for release in RELEASES}


def committed():
    rows = re.findall(r'\{"(\w+)", (\d+), (\d+), (\d+),((?:\s*"[^"]*")+)\}', TABLE.read_text())
    table = {}
    for message, first, last, version, text in rows:
        fields = "".join(re.findall(r'"([^"]*)"', text)).split(",")
        for release in range(int(first), int(last) + 1):
            if (message, release) in table:
                sys.exit(f"{TABLE}: {message} of 1.{release} stands twice")
            table[message, release] = int(version), tuple(field.strip() for field in fields)
    return table


def print_rows(found):
    for message in MESSAGES:
        first = RELEASES[0]
        for release in RELEASES:
            if release + 1 in RELEASES and found[message, release] == found[message, release + 1]:
                continue
            version, fields = found[message, release]
            lines, line = [], ""
            for i, field in enumerate(fields):
                piece = field + ("" if i + 1 == len(fields) else ", ")
                if len(line) + len(piece) > 88:
                    lines.append(line)
                    line = ""
                line += piece
            lines.append(line)
            body = "\n".join(f'     "{line}"' for line in lines)
            print(f'    {{"{message}", {first}, {release}, {version},\n{body}}},')
            first = release + 1


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("FORETRACK_PX4_MSGS", "")
    if not folder or not Path(folder).is_dir():
        print("skipped: give a clone of px4_msgs")
        return 77
    found = published(folder)
    if sys.argv[2:] == ["print"]:
        print_rows(found)
        return 0
    ours = committed()
    faults = [f"{message} of PX4 1.{release}: {ours.get((message, release))} here, {found[message, release]} there"
              for message, release in found if ours.get((message, release)) != found[message, release]]
    print("\n".join(faults) or f"{len(found)} definitions are the same")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
