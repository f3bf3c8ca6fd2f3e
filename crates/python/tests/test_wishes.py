"""The searches by wishes, for poses and for functions: their answers are those of the command."""

import json
import pickle
import subprocess
import sys

import numpy as np
import pandas
import pyarrow
import pytest

import coupler_atlas as ca

STROKE = "output_stroke == 100 and time_ratio == 1.25"
SWING = "output_swing_deg == 110 and is_crank_rocker and mu_worst_deg >= 50"
LOGARITHM = "y = log10(x) for x = 1..10 over 60 deg of input and 90 deg of output"
POSES = [[0.0, 0.0, 0.0], [2.0, 1.0, 20.0], [4.0, 1.0, 60.0]]


def command(*arguments: str, code: int = 0) -> dict:
    """What the command prints as JSON."""
    done = subprocess.run([sys.executable, "-m", "coupler_atlas", *arguments, "--json"], capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    return json.loads(done.stdout)


def again(linkage: ca.Linkage) -> ca.Linkage:
    return pickle.loads(pickle.dumps(linkage))


def complete(records: list[dict]) -> list[dict]:
    """Records without what is missing: the command leaves some of it out."""
    return [{key: value for key, value in record.items() if value is not None} for record in records]


def test_paths_have_the_records_of_the_command(tmp_path) -> None:
    file, atlas = tmp_path / "path.csv", tmp_path / "atlas.toml"
    points = ca.linkage("slider-crank", coupler=2.5, along=1, across=0.8, samples=60).curve()
    np.savetxt(file, points, delimiter=",", fmt="%.17g")
    atlas.write_text('atlas.title = "Sliders"\n[[family]]\nid = "sliders"\nlinkage = "slider-crank"\ngrid = { coupler = [2, 2.6], across = [0.5, 0.7] }\n')
    for arguments, options in [
        (["--index", "2000"], {"index": 2000}),
        (["--linkage", "slider-crank"], {"linkage": "slider-crank"}),
        (["--atlas", str(atlas)], {"atlas": atlas}),
    ]:
        found = ca.find(file, closed=True, effort="quick", top=2, **options)
        printed = command("find", str(file), "--closed", "--effort", "quick", "--top", "2", *arguments)
        assert len(found) > 0 and found.records() == printed["results"]


def test_designs_are_those_of_the_command() -> None:
    designs = ca.design("slider-crank", where=STROKE, maximize="mu_worst_deg", effort="quick", best=3, seed=7)
    printed = command("design", "slider-crank", "--where", STROKE, "--maximize", "mu_worst_deg", "--effort", "quick", "--best", "3", "--seed", "7")
    assert complete(designs.records()) == complete(printed["designs"]) and designs.searched == printed["searched"]
    best = designs[0]
    assert best.wishes == pytest.approx({"output_stroke": 100, "time_ratio": 1.25}, rel=1e-4)
    assert best.goals == {"mu_worst_deg": best.mu_worst_deg} and best.class_ is None
    assert best.parameters == printed["designs"][0]["parameters"] == best.linkage.parameters
    assert best.linkage == ca.linkage("slider-crank", **best.parameters) == again(best.linkage)
    # Measured anew, by the linkage itself.
    measures = ca.linkage("slider-crank", **best.parameters).measures(trace=best.trace, circuit=best.circuit)
    assert measures == best.measures() and measures["output_stroke"] == best.wishes["output_stroke"]
    assert best.curve().shape == (360, 2) and designs.misses == {} and designs.assembled and not designs.unbounded
    assert designs.svg().startswith("<svg") and best._repr_svg_().startswith("<svg")


def test_designs_are_an_atlas_and_a_table(tmp_path) -> None:
    goals = ["mu_worst_deg", "time_ratio"]
    swing = "is_crank_rocker and output_swing_deg == 60 +- 2"
    ranges = {"crank": (10, 40), "coupler": "80..120 by 20", "rocker": (60, 100, 20)}
    designs = ca.design("four-bar", where=swing, maximize=goals, fix={"frame": 100}, ranges=ranges, effort="quick", best=3)
    texts = ["--range", "crank = 10..40", "--range", "coupler = 80..120 by 20", "--range", "rocker = 60..100 by 20", "--fix", "frame = 100"]
    both = [part for goal in goals for part in ("--maximize", goal)]
    printed = command("design", "four-bar", "--where", swing, *both, *texts, "--effort", "quick", "--best", "3")
    assert complete(designs.records()) == complete(printed["designs"]) and len(designs) > 1
    for design in designs:
        own = design.parameters
        assert own["frame"] == 100 and 10 <= own["crank"] <= 40 and own["coupler"] % 20 == 0 and own["rocker"] % 20 == 0
        assert design.wishes == pytest.approx({"is_crank_rocker": True, "output_swing_deg": 60}, abs=2)
    first, second = (design.goals for design in designs[:2])
    assert (first["mu_worst_deg"] - second["mu_worst_deg"]) * (first["time_ratio"] - second["time_ratio"]) < 0
    (tmp_path / "designs.toml").write_text(designs.toml(), encoding="utf-8")
    atlas = ca.read(tmp_path / "designs.toml")
    cells = [family[index] for family in atlas.values() for index in range(len(family))]
    assert [cell.parameters["crank"] for cell in cells] == [design.parameters["crank"] for design in designs]
    frame = pandas.json_normalize(designs.records())
    assert list(frame["parameters.crank"]) == [design.parameters["crank"] for design in designs]
    assert pyarrow.Table.from_pylist(designs.records()).num_rows == len(designs)


def test_what_cannot_be_met_says_what_it_comes_to() -> None:
    none = ca.design("four-bar", where=SWING, effort="quick")
    assert len(none) == 0 and none.records() == [] and list(none.misses) == ["output_swing_deg = 110", "mu_worst_deg ≥ 50"]
    # The command says the same, of a slider-crank, whose search is short.
    stroke = "output_stroke == 100 and mu_worst_deg >= 89"
    sliders = ca.design("slider-crank", where=stroke, fix={"offset": 0, "along": 0, "across": 0}, ranges={"coupler": (100, 300)}, effort="quick")
    fixed = [part for name in ("offset", "along", "across") for part in ("--fix", f"{name} = 0")]
    printed = command("design", "slider-crank", "--where", stroke, *fixed, "--range", "coupler = 100..300", "--effort", "quick", code=2)
    assert len(printed["misses"]) > 0 and list(sliders.misses) == [miss["wish"] for miss in printed["misses"]]
    for miss in printed["misses"]:
        assert sliders.misses[miss["wish"]].parameters == miss["design"]["parameters"]
    nearest = none.misses["mu_worst_deg ≥ 50"]
    assert nearest.wishes["output_swing_deg"] == pytest.approx(110, rel=1e-4) and 30 < nearest.wishes["mu_worst_deg"] < 36
    assert "nearest without" in repr(none) and none._repr_svg_() is None and "No linkage" in none.toml()
    with pytest.raises(ValueError, match="nothing to draw"):
        none.svg()
    assert ca.design("slider-crank", where="time_ratio == 1.2", maximize="output_stroke", effort="quick", best=1).unbounded
    apart = ca.design("four-bar", where="mu_worst_deg > 1", fix={"frame": 100, "crank": 1, "coupler": 1, "rocker": 1}, effort="quick")
    assert not apart.assembled and "can be assembled" in repr(apart)


def test_a_linkage_of_a_manifest_is_designed(tmp_path) -> None:
    (tmp_path / "own.toml").write_text(
        '[[linkage]]\nid = "mine"\nparameters = { frame = { default = 4, min = 0 }, crank = { default = 1, min = 0 },'
        ' coupler = { default = 3.5, min = 0 }, rocker = { default = 3, min = 0 } }\ntrace = ["B"]\noutput_link = ["C", "B"]\n'
        '[linkage.joints]\nO = { fixed = [0, 0] }\nC = { fixed = ["frame", 0] }\nA = { crank = "O", length = "crank" }\n'
        'B = { dyad = ["A", "C"], lengths = ["coupler", "rocker"], side = "left" }\n'
    )
    wishes = {"where": "output_swing_deg == 40", "maximize": "mu_worst_deg", "effort": "quick", "best": 1}
    best = ca.design("mine", manifest=tmp_path / "own.toml", **wishes)
    assert best[0].wishes["output_swing_deg"] == pytest.approx(40, rel=1e-4) and "[[linkage]]" in best.toml()
    assert again(best[0].linkage) == best[0].linkage


def test_poses_are_passed_as_by_the_command(tmp_path) -> None:
    file = tmp_path / "poses.csv"
    np.savetxt(file, POSES, delimiter=",", header="x,y,angle_deg", comments="")
    options = {"effort": "quick", "top": 4, "where": "mu_worst_deg >= 20"}
    found = ca.find_poses(POSES, **options)
    printed = command("find", str(file), "--poses", "--effort", "quick", "--top", "4", "--where", "mu_worst_deg >= 20")
    assert found.records() == printed["results"] and found.left_out == printed["left_out"] and found.dyads is None
    assert ca.find_poses(file, **options).records() == printed["results"] and "angle" in ca.find_poses(file, **options).read
    turned = np.array(POSES) * [1, 1, np.pi / 180]
    assert [answer.class_ for answer in ca.find_poses(turned, radians=True, **options)] == [answer.class_ for answer in found]
    assert np.array_equal(found.poses, POSES) and found.size > 0 and found.read is None
    best = found[0]
    assert best.deviation < 1e-9 and best.in_order and best.one_branch and best.full_turn and np.abs(best.errors).max() < 1e-9
    # The traced joint of the linkage is the point of the body.
    arms = best.crank_pins - best.crank_pins.mean(axis=0)
    assert arms.shape == best.other_pins.shape == (3, 2) and best.inputs.shape == (3,)
    curve = best.linkage.curve(20_000, circuit=best.circuit)
    for x, y, _ in POSES:
        assert np.hypot(*(curve - [x, y]).T).min() < 1e-2
    assert [answer.linkage.id for answer in found] == ["placed-" + record["linkage"] for record in found.records()]
    assert all(again(answer.linkage) == answer.linkage for answer in found)
    five = ca.find_poses([[0, 0, 0], [1, 0.5, 10], [2, 1.2, 25], [3, 1, 35], [4, 0, 50]], top=1)
    assert five.dyads is not None and all("pin" in dyad for dyad in five.dyads)


def test_poses_that_are_not_passed_say_what_to_relax() -> None:
    found = ca.find_poses(POSES, where="mu_worst_deg > 90", effort="quick")
    assert len(found) == 0 and found.relax == ["where"] and found.nearest_miss is not None and found.nearest_miss.mu_worst_deg <= 90
    assert "relax where" in repr(found) and found.svg().startswith("<svg")


def test_functions_are_generated_as_by_the_command(tmp_path) -> None:
    found = ca.find_function(LOGARITHM, top=3)
    printed = command("find", LOGARITHM, "--function", "--top", "3")
    assert found.records() == printed["results"] and found.method == printed["method"] == "points"
    assert found.precision_points == printed["precision_points"] and found.left_out == printed["left_out"].replace("--", "")
    best = found[0]
    travel = best.inputs[0] + np.linspace(0, 60, 1001)
    wanted = best.outputs[0] + 90 * np.log10(1 + 9 * np.linspace(0, 1, 1001))
    error = best.output(travel) - wanted
    assert np.abs(error).max() == pytest.approx(abs(best.greatest), rel=1e-3)
    assert np.abs(best.output(best.zeros) - np.interp(best.zeros, travel, wanted)).max() < 1e-3 * abs(best.greatest) + 1e-4
    assert again(best.linkage) == best.linkage
    assert best.linkage.status == "ok" and best.side in ("left", "right") and not found.output_is_length
    angles = np.linspace(0, 60, 13)
    rows = np.column_stack([angles, 0.3 * angles + 0.001 * angles**2])
    file = tmp_path / "rows.csv"
    np.savetxt(file, rows, delimiter=",", header="input,output", comments="", fmt="%.17g")
    for arguments, options in [
        (["--fit", "minimax"], {"fit": "minimax"}),
        (["--linkage", "slider-crank"], {"linkage": "slider-crank"}),
        (["--linkage", "four-bar", "--keep", "rocker=3", "--effort", "quick"], {"linkage": "four-bar", "keep": {"rocker": 3}, "effort": "quick"}),
    ]:
        printed = command("find", str(file), "--function", "--top", "2", *arguments)
        for function in (rows, file):
            assert ca.find_function(function, top=2, **options).records() == printed["results"]
    slider = ca.find_function(rows, linkage="slider-crank", top=1)
    assert slider.output_is_length and slider[0].side in ("ahead", "behind")
    own = ca.find_function(rows, linkage="four-bar", keep={"rocker": 3}, effort="quick", top=1)[0]
    ends = own.output(np.linspace(*own.inputs, 13)) - own.outputs[0]
    assert np.abs(ends - rows[:, 1]).max() == pytest.approx(abs(own.greatest), rel=1e-6, abs=1e-9)
    turned = ca.find_function(np.radians(rows), radians=True, fit="least-squares", top=1)[0]
    assert turned.rms == pytest.approx(ca.find_function(rows, fit="least-squares", top=1)[0].rms, rel=1e-3)


def test_ctrl_c_ends_a_design(interrupted) -> None:
    code = (
        "import coupler_atlas as ca, sys\nprint('begun', flush=True)\n"
        "try:\n    while True:\n        ca.design('watt-six-bar', where='output_swing_deg == 100', maximize='mu_worst_deg', effort='thorough')\n"
        "except KeyboardInterrupt:\n    sys.exit(3)\n"
    )
    returncode, _, elapsed = interrupted(code, 1.0)
    assert returncode == 3 and elapsed < 3


def test_progress_is_shown() -> None:
    seen: list[tuple[int, int, str]] = []
    ca.design("four-bar", maximize="mu_worst_deg", effort="quick", progress=lambda *step: seen.append(step))
    assert seen and all(0 <= done <= total == 1000 and name == "design" for done, total, name in seen if name)


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({}, ValueError, "nothing is wished; give a condition or a goal"),
        ({"where": "mu_wurst > 3", "best": 0, "max_link": -1, "ranges": {"x": (1, 2)}}, ValueError, "max_link: -1 is not positive"),
        ({"where": "mu_wurst > 3", "best": 0, "ranges": {"x": (1, 2)}}, ValueError, "best=0: give a number from 1 to 50\n`x = 1..2`: "),
        ({"where": "mu_worst_deg > 50 and mu_worst_deg < 40"}, ValueError, "exclude each other"),
        ({"maximize": 3}, TypeError, "maximize: give an expression or a list of expressions"),
        ({"maximize": "mu_worst_deg", "ranges": {"crank": 3}}, TypeError, "ranges: crank: give (least, greatest)"),
        ({"maximize": "mu_worst_deg", "ranges": {"crank": (3, 1)}}, ValueError, "`crank = 3..1`"),
        ({"maximize": "mu_worst_deg", "fix": "crank"}, TypeError, "fix: give a list of names or a dict"),
        ({"maximize": "mu_worst_deg", "fix": ["krank"]}, ValueError, "crank"),
        ({"maximize": "mu_worst_deg", "effort": "much"}, ValueError, 'effort="much": give "quick", "normal" or "thorough"'),
        ({"maximize": "mu_worst_deg", "seed": -1}, ValueError, "seed=-1"),
        ({"maximise": "mu_worst_deg"}, TypeError, "design() got an unexpected keyword argument 'maximise'"),
    ],
)
def test_wishes_are_checked(options, error, message) -> None:
    with pytest.raises(error) as caught:
        ca.design("four-bar", **options)
    assert message in str(caught.value)
    with pytest.raises(ValueError, match="there is no linkage `for-bar`"):
        ca.design("for-bar", maximize="mu_worst_deg")


@pytest.mark.parametrize(
    ("poses", "options", "error", "message"),
    [
        ([[0, 0, 0]], {}, ValueError, "poses: it has 1 pose: give 2 or more"),
        (np.zeros((3, 2)), {}, ValueError, "and this one has (3, 2)"),
        ([[0, 0, 0], [1, 1, float("nan")], [1, 2, 3], [1, 2, 3]], {}, ValueError, "NaN°: its numbers must be finite"),
        ([[0, 0, 0], [1, 1, float("nan")], [1, 2, 3], [1, 2, 3]], {}, ValueError, "poses: poses 3 and 4 are the same"),
        ("no-such.csv", {}, FileNotFoundError, "no-such.csv"),
        ("no-such.csv", {"radians": True}, ValueError, "radians is of arrays"),
        (3, {}, TypeError, "and not a int"),
        (POSES, {"outline": 2}, ValueError, "chooses from the tables in a file"),
        (POSES, {"top": 0, "max_link": 0, "where": "mu_wrst > 3"}, ValueError, "max_link=0: give a positive number"),
        (POSES, {"top": 0, "max_link": 0, "where": "mu_wrst > 3"}, ValueError, "where: `mu_wrst > 3`"),
        (POSES, {"closed": True}, TypeError, "find_poses() got an unexpected keyword argument 'closed'"),
    ],
)
def test_poses_are_checked(poses, options, error, message) -> None:
    with pytest.raises(error) as caught:
        ca.find_poses(poses, **options)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("function", "options", "error", "message"),
    [
        ("y = x^2", {}, FileNotFoundError, "or write the function as in"),
        ("y = x for x = 1..2 over 60 deg of input and of output", {}, ValueError, "the expression is empty"),
        (np.zeros((3, 3)), {}, ValueError, "and this one has (3, 3)"),
        ([[0, 0], [1, 1], [1, 2], [3, float("inf")]], {}, ValueError, "function: row 3: the input is 1 after 1"),
        ([[0, 0], [1, 1], [1, 2], [3, float("inf")]], {}, ValueError, "function: row 4: inf is not a finite number"),
        (3, {}, TypeError, "and not a int"),
        (LOGARITHM, {"radians": True}, ValueError, "radians is of arrays"),
        (LOGARITHM, {"effort": "quick", "top": 0}, ValueError, "top=0: give a number from 1 to 100"),
        (LOGARITHM, {"effort": "quick", "top": 0}, ValueError, "effort is of linkage=…"),
        (LOGARITHM, {"points": 7}, ValueError, "points=7: at most 5 points can be exact: give from 3 to 5, or fit=least-squares"),
        (LOGARITHM, {"fit": "exact"}, ValueError, 'fit="exact": give "points", "least-squares" or "minimax"'),
        (LOGARITHM, {"keep": ["crank"]}, ValueError, "give linkage="),
        (LOGARITHM, {"linkage": "slider-crank"}, ValueError, "is a length"),
        (LOGARITHM, {"linkage": "watt-six-bar", "points": 3, "keep": ["zz"]}, ValueError, "keep: watt-six-bar has no parameter `zz`"),
    ],
)
def test_functions_are_checked(function, options, error, message) -> None:
    with pytest.raises(error) as caught:
        ca.find_function(function, **options)
    assert message in str(caught.value)
