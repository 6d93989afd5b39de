"""`pip install ./tools/python`: CMake builds the package in build/wheel, or in the build tree that RHEONET_BUILD names."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

project = pathlib.Path(__file__).resolve().parents[2]
build = pathlib.Path(os.environ.get("RHEONET_BUILD", project / "build/wheel"))
version = re.search(r"project\(rheonet VERSION ([0-9.]+)", (project / "CMakeLists.txt").read_text())[1]


def cmake(*arguments):
    subprocess.run(["cmake", *map(str, arguments)], check=True)


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        if not (build / "CMakeCache.txt").exists():
            cmake("-S", project, "-B", build, f"-DPython_EXECUTABLE={sys.executable}", "-DRHEONET_TESTS=OFF")
        cmake("--build", build, "--target", "rheonet_python", "--parallel", os.cpu_count())
        with tempfile.TemporaryDirectory() as prefix:
            for component in ("python", "wheel"):
                cmake("--install", build, "--component", component, "--prefix", prefix)
            package = pathlib.Path(self.get_ext_fullpath(extension.name)).parent
            shutil.copytree(f"{prefix}/lib/python3/dist-packages/rheonet", package, dirs_exist_ok=True)


# The files that setuptools makes go to the build folder too, not beside the sources.
files = project / "build/setuptools"
files.mkdir(parents=True, exist_ok=True)
setup(
    version=version,
    ext_modules=[Extension("rheonet._rheonet", [])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": str(files)}, "egg_info": {"egg_base": str(files)}},
)
