#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the tree keeps its own rules; each rule is a test.

    check_tree.py layers     who may include whom
    check_tree.py names      a .cpp has a header of its name beside it, and implements that one
    check_tree.py mirrors    a .cpp of core that decides something has a test of its name, an intention too
    check_tree.py licences   every source says its licence first
    check_tree.py documents  every file that the documents name exists
    check_tree.py promises   every row of the table in docs/safety.md names tests, and they exist
    check_tree.py units      every service has a systemd unit that starts it again, with few rights
    check_tree.py lengths    functions: 95 of 100 have at most 25 lines, none more than 90

Exit code 0: kept; 1: broken, with a line for each fault; 77: a tool is missing.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LEFT_OUT = {"node_modules", "dist"}

# Stages know `common` and never each other, but for these: what runs networks serves perception, what
# judges predictions knows them, and the tracker composes all.
KNOWS = {"perception": {"network"}, "scores": {"prediction"}, "tracker": None}
# From outside, core knows the standard library without clocks, threads, the environment and the
# terminal, and what a stage needs for its work.
LIBRARIES = {"mapping": ("octomap/",), "network": ("xnnpack.h", "pthreadpool.h")}
NOT_IN_CORE = {"chrono", "thread", "mutex", "condition_variable", "future", "iostream", "ctime",
               "cstdlib"}
DDS = ("fastdds/", "fastrtps/", "fastcdr/")

# A command is named by its word, and commands.hpp lists them all. Fitted numbers are tables that a
# program writes; who reads them declares them.
HEADERLESS = re.compile(r"services/cli/\w+_commands?\.cpp|.*/main\.cpp"
                        r"|core/prediction/(intentions/)?\w+_weights\.cpp")

# What decides nothing: fitted numbers, and memory that is taken beforehand.
TESTLESS = re.compile(r"core/prediction/(intentions/)?\w+_weights\.cpp|core/planning/planning_state\.cpp")

# Of two classes that hide the middleware behind them.
HIDDEN = {"services/common/dds_impl.hpp"}

# What runs for long on a vehicle or beside it, and what its unit says: started again at once, for ever,
# as nobody, within bounds.
SERVED = ("safety_gate", "stages", "black_box", "station")
UNIT_SAYS = ("Restart=always", "RestartSec=0", "StartLimitIntervalSec=0", "DynamicUser=yes",
             "NoNewPrivileges=yes", "ProtectSystem=strict", "MemoryMax=", "SystemCallFilter=")
MOST_EXPOSED = "2.0"  # of systemd-analyze security; 10 is worst

MADE = {"core/version.hpp"}  # by the build


def files(*patterns):
    """Sources of the tree, by paths relative to its root."""
    found = []
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            if not LEFT_OUT.intersection(path.parts):
                found.append(path.relative_to(ROOT).as_posix())
    return found


def includes(name):
    for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
        if match := re.match(r'#include ["<]([^">]+)[">]', line):
            yield number, match[1]


def core_fault(name, included):
    stage, folder = name.split("/")[1], included.split("/")
    if folder[0] == "core" and len(folder) > 2:
        known = KNOWS.get(stage, set())
        if known is None or folder[1] in {stage, "common"} | known:
            return None
        return f"core/{stage} includes another stage: {included}"
    if included.startswith("octomap/") and name.endswith(".hpp") and "/octree_" not in name:
        return f"who includes {name} must not need OctoMap: {included}"
    if folder[0] == "core" or included.startswith(("Eigen/",) + LIBRARIES.get(stage, ())):
        return None
    if included in NOT_IN_CORE:
        return f"core has no clock, thread, environment or terminal: {included}"
    if "/" in included or included.endswith((".h", ".hpp")):
        return f"core includes what it must not know: {included}"
    return None


def layers():
    for name in files("core/**/*.[ch]pp"):
        for number, included in includes(name):
            if fault := core_fault(name, included):
                yield f"{name}:{number}: {fault}"
    for name in files("services/**/*.[ch]pp"):
        for number, included in includes(name):
            if included.startswith(DDS) and not name.startswith("services/common/"):
                yield f"{name}:{number}: only services/common calls DDS: {included}"


def names():
    sources = files("core/**/*.cpp", "services/**/*.cpp")
    for name in sources:
        if not HEADERLESS.fullmatch(name) and not (ROOT / name).with_suffix(".hpp").exists():
            yield f"{name}: has no header of its name; its content belongs where it is declared"
    if not shutil.which("ctags"):
        return  # lengths() says so
    declared = {}
    for name, kind, function in functions(*sources, *files("core/**/*.hpp", "services/**/*.hpp")):
        if kind == "prototype":
            declared.setdefault(function, set()).add(name)
    for name, kind, function in functions(*sources):
        headers = {header for header in declared.get(function, ()) if header.endswith(".hpp")}
        if headers and not HEADERLESS.fullmatch(name) and not HIDDEN.intersection(headers) and \
                name.removesuffix(".cpp") + ".hpp" not in headers:
            yield f"{name}: {function[1]} is declared in {', '.join(sorted(headers))}"


def functions(*sources):
    """(file, prototype or function, (class, name, types of its arguments))"""
    tags = subprocess.run(
        ["ctags", "--languages=C++", "--kinds-C++=fp", "--fields=KsS", "-f", "-", *sources],
        cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for line in tags.splitlines():
        function, name, rest = line.split("\t", 2)
        kind, *fields = rest.split(';"\t')[1].split("\t")
        told = dict(field.split(":", 1) for field in fields if ":" in field)
        scope = told.get("class", told.get("struct", ""))
        if "__anon" in scope + told.get("namespace", "") + function:
            continue
        arguments = re.sub(r" = [^,)]*|\s*\b\w+(?=[,)])|\s", "", told.get("signature", ""))
        yield name, kind, (scope.split("::")[-1], function, arguments)


def mirrors():
    intentions = [name for name in files("core/prediction/intentions/*.hpp")
                  if re.search(r"constexpr IntentionRow k", (ROOT / name).read_text())]
    for name in files("core/**/*.cpp") + intentions:
        test = "tests/" + re.sub(r"\.[ch]pp$", "", name) + "_test.cpp"
        if not TESTLESS.fullmatch(name) and not (ROOT / test).exists():
            yield f"{name}: has no {test}"


def licences():
    sources = files("core/**/*.[ch]pp", "services/**/*.[ch]pp", "tests/**/*.[ch]pp",
                    "bench/**/*.[ch]pp", "examples/**/*.[ch]pp", "idl/foretrack_msgs/**/*.idl",
                    "cmake/*", "**/CMakeLists.txt", "deploy/**/*.py", "bench/**/*.py",
                    "tests/**/*.py", "services/ground_station/web/src/**/*.ts*", "run")
    for name in sources:
        if name.startswith("build"):
            continue
        if "SPDX-License-Identifier: Apache-2.0" not in (ROOT / name).read_text()[:200]:
            yield f"{name}: does not say its licence in its first lines"


def documents():
    path = re.compile(r"[`(]((?:\.?[\w-]+/)+[\w.{},*-]*|run|\w+\.md)[`)#]")
    for document in files("*.md", "docs/*.md", "docs/adr/*.md", "examples/*.md"):
        folder = (ROOT / document).parent
        for number, line in enumerate((ROOT / document).read_text().splitlines(), 1):
            for named in path.findall(line):
                first = named.split("/")[0]
                if not (ROOT / first).exists() and not (folder / first).exists():
                    continue  # a topic, a made file, a path of another machine
                if first.startswith(("build", "flights", "models", "recordings")):
                    continue
                if named in MADE:
                    continue
                for one in braces(named):
                    if not any(ROOT.glob(one)) and not any(folder.glob(one)):
                        yield f"{document}:{number}: there is no {one}"


def promises():
    known = {".".join(pair) for name in files("tests/**/*_test.cpp")
             for pair in re.findall(r"TEST(?:_[FP])?\((\w+),\s*(\w+)\)", (ROOT / name).read_text())}
    rows = [line for line in (ROOT / "docs/safety.md").read_text().splitlines()
            if line.startswith("| ") and not line.startswith("| Hazard")]
    if not rows:
        yield "docs/safety.md has no table"
    for row in rows:
        named = re.findall(r"`([^`]*)`", row.split(" | ")[-1])
        if not named:
            yield f"docs/safety.md: no test tells of: {row.split(' | ')[0]}"
        for name in named:
            if name not in known:
                yield f"docs/safety.md: there is no test {name}"


def units():
    text = {path.name: path.read_text() for path in sorted(ROOT.glob("deploy/systemd/*.service"))}
    for service in SERVED:
        if not any(f"foretrack {service} " in unit for unit in text.values()):
            yield f"deploy/systemd has no unit of {service}"
    for name, unit in text.items():
        for word in UNIT_SAYS:
            if f"\n{word}" not in unit:
                yield f"deploy/systemd/{name} does not say {word}"
    if not shutil.which("systemd-analyze"):
        print("no systemd-analyze: the units are only read")
        return
    paths = [str(ROOT / "deploy/systemd" / name) for name in text]
    threshold = f"--threshold={int(10 * float(MOST_EXPOSED))}"
    for command in (["verify", "--man=no"], ["security", "--offline=true", threshold]):
        for path in paths:
            done = subprocess.run(["systemd-analyze", *command, path], capture_output=True, text=True,
                                  check=False)
            told = done.stderr.strip() if command[0] == "verify" else ""
            if done.returncode or told:
                yield f"{path}: systemd-analyze {command[0]}: {told or done.stdout[-200:]}"
    yield from drop_ins()


def drop_ins():
    """Faults of the units with their identities (deploy/systemd/secured/)."""
    told = (ROOT / "services/common/identity.hpp").read_text()
    wanted = set(re.findall(r'constexpr char k\w+\[\] = "([^"]+)"', told))
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(ROOT.glob("deploy/systemd/secured/*.conf")):
            text = path.read_text()
            if set(re.findall(r"^LoadCredential=([^:]+):", text, re.MULTILINE)) != wanted:
                yield f"{path}: hands over other files than an identity has"
            unit = next(ROOT.glob(f"deploy/systemd/{path.stem}[@.]*service"))
            shutil.copy(unit, folder)
            (Path(folder) / f"{unit.name}.d").mkdir()
            shutil.copy(path, Path(folder) / f"{unit.name}.d/identity.conf")
            done = subprocess.run(
                ["systemd-analyze", "verify", "--man=no", unit.name.replace("@", "@uav1")],
                env={**os.environ, "SYSTEMD_UNIT_PATH": folder + ":"}, capture_output=True, text=True,
                check=False)
            if done.returncode or done.stderr.strip():
                yield f"{path}: {done.stderr.strip()}"


def braces(text):
    """`a.{hpp,cpp}` is two names."""
    match = re.search(r"\{([^}]*)\}", text)
    if not match:
        return [text.rstrip("/")]
    return [one for choice in match[1].split(",")
            for one in braces(text[:match.start()] + choice + text[match.end():])]


def lengths():
    if not shutil.which("ctags"):
        print("no ctags (package universal-ctags)")
        sys.exit(77)
    sources = files("core/**/*.[ch]pp", "services/**/*.[ch]pp")
    tags = subprocess.run(
        ["ctags", "--languages=C++", "--kinds-C++=f", "--fields=ne", "-f", "-", *sources],
        cwd=ROOT, capture_output=True, text=True, check=True).stdout
    functions = sorted((int(end) - int(begin) + 1, f"{name}:{begin}") for name, begin, end in
                       re.findall(r"^\S+\t(\S+)\t.*\tline:(\d+).*\tend:(\d+)$", tags, re.M))
    p95 = functions[int(0.95 * len(functions))][0]
    print(f"{len(functions)} functions; lines: median {functions[len(functions) // 2][0]}, "
          f"p95 {p95}, longest {functions[-1][0]} ({functions[-1][1]})")
    if p95 > 25:
        yield f"p95 of the functions' length is {p95} lines"
    for length, place in functions:
        if length > 90:
            yield f"{place}: a function of {length} lines"


RULES = {
    rule.__name__: rule
    for rule in (layers, names, mirrors, licences, documents, promises, units, lengths)
}

if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in RULES:
        raise SystemExit(__doc__)
    faults = list(RULES[sys.argv[1]]())
    print("\n".join(faults))
    sys.exit(1 if faults else 0)
