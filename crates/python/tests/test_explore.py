"""The plate of a curve to explore: the page of the gallery with one plate."""

import base64
import json
import re
from urllib.parse import unquote

import pytest

import coupler_atlas as ca

BAR = dict(frame=4.0, crank=1.0, coupler=3.0, rocker=3.5, along=1.5, across=1.0)


def test_a_plate_to_explore_is_one_page(tmp_path) -> None:
    bar = ca.FourBar(**BAR)
    page = bar.explore(circuit=2)
    summary = json.loads(re.search(r'id="atlas">(.*?)</script>', page.html, re.DOTALL)[1])
    plate = summary["plate"]
    assert plate["address"] == f"#/{plate['id']}/curve/1.1.2" and plate["request"]["curve"] == [1, 2] and summary["families"] == []
    assert dict(plate["request"]["values"]) == BAR and "linkage" in plate["manifest"]
    assert base64.b64decode(summary["kernel"]["module"])[:2] == b"\x1f\x8b"
    # Nothing is read from beside it, or from a network.
    assert "'self'" not in page.html and not re.search(r'(src|href)="', page.html)
    frame = page._repr_html_()
    assert unquote(re.search(r'src="data:text/html;charset=utf-8,([^"]*)"', frame)[1]) == page.html
    page.save(tmp_path / "bar.html")
    assert (tmp_path / "bar.html").read_text(encoding="utf-8") == page.html
    with pytest.raises(ValueError, match="ends in .html"):
        page.save(tmp_path / "bar.svg")
    with pytest.raises(ValueError, match="circuits 1 to 2"):
        bar.explore(circuit=3)


def test_linkages_of_manifests_are_explored() -> None:
    own = ca.linkage("slider", text='[[linkage]]\nid = "slider"\ntrace = ["M"]\nparameters = { l = {} }\njoints = { O = { fixed = [0, 0] }, '
                     'X = { fixed = [1, 0] }, A = { crank = "O", length = 1 }, B = { slide = "A", length = "l", line = ["O", "X"], side = "ahead" }, '
                     'M = { point = ["A", "B"], along = 1, across = 0.5 } }\n', l=3)
    assert '"l"' in own.explore().html
