"""The notebooks of tools/python/notebooks run from their first cell to their last. They hold assertions of their own."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "tools/python/notebooks").glob("*.ipynb"))


def code_cells(notebook):
    return [cell for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == "code"]


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(notebook, tmp_path):
    pytest.importorskip("ipykernel", reason="ipykernel is missing (Debian: python3-ipykernel)")
    pytest.importorskip("nbconvert", reason="nbconvert is missing (Debian: jupyter-nbconvert)")
    environment = os.environ | {"IPYTHONDIR": str(tmp_path / "ipython"), "JUPYTER_CONFIG_DIR": str(tmp_path / "jupyter"), "HOME": str(tmp_path)}
    shutil.copy(notebook, tmp_path)
    # A kernel of this interpreter, whatever kernels are installed.
    kernel = tmp_path / "share/jupyter/kernels/python3"
    kernel.mkdir(parents=True)
    command = {"argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"], "display_name": "Python 3", "language": "python"}
    (kernel / "kernel.json").write_text(json.dumps(command))
    environment["JUPYTER_PATH"] = str(tmp_path / "share/jupyter")
    for words in (["notebook", "--execute", "--output", "executed.ipynb", notebook.name], ["html", "executed.ipynb"]):
        done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", *words], cwd=tmp_path, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr[-3000:]
    executed = code_cells(tmp_path / "executed.ipynb")
    drawn = any(".plot(" in "".join(cell["source"]) for cell in executed)
    assert ("data:image/svg+xml" in (tmp_path / "executed.html").read_text()) == drawn
    assert [cell["execution_count"] for cell in executed] == list(range(1, len(executed) + 1))


def test_notebooks_are_kept_without_outputs():
    assert len(NOTEBOOKS) >= 3
    for notebook in NOTEBOOKS:
        assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code_cells(notebook)), notebook.name
