"""Lets the system fail to read a file, for .ci/faults: unreadable.py PROGRAM FOLDER FONT"""

import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROGRAM, FOLDER, FONT = os.path.abspath(sys.argv[1]), Path(sys.argv[2]) / "unreadable", sys.argv[3]

# By which a file is found and read; calls that a machine does not have are left out.
CALLS = "openat read pread64 lseek statx newfstatat fstat getdents64 readlink".split()

# A disk or a network that fails, a server that has lost a file, too many open files, too little memory; and what is said.
ERRORS = {
    "EIO": "Input/output error",
    "ESTALE": "Stale file handle",
    "EMFILE": "Too many open files",
    "ENOMEM": "Cannot allocate memory",
}

MANIFEST = """[atlas]
title = "T"
output = "out"
formats = ["svg", "png", "pdf"]
[page]
paper = { width = "110 mm", height = "100 mm" }
dpi = 30
theme = { fallback_face = "face.ttf" }
[[linkage]]
id = "own"
trace = ["B"]
parameters = { r = { default = 3, min = 0 } }
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = [4, 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = ["r", 3], side = "left" }
[[family]]
id = "evans"
linkage = "evans"
sampling = { samples = 24 }
cases = [{ p = 2, a = 2.6 }]
"""
POINTS = [(0, 0), (2, 1), (4, 0), (3, -2), (1, -2)]
CORNERS = " ".join(f"{x},{y}" for x, y in POINTS)
FILES = {
    "atlas.toml": MANIFEST,
    "path.csv": "x,y\n" + "".join(f"{x},{y}\n" for x, y in POINTS),
    "path.json": str([list(point) for point in POINTS]),
    "path.svg": f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><polygon points="{CORNERS}" stroke="#000"/></svg>',
}

OWN = ["own", "--manifest", "atlas.toml"]
FIND = ["--no-refine", "--index", "1000", "--top", "1"]
SHARD = "tables/evans/cells-00000-of-00001"
READ = ["atlas.toml", "face.ttf"]
RECORDED = ["run.json", "images.json", "atlas.pdf", "index.html", "kernel.js"]
RECORDED += [f"evans/{name}" for name in ("points.csv", "cells.csv", "evans-001.svg", "evans-001.png", "gallery.js")]

# Commands, what they read from standard input, and the files and folders that they read.
COMMANDS = [
    (["validate"], None, READ),
    (["validate", "-"], "atlas.toml", ["atlas.toml"]),
    (["render", "--quiet", "-o", "rendered"], None, [*READ, "rendered/run.json"]),
    (["render", "--quiet", "--shard", "0/1", "-o", "part"], None, READ),
    (["sweep", "--quiet", "-o", "swept"], None, READ),
    (["sweep", "--quiet", "-o", "swept-again", "-"], "atlas.toml", ["atlas.toml"]),
    (["check", "--against", "out"], None, [*READ, *(f"out/{name}" for name in RECORDED)]),
    (["export", "atlas.toml", "evans:1.1.1", "-o", "-", "--format", "csv"], None, READ),
    (["export", "--linkage", *OWN, "-o", "-", "--format", "csv"], None, ["atlas.toml"]),
    (["list", "families", "atlas.toml"], None, READ),
    (["list", "linkages", *OWN], None, ["atlas.toml"]),
    (["inspect", *OWN], None, ["atlas.toml"]),
    (["find", "path.csv", *FIND], None, ["path.csv"]),
    (["find", "path.json", *FIND], None, ["path.json"]),
    (["find", "path.svg", *FIND], None, ["path.svg"]),
    (["find", "-", *FIND], "path.csv", ["path.csv"]),
    (["find", "path.csv", "--linkage", *OWN, "--index", "10", "--effort", "quick"], None, ["path.csv", "atlas.toml"]),
    (["find", "path.csv", "--atlas", "atlas.toml", "--no-refine"], None, ["path.csv", *READ]),
    (["find", "path.csv", "--atlas", "out", "--no-refine"], None, [*READ, "out", "out/run.json"]),
    (["gather", "tables"], None, ["tables", "tables/evans", f"{SHARD}.parquet"]),
    (["gather", "texts"], None, [f"{SHARD}.csv".replace("tables", "texts"), f"{SHARD}.json".replace("tables", "texts")]),
]


def run(arguments, source, trace=()):
    """Runs the program, and returns the exit code, and what was printed and said."""
    with open(FOLDER / source if source else os.devnull, "rb") as stdin:
        ended = subprocess.run(
            [*trace, PROGRAM, *arguments],
            cwd=FOLDER,
            env={**os.environ, "XDG_CACHE_HOME": str(FOLDER / "cache")},
            stdin=stdin,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
    said = [line for line in ended.stderr.splitlines() if not line.startswith("strace: ")]
    return ended.returncode, ended.stdout, "\n".join(said)


def traced(log, arguments, source, path, expression):
    trace = ["strace", "-f", "-qq", "-P", path, "-P", str(FOLDER / path), "-o", str(log)]
    trace += [part for expression in expression for part in ("-e", expression)]
    ended = run(arguments, source, trace)
    return ended, log.read_text(errors="replace")


def places(log):
    """The greatest number of each call in a thread."""
    counts = Counter(re.match(r"(\d+) +(\w+)\(", line).groups() for line in log.splitlines() if re.match(r"\d+ +\w+\(", line))
    greatest = {}
    for (_, call), count in counts.items():
        greatest[call] = max(count, greatest.get(call, 0))
    return greatest


def check(command):
    """Lets each call of a command and all that follow it fail, and returns how often that was said, and the problems."""
    number, (arguments, source, paths) = command
    log, results, problems = FOLDER / f"{number}.log", Counter(), []
    # What it writes is there from the second run on.
    assert run(arguments, source)[0] == 0, run(arguments, source)
    expected = run(arguments, source)
    for path in paths:
        _, found = traced(log, arguments, source, path, ["trace=" + ",".join("?" + call for call in CALLS)])
        calls = places(found)
        assert calls, f"{arguments} does not read {path}"
        for call, error, at in ((call, error, at) for call in calls for error in ERRORS for at in range(1, calls[call] + 1)):
            injected = [f"trace={call}", f"inject={call}:error={error}:when={at}+"]
            (code, printed, said), found = traced(log, arguments, source, path, injected)
            last = said.splitlines()[-1:]
            if "(INJECTED)" not in found:
                results["unreached"] += 1
            elif (code, printed, said) == expected:
                results["harmless"] += 1
            elif code == 3 and last and last[0].startswith("error: ") and ERRORS[error] in last[0]:
                results["failed"] += 1
            else:
                problems.append(f"{' '.join(arguments)}: {path}, {call} number {at}, {error}: ends with {code}: {said}")
    return results, problems


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for name, text in FILES.items():
        (FOLDER / name).write_text(text)
    shutil.copy(FONT, FOLDER / "face.ttf")
    for arguments in (["render"], ["sweep", "-o", "tables"], ["sweep", "-o", "texts", "--format", "csv"]):
        assert run([*arguments, "--quiet"], None) == (0, "", ""), arguments
    # The index of curves is made once.
    assert run(["find", "path.csv", *FIND], None)[0] == 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(check, enumerate(COMMANDS)))
    results = sum((results for results, _ in found), Counter())
    print("unreadable: " + ", ".join(f"{count} {result}" for result, count in sorted(results.items())))
    problems = [problem for _, problems in found for problem in problems]
    if problems:
        sys.exit("\n".join(["unreadable:", *problems]))
    assert results["failed"] > 200, results


main()
