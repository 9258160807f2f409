#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_schemas.py OUT.cpp: writes the table of schemas (schema_table.hpp) from idl/*/msg/*.idl.

Our own types become one flat IDL text each (omgidl) for live clients; they, and those of ROS 2 and PX4, the text that
rosbag2 and Foxglove know as ros2msg: the message, then each type inside it after a line of equals signs.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
IDL = ROOT / "idl"
sys.path.insert(0, str(ROOT / "deploy" / "ros2"))
from messages import messages_of  # noqa: E402

OWN = "foretrack_msgs"
INCLUDE = re.compile(r'^#include "(.+)"$', re.MULTILINE)
RULER = "=" * 80


def with_includes(name, seen=None):
    """The file and all that it includes, each once, before whoever needs it."""
    seen = {} if seen is None else seen
    if name not in seen:
        text = (IDL / name).read_text()
        for include in INCLUDE.findall(text):
            with_includes(include, seen)
        seen[name] = text
    return seen


def flat_idl(files):
    lines = []
    for text in files.values():
        for line in text.splitlines():
            code = line.split("//")[0].rstrip()
            if code and not code.startswith("#"):
                lines.append(code)
    return "\n".join(lines) + "\n"


def ros_message(files):
    parts = []
    for name, text in reversed(files.items()):
        package = name.split("/")[0]
        for message, body in reversed(messages_of(text).items()):
            body = "\n".join(line.split("#")[0].rstrip() for line in body.splitlines())
            body = "\n".join(line for line in body.splitlines() if line)
            parts.append(f"{RULER}\nMSG: {package}/{message}\n{body}\n" if parts else f"{body}\n")
    return "".join(parts)


def rows():
    for path in sorted(IDL.glob("*/msg/*.idl")):
        package, stem = path.parts[-3], path.stem
        files = with_includes(f"{package}/msg/{path.name}")
        wire = f"{package}::msg::dds_::{stem}_"
        if package == OWN:
            yield wire, [(f"{package}::msg::{stem}", "omgidl", flat_idl(files)),
                         (f"{package}/msg/{stem}", "ros2msg", ros_message(files))]
        else:
            yield wire, [(f"{package}/msg/{stem}", "ros2msg", ros_message(files))]


def main(out):
    text = '#include "services/ground_station/schemas/schema_table.hpp"\n\n'
    text += "namespace foretrack::station {\nnamespace {\nconstexpr SchemaRow kRows[] = {\n"
    for wire, schemas in sorted(rows()):
        forms = ", ".join(f'{{"{name}", "{encoding}", R"~({schema})~"}}' for name, encoding, schema in schemas)
        text += f'{{"{wire}", {forms}{"" if len(schemas) > 1 else ", {}"}}},\n'
    text += "};\n}  // namespace\n\nstd::span<const SchemaRow> schema_table() { return kRows; }\n"
    text += "}  // namespace foretrack::station\n"
    Path(out).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1])
