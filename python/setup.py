"""Builds the wheel: the extension module by CMake, in a build folder of its own, and the data beside it.

MYOTACT_PYTHON_BUILD names a build folder to be used again; CMAKE_CXX_COMPILER_LAUNCHER is passed on by CMake itself.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parent.parent
DATA = ("assets", "meshes", "shaders")
LEFT_OUT = shutil.ignore_patterns("pictures", "desktop", "languages", "lessons")
NOTICES = ("LICENSE", "NOTICE")


def version() -> str:
    found = re.search(r"project\(myotact VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    if found is None:
        raise SystemExit(f"{ROOT}/CMakeLists.txt: names no version; build the wheel in a checkout of the project")
    return found.group(1)


class BuildByCMake(build_ext):
    """All is compiled apart from the program, since a shared library needs position-independent code."""

    def build_extension(self, ext: Extension) -> None:
        folder = Path(os.environ.get("MYOTACT_PYTHON_BUILD") or Path(self.build_temp).resolve() / "cmake")
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            "MYOTACT_BUILD_PYTHON": "ON",
            "MYOTACT_BUILD_PREPARE": "OFF",
            "MYOTACT_BUILD_TESTS": "OFF",
            "MYOTACT_BUNDLES": "ON",
            "Python_EXECUTABLE": sys.executable,
            "pybind11_DIR": pybind11.get_cmake_dir(),
        }
        defined = [f"-D{name}={value}" for name, value in options.items()]
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(folder), "-G", "Ninja", *defined], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "_myotact"], check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(folder / "python" / target.name, target)


class BuildWithData(build_py):
    """The wheel needs nothing else of Myotact: scenes, specimens and what they name are in myotact/share."""

    def run(self) -> None:
        super().run()
        share = Path(self.build_lib) / "myotact" / "share"
        shutil.rmtree(share, ignore_errors=True)
        for name in DATA:
            shutil.copytree(ROOT / name, share / name, ignore=LEFT_OUT)
        for name in NOTICES:
            shutil.copy2(ROOT / name, share / name)


setup(
    version=version(),
    ext_modules=[Extension("myotact._myotact", sources=[])],
    cmdclass={"build_ext": BuildByCMake, "build_py": BuildWithData},
)
