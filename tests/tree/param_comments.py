#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A parameter's meaning beside its field, where an editor shows it. It is written once, in the
parameter's row; this copies it.

    param_comments.py check    whether every field's comment is what its row says
    param_comments.py write    copies the rows' meanings to the fields (needs clang-format)

Exit code 0: they are the same; 1: not, with a line for each.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIELD = re.compile(r"^  (?:double|int|bool) (\w+) = [^;]*;")
ROW = re.compile(r'\{\s*"\w+",\s*&\w+\.(\w+),\s*"[^"]*",[^{}]*?,\s*((?:"[^"]*"\s*)+)\}')


def meanings():
    """{struct: {field: meaning}}, as all rows() of core say."""
    found = {}
    for source in ROOT.glob("core/**/*.cpp"):
        text = source.read_text()
        for begin in re.finditer(r"^ParamRows rows\w*\((\w+)& \w+\) \{$", text, re.M):
            body = text[begin.end():text.index("\n}\n", begin.end())]
            rows = {field: " ".join("".join(re.findall(r'"([^"]*)"', quoted)).split())
                    for field, quoted in ROW.findall(body)}
            if rows:
                found.setdefault(begin[1], {}).update(rows)
    return found


def said_of(lines, i):
    """What stands at line i as a comment, behind the code and in whole lines that go on with it."""
    words = [lines[i].partition("//")[2]]
    while words[0] and i + 1 < len(lines) and re.match(r"^ {4,}///?<? ", lines[i + 1]):
        i += 1
        words.append(lines[i].partition("//")[2])
    return i, [re.sub(r"^/?<? ?", "", word) for word in words]


def of_struct(lines, rows):
    """The struct's lines with the comments that they should have, and (field, said) as they are."""
    out, said, i = [], [], 0
    while i < len(lines):
        field = FIELD.match(lines[i])
        if not field or field[1] not in rows:
            out.append(lines[i])
            i += 1
            continue
        code = lines[i].partition("//")[0].rstrip()
        i, words = said_of(lines, i)
        while out and out[-1].startswith("  /// "):
            words.insert(0, out.pop().removeprefix("  /// "))
        said.append((field[1], " ".join(" ".join(words).split())))
        behind = f"{code}  ///< {rows[field[1]]}"
        out += [behind] if len(behind) <= 100 else [f"  /// {rows[field[1]]}", code]
        i += 1
    return out, said


def headers(known):
    """(path, its text, its text as it should be, the faults)"""
    for path in sorted(ROOT.glob("core/**/*.hpp")):
        text, faults = path.read_text(), []
        wanted = text
        for begin in re.finditer(r"^struct (\w+) \{\n", text, re.M):
            rows = known.get(begin[1])
            if not rows:
                continue
            end = text.index("\n};", begin.end())
            body = text[begin.end():end]
            out, said = of_struct(body.split("\n"), rows)
            name = path.relative_to(ROOT)
            faults += [f"{name}: {begin[1]}.{field} does not say: {rows[field]}"
                       for field, words in said if words != rows[field]]
            faults += [f"{name}: {begin[1]} has no field {field}"
                       for field in rows.keys() - {field for field, _ in said}]
            wanted = wanted.replace(body, "\n".join(out))
        yield path, text, wanted, faults


def main():
    if sys.argv[1:] not in (["check"], ["write"]):
        raise SystemExit(__doc__)
    known, all_faults = meanings(), []
    if not known:
        all_faults.append("no rows are found in core")
    for path, text, wanted, faults in headers(known):
        if sys.argv[1] == "write" and faults:
            path.write_text(wanted)
            subprocess.run(["clang-format", "-i", path], check=True)
        all_faults += faults
    if sys.argv[1] == "check":
        print("\n".join(all_faults))
        sys.exit(1 if all_faults else 0)


if __name__ == "__main__":
    main()
