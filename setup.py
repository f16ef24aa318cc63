"""Builds with CMake for the interpreter that runs this file, and takes the package from the build folder; all else is in
pyproject.toml.
"""

import pathlib
import shutil
import subprocess
import sys
import sysconfig

import setuptools
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
RELEASE = ROOT / "build/release"
SYSTEM_PYTHON = pathlib.Path("/usr/bin/python3")  # the interpreter of build/release
VERSION = f"{sys.version_info.major}.{sys.version_info.minor}"
NATIVE = f"_native{sysconfig.get_config_var('EXT_SUFFIX')}"


# An older one ignores [project] of pyproject.toml and installs an empty package named UNKNOWN.
if int(setuptools.__version__.split(".")[0]) < 61:
    raise SystemExit(f"setuptools 61 or later is required, {sys.executable} has {setuptools.__version__}; update it: "
                     f"{sys.executable} -m pip install --upgrade setuptools")


def cmake(*arguments):
    print("cmake", *arguments)
    subprocess.run(["cmake", *arguments], cwd=ROOT, check=True)


def build():
    """Returns the folder of the package for this interpreter."""
    subprocess.run([ROOT / "scripts/build", "hedgehop_package"], check=True)
    if pathlib.Path(sys.executable).resolve() == SYSTEM_PYTHON.resolve():
        return RELEASE / "python/hedgehop"
    # Another interpreter needs only the package, with the libraries of build/release, which remains as it is.
    libraries, folder = ROOT / "build/development", ROOT / f"build/python{VERSION}"
    cmake("--install", RELEASE, "--component", "development", "--prefix", libraries)
    shutil.rmtree(folder / "python", ignore_errors=True)  # may have the files of another build of this version
    cmake("--fresh", "-S", "sim/python/other_interpreter", "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
          f"-DCMAKE_PREFIX_PATH={libraries}", f"-DPython3_EXECUTABLE={sys.executable}")
    cmake("--build", folder)
    return folder / "python/hedgehop"


class CMakeBuild(build_ext):
    def run(self):
        built = build()
        if not (built / NATIVE).exists():
            raise SystemExit(f"{built} has no {NATIVE}, the module for {sys.executable}. If python3-dev or pybind11-dev is missing: "
                             "scripts/packages python")
        package = pathlib.Path(self.build_lib) / "hedgehop"
        shutil.copytree(built, package, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
        (package / "bin").mkdir(exist_ok=True)
        shutil.copy2(RELEASE / "sim/cli/hedgehop", package / "bin/hedgehop")
        for library in (RELEASE / "lib").glob("*.so"):  # libraries that the program loads from its own folder
            shutil.copy2(library, package / "bin")


setup(packages=[], ext_modules=[Extension("hedgehop._native", [])], cmdclass={"build_ext": CMakeBuild})
