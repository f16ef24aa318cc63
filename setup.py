"""Builds with CMake and takes the package from its build folder; all else is in pyproject.toml."""

import pathlib
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
BUILD = ROOT / "build/release"


class CMakeBuild(build_ext):
    def run(self):
        subprocess.run([ROOT / "scripts/build", "hedgehop", "hedgehop_native", "hedgehop_python"], check=True)
        built = BUILD / "python/hedgehop"
        if not (built / f"_native{sysconfig.get_config_var('EXT_SUFFIX')}").exists():
            raise SystemExit(f"Hedgehop builds its package for Debian's /usr/bin/python3, and pip runs on {sys.executable}. Use "
                             "a virtual environment of Debian's Python: /usr/bin/python3 -m venv --system-site-packages DIR; "
                             "if python3-dev, pybind11-dev or python3-numpy is missing: scripts/packages python")
        package = pathlib.Path(self.build_lib) / "hedgehop"
        shutil.copytree(built, package, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
        (package / "bin").mkdir(exist_ok=True)
        shutil.copy2(BUILD / "sim/cli/hedgehop", package / "bin/hedgehop")
        for library in (BUILD / "lib").glob("*.so"):  # libraries that the program loads from its own folder
            shutil.copy2(library, package / "bin")


setup(packages=[], ext_modules=[Extension("hedgehop._native", [])], cmdclass={"build_ext": CMakeBuild})
