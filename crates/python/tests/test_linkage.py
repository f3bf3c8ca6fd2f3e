"""Linkages, compared with closed forms and with each other."""

import copy
import math
import pickle

import numpy as np
import pytest

import coupler_atlas as ca

BAR = dict(frame=4.0, crank=1.0, coupler=3.0, rocker=3.5, along=1.5, across=1.0)


def bar() -> ca.FourBar:
    return ca.FourBar(**BAR)


def test_a_curve_satisfies_the_closed_form_of_the_four_bar() -> None:
    points = bar().curve(720)
    assert points.shape == (720, 2) and points.dtype == np.float64
    angles = np.deg2rad(np.arange(720) * 0.5)
    crank = np.exp(1j * angles)
    # The rocker pin is left of the line from crank pin to rocker pivot.
    base = 4 - crank
    length = np.abs(base)
    along = (length**2 + 9 - 3.5**2) / (2 * length)
    pin = crank + (along + 1j * np.sqrt(9 - along**2)) * base / length
    unit = (pin - crank) / 3
    expected = crank + unit * (1.5 + 1j)
    assert np.abs(points[:, 0] + 1j * points[:, 1] - expected).max() < 1e-12


def test_arrays_are_shared_and_read_only() -> None:
    four_bar = bar()
    curve = four_bar.curves[0]
    assert four_bar.curve() is four_bar.curve() is curve.points
    assert curve.inputs is curve.inputs and curve.velocities is curve.velocities and curve.branches is curve.branches
    for array in (curve.points, curve.inputs, curve.velocities, curve.branches, four_bar.sextic().coefficients):
        assert not array.flags.writeable
    with pytest.raises(ValueError):
        curve.points[0, 0] = 1.0
    # A view of the memory that the library filled, and alive after the linkage is gone.
    assert curve.points.base is not None
    points = bar().curve()
    assert np.array_equal(points, curve.points)


def test_velocities_are_derivatives_of_points() -> None:
    curve = bar().curves[0]
    fine = bar().curve(36000)
    step = math.radians(0.01)
    differences = (np.roll(fine, -1, axis=0) - np.roll(fine, 1, axis=0)) / (2 * step)
    assert np.abs(differences[::100] - curve.velocities).max() < 1e-6
    circuit = bar().circuits[0]
    assert np.array_equal(circuit.velocities("M"), curve.velocities)
    assert np.allclose(np.hypot(*circuit.velocities("A").T), 1.0)


def test_torques_are_those_of_virtual_work() -> None:
    press = ca.linkage("slider-crank", samples=360)
    curve = next(curve for curve in press.curves if curve.joint == "B")
    assert np.allclose(curve.torques("50 on B at 180 deg"), 50 * curve.velocities[:, 0])
    assert np.allclose(curve.torques("50 on B"), 50 * np.abs(curve.velocities[:, 0]))
    with pytest.raises(ValueError, match="it has no load"):
        curve.torques()
    with pytest.raises(ValueError, match="no single joint"):
        curve.torques("50 on Z")


def test_accelerations_are_derivatives_of_velocities() -> None:
    curve = bar().curves[0]
    fine = ca.FourBar(**BAR, samples=36000).curves[0].velocities
    step = math.radians(0.01)
    differences = (np.roll(fine, -1, axis=0) - np.roll(fine, 1, axis=0)) / (2 * step)
    assert np.abs(differences[::100] - curve.accelerations).max() < 1e-5
    circuit = bar().circuits[0]
    assert np.array_equal(circuit.accelerations("M"), curve.accelerations)
    # A pin on a circle: towards its centre.
    assert np.allclose(circuit.accelerations("A"), -circuit.positions("A"))


def test_positions_at_chosen_inputs() -> None:
    circuit = bar().circuits[1]
    own = circuit.positions("M")
    assert np.array_equal(circuit.positions("M", at=[0, 30, 359]), own[[0, 30, 359]])
    assert np.allclose(circuit.positions("M", at=[-330.0, 390]), own[[30, 30]])
    # Through change points a circuit returns after two turns.
    twice = ca.FourBar(4, 1, 3, 2).circuits[0]
    assert twice.full_turn and np.ptp(twice.inputs) > 700
    assert np.allclose(twice.positions("B", at=twice.inputs), twice.positions("B"), atol=1e-9)
    geared = ca.linkage("geared-five-bar", n=2, m=3).circuits[0]
    assert np.allclose(geared.positions("B", at=geared.inputs + 1080), geared.positions("B"), atol=1e-9)
    with pytest.raises(TypeError, match="give a number, or a list or an array"):
        circuit.positions("M", at="thirty")
    rocker = ca.FourBar(frame=2, crank=2.59, coupler=1, rocker=2.59)
    circuit = rocker.circuits[0]
    assert np.allclose(circuit.positions("B", at=[360 + sum(circuit.limits) / 2]), circuit.positions("B", at=[sum(circuit.limits) / 2]))
    low, high = circuit.limits
    inside, outside = circuit.positions("B", at=[(low + high) / 2, high + 1])
    assert np.isfinite(inside).all() and np.isnan(outside).all()
    assert np.hypot(*(inside - [2, 0])) == pytest.approx(2.59)


def test_transmission_angles_are_those_of_the_measures() -> None:
    four_bar = ca.FourBar(**BAR, samples=7200)
    angles = four_bar.circuits[0].transmission_angles
    pins = four_bar.circuits[0]
    # The angle between coupler and rocker.
    [to_crank, to_pivot] = [pins.positions(name) - pins.positions("B") for name in ("A", "C")]
    cosine = (to_crank * to_pivot).sum(axis=1) / (3 * 3.5)
    assert np.allclose(angles, np.degrees(np.arccos(cosine)))
    measures = four_bar.measures()
    assert angles.min() == pytest.approx(measures["mu_min_deg"]) and angles.max() == pytest.approx(measures["mu_max_deg"])
    assert np.isnan(ca.linkage("slider-crank", coupler=3).circuits[0].transmission_angles).all()


def test_linkages_are_compared_pickled_and_copied() -> None:
    four_bar = bar()
    made = [
        four_bar,
        ca.FourBar(**BAR, x=1, turn=30, samples=90),
        ca.linkage("evans", p=2.5, a=2.6, circuits="all"),
        ca.linkage("slider-crank", coupler="5 / 2"),
        *four_bar.cognates(),
    ]
    for linkage in made:
        again = pickle.loads(pickle.dumps(linkage))
        assert again == linkage and hash(again) == hash(linkage) and type(again) is type(linkage)
        assert np.array_equal(again.curve(), linkage.curve()) and copy.deepcopy(linkage) == linkage
        curve = pickle.loads(pickle.dumps(linkage.curves[-1]))
        assert curve == linkage.curves[-1] and np.array_equal(curve.points, linkage.curves[-1].points)
    assert len({*made, *made}) == len(made)
    assert four_bar == bar() == ca.linkage("four-bar", **BAR) and isinstance(ca.linkage("four-bar", **BAR), ca.FourBar)
    assert four_bar != ca.FourBar(**BAR, samples=90) and four_bar != 3
    zero, minus_zero = (ca.FourBar(4, 1, 3, 3.5, 1.5, sign * 0.0) for sign in (1, -1))
    assert zero == minus_zero and len({zero, minus_zero}) == 1


def test_circuits_branches_and_limits() -> None:
    four_bar = bar()
    assert [circuit.full_turn for circuit in four_bar.circuits] == [True, True]
    assert four_bar.limits == [None, None] and four_bar.class_ == "crank-rocker"
    assert [set(curve.branch.tolist()) for curve in four_bar.curves] == [{1}, {-1}]
    rocker = ca.FourBar(frame=2, crank=2.59, coupler=1, rocker=2.59)
    assert rocker.class_ == "double-rocker" and len(rocker.circuits) == 2
    for limits, circuit in zip(rocker.limits, rocker.circuits, strict=True):
        assert limits is not None and limits == circuit.limits
        assert circuit.inputs.min() == limits[0] and circuit.inputs.max() == limits[1]
        assert set(circuit.branches[:, 0].tolist()) == {1, -1}
        # At a limit the coupler and the rocker are in line: the crank pin is 1 + 2.59, or 2.59 - 1, from the rocker's pivot.
        pin = circuit.positions("A")[np.argmax(circuit.inputs)]
        assert min(abs(np.hypot(pin[0] - 2, pin[1]) - far) for far in (3.59, 1.59)) < 1e-12


def test_cognates_trace_the_same_curve() -> None:
    points = bar().curve(720)
    cognates = bar().cognates()
    assert len(cognates) == 2
    for cognate in cognates:
        traced = np.concatenate([cognate.curve(20000, circuit=k + 1) for k in range(len(cognate.circuits))])
        distances = np.abs(points[::60, None, :] - traced[None]).sum(axis=2).min(axis=1)
        assert distances.max() < 1e-3
        assert cognate.cognates()


def test_the_sextic_vanishes_on_the_curve() -> None:
    sextic = bar().sextic()
    coefficients = sextic.coefficients
    assert coefficients.shape == (7, 7) and coefficients[6, 0] == 1
    x, y = bar().curve().T
    value = np.polynomial.polynomial.polyval2d(x, y, coefficients)
    sizes = np.polynomial.polynomial.polyval2d(np.abs(x), np.abs(y), np.abs(coefficients))
    assert np.abs(value / sizes).max() < 1e-12
    assert all(kind in ("crunode", "tacnode", "cusp", "acnode") for _, _, kind in sextic.double_points)
    assert sextic.circular_points == 3
    value = np.polynomial.polynomial.polyval2d(x - 2, y, sextic.centred_coefficients)
    assert np.abs(value / sizes).max() < 1e-11


def test_measures_have_the_types_and_values_of_the_curve() -> None:
    measures = bar().measures()
    x, y = bar().curve(20000).T
    area = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    length = np.hypot(np.roll(x, -1) - x, np.roll(y, -1) - y).sum()
    assert measures["class"] == "crank-rocker" and measures["six_bar"] is None
    assert abs(abs(measures["area"]) - abs(area)) < 1e-5 and abs(measures["length"] - length) < 1e-5
    assert measures["is_full_turn"] is True and ca.FourBar(4, 3, 3, 3.5).measures()["is_full_turn"] is False
    assert bar().curves[0].measures() == measures and bar().curves[1].measures() != measures


def test_a_linkage_of_the_catalogue_by_numbers_and_expressions() -> None:
    evans = ca.linkage("evans", p=2.5, a=2.6)
    assert evans.parameters == {"p": 2.5, "r": 1.0, "a": 2.6, "s": 2.6, "k": 2.0} and evans.input == "deg"
    assert np.array_equal(ca.linkage("evans", p="5 / 2", a=2.6).curve(), evans.curve())
    assert set(ca.linkages()) >= {"evans", "watt", "jansen", "linear-actuator"}
    all_circuits = ca.linkage("evans", p=2.5, a=2.6, circuits="all")
    assert len(all_circuits.circuits) >= len(evans.circuits)


def test_a_linkage_at_a_place_is_the_same_moved() -> None:
    moved = ca.FourBar(**BAR, x=3, y=-2, turn=90)
    x, y = bar().curve().T
    # The input is the crank's angle from the x-axis: a quarter turn later.
    expected = np.column_stack([3 - y, -2 + x])
    assert np.abs(np.roll(moved.curve(), -90, axis=0) - expected).max() < 1e-12
    assert np.allclose(moved.pivots, [[3, -2], [3, 2]])


def test_drawings_and_files() -> None:
    four_bar = bar()
    plate = four_bar._repr_svg_()
    assert plate is not None and plate.startswith("<svg") and plate == four_bar.svg()
    curve = four_bar.curves[0]
    assert curve._repr_svg_().startswith("<svg") and "[[family]]" in curve.toml()
    assert curve.csv().count("\n") == 361 and "SECTION" in curve.dxf() and curve.json().startswith("{")
    animation = four_bar.animate()
    html = animation._repr_html_()
    assert html.startswith("<iframe sandbox ") and "<script" not in animation.svg and "animate" in animation.svg
    # Everything of the drawing is in one attribute.
    assert html.count("<") == 2 + html.split('srcdoc="')[1].split('"')[0].count("<") and "&quot;" in html


def test_an_animation_is_saved(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "bar.svg"
    animation = bar().animate(circuit=2)
    animation.save(path)
    assert path.read_text() == animation.svg
    with pytest.raises(ca.OutputError, match="its folder does not exist"):
        animation.save(tmp_path / "no" / "bar.svg")


def test_plates_and_curves_are_saved(tmp_path) -> None:  # type: ignore[no-untyped-def]
    bar().save(tmp_path / "bar.svg")
    assert (tmp_path / "bar.svg").read_text() == bar().svg()
    curve = bar().curves[0]
    begins = {"svg": b"<svg", "png": b"\x89PNG", "dxf": b"999", "csv": b"cell", "json": b"{", "toml": b""}
    for suffix, begin in begins.items():
        path = tmp_path / f"curve.{suffix}"
        curve.save(path)
        assert path.read_bytes().lstrip().startswith(begin), suffix
    assert (tmp_path / "curve.csv").read_text() == curve.csv()
    for save in (bar().save, curve.save):
        with pytest.raises(ValueError, match="give a name that ends in .svg"):
            save(tmp_path / "curve.jpg")


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: ca.FourBar(4, -1, 3, 3), ca.LinkageError, "`crank` is -1, and must be more than 0"),
        (lambda: ca.FourBar(4, 1, 3, math.nan), ca.LinkageError, "`rocker` is NaN"),
        (lambda: ca.FourBar(10, 1, 2, 3).curve(), ca.LinkageError, "links of 2 and 3 reach 5"),
        (lambda: bar().curve(-1), ValueError, "samples=-1: give a whole number that is not negative"),
        (lambda: bar().curve(1), ValueError, "samples=1: a circuit has from 2 to 100000 samples"),
        (lambda: bar().curve(10**9), ValueError, "samples=1000000000"),
        (lambda: bar().curve(circuit=3), ValueError, "circuit=3: `four-bar` has traces 1 to 1 and circuits 1 to 2"),
        (lambda: bar().curve(trace=0), ValueError, "trace=0"),
        (lambda: bar().animate(circuit=0), ValueError, "circuit=0"),
        (lambda: bar().circuits[0].positions("Q"), ValueError, "there is no joint `Q`"),
        (lambda: bar().sextic(trace=2), ValueError, "trace=2: `four-bar` traces joints 1 to 1"),
        (lambda: ca.FourBar(4, 1, 3, 3.5, along=0).cognates(), ca.LinkageError, "the coupler point is the crank pin"),
        (lambda: ca.linkage("evan"), ValueError, "did you mean `evans`"),
        (lambda: ca.linkage("evans", p=2, q=3), ca.LinkageError, "unknown parameter `q`"),
        (lambda: ca.linkage("evans", p="2 +"), ValueError, "2 +"),
        (lambda: ca.linkage("evans", p=None), TypeError, "p: a parameter is a number or an expression"),
        (lambda: ca.linkage("evans", p=2, circuits="both"), ValueError, 'circuits="both"'),
        (lambda: ca.linkage("linear-actuator").sextic(), ca.LinkageError, "linear-actuator: "),
    ],
)
def test_errors_name_the_argument_and_the_remedy(call, error, message) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(error) as caught:
        call()
    assert message in str(caught.value)
    assert "\x1b" not in str(caught.value)


def test_a_linkage_that_cannot_be_assembled_is_not_drawn() -> None:
    short = ca.FourBar(10, 1, 2, 3)
    assert short.status == "none" and "links of 2 and 3 reach 5" in short.reason
    assert short.curves == () and short.circuits == () and short._repr_svg_() is None
    with pytest.raises(ca.LinkageError):
        short.svg()


def test_sensitivities_are_those_of_linkages_that_differ() -> None:
    values = {"frame": 4.0, "crank": 1.0, "coupler": 3.0, "rocker": 3.5, "along": 1.5, "across": 1.0}
    bar = ca.linkage("four-bar", **values)
    angles = [30.0, 200.0]
    found = bar.circuits[0].sensitivities("M", at=angles)
    assert list(found) == ["C x", "C y", "OA", "AB", "CB", "M along", "M across"]
    for name, parameter in [("C x", "frame"), ("OA", "crank"), ("AB", "coupler"), ("CB", "rocker"), ("M across", "across")]:
        low, high = [bar.replace(**{parameter: values[parameter] + step}) for step in (-1e-5, 1e-5)]
        expected = (high.circuits[0].positions("M", at=angles) - low.circuits[0].positions("M", at=angles)) / 2e-5
        assert np.abs(found[name] - expected).max() < 1e-8, name
    single = bar.circuits[0].sensitivities("M", at=30)
    assert single["OA"].shape == (2,) and np.array_equal(single["OA"], found["OA"][0])
    assert bar.circuits[0].sensitivities("M")["OA"].shape == bar.curves[0].points.shape


def test_tolerances_are_those_of_inspect() -> None:
    curve = ca.linkage("evans", p=2.5, a=2.6).curves[0]
    found = curve.tolerance(0.02)
    assert found is not None and abs(found["worst_case"] - 0.2204) < 1e-4 and abs(found["root_sum_square"] - 0.09243) < 1e-5
    assert max(found["sensitivities"], key=found["sensitivities"].get) == "CB"
    with pytest.raises(ValueError, match="positive length"):
        curve.tolerance(-1)
    with pytest.raises(ca.LinkageError, match="no length is off by itself"):
        ca.linkage("hrones-nelson", A=2, B=2, C=2.5).curves[0].tolerance()
    # Joints that are placed together have tolerances, too.
    group = ca.linkage("stephenson-ii-six-bar").curves[0].tolerance(0.01)
    assert group is not None and abs(group["worst_case"] - 0.06887) < 1e-5 and "FC" in group["sensitivities"]
