"""Runs a notebook in its folder, and fails where a cell does."""

import pathlib
import sys

import nbformat
from nbclient import NotebookClient

path = pathlib.Path(sys.argv[1])
notebook = nbformat.read(path, as_version=4)
NotebookClient(notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}).execute()
shown = {kind for cell in notebook.cells for output in cell.get("outputs", []) for kind in output.get("data", {})}
assert "image/svg+xml" in shown or "image/png" in shown, f"{path} shows nothing but {shown}"
print(f"{path}: {sum(cell.cell_type == 'code' for cell in notebook.cells)} cells")
