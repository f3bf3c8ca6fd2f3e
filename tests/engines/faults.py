"""Lets each system call of a run fail, for .ci/faults: faults.py PROGRAM FOLDER"""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROGRAM, FOLDER = os.path.abspath(sys.argv[1]), Path(sys.argv[2]) / "faults"

# What has to do with files; calls that a machine does not have are left out. Files are handed to the disk before they are closed, so that
# nothing depends on `close`.
CALLS = (
    "openat read pread64 write pwrite64 lseek ftruncate fsync fdatasync rename renameat renameat2 unlink unlinkat mkdir rmdir "
    "statx newfstatat fstat getdents64 flock fcntl readlink link linkat chmod fchmod copy_file_range sendfile"
).split()

MANIFEST = """[atlas]
title = "T"
output = "out"
formats = ["svg", "png", "pdf"]
[page]
paper = {{ width = "110 mm", height = "100 mm" }}
dpi = 30
[[family]]
id = "evans"
linkage = "evans"
panels = [1, 1]
sampling = {{ step = "{step}" }}
cases = [{cases}]
"""
# The new atlas has other bytes in every file, a page less, and a family less.
CASES = ["{ p = 2, a = 2.6 }", "{ p = 3, a = 4 }", "{ p = 4, a = 5.6 }"]
OLD = MANIFEST.format(step="10 deg", cases=", ".join(CASES)) + '[[family]]\nid = "watt"\nlinkage = "watt"\ngrid = { p = 3, r = 2, a = 1 }\n'
NEW = MANIFEST.format(step="6 deg", cases=", ".join(CASES[:2]))


def tree(folder):
    """The digests of the files in a folder."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.rglob("*")
        if path.is_file() and not path.is_symlink()
    }


def render(folder, manifest, trace=()):
    """Renders a manifest into a folder, and returns the exit code and what was said."""
    (folder / "atlas.toml").write_text(manifest)
    command = [*trace, PROGRAM, "render", "--quiet", "--jobs", "1"]
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300, check=False)
    return ended.returncode, ended.stderr


def prepared(name, source):
    folder = FOLDER / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if source is not None:
        shutil.copytree(source / "out", folder / "out")
    return folder


def undisturbed(name, manifest):
    folder = prepared(name, None)
    assert render(folder, manifest) == (0, ""), name
    return folder, tree(folder / "out")


def places(source, manifest):
    """For each call the number of the first that the program makes for itself, and the greatest number of a thread."""
    folder, log = prepared("log", source), FOLDER / "calls"
    trace = ["strace", "-f", "-qq", "-e", "trace=" + ",".join("?" + call for call in CALLS), "-o", str(log)]
    assert render(folder, manifest, trace) == (0, "")
    counts, first, main = {}, None, None
    for line in log.read_text(errors="replace").splitlines():
        # A call that another thread interrupts is counted where it begins.
        found = re.match(r"(\d+) +(\w+)\(", line)
        if not found:
            continue
        main = main or found[1]
        # What the system does to start the program comes before.
        if first is None and "atlas.toml" in line:
            first = Counter(counts[main])
        counts.setdefault(found[1], Counter())[found[2]] += 1
    assert first is not None
    return {
        call: range(first[call] + 1, max(count[call] for count in counts.values()) + 1)
        for call in CALLS
        if any(count[call] for count in counts.values())
    }


def check_record(out):
    """Asserts that every file that a record says something about has the digest in it."""
    path = out / "run.json"
    if not path.exists():
        return
    record = json.loads(path.read_text())
    files = [(family["id"], file) for family in record["families"] for file in family["files"]]
    files += [("", record[key]) for key in ("gallery", "kernel") if key in record]
    for folder, file in files:
        if "sha256" in file:
            assert (out / folder / file["name"]).exists(), f"{file['name']} is in run.json and not there"
            found = hashlib.sha256((out / folder / file["name"]).read_bytes()).hexdigest()
            assert found == file["sha256"], f"{file['name']} is not what run.json says"


def fault(name, source, old, new, call, number):
    """Lets a call fail, and returns what came of it: `unreached`, `failed` or `harmless`."""
    folder, log = prepared(name, source), FOLDER / f"{name}.log"
    trace = ["strace", "-f", "-qq", "-e", f"trace={call}", "-e", f"inject={call}:error=EIO:when={number}", "-o", str(log)]
    code, said = render(folder, NEW, trace)
    faults = log.read_text(errors="replace").count("(INJECTED)")
    if not faults:
        return "unreached"
    out = folder / "out"
    found = tree(out) if out.exists() else {}
    is_temporary = lambda path: Path(path).name.startswith(".coupler-atlas")
    for path, digest in found.items():
        if is_temporary(path) or path in ("run.json", "images.json"):
            continue
        assert digest in (old.get(path), new.get(path)), f"{path} has neither its old nor its new bytes"
    lost = [path for path in old if path in new and path not in found]
    assert not lost, f"lost: {lost}"
    check_record(out)
    if code == 0:
        whole = {path: digest for path, digest in found.items() if not is_temporary(path)}
        assert whole == new, f"ends with 0: {sorted(path for path in {**whole, **new} if whole.get(path) != new.get(path))}"
    else:
        assert code == 3, f"ends with {code}: {said}"
        # A thread counts its own calls, so that the message may be lost as well.
        assert said.startswith("error: ") or said == "" and faults > 1, f"says {said!r}"
    left = [path for path in found if is_temporary(path) and (code == 0 or path.endswith((".tmp", ".partial", ".lock")))]
    for path in left:
        assert Path(path).name in said, f"{path} is left and not said: {said}"
    again = render(folder, NEW)
    assert again == (0, ""), f"the next run: {again}"
    assert tree(out) == new, "the next run does not complete the atlas"
    shutil.rmtree(folder)
    log.unlink()
    return "harmless" if code == 0 else "failed"


def main():
    old_folder, old = undisturbed("old", OLD)
    _, new = undisturbed("new", NEW)
    problems, total = [], Counter()
    # A first run, and one that replaces an atlas.
    for source, before, title in ((None, {}, "first"), (old_folder, old, "next")):
        tasks = [(call, number) for call, numbers in places(source, NEW).items() for number in numbers]

        def attempt(task):
            call, number = task
            try:
                return fault(f"{title}-{call}-{number}", source, before, new, call, number)
            except AssertionError as error:
                problems.append(f"{title} run, {call} number {number}: {error}")
                return "problem"

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            results = Counter(pool.map(attempt, tasks))
        print(f"faults: {title} run: {len(tasks)} calls, " + ", ".join(f"{count} {result}" for result, count in sorted(results.items())))
        total += results
    if problems:
        sys.exit("\n".join(["faults:", *problems]))
    assert total["failed"] > 200 and not total["problem"], total


main()
