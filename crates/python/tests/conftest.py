"""What the tests have in common: the repository, a small manifest, and no progress bars."""

import pathlib
import signal
import subprocess
import sys
import time
from collections.abc import Callable

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]

SMALL = """
[atlas]
title = "Small"
[[family]]
id = "four-bars"
linkage = "four-bar"
sampling = { samples = 36 }
where = "is_crank_rocker"
columns = ["psi_deg", "speed"]
let = { crank = 1 }
grid = { frame = { from = 2, to = 5, count = 4 }, coupler = { from = 2, to = 5, count = 5 }, rocker = { from = 2, to = 5, count = 5 }, along = [0, 1], across = [0, 1] }
[[family]]
id = "watt"
linkage = "watt"
sampling = { samples = 36 }
grid = { p = [3, 40], r = [2, 2.5], a = [1, 1.5, 2] }
"""


@pytest.fixture
def root() -> pathlib.Path:
    return ROOT


@pytest.fixture
def interrupted() -> Callable[[str, float], tuple[int, str, float]]:
    """Runs a program, and sends it Ctrl-C so many seconds after it has printed "begun": its exit code, its errors, and the seconds until it ended."""

    def run(program: str, after: float) -> tuple[int, str, float]:
        process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert process.stdout is not None and process.stdout.readline() == "begun\n"
        time.sleep(after)
        process.send_signal(signal.SIGINT)
        begin = time.monotonic()
        _, errors = process.communicate(timeout=60)
        return process.returncode, errors, time.monotonic() - begin

    return run


@pytest.fixture
def manifest(tmp_path: pathlib.Path) -> Callable[[str], pathlib.Path]:
    """Writes a manifest, and returns its path."""

    def write(text: str = SMALL) -> pathlib.Path:
        path = tmp_path / "small.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write
