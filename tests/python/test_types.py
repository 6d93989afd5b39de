"""The stub, by which editors and type checkers know the package: against the package, and against its examples."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import rheonet

ROOT = pathlib.Path(__file__).parents[2]
MYPY = [sys.executable, "-m", "mypy"]
CONFIGURATION = """
[mypy]
strict = true
[mypy-pandas.*,xarray.*]
ignore_missing_imports = true
follow_imports = skip
"""

pytestmark = pytest.mark.skipif(
    subprocess.run([*MYPY, "--version"], capture_output=True).returncode != 0, reason="mypy is missing (Debian: mypy)"
)


@pytest.fixture
def checked(tmp_path, monkeypatch):
    """Checks a program against the stub alone, and returns the errors."""
    stubs = tmp_path / "stubs" / "rheonet"
    stubs.mkdir(parents=True)
    for name in ("__init__.pyi", "py.typed"):
        shutil.copy(pathlib.Path(rheonet.__file__).parent / name, stubs)
    (tmp_path / "mypy.ini").write_text(CONFIGURATION)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MYPYPATH", str(stubs.parent))

    def check(program):
        (tmp_path / "program.py").write_text(program)
        done = subprocess.run([*MYPY, "--config-file", "mypy.ini", "program.py"], capture_output=True, text=True)
        return [line for line in done.stdout.splitlines() if ": error:" in line]

    return check


def test_the_stub_is_that_of_the_package(checked, tmp_path):
    (tmp_path / "allowed").write_text("rheonet\\.librheonet_mat(_hdf5)?\n")  # libraries of C++ beside the module
    options = ["--mypy-config-file", "mypy.ini", "--allowlist", "allowed", "--ignore-unused-allowlist"]
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "rheonet", *options], capture_output=True, text=True, env=os.environ)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_examples_of_the_readme_have_right_types(checked):
    text = (ROOT / "tools/python/README.md").read_text()
    examples = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(examples) > 5
    # They take for granted that a model and a price are found.
    assert checked("# mypy: disable-error-code=union-attr\n" + "\n".join(examples)) == []


def test_arrays_and_series_are_lists_of_values(checked):
    program = """
import numpy as np
import pandas
import rheonet

scene = rheonet.loads("", {"k1.stiffness": np.float32(2), "drive.position.table": np.ones((2, 2)), "m1.mass": 0.5})
scene.sweep({"k1.stiffness": np.linspace(1, 2, 5), "m1.mass": range(3), "c1.damping": ["1 N*s/m", 2]}, on_error="raise")
scene.sweep({"k1.stiffness": pandas.Series([1, 2])})
scene.precision(np.array([1e-3]))
scene.run().report(scene, title="two")
"k1.force" in scene.sensitivities("k1.stiffness")
"""
    assert checked(program) == []


WRONG = """
rheonet.Scene()
rheonet.Scene(1, 2, 3)
rheonet.Result(1, 2, 3, 4)
rheonet.load(3)
scene.sample({}, 3, "max(a)", kind="halton")
scene.run(accurracy=1e-3)
scene.sweep({"a": 3})
scene.precision(1e-3)
scene.report(result)
"""


def test_what_the_package_refuses_is_a_wrong_type(checked):
    errors = checked("import rheonet\n\nscene = rheonet.loads('')\nresult = scene.run()" + WRONG)
    with_errors = {int(error.split(":")[1]) for error in errors}
    assert with_errors == set(range(5, 5 + len(WRONG.split("\n")) - 2))
