"""Explains a missing part of the package, and the command that builds or installs it."""

import importlib.machinery
import importlib.util
import pathlib
import sys


def explain(init_file):
    """Raises ImportError if numpy or the compiled part for this interpreter is missing."""
    if importlib.util.find_spec("numpy") is None:
        raise ImportError(f"hedgehop needs numpy, which {sys.executable} lacks; install it: apt install python3-numpy, or "
                          "pip install numpy")
    folder = pathlib.Path(init_file).resolve().parent
    if any((folder / f"_native{suffix}").exists() for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        return
    others = sorted(file.name.split("cpython-")[1].split("-")[0] for file in folder.glob("_native.cpython-*.so"))
    this = f"Python {sys.version_info.major}.{sys.version_info.minor} ({sys.executable})"
    if others:
        versions = ", ".join(f"{version[0]}.{version[1:]}" for version in others)
        raise ImportError(f"hedgehop in {folder} was built for Python {versions}, and this is {this}; use Python {versions}, or "
                          f"build for this one in the source checkout: {sys.executable} -m pip install .")
    raise ImportError(f"the compiled part of hedgehop is missing in {folder}; build it in the source checkout: "
                      "scripts/packages python && scripts/build hedgehop_package")
