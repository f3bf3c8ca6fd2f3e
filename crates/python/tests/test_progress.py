"""Who shows progress, and how."""

import io
import sys

import pytest

from coupler_atlas import _progress


def test_progress_is_shown_where_it_can_be_seen(monkeypatch) -> None:
    assert _progress.reporter(None) is None and _progress.reporter(False) is None
    assert isinstance(_progress.reporter(print), _progress.Called)
    assert isinstance(_progress.reporter(True), _progress.Bar)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    assert isinstance(_progress.reporter(None), _progress.Bar)
    # Without tqdm.
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    assert isinstance(_progress.reporter(None), _progress.Line)
    with pytest.raises(TypeError, match="progress=3"):
        _progress.reporter(3)


def test_a_line_is_written_over_and_removed(monkeypatch) -> None:
    written = io.StringIO()
    monkeypatch.setattr(sys, "stderr", written)
    line = _progress.Line()
    line(5, 100, "evans")
    line(7, 0, "x")
    line.close()
    assert written.getvalue() == "\revans: 5 of 100\rx: 7           \r    \r"


def test_a_bar_follows_the_parts() -> None:
    made = []

    class Tqdm:
        def __init__(self, total: object, desc: str, leave: bool) -> None:
            self.n, self.total, self.desc, self.closed = 0, total, desc, False
            made.append(self)

        def update(self, steps: int) -> None:
            self.n += steps

        def close(self) -> None:
            self.closed = True

    bar = _progress.Bar(Tqdm)
    bar(3, 10, "a")
    bar(10, 10, "a")
    bar(1, 0, "b")
    bar.close()
    assert [(one.desc, one.n, one.total, one.closed) for one in made] == [("a", 10, 10, True), ("b", 1, None, True)]
