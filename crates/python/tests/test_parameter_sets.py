"""Sweeps of parameter sets in memory, compared with the same cells of manifests; manifests of texts and dictionaries; linkages with other values."""

import pickle
import tomllib

import duckdb
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest

import coupler_atlas as ca

RANDOM = np.random.default_rng(7)
SETS = {name: RANDOM.uniform(low, high, 40) for name, low, high in [("frame", 2, 5), ("crank", 0.5, 1.5), ("coupler", 2, 5), ("rocker", 2, 5)]}
MEASURES = ["length", "mu_worst_deg", "class"]


def swept(parameters: object, **keywords: object) -> pa.Table:
    return pa.table(ca.sweep(linkage="four-bar", parameters=parameters, measures=MEASURES, progress=False, **keywords))


def test_own_sets_are_the_cells_of_a_manifest(manifest) -> None:
    cases = ", ".join("{ " + ", ".join(f"{name} = {float(column[k])!r}" for name, column in SETS.items()) + " }" for k in range(40))
    path = manifest(f'atlas.title = "S"\n[[family]]\nid = "four-bar"\nlinkage = "four-bar"\nwhere = "length > 3"\nsampling.samples = 90\ncases = [{cases}]')
    expected = pa.table(ca.sweep(path, measures=MEASURES, progress=False))
    found = swept(SETS, where="length > 3", samples=90)
    assert found.equals(expected) and 0 < found.num_rows


def test_every_kind_of_table_is_the_same() -> None:
    expected = swept(SETS)
    frame = pd.DataFrame(SETS)
    tables = [frame, pl.DataFrame(SETS), pa.table(SETS), pa.record_batch(SETS), duckdb.sql("select * from frame")]
    tables.append(np.array(list(zip(*SETS.values())), dtype=[(name, float) for name in SETS]))
    assert all(swept(table).equals(expected) for table in tables)
    whole = {"frame": [4, 5], "crank": np.array([1, 1], dtype=np.uint8), "coupler": pd.Series([3, 3]), "rocker": pl.Series([4.0, 4.0])}
    assert swept(whole)["frame"].to_pylist()[-1] == 5.0


def test_numbers_and_expressions_hold_for_all_sets(tmp_path) -> None:
    one = swept({"frame": 4, "crank": [1.0, 1.5], "coupler": "3 * crank", "rocker": np.float64(3.5)})
    other = swept({"frame": [4, 4], "crank": [1.0, 1.5], "coupler": [3, 4.5], "rocker": [3.5, 3.5]})
    assert one["length"].equals(other["length"])
    bar = ca.FourBar(4, 1, 3, 3.5, 1.5, 1)
    kept = pa.table(ca.sweep(linkage=bar, parameters={"crank": [0.8]}, measures=["length"]))
    assert kept["length"][0].as_py() == bar.replace(crank=0.8).measures(only=["length"])["length"]
    assert pa.table(ca.sweep(linkage=bar, measures=["length"]))["length"][0].as_py() == bar.measures()["length"]


def test_a_sweep_of_own_sets_is_pickled_and_divided() -> None:
    sweep = ca.sweep(linkage="four-bar", parameters=SETS, measures=MEASURES)
    whole = pa.table(sweep)
    assert pa.table(pickle.loads(pickle.dumps(sweep))).equals(whole)
    parts = [swept(SETS, shard=(k, 3)) for k in range(3)]
    assert pa.concat_tables(parts).equals(whole)
    assert set(swept(SETS, cells=(3, 5))["cell"].to_pylist()) == {3, 4, 5}
    assert "<td>length</td><td>float64</td>" in sweep._repr_html_()


@pytest.mark.parametrize(
    ("change", "kind", "message"),
    [
        ({"crank": [1, float("nan")]}, ValueError, "column `crank`, row 2, counted from 1: expected a finite number, found NaN"),
        ({"crank": [1, "x"]}, ValueError, "column `crank`, row 2, counted from 1: expected a finite number, found 'x'"),
        ({"crank": pd.array([None, 1], dtype="Float64")}, ValueError, "column `crank`, row 1"),
        ({"crank": [1, -2]}, ValueError, "`parameters`, row 2: frame = 4, crank = -2"),
        ({"crank": [1, 2, 3]}, ValueError, "column `frame` has 2 values, and `crank` 3"),
        ({"cranc": [1, 2]}, ValueError, "did you mean `crank`"),
        ({"crank": [[1, 2]]}, TypeError, "column `crank`: expected an array of one dimension, found an array of shape (1, 2)"),
        ({"crank": [True, False]}, TypeError, "column `crank`: expected numbers"),
        ({"frame": [], "crank": []}, ValueError, "the columns are empty"),
        ({3: [1, 2]}, TypeError, "a column is named by a parameter, and not 3"),
    ],
)
def test_wrong_sets_name_the_column_the_row_and_the_value(change, kind, message) -> None:
    with pytest.raises(kind) as caught:
        ca.sweep(linkage="four-bar", parameters={"frame": [4, 4], "coupler": 3, "rocker": 3.5, **change})
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("keywords", "kind", "message"),
    [
        ({}, TypeError, "give a manifest, or linkage=… with parameters=…"),
        ({"manifest": "atlas.toml", "where": "length > 3"}, ValueError, "where is for linkage=…"),
        ({"linkage": "for-bar", "parameters": SETS}, ValueError, "did you mean `four-bar`"),
        ({"linkage": 3, "parameters": SETS}, TypeError, "give the id of a linkage or a Linkage, not a int"),
        ({"linkage": "four-bar", "parameters": [1, 2]}, TypeError, "give a dict of arrays by their names"),
        ({"linkage": "four-bar", "parameters": SETS, "where": "lenght > 3"}, ValueError, "did you mean `length`"),
    ],
)
def test_arguments_for_own_sets_are_checked(keywords, kind, message) -> None:
    with pytest.raises(kind) as caught:
        ca.sweep(**keywords)
    assert message in str(caught.value)


def test_a_few_measures_are_those_of_all() -> None:
    bar = ca.FourBar(4, 1, 3, 3.5, 1.5, 1)
    some = bar.curves[1].measures(only=["length", "mu_worst_deg", "class"])
    every = ca.FourBar(4, 1, 3, 3.5, 1.5, 1).curves[1].measures()
    assert some == {name: every[name] for name in some} and set(some) == {"length", "mu_worst_deg", "class"}
    assert bar.measures(only=[]) == {} and bar.measures(circuit=2, only=["length"])["length"] == every["length"]
    with pytest.raises(ValueError, match="only: unknown measure `lenght`: did you mean `length`"):
        bar.measures(only=["lenght"])


def test_a_manifest_is_parsed_in_memory(root) -> None:
    text = (root / "atlas.toml").read_text(encoding="utf-8")
    parsed, of_dict = ca.parse(text, path=root / "atlas.toml"), ca.parse(tomllib.loads(text), path=root / "atlas.toml")
    assert parsed == ca.read(root / "atlas.toml") and parsed.keys() == of_dict.keys()
    assert np.array_equal(of_dict["evans"][0].curve(), parsed["evans"][0].curve())
    small = ca.parse({"atlas": {"title": 'A "T"'}, "family": [{"id": "e", "linkage": "evans", "grid": {"p": np.array([2, 3]), "a": [2, 2.6]}}]})
    assert len(small["e"]) == 4 and small.title == 'A "T"' and "<td>evans</td><td>4</td><td>1</td><td><img " in small._repr_html_()
    assert small["e"]._repr_html_().count("<img ") == 4
    with pytest.raises(ca.ManifestError, match="manifest.toml:5:13"):
        ca.parse({"atlas": {"title": "T"}, "family": [{"id": "e", "linkage": "evnas", "grid": {"p": [2]}}]})
    with pytest.raises(TypeError, match="atlas.title: a manifest has no NoneType"):
        ca.parse({"atlas": {"title": None}})


def test_a_linkage_of_a_text() -> None:
    own = {"linkage": [{"id": "own", "parameters": {"r": {"min": 0}}, "trace": ["A"], "joints": {"O": {"fixed": [0, 0]}, "A": {"crank": "O", "length": "r"}}}]}
    linkage = ca.linkage("own", text=own, r=2)
    assert linkage.measures(only=["length"])["length"] == pytest.approx(4 * np.pi)
    assert pickle.loads(pickle.dumps(linkage)) == linkage
    assert pa.table(ca.sweep(linkage=linkage, parameters={"r": [1, 3]}, measures=["length"]))["length"][1].as_py() == pytest.approx(6 * np.pi)


def test_a_linkage_with_other_values() -> None:
    bar = ca.FourBar(4, 1, 3, 3.5, samples=90)
    changed = bar.replace(crank=0.8, coupler="6 / 2")
    assert changed == ca.FourBar(4, 0.8, 3, 3.5, samples=90) and isinstance(changed, ca.FourBar) and len(changed.curve()) == 90
    # What the family derives follows, and the cell is none of the atlas.
    atlas = ca.parse('atlas.title = "T"\n[[family]]\nid = "e"\nlinkage = "evans"\nlet = { a = "p / 2" }\ngrid = { p = [3, 4] }')
    cell = atlas["e"][0].replace(p=5)
    assert cell.parameters["a"] == 2.5 and cell.number is None and pickle.loads(pickle.dumps(cell)) == cell
    for name, value, message in [("cranc", 2, "did you mean `crank`"), ("crank", -2, "`crank` is -2")]:
        with pytest.raises(ca.LinkageError, match=message):
            bar.replace(**{name: value})


def test_a_circuit_at_a_number_and_at_an_array() -> None:
    circuit = ca.FourBar(4, 1, 3, 3.5, 1.5, 1).circuits[0]
    for name in ("positions", "velocities", "accelerations"):
        of_joint = getattr(circuit, name)
        assert of_joint("M", at=30).shape == (2,) and of_joint("M", at=np.float64(390)).shape == (2,)
        assert np.allclose(of_joint("M", at=30), of_joint("M")[30], rtol=1e-12)
        assert np.allclose(of_joint("M", at=[30, 31]), of_joint("M")[30:32], rtol=1e-12)
    step = 1e-4
    low, high = circuit.positions("M", at=[30 - step, 30 + step])
    assert np.allclose((high - low) / np.radians(2 * step), circuit.velocities("M", at=30), rtol=1e-7)
    again = pickle.loads(pickle.dumps(circuit))
    assert np.array_equal(again.positions("M"), circuit.positions("M")) and again.number == 1
