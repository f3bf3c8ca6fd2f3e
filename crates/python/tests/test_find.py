"""The search, on curves whose linkage is known."""

import pickle

import numpy as np
import pytest

import coupler_atlas as ca


def curve() -> np.ndarray:
    return ca.FourBar(frame=4, crank=1.5, coupler=3, rocker=3.5, along=1.5, across=1).curve(60)


def test_the_linkage_of_a_curve_is_found() -> None:
    found = ca.find(curve(), closed=True, index=20000, top=3)
    best = found[0]
    assert best.deviation < 1e-9 and best.quality == "exact" and best.in_order and found.kind == "closed"
    assert all(best.deviation <= other.deviation for other in found) and len(found) <= 3
    assert found[0] == best and best in found and list(reversed(found))[-1] == best and found[:1] == [best]
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


def test_what_was_taken_of_a_file_is_said(tmp_path) -> None:
    points = curve()
    options = {"index": 2000, "effort": "quick", "top": 1}
    file = tmp_path / "two.csv"
    names = "a x,a y,b x,b y"
    round = np.vstack([points, points[:1]])
    np.savetxt(file, np.hstack([round, 3 * round]), delimiter=",", header=names, comments="")
    found = [ca.find(file, outline=outline, **options) for outline in (1, "2", "b")]
    assert np.allclose([each.size / found[0].size for each in found], [1, 3, 3])
    assert found[0].read.startswith("path 1 `a` of 2; x is column 1 `a x`") and found[0].read.endswith("closed, for its ends are near")
    for outline in (None, 3, "c"):
        with pytest.raises(ValueError, match="two.csv: .*outline"):
            ca.find(file, outline=outline, **options)
    with pytest.raises(ValueError, match='outline="a" chooses from the paths in a file'):
        ca.find(points, outline="a", **options)
    assert ca.find(points, **options).read is None
    timed = tmp_path / "timed.csv"
    np.savetxt(timed, np.column_stack([points, np.arange(60) * 6]), delimiter=",", header="x,y,angle", comments="")
    with pytest.warns(UserWarning, match="the angles in .*timed.csv are not used: with timed=True"):
        assert "column 3 `angle` is not used" in ca.find(timed, **options).read
    assert "angle of the crank column 3" in ca.find(timed, timed=True, **options).read


def test_constraints_are_kept_and_named_where_they_cannot_be() -> None:
    found = ca.find(curve(), closed=True, index=5000, effort="quick", where="mu_worst_deg >= 30")
    assert all(answer.mu_worst_deg >= 30 - 1e-6 for answer in found)
    none = ca.find(curve(), closed=True, index=2000, effort="quick", where="frame > 1e6", top=1)
    assert len(none) == 0 and none.relax == ["where"] and none.nearest_miss is not None
    timed = ca.find(curve(), closed=True, timed=True, index=5000, effort="quick")
    assert timed[0].deviation < 1e-6


SLIDERS = """
atlas.title = "Sliders and four-bars"
[[family]]
id = "sliders"
linkage = "slider-crank"
grid = { coupler = [2, 2.5, 3], across = [0.5, 1.5] }
sampling = { samples = 180 }
[[family]]
id = "bars"
linkage = "four-bar"
cases = [{ frame = 3, crank = 1, coupler = 2.5, rocker = 2.8, along = 1, across = 1 }]
sampling = { samples = 180 }
"""


def check_placement(answer: ca.Answer) -> None:
    """The curve of an answer is that of its linkage, placed."""
    curve = answer.curve()
    own = answer.linkage.curve(trace=answer.trace, circuit=answer.circuit)
    matrix = answer.placement
    assert np.allclose(own @ matrix[:, :2].T + matrix[:, 2], curve, atol=1e-9 * np.abs(curve).max())


def test_the_curves_of_an_atlas_are_found_wherever_they_are(tmp_path) -> None:
    (tmp_path / "atlas.toml").write_text(SLIDERS)
    atlas = ca.read(tmp_path / "atlas.toml")
    own = atlas["sliders"].cell(4).curve()
    # Mirrored, seven times as large, elsewhere.
    path = np.column_stack([100 + 7 * own[::3, 1], 7 * own[::3, 0] - 30])
    best = ca.find(path, closed=True, atlas=atlas, top=2)[0]
    assert best.name == "sliders:4.1.1" and best.deviation < 1e-9 and best.class_ is None and best.inputs is None
    assert best.linkage.parameters["coupler"] == pytest.approx(7 * atlas["sliders"].cell(4).parameters["coupler"])
    assert np.linalg.det(best.placement[:, :2]) == pytest.approx(-1.0)
    assert np.abs(best.curve()[::3] - path).max() < 1e-6
    check_placement(best)
    # A four-bar is refined to one that stands on the path.
    bar = ca.FourBar(frame=3.1, crank=1.02, coupler=2.5, rocker=2.8, along=1, across=1)
    found = ca.find(bar.curve(60), closed=True, atlas=tmp_path / "atlas.toml", top=1)
    assert found[0].name == "bars:1.1.1" and found[0].deviation < 1e-9 and isinstance(found[0].linkage, ca.FourBar)
    assert "frame" in found.toml()
    # Where it is, and only there.
    fixed = ca.find(atlas["bars"][0].curve(), closed=True, atlas=atlas, fixed=True, top=1)[0]
    assert fixed.deviation < 1e-9 and np.allclose(fixed.placement, [[1, 0, 0], [0, 1, 0]])
    none = ca.find(path, closed=True, atlas=atlas, where="length < 0")
    assert len(none) == 0 and "where" in none.relax and none.nearest_miss is not None
    ca.render(atlas, tmp_path / "rendered", formats=["svg"], progress=False)
    assert ca.find(path, closed=True, atlas=tmp_path / "rendered", top=1)[0].name == "sliders:4.1.1"


def test_the_dimensions_of_a_linkage_are_found() -> None:
    own = ca.linkage("slider-crank", coupler=2.5, along=1, across=0.8, offset=0.2, samples=60).curve()
    path = 3 * own + [5, 6]
    found = ca.find(path, closed=True, linkage="slider-crank", keep={"offset": "0.2 * crank"}, top=3)
    best = found[0]
    assert best.deviation < 1e-6 and best.name is None and best.linkage.id == "slider-crank" and len(best.inputs) == 2
    assert best.linkage.parameters["offset"] == pytest.approx(0.2 * best.linkage.parameters["crank"])
    linkage = best.linkage
    again = pickle.loads(pickle.dumps(linkage))
    assert np.array_equal(again.curve(), linkage.curve()) and again.parameters == pytest.approx(linkage.parameters)
    assert len(pickle.loads(pickle.dumps(linkage.circuits[0]))) == len(linkage.circuits[0])
    check_placement(best)
    assert "slider-crank" in found.toml()
    same = ca.find(path, closed=True, linkage="four-bar", index=5000, effort="quick", top=1)[0]
    assert isinstance(same.linkage, ca.FourBar)


def test_ctrl_c_ends_a_search(interrupted) -> None:
    code = (
        "import coupler_atlas as ca, sys\n"
        "bar = ca.FourBar(frame=4, crank=1.5, coupler=3, rocker=3.5, along=1.5, across=1)\n"
        "points = bar.curve(4000) + 0.01 * __import__('numpy').random.default_rng(1).normal(size=(4000, 2))\n"
        "print('begun', flush=True)\n"
        "try:\n    while True:\n        ca.find(points, closed=True, effort='thorough', index=20000)\n"
        "except KeyboardInterrupt:\n    sys.exit(3)\n"
    )
    returncode, _, elapsed = interrupted(code, 1.0)
    assert returncode == 3 and elapsed < 3


@pytest.mark.parametrize(
    ("path", "options", "error", "message"),
    [
        (np.zeros((10, 3)), {}, ValueError, "and this one has (10, 3)"),
        (np.zeros((10, 2)), {}, ValueError, "at least 5 distinct points"),
        (3, {}, TypeError, "give real numbers of shape (n, 2), a curve, or the path of a file, and not a int"),
        ([[0, 0], [1, float("nan")], [2, 2], [3, 1], [1, 5]], {}, ValueError, "point 2 of the path is (1, NaN)"),
        ("no-such-file.csv", {}, FileNotFoundError, "no-such-file.csv"),
        ([], {}, TypeError, "not an empty sequence"),
        (np.zeros(10), {}, TypeError, "not an array of shape (10,) of float64"),
        (np.zeros((10, 2), complex), {}, TypeError, "not an array of shape (10, 2) of complex128"),
        (None, {"top": -1}, ValueError, "top=-1: give a whole number"),
        (None, {"top": 0}, ValueError, "top=0: give a number from 1 to 100"),
        (None, {"max_link": -1}, ValueError, "max_link=-1"),
        (None, {"top": 0, "max_link": 0}, ValueError, "max_link=0: give a positive number of sizes of the path, as in 10, or inf\ntop=0"),
        (None, {"tops": 3}, TypeError, "unexpected keyword argument 'tops'"),
        (None, {"top": "3"}, TypeError, "top: "),
        (None, {"top": None}, TypeError, "top: "),
        (None, {"effort": "much"}, ValueError, 'effort="much"'),
        (None, {"pivots": (1, 0, 0, 1)}, ValueError, "pivots=(1, 0, 0, 1): give a box"),
        (None, {"where": "mu_wrst_deg > 3"}, ValueError, "mu_worst_deg"),
        (None, {"closed": True, "part": True}, ValueError, "leave one out"),
        (None, {"closed": False, "timed": True}, ValueError, "give angles="),
        (None, {"angles": [1.0, 2.0]}, ValueError, "60 points and 2 angles"),
        (None, {"fixed": True}, ValueError, "name one, atlas="),
        (None, {"keep": ["s"]}, ValueError, "give linkage="),
        (None, {"atlas": "a.toml", "linkage": "evans"}, ValueError, "give one of them"),
        (None, {"atlas": "no-such.toml"}, ValueError, "leave one out"),
        (None, {"linkage": "slider-krank"}, ValueError, "slider-crank"),
        (None, {"linkage": "slider-crank", "keep": "offset"}, TypeError, "keep: give a list of names or a dict"),
        (None, {"linkage": "slider-crank", "keep": ["ofset"]}, ca.LinkageError, "offset"),
    ],
)
def test_arguments_are_checked(path, options, error, message) -> None:
    with pytest.raises(error) as caught:
        ca.find(curve() if path is None else path, index=100, **options)
    assert message in str(caught.value)
