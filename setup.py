"""Builds with CMake and takes the package from its build folder; all else is in pyproject.toml."""

import pathlib
import shutil
import subprocess

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
BUILD = ROOT / "build/release"


class CMakeBuild(build_ext):
    def run(self):
        subprocess.run([ROOT / "scripts/build", "hedgehop", "hedgehop_native", "hedgehop_python"], check=True)
        package = pathlib.Path(self.build_lib) / "hedgehop"
        shutil.copytree(BUILD / "python/hedgehop", package, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
        (package / "bin").mkdir(exist_ok=True)
        shutil.copy2(BUILD / "sim/cli/hedgehop", package / "bin/hedgehop")
        for library in (BUILD / "lib").glob("*.so"):  # libraries that the program loads from its own folder
            shutil.copy2(library, package / "bin")


setup(packages=[], ext_modules=[Extension("hedgehop._native", [])], cmdclass={"build_ext": CMakeBuild})
