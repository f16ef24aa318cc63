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


def text(instance):
    """Returns "Class(name=value, ...)" with the attributes in their order of definition."""
    cls = type(instance)
    names = [name for name, member in vars(cls).items() if isinstance(member, property)]
    return f"{cls.__name__}({', '.join(f'{name}={_attribute(instance, name)}' for name in names)})"
