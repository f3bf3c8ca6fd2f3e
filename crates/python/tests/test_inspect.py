"""What is known of a linkage: the answer of the command `inspect`."""

import json
import re
import subprocess
import sys

import pytest

import coupler_atlas as ca

BAR = dict(frame=4.0, crank=1.0, coupler=3.0, rocker=3.5, along=1.5, across=1.0)
GIVEN = [f"{name}={value}" for name, value in BAR.items()]


def printed(*arguments: str) -> str:
    return subprocess.run([sys.executable, "-m", "coupler_atlas", "inspect", *arguments], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize(
    "arguments, options",
    [
        ([], {}),
        (["--at", "30", "--branch", "-1"], {"at": 30, "branch": -1}),
        (["--at", "0.5 rad", "--load", "100 on B at -90 deg"], {"at": "0.5 rad", "load": "100 on B at -90 deg"}),
        (["--tolerance", "0.1", "--sextic"], {"tolerance": 0.1, "sextic": True}),
        (["--cognates", "--trace", "1"], {"cognates": True, "trace": 1}),
    ],
)
def test_an_inspection_is_what_the_command_prints(arguments, options) -> None:
    inspection = ca.inspect(ca.FourBar(**BAR), **options)
    assert str(inspection) == printed("four-bar", *GIVEN, *arguments)
    assert inspection.json() == printed("four-bar", *GIVEN, *arguments, "--json")
    assert dict(inspection) == inspection.to_dict() == json.loads(inspection.json())


def test_an_inspection_is_a_mapping() -> None:
    inspection = ca.inspect(ca.FourBar(**BAR))
    assert inspection["class"] == "crank-rocker" and inspection.get("none") is None and "circuits" in inspection
    assert list(inspection) == inspection.keys() and len(inspection) == len(inspection.items()) == len(inspection.values())
    assert [circuit["full_turn"] for circuit in inspection["circuits"]] == [True, True]
    assert inspection.svg().startswith("<svg") and "<pre>four-bar: " in inspection._repr_html_()
    with pytest.raises(KeyError, match="none"):
        inspection["none"]
    with pytest.raises(ValueError, match="cognates=True"):
        inspection.toml()
    cognates = ca.parse(ca.inspect(ca.FourBar(**BAR), cognates=True).toml())
    assert len(cognates) == 3


def test_cells_and_linkages_that_cannot_be_assembled_are_inspected(manifest) -> None:
    cell = ca.read(manifest())["watt"].cell(2)
    assert ca.inspect(cell)["parameters"]["a"] == cell.parameters["a"]
    apart = ca.inspect(ca.FourBar(frame=9, crank=1, coupler=1, rocker=1))
    assert apart["status"] == "none" and "not assembled" in str(apart) and "<img" not in apart._repr_html_()
    with pytest.raises(ca.LinkageError, match="cannot be assembled"):
        apart.svg()


@pytest.mark.parametrize(
    "options, message",
    [
        ({"at": float("inf")}, "at=inf: give a finite number"),
        ({"at": "3 mm"}, "write it like at=30"),
        ({"branch": 1}, "give at="),
        ({"at": 3, "branch": 2}, "branch=2: give 1 or -1"),
        ({"load": "much"}, "load: four-bar: "),
        ({"tolerance": 0.0}, "tolerance=0: give a positive length, as in tolerance=0.1"),
        ({"cognates": True, "trace": 2}, "give trace=1 to 1"),
    ],
)
def test_wrong_arguments_are_errors(options, message) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        ca.inspect(ca.FourBar(**BAR), **options)


def test_equations_are_those_of_four_bars() -> None:
    with pytest.raises(ValueError, match="leave sextic out"):
        ca.inspect(ca.linkage("slider-crank", coupler=3), sextic=True)
