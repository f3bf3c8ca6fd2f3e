"""How long calls show their progress."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np


class Reporter(Protocol):
    """Is called with the steps done, those in all (0 if that is not known) and the name of the part; closed at the end."""

    def __call__(self, done: int, total: int, name: str) -> None: ...

    def close(self) -> None: ...


class Bar:
    """A bar of tqdm, in notebooks a widget."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None
        self._shown: tuple[str, int] | None = None

    def __call__(self, done: int, total: int, name: str) -> None:
        if self._bar is None or self._shown != (name, total):
            self.close()
            self._bar = self._tqdm(total=total or None, desc=name, leave=False)
            self._shown = (name, total)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


class Line:
    """A line on standard error, where there is no tqdm."""

    def __init__(self) -> None:
        self._width = 0

    def __call__(self, done: int, total: int, name: str) -> None:
        text = f"{name}: {done} of {total}" if total else f"{name}: {done}"
        sys.stderr.write("\r" + text.ljust(self._width))
        sys.stderr.flush()
        self._width = len(text)

    def close(self) -> None:
        if self._width:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()
            self._width = 0


class Called:
    """A function of the caller's."""

    def __init__(self, function: Callable[[int, int, str], object]) -> None:
        self._function = function

    def __call__(self, done: int, total: int, name: str) -> None:
        self._function(done, total, name)

    def close(self) -> None:
        pass


class Lasting:
    """A reporter for several calls, which are parts of one reading."""

    def __init__(self, reporter: Reporter) -> None:
        self._reporter = reporter

    def __call__(self, done: int, total: int, name: str) -> None:
        self._reporter(done, total, name)

    def close(self) -> None:
        pass

    def end(self) -> None:
        self._reporter.close()


def is_shown() -> bool:
    """Whether progress is shown where nothing is said of it: in notebooks and terminals."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    if shell is not None and type(shell).__name__ == "ZMQInteractiveShell":
        return True
    return sys.stderr is not None and sys.stderr.isatty()


def reporter(progress: Any) -> Reporter | None:
    """The reporter for an argument ``progress``: None, True, False or a function."""
    if callable(progress):
        return Called(progress)
    if progress is not None and not isinstance(progress, (bool, np.bool_)):
        raise TypeError(f"progress={progress!r}: give True, False, None or a function of (done, total, name)")
    if not (is_shown() if progress is None else progress):
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return Line()
    return Bar(tqdm)


def lasting_reporter(progress: Any) -> Lasting | None:
    """The reporter for a reading of several batches."""
    made = reporter(progress)
    return None if made is None else Lasting(made)
