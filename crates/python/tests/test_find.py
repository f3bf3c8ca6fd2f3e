"""The search, on curves whose linkage is known."""

import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import coupler_atlas as ca


def curve() -> np.ndarray:
    return ca.FourBar(frame=4, crank=1.5, coupler=3, rocker=3.5, along=1.5, across=1).curve(60)


def test_the_linkage_of_a_curve_is_found() -> None:
    found = ca.find(curve(), closed=True, index=20000, top=3)
    best = found[0]
    assert best.deviation < 1e-9 and best.quality == "exact" and best.in_order and found.kind == "closed"
    assert [best.deviation <= other.deviation for other in found] and len(found) <= 3 and best is not None
    four_bars = [best.linkage, *best.cognates]
    lengths = [[bar.frame, bar.crank, bar.coupler, bar.rocker] for bar in four_bars]
    assert any(np.allclose(own, [4, 1.5, 3, 3.5], atol=1e-6) for own in lengths)
    # Every point of the path is on the curve.
    distances = np.abs(best.curve()[:, None] - curve()[None]).sum(axis=2).min(axis=0)
    assert distances.max() < 0.2 and best.rms == pytest.approx(best.deviation * found.size)
    assert "[[family]]" in found.toml() and best._repr_svg_().startswith("<svg")
    assert np.allclose(found.points, curve())


def test_paths_come_as_arrays_lists_curves_and_files(tmp_path) -> None:
    points = curve()
    file = tmp_path / "path.csv"
    np.savetxt(file, points, delimiter=",")
    bar = ca.FourBar(frame=4, crank=1.5, coupler=3, rocker=3.5, along=1.5, across=1, samples=60)
    options = {"index": 5000, "effort": "quick", "top": 1}
    sizes = [ca.find(path, **options).size for path in (points, points.tolist(), points.astype(np.float32), bar.curves[0], file, str(file))]
    assert np.allclose(sizes, sizes[0], rtol=1e-6)


def test_constraints_are_kept_and_named_where_they_cannot_be() -> None:
    found = ca.find(curve(), closed=True, index=5000, effort="quick", where="mu_worst_deg >= 30")
    assert all(answer.mu_worst_deg >= 30 - 1e-6 for answer in found)
    none = ca.find(curve(), closed=True, index=2000, effort="quick", where="frame > 1e6", top=1)
    assert len(none) == 0 and none.relax == ["where"] and none.nearest_miss is not None
    timed = ca.find(curve(), closed=True, timed=True, index=5000, effort="quick")
    assert timed[0].deviation < 1e-6


def test_ctrl_c_ends_a_search() -> None:
    code = (
        "import coupler_atlas as ca, sys\n"
        "bar = ca.FourBar(frame=4, crank=1.5, coupler=3, rocker=3.5, along=1.5, across=1)\n"
        "points = bar.curve(4000) + 0.01 * __import__('numpy').random.default_rng(1).normal(size=(4000, 2))\n"
        "print('begun', flush=True)\n"
        "try:\n    while True:\n        ca.find(points, closed=True, effort='thorough', index=20000)\n"
        "except KeyboardInterrupt:\n    sys.exit(3)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    begin = time.monotonic()
    process.communicate(timeout=60)
    assert process.returncode == 3 and time.monotonic() - begin < 3


@pytest.mark.parametrize(
    ("path", "options", "error", "message"),
    [
        (np.zeros((10, 3)), {}, ValueError, "an array of points has the shape (n, 2), and this one has [10, 3]"),
        (np.zeros((10, 2)), {}, ValueError, "at least 5 distinct points"),
        (3, {}, TypeError, "give an array of points"),
        ([[0, 0], [1, float("nan")], [2, 2], [3, 1], [1, 5]], {}, ValueError, "point 2 of the path is (1, NaN)"),
        ("no-such-file.csv", {}, ca.OutputError, "no-such-file.csv"),
        (None, {"top": 0}, ValueError, "top=0: give a number from 1 to 100"),
        (None, {"max_link": -1}, ValueError, "max_link=-1"),
        (None, {"effort": "much"}, ValueError, 'effort="much"'),
        (None, {"pivots": (1, 0, 0, 1)}, ValueError, "pivots=[1.0, 0.0, 0.0, 1.0]"),
        (None, {"where": "mu_wrst_deg > 3"}, ValueError, "mu_worst_deg"),
        (None, {"closed": True, "part": True}, ValueError, "leave one out"),
        (None, {"closed": False, "timed": True}, ValueError, "give angles="),
        (None, {"angles": [1.0, 2.0]}, ValueError, "60 points and 2 angles"),
    ],
)
def test_arguments_are_checked(path, options, error, message) -> None:
    with pytest.raises(error) as caught:
        ca.find(curve() if path is None else path, index=100, **options)
    assert message in str(caught.value)
