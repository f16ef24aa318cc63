"""The files of the tree, and a fault in one of them, for the rules of scripts/style."""

import os
import pathlib

SKIPPED_FOLDERS = {"build", "out", "node_modules", "__pycache__"}
CODE = {".h", ".cpp"}


class Fault:
    def __init__(self, path, line, text):
        self.path, self.line, self.text = path, line, text

    def __str__(self):
        return f"{self.path}:{self.line}: {self.text}"


def files(root, suffixes):
    """All files of the given suffixes or names, relative to root, in order, without build products and hidden folders."""
    found = []
    for folder, names, leaves in os.walk(root):
        names[:] = sorted(n for n in names if n not in SKIPPED_FOLDERS and (not n.startswith(".") or n == ".ci"))
        for leaf in leaves:
            path = pathlib.Path(folder, leaf)
            if path.suffix in suffixes or path.name in suffixes:
                found.append(path.relative_to(root))
    return sorted(found)


def read(root, path):
    return (root / path).read_text(encoding="utf-8")


def below(path, folder):
    """Whether a file is `folder` itself or lies in it."""
    return str(path) == folder or str(path).startswith(folder.rstrip("/") + "/")


def line_of(text, place):
    return text.count("\n", 0, place) + 1
