"""The measurements of `benches/peers.sh`: this program and its peers on the same work, in one run."""

import csv
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import matplotlib
import numba
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pylinkage
from matplotlib.collections import LineCollection

PROGRAM = "target/release/coupler-atlas"
ATLAS = "examples/hrones-nelson.toml"
FINER = "examples/hrones-nelson-fine.toml"
OUT = Path("target/peers/out")
PAGES = 780
SAMPLES = 360
PAGE_MEASURES = ["class", "mu_min_deg", "mu_max_deg"]


def best(run, repeat=100, least=0.05):
    """The least time per call of many short batches, as those of `criterion`: on a busy machine a longer one is interrupted, and the peer
    looks slower than it is."""
    times = []
    for _ in range(repeat):
        count, begun = 0, time.perf_counter()
        while count == 0 or time.perf_counter() - begun < least:
            run()
            count += 1
        times.append((time.perf_counter() - begun) / count)
    return min(times)


def row(what, ours, peer, unit, target=""):
    ratio = f"{ours / peer:10.1f}" if peer else " " * 10
    peer = f"{peer:14.4g}" if peer else " " * 14
    print(f"{what:<58}{ours:14.4g}{peer}{ratio}  {unit:<14}{target}", flush=True)


def criterion(name):
    """Positions per second in the best of the batches of the preceding benchmark run, a hundred in five seconds."""
    folder = Path("target/criterion/kernel") / name / "new"
    batches = json.loads((folder / "sample.json").read_text())
    nanoseconds = min(time / count for time, count in zip(batches["times"], batches["iters"]))
    elements = json.loads((folder / "benchmark.json").read_text())["throughput"]["Elements"]
    return elements / nanoseconds * 1e9


def numpy_positions(points):
    """Positions of coupler points per second by numpy, on columns, with precomputed sines."""
    angle = np.radians(np.arange(SAMPLES) * 360.0 / SAMPLES)
    cos, sin = np.cos(angle), np.sin(angle)
    frame, coupler, rocker = 4.0, 3.0, 3.5
    along, across = 0.4 * np.arange(points)[:, None], 1.0

    def solve():
        ax, ay = cos, sin
        dx, dy = frame - ax, -ay
        d2 = dx * dx + dy * dy
        d = np.sqrt(d2)
        height = (coupler + rocker + d) * (coupler + rocker - d) * (d + coupler - rocker) * (d - coupler + rocker)
        u = (d2 + (coupler - rocker) * (coupler + rocker)) / (2.0 * d2)
        v = np.sqrt(height) / (2.0 * d2)
        bx, by = ax + u * dx - v * dy, ay + u * dy + v * dx
        ex, ey = bx - ax, by - ay
        return ax + along * ex - across * ey, ay + along * ey + across * ex

    return SAMPLES * points / best(solve)


@numba.njit
def numba_solve(cos, sin, lengths, along, across, x, y):
    """The loop over the inputs that a careful user compiles, with precomputed sines."""
    frame, coupler, rocker = lengths
    total, difference = coupler + rocker, coupler - rocker
    for k in range(cos.size):
        ax, ay = cos[k], sin[k]
        dx, dy = frame - ax, -ay
        d2 = dx * dx + dy * dy
        d = np.sqrt(d2)
        u = (d2 + total * difference) / (2.0 * d2)
        v = np.sqrt((total - d) * (total + d) * (d - difference) * (d + difference)) / (2.0 * d2)
        ex, ey = u * dx - v * dy, u * dy + v * dx
        for j in range(along.size):
            x[j, k] = ax + along[j] * ex - across * ey
            y[j, k] = ay + along[j] * ey + across * ex


def numba_positions(points):
    """Positions of coupler points per second by numba, into arrays that are there."""
    angle = np.radians(np.arange(SAMPLES) * 360.0 / SAMPLES)
    cos, sin, along = np.cos(angle), np.sin(angle), 0.4 * np.arange(points)
    x, y = np.empty((points, SAMPLES)), np.empty((points, SAMPLES))
    return SAMPLES * points / best(lambda: numba_solve(cos, sin, (4.0, 3.0, 3.5), along, 1.0, x, y))


def pylinkage_positions(fast):
    """Positions per second by pylinkage: a crank, a dyad and a coupler point, over one revolution."""
    o, q = pylinkage.Ground(0.0, 0.0), pylinkage.Ground(4.0, 0.0)
    crank = pylinkage.Crank(anchor=o, radius=1.0, angular_velocity=2.0 * np.pi / SAMPLES)
    pin = pylinkage.RRRDyad(crank.output, q, distance1=3.0, distance2=3.5, x=3.0, y=3.0)
    point = pylinkage.FixedDyad(crank.output, pin, distance=1.0, angle=0.7)
    linkage = pylinkage.Linkage((o, q, crank, pin, point), name="four-bar")
    start = linkage.get_coords()

    def turn():
        linkage.set_coords(start)
        if fast:
            linkage.step_fast(iterations=SAMPLES)
        else:
            for _ in linkage.step(iterations=SAMPLES):
                pass

    turn()
    return SAMPLES / best(turn)


@numba.njit
def newton_solve(cos, sin, start, pairs, lengths, out):
    """The joints D, E and F of a Stephenson II at each input, by Newton's method from the pose before: what a careful user compiles. `pairs` are the
    ends of the links, of which those below 3 are fixed or on the crank."""
    z = start.copy()
    n = z.size
    known = np.empty((3, 2))
    for k in range(cos.size):
        known[0] = (0.8 * cos[k] - 0.2 * sin[k], 0.8 * sin[k] + 0.2 * cos[k])
        known[1] = (-0.2 * cos[k] - 0.7 * sin[k], -0.2 * sin[k] + 0.7 * cos[k])
        known[2] = (4.0, 0.0)
        for _ in range(20):
            jacobian, residual = np.zeros((n, n)), np.empty(n)
            for row in range(pairs.shape[0]):
                a, b = pairs[row]
                xa, ya = (known[a, 0], known[a, 1]) if a < 3 else (z[2 * a - 6], z[2 * a - 5])
                xb, yb = z[2 * b - 6], z[2 * b - 5]
                dx, dy = xb - xa, yb - ya
                residual[row] = dx * dx + dy * dy - lengths[row] ** 2
                jacobian[row, 2 * b - 6], jacobian[row, 2 * b - 5] = 2 * dx, 2 * dy
                if a >= 3:
                    jacobian[row, 2 * a - 6], jacobian[row, 2 * a - 5] = -2 * dx, -2 * dy
            step = np.linalg.solve(jacobian, residual)
            z -= step
            if np.abs(step).max() < 1e-12:
                break
        out[k] = z


def newton_positions():
    """Positions per second of the Stephenson II of the catalogue by Newton's method, compiled by numba: with no proof that it stays on its circuit."""
    turn = np.linspace(0.0, 2.0 * np.pi, SAMPLES, endpoint=False)
    drawn = np.array([2.6, 2.4, 1.0, 3.2, 3.6, 3.4])
    points = np.array([[0.8, 0.2], [-0.2, 0.7], [4.0, 0.0], [2.6, 2.4], [1.0, 3.2], [3.6, 3.4]])
    pairs = np.array([[0, 3], [1, 4], [2, 5], [3, 4], [4, 5], [3, 5]])
    lengths = np.array([np.hypot(*(points[a] - points[b])) for a, b in pairs])
    out = np.empty((SAMPLES, 6))
    return SAMPLES / best(lambda: newton_solve(np.cos(turn), np.sin(turn), drawn, pairs, lengths, out))


def render(manifest, formats, dpi=None, measures=None):
    """Seconds and peak megabytes of a run into an empty folder, with the given measures or with all."""
    shutil.rmtree(OUT, ignore_errors=True)
    text = Path(manifest).read_text()
    if dpi:
        text = text.replace('paper = "tabloid"', f'paper = "tabloid"\ndpi = {dpi}')
    if measures is not None:
        text = text.replace("\nsampling =", f"\nmeasures = {json.dumps(measures)}\nsampling =")
    manifest = "target/peers/atlas.toml"
    Path(manifest).write_text(text)
    # A child's peak memory includes that of the process it is forked from: this one has matplotlib loaded, so a bare
    # interpreter starts the child and waits for it.
    command = [PROGRAM, "render", "--quiet", "--format", formats, "-o", str(OUT), manifest]
    waiting = subprocess.run([sys.executable, "-S", "-c", WAIT, *command], stdout=subprocess.PIPE, text=True)
    if waiting.returncode != 0:
        sys.exit(f"{PROGRAM} failed")
    seconds, kilobytes = waiting.stdout.split()
    return float(seconds), float(kilobytes) / 1024


WAIT = """
import os, sys, time
begun = time.perf_counter()
child = os.fork()
if child == 0:
    os.execv(sys.argv[1], sys.argv[1:])
_, status, usage = os.wait4(child, 0)
print(time.perf_counter() - begun, usage.ru_maxrss)
sys.exit(status != 0)
"""


def some_pages(count):
    """Pages of ten curves, from cells spread over the atlas, at every degree of the crank, which dashes of 3 degrees need to
    look as smooth as ours. Their points are compared with `points.csv`."""
    with open(OUT / "hrones-nelson" / "cells.csv", newline="") as file:
        rows = [line for line in csv.DictReader(file) if line["trace"] == "1"]
    chosen = [rows[k * len(rows) // count] for k in range(count)]
    pages = []
    for k, row in enumerate(chosen):
        ratios = [float(row[name]) for name in "ABC"]
        first = 10 * (k % 5)
        pages.append((row["cell"], first, ratios, [coupler_curve(ratios, trace) for trace in range(first, first + 10)]))
    check(pages[0])
    return pages


def coupler_curve(ratios, trace):
    """A curve of `examples/hrones-nelson.toml`; traces are counted from 0."""
    coupler, rocker, frame = ratios
    along = (-0.5 + 0.5 * (trace // 10)) * coupler
    across = -2.25 + 0.5 * (trace % 10)
    angle = np.radians(np.arange(360.0))
    a = np.exp(1j * angle)
    base = frame - a
    d = np.abs(base)
    height = (coupler + rocker + d) * (coupler + rocker - d) * (d + coupler - rocker) * (d - coupler + rocker)
    u = (d * d + (coupler - rocker) * (coupler + rocker)) / (2 * d)
    unit = (u + 1j * np.sqrt(np.maximum(height, 0.0)) / (2 * d)) * base / d / coupler
    return a + (along + 1j * across) * unit


def check(page):
    """Compares the curves of a page with those of the atlas."""
    cell, first, _, curves = page
    with open(OUT / "hrones-nelson" / "points.csv", newline="") as file:
        for line in csv.DictReader(file):
            k = int(line["trace"]) - 1 - first
            if line["cell"] == cell and 0 <= k < 10:
                ours = complex(float(line["x"]), float(line["y"]))
                assert abs(ours - curves[k][5 * int(line["sample"])]) < 1e-9, line


def matplotlib_page(page, path, dpi):
    """A page as a good script draws it: ten curves in dashes of 3 of 5 degrees, their points with numbers, the linkage,
    a caption and a folio, but no grid, key, table or label placement."""
    _, first, ratios, curves = page
    coupler, _, frame = ratios
    figure, axes = plt.subplots(figsize=(17, 11))
    for k, curve in enumerate(curves):
        places = np.column_stack([curve.real, curve.imag])
        dashes = [places[at : at + 4] for at in range(0, 360, 5)]
        axes.add_collection(LineCollection(dashes, colors=f"C{k}", linewidths=1.0))
        axes.plot(*places[0], "o", color=f"C{k}", markersize=4, fillstyle="none")
        axes.annotate(str(first + k + 1), places[0], textcoords="offset points", xytext=(4, 4), fontsize=8)
    axes.plot([0, 1, 1 + coupler, frame], [0, 0, 0, 0], "k-o", linewidth=2)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.autoscale_view()
    figure.text(0.05, 0.05, "A = {:.2f}  B = {:.2f}  C = {:.2f}".format(*ratios), fontsize=24)
    figure.text(0.95, 0.05, "The atlas of coupler curves · page 1 of 780", fontsize=10, ha="right")
    figure.savefig(path, dpi=dpi)
    plt.close(figure)


def matplotlib_pages(pages, form, dpi):
    """Pages per second of matplotlib, in one process."""
    folder = Path("target/peers/matplotlib")
    folder.mkdir(parents=True, exist_ok=True)
    matplotlib_page(pages[0], folder / f"warm-up.{form}", dpi)
    begun = time.perf_counter()
    for k, page in enumerate(pages):
        matplotlib_page(page, folder / f"{k}.{form}", dpi)
    return len(pages) / (time.perf_counter() - begun)


def main():
    full = "--full" in sys.argv
    print(f"numpy {np.__version__}, numba {numba.__version__}, matplotlib {matplotlib.__version__}, pylinkage {pylinkage.__version__}, "
          f"Python {sys.version.split()[0]}, {os.cpu_count()} cores")
    print(f"{'':<58}{'coupler-atlas':>14}{'peer':>14}{'ratio':>10}")
    one, ten = criterion("1 coupler points"), criterion("10 coupler points")
    row("kernel, one coupler point, one core: numpy", one, numpy_positions(1), "positions/s", "2.5e8")
    row("kernel, ten points on a dyad, one core: numpy", ten, numpy_positions(10), "positions/s", "6e8")
    row("kernel, one coupler point, one core: numba", one, numba_positions(1), "positions/s", "ratio 3.3")
    row("kernel, ten points on a dyad, one core: numba", ten, numba_positions(10), "positions/s", "ratio 4.8")
    part = criterion("1 coupler points over a limited range")
    row("kernel, one point, a range with its own sines: numpy", part, numpy_positions(1), "positions/s")
    row("kernel, a Stephenson II by its crank: Newton, numba", criterion("stephenson-ii-six-bar"), newton_positions(), "positions/s", "1e5")
    row("kernel, an eight-bar of class III", criterion("eight-bar-class-iii"), None, "positions/s", "1e5")
    row("kernel, one coupler point: pylinkage, compiled", one, pylinkage_positions(True), "positions/s")
    row("kernel, one coupler point: pylinkage, step by step", one, pylinkage_positions(False), "positions/s")

    seconds, megabytes = min(render(ATLAS, "svg") for _ in range(3))
    pages = some_pages(12)
    drawn = sum(1 for _ in (OUT / "hrones-nelson").glob("*.svg"))
    assert drawn == PAGES, drawn
    peer = matplotlib_pages(pages, "svg", 100)
    row("SVG and CSV, all measures: matplotlib, SVG alone", PAGES / seconds, peer, "pages/s", "ratio 60")
    row(f"  {PAGES} pages, peak memory {megabytes:.0f} MB", seconds, None, "s", "about 1 s, 300 MB")
    # The peer computes no measures. The page prints class and transmission angle next to the curves.
    seconds, megabytes = min(render(ATLAS, "svg", measures=PAGE_MEASURES) for _ in range(3))
    row("  the same with no more measures than the peer's page needs", PAGES / seconds, peer, "pages/s", "ratio 60")
    row(f"  {PAGES} pages, peak memory {megabytes:.0f} MB", seconds, None, "s", "about 1 s, 300 MB")
    seconds, megabytes = min(render(ATLAS, "png") for _ in range(2))
    peer = matplotlib_pages(pages, "png", 100)
    row("PNG at 100 dpi, all measures: matplotlib", PAGES / seconds, peer, "pages/s", "ratio 12")
    row(f"  {PAGES} pages, peak memory {megabytes:.0f} MB", seconds, None, "s", "300 MB")
    seconds, megabytes = min(render(ATLAS, "png", measures=PAGE_MEASURES) for _ in range(2))
    row("  the same with no more measures than the peer's page needs", PAGES / seconds, peer, "pages/s", "ratio 12")
    seconds, megabytes = min(render(ATLAS, "pdf") for _ in range(2))
    size = sum(file.stat().st_size for file in OUT.glob("*.pdf")) / 1e6
    row("PDF: matplotlib, a file a page", PAGES / seconds, matplotlib_pages(pages, "pdf", 100), "pages/s")
    row(f"  {PAGES} pages, {size:.1f} MB, peak memory {megabytes:.0f} MB", seconds, None, "s", "5 s, 40 MB, 300 MB")
    if full:
        seconds, megabytes = render(ATLAS, "png", 300)
        row("PNG at 300 dpi: matplotlib", PAGES / seconds, matplotlib_pages(pages[:4], "png", 300), "pages/s")
        row(f"  {PAGES} pages, peak memory {megabytes:.0f} MB", seconds, None, "s", "60 s, 300 MB")
        for form in ["svg", "png"]:
            seconds, megabytes = render(FINER, form)
            row(f"{10 * PAGES} pages to {form.upper()}, peak memory {megabytes:.0f} MB", seconds, None, "s", "300 MB")


if __name__ == "__main__":
    main()
