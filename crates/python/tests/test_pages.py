"""Pages of an atlas in memory, and those that a notebook shows, compared with the files that are rendered."""

import re
import urllib.parse

import pytest

import coupler_atlas as ca

# A family of each kind: pages of cells as they come, those that `where` and `sort` select, coupler points, and charts.
KINDS = """
[atlas]
title = "Pages <&> more"
formats = ["svg", "png"]
[page]
dpi = 30
[[family]]
id = "evans"
linkage = "evans"
title = 'Evans "and" others'
panels = [2, 1]
sampling = { samples = 36 }
grid = { p = [2, 3, 4], a = [2, 2.6] }
[[family]]
id = "longest"
linkage = "evans"
panels = [2, 1]
sampling = { samples = 36 }
grid = { p = [2, 3, 4], a = [2, 2.6] }
where = "p < 4"
sort = "-length"
[[family]]
id = "points"
linkage = "hrones-nelson"
layout = "coupler-grid"
sampling = { samples = 36 }
cases = [{ A = 2.5, B = 3, C = 2 }, { A = 2, B = 3, C = 3.5 }]
[[family]]
id = "charts"
linkage = "evans"
layout = "chart"
chart = { x = "p", y = ["length", "area"] }
sampling = { samples = 36 }
grid = { p = { from = 2, to = 3, count = 5 }, a = 2.6 }
"""


def pictures(html: str) -> list[str]:
    """The drawings in HTML, each an address of its own."""
    return [urllib.parse.unquote(found) for found in re.findall(r'<img src="data:image/svg\+xml,([^"]*)"', html)]


@pytest.fixture(scope="module")
def rendered(tmp_path_factory: pytest.TempPathFactory) -> tuple[ca.Atlas, dict[str, list[tuple[str, bytes]]]]:
    """The atlas, and the text and the image of each page in its folder, by the ids of the families."""
    folder = tmp_path_factory.mktemp("pages")
    path = folder / "kinds.toml"
    path.write_text(KINDS, encoding="utf-8")
    rendering = ca.render(path, folder / "out")
    files: dict[str, list[tuple[str, bytes]]] = {}
    for file in (file for file in rendering.files if file.suffix == ".svg" and file.parent.parent == folder / "out"):
        files.setdefault(file.parent.name, []).append((file.read_text(encoding="utf-8"), file.with_suffix(".png").read_bytes()))
    assert {family["id"]: family["pages"] for family in rendering.families} == {id: len(pages) for id, pages in files.items()}
    return ca.read(path), files


def test_pages_in_memory_are_those_that_are_rendered(rendered, tmp_path) -> None:
    atlas, files = rendered
    assert [len(pages) for pages in files.values()] == [3, 2, 2, 1]
    for id, pages in files.items():
        for number, (svg, png) in enumerate(pages, 1):
            page = atlas[id].page(number)
            assert (page.family, page.number, page.count) == (id, number, len(pages))
            assert page.svg() == page._repr_svg_() == svg and page.png() == png
    page = atlas["evans"].page(2)
    for suffix, expected in zip(("svg", "png"), files["evans"][1]):
        page.save(tmp_path / f"page.{suffix}")
        found = (tmp_path / f"page.{suffix}").read_bytes()
        assert found == (expected.encode() if isinstance(expected, str) else expected)
    assert page == atlas["evans"].page(2) != atlas["evans"].page(1) and repr(page) == "<coupler_atlas.Page 2 of 3 of evans>"
    with pytest.raises(ValueError, match="page.pdf: give a name that ends in .svg or .png"):
        page.save(tmp_path / "page.pdf")


def test_pages_that_do_not_exist_say_which_there_are(rendered) -> None:
    atlas, _ = rendered
    for number in (0, 4):
        with pytest.raises(IndexError, match=r"`evans` has no page \d: its pages are numbered from 1 to 3"):
            atlas["evans"].page(number)
    with pytest.raises(ValueError, match="number=-1"):
        atlas["evans"].page(-1)
    with pytest.raises(IndexError, match="`charts` has no page 2: its only page is 1"):
        atlas["charts"].page(2)
    with pytest.raises(KeyError, match="did you mean `evans`"):
        atlas["evan"].page(1)
    none = ca.parse(KINDS.replace('where = "p < 4"', 'where = "p < 1"'))
    with pytest.raises(IndexError, match="`longest` has no page 1: it has none, since `where` keeps no cell"):
        none["longest"].page(1)
    large = ca.parse(KINDS.replace('id = "evans"', 'id = "evans"\nscale = "50 mm"', 1))
    with pytest.raises(ca.OutputError, match="the linkages of `evans` do not fit any of the 3 pages at 50 mm"):
        large["evans"].page(1)
    assert "do not fit any of the 3 pages" in large._repr_html_()


def test_a_notebook_shows_the_first_page_of_each_family(rendered) -> None:
    atlas, files = rendered
    html = atlas._repr_html_()
    assert pictures(html) == [pages[0][0] for pages in files.values()]
    count = sum(map(len, files.values()))
    assert f"Pages shown: 4 of {count}. <code>coupler_atlas.render(atlas)</code> writes all of them" in html
    assert 'alt="page 1 of 3 of evans: Evans &quot;and&quot; others"' in html and "<caption>Pages &lt;&amp;&gt; more</caption>" in html
    assert html.count("<tr>") == html.count("</tr>") == 5 and html.count("<td>") == html.count("</td>") == 4 * 6
    # Nothing is loaded.
    assert not re.search(r'(src|href)="(?!data:)', html)


def test_a_notebook_shows_no_more_than_it_can(rendered) -> None:
    atlas, _ = rendered
    family = '[[family]]\nid = "f{}"\nlinkage = "evans"\npanels = [1, 1]\nsampling = {{ samples = 12 }}\ngrid = {{ p = [2, 3], a = 2.6 }}\n'
    many = ca.parse('[atlas]\ntitle = "Many"\n' + "".join(family.format(k) for k in range(14)))
    html = many._repr_html_()
    assert len(pictures(html)) == 12 and "Pages shown: 12 of 28." in html and html.count("<tr>") == 15
    # All cells would be solved for the first page of a selection of them: beyond 300, a plate, and what to call.
    text = KINDS.replace('grid = { p = [2, 3, 4], a = [2, 2.6] }\nwhere = "p < 4"', 'grid = { p = { from = 2, to = 4, count = 301 }, a = 2.6 }\nwhere = "p < 2.01"')
    html = ca.parse(text)._repr_html_()
    shown = pictures(html)
    assert len(shown) == 4 and shown[1] == ca.parse(text)["longest"][0].svg() and "Pages shown: 3 of " in html
    assert "atlas[&quot;longest&quot;].page(1) solves 301 cells for its first page" in html and "not counted" in html
    assert "and those of a family that are not counted" in html and ca.parse(text)["longest"].page(1).count == 1


def test_a_manifest_too_large_to_draw_is_shown_with_plates() -> None:
    text = '[atlas]\ntitle = "T"\n[[family]]\nid = "e"\nlinkage = "evans"\npanels = [1, 1]\nsampling = { samples = 12 }\ngrid = { p = { from = 2, to = 3, count = 100_001 }, a = 2.6 }\n'
    atlas = ca.parse(text.replace("sampling", "limit = 1_000_000\nsampling"))
    html = atlas._repr_html_()
    assert pictures(html) == [atlas["e"][0].svg()] and "files of pages" in html and "Pages shown: 0 of 100001." in html
    with pytest.raises(ca.ManifestError, match="files of pages"):
        atlas["e"].page(1)
