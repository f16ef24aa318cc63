"""Texts of the objects of the package: their class with the values of all attributes."""

import numpy as np

MAX_ITEMS = 16  # of an array, which is otherwise given by its shape


def _value(value):
    if isinstance(value, np.ndarray):
        if value.ndim > 1 or value.size > MAX_ITEMS:
            return f"<{' x '.join(map(str, value.shape))} {value.dtype}>"
        return "[" + ", ".join(f"{item:.6g}" for item in value) + "]"
    if hasattr(type(value), "__members__"):  # a choice
        return repr(value.name)
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key!r}: {_value(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_value, value)) + "]"
    return repr(value)


def _attribute(instance, name):
    try:
        return _value(getattr(instance, name))
    except (ValueError, RuntimeError) as error:  # such as the focal length of a fisheye
        return f"<{error}>"


def _names(cls):
    """Returns the attributes in their order of definition."""
    return [name for name, member in vars(cls).items() if isinstance(member, property)]


def text(instance):
    """Returns "Class(name=value, ...)"."""
    cls = type(instance)
    return f"{cls.__name__}({', '.join(f'{name}={_attribute(instance, name)}' for name in _names(cls))})"


def rebuilt(instance):
    """Pickles an object whose constructor takes its attributes in their order of definition, as that of commands."""
    cls = type(instance)
    return cls, tuple(getattr(instance, name) for name in _names(cls))
