"""The type stubs match the package."""

import ast
import os
import pathlib
import unittest

import hedgehop._native as native

STUBS = pathlib.Path(os.environ["HEDGEHOP_SOURCE"]) / "sim/python/hedgehop/_native.pyi"
INNER = ("Simulation",)  # wrapped by a class of the package


def names(stub):
    return ({item.name for item in stub.body if isinstance(item, (ast.FunctionDef, ast.ClassDef))}
            | {item.target.id for item in stub.body if isinstance(item, ast.AnnAssign)}) - {"__init__"}


class Stubs(unittest.TestCase):
    def test_stubs_have_exactly_the_classes_and_members(self):
        stubs = {item.name: item for item in ast.parse(STUBS.read_text()).body if isinstance(item, ast.ClassDef)}
        real = {name for name, value in vars(native).items() if isinstance(value, type)}
        self.assertEqual(real, set(stubs))
        for name in real - {*INNER}:
            members = {member for member in vars(getattr(native, name)) if not member.startswith("_")}
            self.assertEqual(members, names(stubs[name]), name)


if __name__ == "__main__":
    unittest.main()
