"""The type stubs name what there is."""

import ast
import os
import pathlib
import unittest

import hedgehop._native as native

STUBS = pathlib.Path(os.environ["HEDGEHOP_SOURCE"]) / "sim/python/hedgehop/_native.pyi"
INNER = ("Simulation",)  # the package's own class wraps it


def names(stub):
    return ({item.name for item in stub.body if isinstance(item, (ast.FunctionDef, ast.ClassDef))}
            | {item.target.id for item in stub.body if isinstance(item, ast.AnnAssign)}) - {"__init__"}


class Stubs(unittest.TestCase):
    def test_every_class_and_member_is_there_and_no_other(self):
        stubs = {item.name: item for item in ast.parse(STUBS.read_text()).body if isinstance(item, ast.ClassDef)}
        real = {name for name, value in vars(native).items() if isinstance(value, type)}
        self.assertEqual(real, set(stubs))
        for name in real - {*INNER}:
            members = {member for member in vars(getattr(native, name)) if not member.startswith("_")}
            self.assertEqual(members, names(stubs[name]), name)


if __name__ == "__main__":
    unittest.main()
