"""Manifests, rendered atlases and their checks."""

import pathlib
import pickle
import subprocess
import sys
from collections.abc import Mapping, Sequence

import numpy as np
import pytest

import coupler_atlas as ca

from conftest import SMALL
from test_sweep import MANY, command


def test_a_manifest_is_read(manifest) -> None:
    atlas = ca.read(manifest())
    assert atlas.title == "Small" and list(atlas) == atlas.keys() == ["four-bars", "watt"] and len(atlas) == 2
    family = atlas["watt"]
    assert len(family) == 12 and family.linkage == "watt" and family.values(0)["p"] == 3 and family.values(-1)["a"] == 2
    assert family[2].number == 3 == family.cell(3).number and family[2].parameters == family.cell(3).parameters
    assert len(list(family)) == 12
    own = ca.linkage("watt", samples=36, **family[0].parameters)
    assert np.array_equal(own.curve(), family[0].curve())
    four_bar = atlas["four-bars"][0]
    assert four_bar.curve().shape == (36, 2) and isinstance(four_bar, ca.FourBar) and four_bar.id == "four-bars"
    assert [cell.number for cell in family[1:8:3]] == [2, 5, 8] and next(reversed(family)).number == 12
    assert family[0] == family[0] != family[1] and isinstance(family, Sequence) and isinstance(atlas, Mapping)
    assert dict(atlas.items()) == {family.id: family for family in atlas.values()}
    assert "watt" in atlas and "wat" not in atlas and atlas.get("wat", 3) == 3 and atlas.get("watt") == family
    for wrong in (lambda: family[12], lambda: family.cell(0), lambda: family.cell(13), lambda: family[-13]):
        with pytest.raises(IndexError, match="12"):
            wrong()
    with pytest.raises(KeyError, match="did you mean `watt`"):
        atlas["wat"]


ADDRESS = (
    "https://app.pmksplus.com/?j=A,0,0,AB,R,t,0,0.1,t,%0AB,0.6,0.8,AB%7CBCM,R,f,0,0.1,f,%0AC,3.4,2.6,BCM%7CCD,R,f,0,0.1,f,%0A"
    "D,4,0,CD,R,t,0,0.1,f,%0AM,2.5,3.4,BCM,R,f,0,0.1,f,%0A"
)


def test_linkages_of_other_programs_are_read(manifest, tmp_path) -> None:
    links = '{"edges": [[0, 1], [1, 2], [2, 3], [1, 4], [2, 4]], "positions": [[0, 0], [0.6, 0.8], [3.4, 2.6], [4, 0], [2.5, 3.4]], "fixed": [0, 3], '
    path = tmp_path / "bars.json"
    path.write_text(links + '"motor": [0, 1], "target": 4}')
    curves = []
    for source in (ADDRESS, path):
        atlas = ca.read(source)
        assert list(atlas) == ["imported"] and len(atlas["imported"]) == 1
        linkage = atlas["imported"][0]
        curves.append(linkage.curve())
        assert pickle.loads(pickle.dumps(linkage)).curve().tolist() == curves[-1].tolist()
    assert np.abs(curves[0] - curves[1]).max() < 1e-12
    # The curve passes the coupler point of the drawing.
    assert np.hypot(*(curves[0] - [2.5, 3.4]).T).min() < 0.05
    driven = ca.read(ADDRESS, input="D, C")["imported"][0]
    assert driven.curve().shape != curves[0].shape or np.abs(driven.curve() - curves[0]).max() > 0.01
    with pytest.raises(ca.Error, match="9 fields"):
        ca.read("?j=A,0,0,AB,R,t")
    with pytest.raises(ValueError, match="of other programs"):
        ca.read(manifest(), input="A, B")


def test_atlases_and_their_cells_are_pickled_with_the_text(manifest) -> None:
    path = manifest()
    atlas = ca.read(path)
    made = [atlas, atlas["watt"], atlas["watt"].cell(2), atlas["four-bars"].cell(3)]
    pickles = [pickle.dumps(one) for one in made]
    path.unlink()
    again = [pickle.loads(one) for one in pickles]
    assert again == made and [hash(one) for one in again] == [hash(one) for one in made]
    assert np.array_equal(again[2].curve(), made[2].curve()) and again[2].number == 2


def test_cases_in_a_file_are_read_beside_the_manifest_and_pickled(manifest) -> None:
    text = '[atlas]\ntitle = "T"\n[[family]]\nid = "listed"\nlinkage = "evans"\nsampling = { samples = 36 }\ncases = CASES\n'
    inline = manifest(text.replace("CASES", "[{ p = 2, a = 2.5 }, { p = 3, a = 4 }, { p = 4, a = 5.5 }]"))
    expected = ca.read(inline)["listed"]
    rows = sum(len(batch) for batch in ca.sweep(inline).batches())
    path = manifest(text.replace("CASES", '"list.csv"'))
    table = path.parent / "list.csv"
    table.write_text("p,a\n2,2.5\n3,x\n4,5.5\n", encoding="utf-8")
    with pytest.raises(ca.ManifestError, match="`list.csv`, line 3, column `a`: expected a finite number, found `x`"):
        ca.read(path)
    table.write_text("p,a\n2,2.5\n3,4\n4,5.5\n", encoding="utf-8")
    atlas, sweep = ca.read(path), ca.sweep(path)
    assert [atlas["listed"].values(k) for k in range(3)] == [expected.values(k) for k in range(3)]
    made = [atlas, atlas["listed"], atlas["listed"].cell(2)]
    pickles = [pickle.dumps(one) for one in [*made, sweep]]
    assert len(pickles[2]) < 2_000
    table.write_text("p,a\n2,2.5\n3,4.5\n4,5.5\n", encoding="utf-8")
    assert ca.read(path) != atlas
    table.unlink()
    *again, sweep_again = [pickle.loads(one) for one in pickles]
    assert again == made and again[2].number == 2
    assert np.array_equal(again[2].curve(), expected.cell(2).curve())
    for one in (sweep, sweep_again, ca.sweep(atlas)):
        assert sum(len(batch) for batch in one.batches()) == rows
    with pytest.raises(ca.ManifestError, match="cannot read `list.csv`"):
        ca.sweep(path)


def test_a_manifest_too_large_to_draw_can_be_read_and_swept(manifest) -> None:
    path = manifest(MANY)
    atlas = ca.read(path)
    assert len(atlas["many"]) == 1_120_000 and atlas["many"].cell(1_119_999).curve().shape == (360, 2)
    with pytest.raises(ca.ManifestError, match="files of pages"):
        ca.render(atlas, path.parent / "pages")


def test_problems_of_a_manifest_are_reported_with_their_places(manifest) -> None:
    path = manifest('[atlas]\ntitle = "x"\n[[family]]\nid = "a"\nlinkage = "evan"\ngrid = { p = [1, 2], p2 = 3 }\n')
    with pytest.raises(ca.ManifestError) as caught:
        ca.read(path)
    error = caught.value
    assert error.file == str(path) and error.problems[0]["line"] == 5 and error.problems[0]["is_error"]
    assert "did you mean `evans`" in error.problems[0]["help"] + error.problems[0]["message"]
    assert f"{path}:5:" in str(error) and "\x1b" not in str(error)
    for call in (ca.sweep, ca.render, lambda path: ca.check(path, against=path.parent)):
        with pytest.raises(ca.ManifestError):
            call(path)
    with pytest.raises(FileNotFoundError, match="nothing.toml"):
        ca.read(path.parent / "nothing.toml")
    assert issubclass(ca.ManifestError, ca.Error)


def test_warnings_are_warnings(manifest) -> None:
    path = manifest(
        '[atlas]\ntitle = "x"\noutput = "out"\n[[family]]\nid = "a"\nlinkage = "evans"\ngrid = { p = [2, 3], a = 2.6 }\nwhere = "p > 5"\n'
    )
    with pytest.warns(ca.ManifestWarning, match="`where` keeps none"):
        ca.render(path)


def test_an_atlas_is_rendered_checked_and_found_changed(manifest, tmp_path) -> None:
    # Some pages are enough.
    path = manifest(SMALL.replace("count = 4", "count = 2").replace("count = 5", "count = 3"))
    calls = []
    rendering = ca.render(path, tmp_path / "here", progress=lambda *call: calls.append(call))
    command("render", path, "-o", tmp_path / "there", "--quiet")
    # The same files, but for nothing.
    for file in rendering.files:
        other = tmp_path / "there" / file.relative_to(tmp_path / "here")
        assert file.read_bytes() == other.read_bytes()
    assert rendering.pages == rendering.drawn > 0 and rendering.folder == tmp_path / "here"
    assert rendering.gallery == tmp_path / "here" / "index.html" and rendering.gallery in rendering.files
    assert tmp_path / "here" / "kernel.js" in rendering.files
    assert [family["id"] for family in rendering.families] == ["four-bars", "watt"]
    assert ca.render(path, tmp_path / "here").drawn == 0
    report = ca.check(path, against=tmp_path / "here")
    assert report and not report.has_differences and report.findings == [] and report.families == 2
    assert "nothing has changed" in str(report)

    table = tmp_path / "here" / "watt" / "points.csv"
    lines = table.read_text().splitlines(keepends=True)
    cell, *rest, x, y = lines[1].rstrip("\n").split(",")
    lines[1] = ",".join([cell, *rest, str(float(x) + 0.01), y]) + "\n"
    table.write_text("".join(lines))
    report = ca.check(path, against=tmp_path / "here")
    assert not report and report.has_differences and len(report) >= 1
    finding = next(finding for finding in report.findings if finding.get("cell") == int(cell))
    assert finding["family"] == "watt"
    assert "watt" in str(report) and sum(report.counts.values()) >= 1
    assert ca.check(path, against=tmp_path / "here", only=["four-bars"])


def test_arguments_of_render_and_check_are_checked(manifest, tmp_path) -> None:
    path = manifest()
    with pytest.raises(ValueError, match="unknown format \"gif\": give any of svg, png, pdf"):
        ca.render(path, formats=["gif"])
    with pytest.raises(ValueError, match="did you mean `watt`"):
        ca.render(path, only=["wat"])
    with pytest.raises(ValueError, match="atol=-1"):
        ca.check(path, against=tmp_path, atol=-1)
    with pytest.raises(ValueError, match="`lenght`: did you mean `length`"):
        ca.check(path, against=tmp_path, ignore=["lenght"])
    with pytest.raises(ValueError, match="length=-1"):
        ca.check(path, against=tmp_path, measures={"length": -1})
    with pytest.raises(ca.OutputError, match="run.json"):
        ca.check(path, against=tmp_path / "nothing")
    (tmp_path / "file").write_text("")
    with pytest.raises(ca.OutputError, match="cannot write"):
        ca.render(path, tmp_path / "file" / "folder")


def test_plates_are_those_of_the_program() -> None:
    evans = ca.linkage("evans", p=2.5, a=2.6)
    assert evans.svg() == command("inspect", "evans", "p=2.5", "a=2.6", "--svg", "-")
    assert evans.animate().svg == command("inspect", "evans", "p=2.5", "a=2.6", "--animate", "--svg", "-")
    assert evans.curves[0].toml() == command("export", "--linkage", "evans", "p=2.5", "a=2.6", "--format", "toml", "-o", "-")


def test_the_command_is_the_program(manifest, tmp_path) -> None:
    assert command("--version").startswith(f"coupler-atlas {ca.__version__}")
    module = subprocess.run([sys.executable, "-m", "coupler_atlas", "list", "linkages"], capture_output=True, text=True)
    assert module.returncode == 0 and module.stdout == command("list", "linkages")
    program = pathlib.Path(sys.executable).parent / "coupler-atlas"
    wrong = subprocess.run([program, "validate", tmp_path / "no.toml"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "cannot find" in wrong.stderr
    misspelt = subprocess.run([program, "rendr"], capture_output=True, text=True)
    assert misspelt.returncode == 2 and "render" in misspelt.stderr
