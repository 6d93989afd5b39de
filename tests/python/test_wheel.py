"""`pip install ./tools/python` into a virtual environment, from the build tree that the tests use."""

import os
import pathlib
import subprocess
import venv

import pytest

PACKAGE = pathlib.Path(__file__).parents[2] / "tools/python"
# A model of the library that comes with the package.
SCENE = """
include = ["library/rheology.toml"]
[elements]
drive = { type = "motion", at = "a", velocity = 1 }
m1 = { type = "maxwell", between = ["a", "ground"], k = 1, B = 1 }
[simulate]
stop = 1
output = { points = 3 }
"""


def test_pip_installs_the_package(tmp_path):
    pytest.importorskip("pip")
    environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "RHEONET_LIBRARY")}
    venv.create(tmp_path / "venv", with_pip=True, system_site_packages=True)
    python = tmp_path / "venv/bin/python"
    # From Debian's packages alone: nothing is fetched.
    install = [python, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", "--no-deps", PACKAGE]
    subprocess.run(install, check=True, env=environment)
    (tmp_path / "scene.toml").write_text(SCENE)
    program = "import rheonet; print(rheonet.__file__, len(rheonet.load('scene.toml').run().time))"
    done = subprocess.run([python, "-c", program], check=True, env=environment, cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout.startswith(str(tmp_path / "venv")) and done.stdout.endswith(" 3\n")
    assert not any((PACKAGE / left).exists() for left in ("build", "rheonet.egg-info"))
