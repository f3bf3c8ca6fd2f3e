"""Manifests of dictionaries as TOML."""

from collections.abc import Iterable, Mapping
from typing import Any

_ESCAPES = {'"': '\\"', "\\": "\\\\"} | {chr(code): f"\\u{code:04X}" for code in [*range(32), 127]}


def _quoted(text: str) -> str:
    return '"' + "".join(_ESCAPES.get(letter, letter) for letter in text) + '"'


def _value(value: Any, place: str) -> str:
    """A value in one line; arrays and numbers of NumPy are lists and numbers."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(_entry(key, item, place) for key, item in value.items()) + " }"
    if isinstance(value, Iterable):
        return "[" + ", ".join(_value(item, f"{place}[{k}]") for k, item in enumerate(value)) + "]"
    raise TypeError(f"{place}: a manifest has no {type(value).__name__}")


def _entry(key: Any, value: Any, place: str) -> str:
    if not isinstance(key, str):
        raise TypeError(f"{place}: a key of a manifest is a text, not {key!r}")
    return f"{_quoted(key)} = {_value(value, f'{place}.{key}' if place else key)}"


def document(manifest: Any) -> str:
    """The text of a manifest, with a line for each entry of its tables, so that messages have places."""
    if not isinstance(manifest, Mapping):
        raise TypeError(f"give the text of a manifest or a dict, and not a {type(manifest).__name__}")
    plain, tables = [], []
    for key, value in manifest.items():
        several = isinstance(value, list | tuple) and bool(value) and all(isinstance(item, Mapping) for item in value)
        if not isinstance(value, Mapping) and not several:
            plain.append(_entry(key, value, ""))
            continue
        head = f"[[{_quoted(str(key))}]]" if several else f"[{_quoted(str(key))}]"
        for table in value if several else [value]:
            tables += [head, *(_entry(name, item, str(key)) for name, item in table.items())]
    return "\n".join([*plain, *tables, ""])
