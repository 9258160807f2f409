#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether deploy/ros2/foretrack_bringup fits the program and the contract, as far as it can be seen without ROS.

Launch files are run with stand-ins for `launch` and `launch_ros`: each command must be one of the program, each option
one that its sources have. Topics of the layouts must be those of idl/README.md. Exit code 1: a line for each fault.
"""
import ast
import json
import re
import sys
import types
import xml.etree.ElementTree as xml
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "deploy/ros2/foretrack_bringup"
SOURCES = "".join(path.read_text() for folder in ("cli", "common")
                  for path in (ROOT / "services" / folder).glob("*.[ch]pp"))
TABLE = (ROOT / "idl/README.md").read_text()


class Stand(types.ModuleType):
    """Of any class of a module: keeps what it was made with."""

    def __getattr__(self, name):
        def make(*arguments, **named):
            return types.SimpleNamespace(kind=name, positional=arguments, **named)
        return make


class Configuration:
    def __init__(self, name):
        self.name = name

    def perform(self, context):
        return context[self.name]


def stand_in_for_ros():
    for name in ("launch", "launch.actions", "launch.substitutions", "launch_ros", "launch_ros.actions",
                 "launch_ros.substitutions"):
        sys.modules[name] = Stand(name)
    sys.modules["launch.substitutions"].LaunchConfiguration = Configuration


def commands_of(path):
    """The words of each process, with every argument given."""
    scope = {}
    exec(compile(path.read_text(), path, "exec"), scope)  # pylint: disable=exec-used
    values = {name: default or "x" for name, (default, _) in scope["ARGUMENTS"].items()}
    values.update({name: "true" for name, value in values.items() if value == "false"})
    if "record" in values:
        values["record"] = "false"
    declared = scope["generate_launch_description"]().positional[0]
    if len(declared) != len(scope["ARGUMENTS"]) + 1:
        yield None
    for action in scope["start"](values):
        if hasattr(action, "cmd"):
            yield action.cmd


def launch_faults(path):
    for words in commands_of(path):
        if words is None:
            yield f"{path.name}: an argument is not declared"
            continue
        if words[0] != "foretrack" or f'{{"{words[1]}", "' not in SOURCES:
            yield f"{path.name}: there is no command {words[:2]}"
        for word in words[2:]:
            if word.startswith("--") and f'"{word}"' not in SOURCES:
                yield f"{path.name}: foretrack has no option {word}"


def topics_in(text):
    for topic in re.findall(r"[\"' ](/[a-z0-9_]+(?:/[a-z0-9_]+)*)", text):
        yield topic


def layout_faults(path):
    text = path.read_text()
    yaml.safe_load(text) if path.suffix == ".rviz" else json.loads(text)
    for topic in topics_in(text):
        own = re.match(r"/uav1/(.+)", topic)
        row = f"| `{own[1]}` |" if own else f"| `{topic[1:]}` (shared) |"
        if row not in TABLE:
            yield f"{path.name}: {topic} is not in idl/README.md"


def package_faults():
    name = xml.parse(PACKAGE / "package.xml").getroot().findtext("name")
    if name != PACKAGE.name or f"project({name} " not in (PACKAGE / "CMakeLists.txt").read_text():
        yield f"the package is named {name}"
    orders = (ROOT / "core/safety/mission.cpp").read_text()
    script = PACKAGE / "scripts/mission_services.py"
    tree = ast.parse(script.read_text())
    listed = next(node.value for node in tree.body if isinstance(node, ast.Assign)
                  and node.targets[0].id == "ORDERS")
    for order in ast.literal_eval(listed):
        if f'"{order}"' not in orders:
            yield f"{script.name}: foretrack has no order {order}"
    params = (ROOT / "core/perception/stream_params.cpp").read_text()
    for key in yaml.safe_load((PACKAGE / "config/params.yaml").read_text())["ground_stream"]:
        if f'"{key}"' not in params:
            yield f"params.yaml: there is no ground_stream.{key}"


def main():
    stand_in_for_ros()
    faults = list(package_faults())
    for path in sorted(PACKAGE.glob("launch/*.py")):
        faults += launch_faults(path)
    for path in [*PACKAGE.glob("rviz/*.rviz"), *PACKAGE.glob("layouts/*.json")]:
        faults += layout_faults(path)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
