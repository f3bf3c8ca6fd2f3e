"""Every object of the package can be pickled and copied, and answers the same."""

import copy
import inspect
import multiprocessing
import operator
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import coupler_atlas as ca
from coupler_atlas import _core

OWN = """
[atlas]
title = "Own"
[[linkage]]
id = "own-slider"
trace = ["M"]
[linkage.parameters]
crank = {}
coupler = {}
[linkage.joints]
O = { fixed = [0, 0] }
A = { crank = "O", length = "crank" }
X = { fixed = [1, 0] }
B = { slide = "A", length = "coupler", line = ["O", "X"], side = "ahead" }
M = { point = ["A", "B"], along = "coupler / 3", across = 0.4 }
[[family]]
id = "sliders"
linkage = "own-slider"
sampling = { samples = 36 }
grid = { crank = [1, 1.2], coupler = [2.5, 3] }
"""


def bar() -> ca.FourBar:
    return ca.FourBar(frame=4, crank=1.5, coupler=3, rocker=3.5, along=1.5, across=1)


@pytest.fixture(scope="module")
def examples(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Any]]:
    """Objects of each class, by its name; of those that searches return one of each kind of search."""
    folder = tmp_path_factory.mktemp("pickle")
    path = folder / "own.toml"
    path.write_text(OWN, encoding="utf-8")
    atlas = ca.read(path)
    cells = iter(atlas["sliders"])
    next(cells)
    points = bar().curve(40)
    slider = atlas["sliders"][0].curve()
    rows = np.column_stack([angles := np.linspace(0, 60, 31), 0.3 * angles + 0.001 * angles**2])
    found = [
        ca.find(points, closed=True, index=2000, effort="quick", top=2),
        ca.find(points, closed=True, linkage="slider-crank", where="mu_worst_deg > 89.9", index=300, effort="quick"),
        ca.find(slider, closed=True, linkage="own-slider", manifest=path, effort="quick", top=1, index=300),
        ca.find(slider, closed=True, atlas=path, top=1),
    ]
    functions = [
        ca.find_function("y = log10(x) for x = 1..10 over 60 deg of input and 90 deg of output", top=2),
        ca.find_function(rows, linkage="inverted-slider-crank", effort="quick", top=1),
        ca.find_function(np.column_stack([angles, np.cos(np.radians(angles))]), linkage="slider-crank", top=1),
    ]
    poses = [
        ca.find_poses([[0, 0, 0], [2, 1, 20], [4, 1, 60]], effort="quick", top=3),
        ca.find_poses([[0, 0, 0], [2, 1, 20], [4, 1, 60]], effort="quick", pivots=(90, 90, 91, 91)),
    ]
    sliders = {"fix": {"offset": 0, "along": 0, "across": 0}, "ranges": {"coupler": (100, 300)}, "effort": "quick"}
    designs = [
        ca.design("slider-crank", where="output_stroke == 100", minimize="coupler", best=1, **sliders),
        ca.design("slider-crank", where="output_stroke == 100 and mu_worst_deg >= 89", **sliders),
    ]
    rendering = ca.render(path, folder / "out")
    text = (folder / "out" / "sliders" / "cells.csv").read_text(encoding="utf-8")
    (folder / "out" / "sliders" / "cells.csv").write_text(text.replace("1.2", "1.3"), encoding="utf-8")
    sweep = ca.sweep(atlas)
    own = [answer.linkage for answer in (found[2][0], found[3][0], functions[1][0])]
    return {
        "Linkage": [ca.linkage("evans", p=2.5, a=2.6, circuits="all", samples=30), atlas["sliders"][1], *own],
        "FourBar": [bar(), bar().replace(crank=1.4), *found[0][0].cognates],
        "Curve": [bar().curves[-1], own[0].curves[0]],
        "Circuit": [bar().circuits[-1], own[2].circuits[0]],
        "Sextic": [bar().sextic()],
        "Animation": [bar().animate()],
        "Explorer": [bar().explore(circuit=2)],
        "Inspection": [ca.inspect(bar(), at=30), ca.inspect(bar(), cognates=True)],
        "Atlas": [atlas],
        "Family": [atlas["sliders"]],
        "Page": [atlas["sliders"].page(1)],
        "Cells": [cells, reversed(atlas["sliders"])],
        "Sweep": [sweep, ca.sweep(atlas, points=True, cells=(2, 3))],
        "Batch": [*sweep.batches(), *ca.sweep(atlas, measures=["class", "length", "mu_worst_deg"]).batches()],
        "Found": found,
        "Answer": [found[1].nearest_miss, *(answer for one in found for answer in one)],
        "FoundPoses": poses,
        "PoseAnswer": [poses[1].nearest_miss, *poses[0]],
        "FoundFunction": functions,
        "FunctionAnswer": [answer for one in functions for answer in one],
        "Designs": designs,
        "Design": [designs[0][0], *designs[1].misses.values()],
        "Rendering": [rendering],
        "Report": [ca.check(path, folder / "out")],
    }


def is_same(one: Any, other: Any, depth: int = 3) -> bool:
    """Whether two values are the same, objects of the package by all that they answer without arguments."""
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if isinstance(one, dict):
        return list(one) == list(other) and all(is_same(one[key], other[key], depth) for key in one)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(is_same, one, other, [depth] * len(one)))
    if type(one).__module__ != "coupler_atlas":
        return bool(one == other) or one != one and other != other
    return repr(one) == repr(other) and str(one) == str(other) and (depth == 0 or is_same(answers(one, depth), answers(other, depth), depth - 1))


def answers(one: Any, depth: int) -> dict[str, Any]:
    """The values of all attributes, and what the methods return that need no argument."""
    found = {}
    for name in (name for name in dir(one) if not name.startswith("_") and name not in ("batches", "items", "values")):
        value = getattr(one, name)
        if callable(value):
            parameters = inspect.signature(value).parameters.values()
            if any(parameter.default is parameter.empty and parameter.kind is not parameter.VAR_KEYWORD for parameter in parameters):
                continue
            try:
                value = value()
            except (ca.Error, ValueError) as error:
                value = str(error)
        found[name] = value
    return found


def of_any_kind(one: Any) -> list[Any]:
    """What an object answers to what it alone is asked."""
    if isinstance(one, ca.FunctionAnswer):
        return [one.output(np.linspace(*one.inputs, 7))]
    if isinstance(one, ca.Circuit):
        return [one.positions("A"), one.positions("A", at=[0, 30])]
    if isinstance(one, ca.Family):
        return [one[0], one.values(1)]
    if isinstance(one, ca.Sweep):
        return [batch.to_dict() for batch in one.batches()]
    if isinstance(one, ca.Results):
        return list(one)
    return []


def test_there_is_an_example_of_every_class(examples) -> None:
    named = [(name, kind) for module in (ca, _core) for name, kind in vars(module).items() if not name.startswith("_")]
    classes = {name for name, kind in named if isinstance(kind, type) and not issubclass(kind, Exception)}
    # Is what all that searches return has in common.
    assert classes == {*examples, "Results"}
    for name, made in examples.items():
        assert made and all(type(one).__name__ == name for one in made), name


@pytest.mark.parametrize("make", [lambda one: pickle.loads(pickle.dumps(one)), copy.copy, copy.deepcopy], ids=["pickle", "copy", "deepcopy"])
def test_every_object_is_made_again(examples, make: Callable[[Any], Any]) -> None:
    for name, made in examples.items():
        for one in made:
            again = make(one)
            assert type(again) is type(one), name
            if name == "Cells":
                assert list(make(one)) == list(again), name
                continue
            depth = 2 if make is not copy.copy else 0
            assert is_same(one, again, depth), f"{name}: {one!r} and {again!r}"
            assert is_same(of_any_kind(one), of_any_kind(again), 1), f"{name}: {one!r}"
            if type(one).__eq__ is not object.__eq__:
                assert again == one and hash(again) == hash(one), name


def test_exceptions_are_pickled() -> None:
    with pytest.raises(ca.ManifestError) as raised:
        ca.parse("[atlas]\n")
    again = pickle.loads(pickle.dumps(raised.value))
    assert str(again) == str(raised.value) and again.problems == raised.value.problems


def test_a_pickle_of_another_version_is_an_error() -> None:
    make, (_, state) = bar().__reduce__()
    with pytest.raises(TypeError, match="no class Linkages: the pickle is of another version"):
        make("Linkages", state)


def test_answers_are_sent_to_other_processes(examples) -> None:
    sent = [examples[name][0] for name in ("Linkage", "Found", "Answer", "Design", "Family")]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(repr, sent) == [repr(one) for one in sent]
        assert is_same(pool.map(operator.attrgetter("linkage"), examples["Answer"][:3]), [answer.linkage for answer in examples["Answer"][:3]], 0)
