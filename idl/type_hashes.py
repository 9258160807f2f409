#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""type_hashes.py OUT.cpp: writes the hash of each type in idl/ as ROS 2 computes it (REP-2011).

A hash is SHA-256 over a description of the type and of all types inside it, as JSON with fixed
spaces. ROS 2 from Iron on tells types of one name apart by it.
"""
import hashlib
import json
import re
import sys
from pathlib import Path

IDL = Path(__file__).resolve().parent
sys.path.insert(0, str(IDL.parent / "deploy" / "ros2"))
from messages import FIELD, STRUCT  # noqa: E402

# type_description_interfaces/msg/FieldType, where a message's char is an uint8; arrays and sequences
# are these plus a number.
KINDS = {"nested": 1, "int8": 2, "uint8": 3, "char": 3, "int16": 4, "uint16": 5, "int32": 6,
         "uint32": 7, "int64": 8, "uint64": 9, "float": 10, "double": 11, "boolean": 15, "octet": 16,
         "string": 17, "bounded string": 21}
ARRAY, BOUNDED_SEQUENCE, SEQUENCE = 48, 96, 144
MODULE = re.compile(r"module (\w+) \{$")
SEQUENCE_OF = re.compile(r"sequence<(.+?)(?:, ?(\d+))?>$")
STRING = re.compile(r"string(?:<(\d+)>)?$")


def field_type(idl_type, dimensions):
    added, capacity = 0, 1
    for size in re.findall(r"\d+", dimensions):  # ROS 2 has one dimension; on the wire it is the same
        added, capacity = ARRAY, capacity * int(size)
    if match := SEQUENCE_OF.match(idl_type):
        idl_type, bound = match.groups()
        added, capacity = (BOUNDED_SEQUENCE, int(bound)) if bound else (SEQUENCE, 0)
    kind, string_capacity, nested = idl_type, 0, ""
    if match := STRING.match(idl_type):
        string_capacity = int(match[1] or 0)
        kind = "bounded string" if string_capacity else "string"
    elif "::" in idl_type:
        kind, nested = "nested", idl_type.replace("::", "/")
    return {"type_id": KINDS[kind] + added, "capacity": capacity if added else 0,
            "string_capacity": string_capacity, "nested_type_name": nested}


def types_of(text):
    """Description by name ("std_msgs/msg/Header") of each struct of one IDL file."""
    types, modules, fields = {}, [], None
    for line in (line.split("//")[0].strip() for line in text.splitlines()):
        if match := MODULE.match(line):
            modules.append(match[1])
        elif match := STRUCT.match(line):
            fields = []
            name = "/".join([*modules, match[1]])
            types[name] = {"type_name": name, "fields": fields}
        elif line == "};" and fields is not None:
            fields = None
        elif line == "};":
            modules.pop()
        elif fields is not None and (match := FIELD.match(line)):
            fields.append({"name": match[2], "type": field_type(match[1], match[3])})
    return types


def all_types():
    types = {}
    for path in sorted(IDL.glob("*/*/*.idl")):
        types.update(types_of(path.read_text()))
    return types


def hash_of(name, types):
    inside, waiting = set(), [name]
    while waiting:
        nested = {f["type"]["nested_type_name"] for f in types[waiting.pop()]["fields"]} - {""}
        waiting += nested - inside
        inside |= nested
    description = {"type_description": types[name],
                   "referenced_type_descriptions": [types[other] for other in sorted(inside)]}
    return "RIHS01_" + hashlib.sha256(json.dumps(description).encode()).hexdigest()


def main(out):
    types = all_types()
    rows = []
    for name in types:
        package, folder, stem = name.split("/")
        rows.append(f'{{"{package}::{folder}::dds_::{stem}_", "{hash_of(name, types)}"}},\n')
    text = '#include "services/common/type_hash_table.hpp"\n\nnamespace foretrack {\nnamespace {\n'
    text += "constexpr TypeHashRow kRows[] = {\n" + "".join(sorted(rows)) + "};\n}  // namespace\n\n"
    text += "std::span<const TypeHashRow> type_hash_table() { return kRows; }\n}  // namespace foretrack\n"
    Path(out).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1])
