"""No two test programs have a suite of one name, because ctest would run, select and label both by that name."""

import os
import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def suites(root):
    """Returns {suite: {program: source}} of the programs that hedgehop_test() declares below `root`."""
    found = {}
    for cmake in sorted(root.rglob("CMakeLists.txt")):
        text = re.sub(r"#.*", "", cmake.read_text(encoding="utf-8"))
        for program, arguments in re.findall(r"hedgehop_test\(\s*(\w+)([^)]*)\)", text):
            for name in re.findall(r"[\w./-]+\.cpp", arguments):
                source = pathlib.Path(os.path.normpath(cmake.parent / name))
                for suite in re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)", source.read_text(encoding="utf-8"), re.M):
                    found.setdefault(suite, {})[program] = source.relative_to(root)
    return found


def repeated(root):
    return [f"suite {suite} of {', '.join(f'{program} ({source})' for program, source in sorted(programs.items()))}"
            for suite, programs in sorted(suites(root).items()) if len(programs) > 1]


class SuiteNames(unittest.TestCase):
    def test_each_suite_belongs_to_one_program(self):
        self.assertGreater(len(suites(ROOT / "tests")), 300, "suites are not found")
        self.assertEqual(repeated(ROOT / "tests"), [], "rename a suite")

    def test_a_suite_in_two_programs_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "sim").mkdir()
            (root / "CMakeLists.txt").write_text("hedgehop_test(a_test LABEL unit\n  SRCS one_test.cpp two_test.cpp)\n")
            (root / "sim/CMakeLists.txt").write_text("hedgehop_test(b_test SRCS\n  b_test.cpp)\n")
            for source in ("one_test.cpp", "two_test.cpp"):
                (root / source).write_text("TEST(Plan, IsFlown) {}\n")
            (root / "sim/b_test.cpp").write_text("TEST(Other, Flies) {}\n")
            self.assertEqual(repeated(root), [], "two sources of one program")
            (root / "sim/b_test.cpp").write_text("TEST(Other, Flies) {}\n\nTEST_F(Plan,\n       IsShown) {}\n")
            self.assertEqual(repeated(root), ["suite Plan of a_test (two_test.cpp), b_test (sim/b_test.cpp)"])


if __name__ == "__main__":
    unittest.main()
