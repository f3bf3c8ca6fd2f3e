"""The examples of the documents run, every name has a docstring, and the licences are those of the repository."""

import doctest
import inspect
import pathlib
import re

import pytest

import coupler_atlas as ca

from conftest import ROOT


def blocks(path: pathlib.Path) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", path.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("path", [ROOT / "docs" / "python.md", ROOT / "crates" / "python" / "README.md"], ids=lambda path: path.name)
def test_the_examples_of_a_page_run(path, tmp_path, monkeypatch) -> None:
    found = blocks(path)
    assert found
    (tmp_path / "atlas.toml").write_text(
        '[atlas]\ntitle = "Evans"\noutput = "output"\n[[family]]\nid = "evans"\nlinkage = "evans"\ngrid = { p = [2, 3], a = [2, 2.6] }\n'
    )
    monkeypatch.chdir(tmp_path)
    # The blocks of a page are one program.
    names: dict[str, object] = {}
    for number, block in enumerate(found):
        exec(compile(block, f"{path.name}, block {number + 1}", "exec"), names)


def test_the_docstring_of_the_module_is_true() -> None:
    assert doctest.testmod(ca).failed == 0


def test_every_public_name_has_a_docstring() -> None:
    missing = []
    for name in ca.__all__:
        value = getattr(ca, name)
        if name == "__version__":
            continue
        if not inspect.getdoc(value):
            missing.append(name)
        if inspect.isclass(value) and not issubclass(value, Exception):
            own = [(key, member) for key, member in vars(value).items() if not key.startswith("_")]
            missing += [f"{name}.{key}" for key, member in own if not inspect.getdoc(member)]
    assert missing == []


def test_the_licences_are_those_of_the_repository() -> None:
    for path in (ROOT / "crates" / "python").glob("LICENSE-*"):
        assert path.read_bytes() == (ROOT / path.name).read_bytes()


def test_the_page_names_every_function_and_class() -> None:
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    missing = [name for name in ca.__all__ if name != "__version__" and not re.search(rf"\b{name}\b", text)]
    assert missing == []
