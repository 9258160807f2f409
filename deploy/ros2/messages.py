#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the ROS 2 package foretrack_msgs from the IDL contract, or checks that it still matches.

    messages.py write    rewrites foretrack_msgs/msg/*.msg from idl/foretrack_msgs/msg/*.idl
    messages.py check    exit code 1 and a list of differences if the two do not match
"""
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
IDL = HERE.parents[1] / "idl"
MSG = HERE / "foretrack_msgs" / "msg"

# IDL's names of primitive types, and ROS 2's.
PRIMITIVES = {"boolean": "bool", "octet": "byte", "uint8": "uint8", "int8": "int8",
              "int16": "int16", "uint16": "uint16", "int32": "int32", "uint32": "uint32",
              "int64": "int64", "uint64": "uint64", "float": "float32", "double": "float64",
              "string": "string", "char": "char"}

STRUCT = re.compile(r"struct (\w+) \{$")
CONSTANTS = re.compile(r"module (\w+)_Constants \{$")
CONSTANT = re.compile(r"const (\w+) (\w+) = ([^;]+);\s*(?://\s*(.*))?$")
FIELD = re.compile(r"([\w:]+(?:<.*>)?) (\w+)((?:\[\d+\])*);\s*(?://\s*(.*))?$")


def ros_type(idl_type):
    """`sequence<foretrack_msgs::msg::Landmark, 33>` is `Landmark[<=33]`."""
    bounded = re.fullmatch(r"(sequence|string)<([^,]+?)(?:, ?(\d+))?>", idl_type)
    if bounded and bounded[1] == "string":
        return f"string<={bounded[2]}"
    if bounded:
        return f"{ros_type(bounded[2])}[{'<=' + bounded[3] if bounded[3] else ''}]"
    if idl_type in PRIMITIVES:
        return PRIMITIVES[idl_type]
    package, _, name = idl_type.split("::")
    return name if package == "foretrack_msgs" else f"{package}/{name}"


def field_line(match):
    idl_type, name, dimensions, comment = match.groups()
    sizes = [int(n) for n in re.findall(r"\d+", dimensions)]
    length = 1
    for size in sizes:
        length *= size
    if len(sizes) > 1:  # ROS 2 has one dimension; on the wire it is the same
        shape = "".join(f"[{n}]" for n in sizes) + " row major"
        comment = f"{shape}: {comment}" if comment else shape
    ros = ros_type(idl_type) + (f"[{length}]" if sizes else "")
    return f"{ros} {name}" + (f"  # {comment}" if comment else "")


def messages_of(idl_text):
    """Message name -> text of its .msg file, for each struct of one IDL file."""
    lines = [line.strip() for line in idl_text.splitlines()]
    lines = [line for line in lines if not line.startswith("// SPDX-")]
    title = lines[0].removeprefix("// ")
    constants, messages, comments = {}, {}, []
    owner, target = None, None
    for line in lines[1:]:
        if line.startswith("//"):
            comments.append("# " + line.removeprefix("//").strip())
        elif match := CONSTANTS.fullmatch(line):
            owner = match[1]
            target = constants.setdefault(owner, [])
        elif match := STRUCT.fullmatch(line):
            target = messages[match[1]] = comments + constants.pop(match[1], [])
            comments = []
        elif match := CONSTANT.fullmatch(line):
            kind, name, value, comment = match.groups()
            target.append(f"{PRIMITIVES[kind]} {name}={value}" + (f"  # {comment}" if comment else ""))
        elif match := FIELD.fullmatch(line):
            target.extend(comments)
            comments = []
            target.append(field_line(match))
        elif line and not re.fullmatch(r"module \w+ \{|\};|#(ifndef|define|include|endif).*", line):
            raise ValueError(f"not understood: {line}")
    if constants:
        raise ValueError(f"constants without a message: {', '.join(constants)}")
    main = list(messages)[-1]
    messages[main].insert(0, f"# {title}")
    return {name: "\n".join(text) + "\n" for name, text in messages.items()}


def wanted():
    messages = {}
    for path in sorted((IDL / "foretrack_msgs" / "msg").glob("*.idl")):
        try:
            messages.update(messages_of(path.read_text()))
        except ValueError as error:
            raise SystemExit(f"{path}: {error}") from error
    return messages


def broken_rules(name, text):
    """What the ROS 2 build would refuse."""
    faults = [] if re.fullmatch(r"[A-Z][A-Za-z0-9]*", name) else [f"message name {name}"]
    for line in text.splitlines():
        code = line.split("#")[0].strip()
        if not code:
            continue
        constant = re.fullmatch(r"\w+ [A-Z][A-Z0-9_]*=-?\d+", code)
        field = re.fullmatch(r"[\w/]+(<=\d+)?(\[(<=)?\d*\])? [a-z][a-z0-9]*(_[a-z0-9]+)*", code)
        if not constant and not field:
            faults.append(f"{name}.msg: {code}")
    return faults


def check():
    messages = wanted()
    have = {path.stem: path.read_text() for path in MSG.glob("*.msg")}
    differences = [f"{name}.msg is missing" for name in messages if name not in have]
    differences += [f"{name}.msg has no struct in the IDL" for name in have if name not in messages]
    differences += [f"{name}.msg differs from the IDL" for name in messages
                    if name in have and have[name] != messages[name]]
    for name, text in have.items():
        differences += broken_rules(name, text)
    for difference in differences:
        print(difference)
    if differences:
        print("`deploy/ros2/messages.py write` rewrites the messages from the IDL.")
    return 1 if differences else 0


def write():
    MSG.mkdir(parents=True, exist_ok=True)
    for path in MSG.glob("*.msg"):
        path.unlink()
    for name, text in wanted().items():
        (MSG / f"{name}.msg").write_text(text)
    return 0


if __name__ == "__main__":
    commands = {"write": write, "check": check}
    if len(sys.argv) != 2 or sys.argv[1] not in commands:
        raise SystemExit(__doc__)
    sys.exit(commands[sys.argv[1]]())
