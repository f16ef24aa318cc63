"""Loads modules from source files."""

import importlib.util
import json
import pathlib
import sys


class Refusal(ValueError):
    """The file of a module cannot be used. Its text is a whole message."""


def load_module(file, class_name, parameters):
    """Returns an object of a class in a file. parameters  keyword arguments as JSON."""
    path = pathlib.Path(file)
    name = f"hedgehop_module_{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None:
        raise Refusal("is not a Python source: the name must end in .py")
    source = importlib.util.module_from_spec(spec)
    sys.modules[name] = source
    sys.path.insert(0, str(path.parent))
    try:
        spec.loader.exec_module(source)
    finally:
        sys.path.remove(str(path.parent))
    if not hasattr(source, class_name):
        classes = sorted(key for key, value in vars(source).items() if isinstance(value, type) and hasattr(value, "update"))
        raise Refusal(f"has no class '{class_name}'; its modules: {', '.join(classes) or 'none'}")
    return getattr(source, class_name)(**json.loads(parameters))
