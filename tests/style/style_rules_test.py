"""Feeds scripts/style small trees that break one rule each, and one that breaks none."""

import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def load_style():
    loader = importlib.machinery.SourceFileLoader("style", str(ROOT / "scripts" / "style"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("style", loader))
    loader.exec_module(module)
    return module


style = load_style()

GOOD_TREE = {
    "CMakeLists.txt": 'set(HEDGEHOP_LAYERS\n    "vision:"\n    "avoidance: vision"\n    "sim/loop: vision avoidance")\n',
    "vision/CMakeLists.txt": "hedgehop_library(vision\n  HDRS flow.h\n  SRCS flow.cpp ${CMAKE_CURRENT_BINARY_DIR}/made.cpp)\n",
    "vision/flow.h": "#pragma once\n\n/// Mean flow: [Garratt2009] eq. (2).\nint flow();\n",
    "vision/flow.cpp": '#include "vision/flow.h"\n\n#include <opencv2/core.hpp>\n\n// [Garratt2009]\n// sec. 3\nint flow() { return 1; }\n',
    "avoidance/CMakeLists.txt": "hedgehop_library(avoidance HDRS steer.h)\n",
    "avoidance/steer.h": '#pragma once\n\n#include "vision/flow.h"\n',
    "REFERENCES.md": "- **[Garratt2009]** A. Author: A title, 2009.\n",
    ".clang-format": "BasedOnStyle: Google\nColumnLimit: 120\n",
    "build/vision/bad.cpp": "int   badly( ) ;\n",
}


class Tree(unittest.TestCase):
    def faults(self, rule, changes=None):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**GOOD_TREE, **(changes or {})}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return [str(fault) for fault in style.RULES[rule](root)]

    def assert_refused(self, rule, changes, *said):
        found = self.faults(rule, changes)
        self.assertEqual(len(found), 1, found)
        for words in said:
            self.assertIn(words, found[0])

    def test_a_good_tree_passes_every_rule(self):
        for rule in style.RULES:
            self.assertEqual(self.faults(rule), [], rule)


class Layers(Tree):
    def test_an_include_up_the_table(self):
        self.assert_refused("layers", {"vision/flow.h": '#include "avoidance/steer.h"\n'},
                            "vision/flow.h:1:", "vision may not include avoidance")

    def test_an_include_up_the_table_in_angle_brackets(self):
        self.assert_refused("layers", {"vision/flow.h": "#include <avoidance/steer.h>\n"}, "vision may not include")

    def test_an_include_that_does_not_start_at_the_root(self):
        self.assert_refused("layers", {"vision/flow.cpp": '#include "flow.h"\n'}, "is no path from the root")

    def test_an_include_of_a_missing_file(self):
        self.assert_refused("layers", {"avoidance/steer.h": '#include "vision/gone.h"\n'}, "does not exist")

    def test_a_row_that_looks_down(self):
        table = 'set(HEDGEHOP_LAYERS\n    "vision: avoidance"\n    "avoidance: vision")\n'
        self.assert_refused("layers", {"CMakeLists.txt": table}, "stands not above it")

    def test_yaml_outside_the_scenario_room(self):
        self.assert_refused("layers", {"sim/loop/x.h": "#include <yaml-cpp/yaml.h>\n"}, "belongs into sim/scenario")

    def test_tests_may_include_everything(self):
        self.assertEqual(self.faults("layers", {"tests/x_test.cpp": '#include "avoidance/steer.h"\n'}), [])


class Citations(Tree):
    def test_an_unknown_key(self):
        self.assert_refused("citations", {"vision/flow.cpp": "\n// [Nobody1999] eq. (1)\n"},
                            "vision/flow.cpp:2:", "[Nobody1999] is not in REFERENCES.md")

    def test_a_key_without_its_place(self):
        self.assert_refused("citations", {"vision/flow.cpp": "// as in [Garratt2009]; see there\n"}, "needs its place")

    def test_a_place_without_its_number(self):
        self.assert_refused("citations", {"vision/flow.cpp": "// [Garratt2009] sec.\n"}, "needs its place")

    def test_places_in_words_where_nothing_is_numbered(self):
        for place in ('sec. "Hover"', "sec. on hover", "table of\n/// parameters", "\n/// eqs. (2)-(3)"):
            self.assertEqual(self.faults("citations", {"vision/flow.cpp": f"/// [Garratt2009] {place}\n"}), [], place)

    def test_credit_for_an_idea_needs_no_place(self):
        self.assertEqual(self.faults("citations", {"vision/flow.cpp": "// iterated after [Garratt2009]\n"}), [])

    def test_a_key_listed_twice(self):
        twice = GOOD_TREE["REFERENCES.md"] * 2
        self.assert_refused("citations", {"REFERENCES.md": twice}, "listed twice")

    def test_configs_are_read_too(self):
        self.assert_refused("citations", {"configs/a.yaml": "gain: 4.0  # [Nobody1999] table 1\n"}, "configs/a.yaml:1:")

    def test_array_subscripts_are_no_citations(self):
        self.assertEqual(self.faults("citations", {"vision/flow.cpp": "int a = b[kCount2] + c[2009];\n"}), [])


class Format(Tree):
    def test_a_line_that_clang_format_would_change(self):
        self.assert_refused("format", {"vision/flow.cpp": "int  flow( ){return 1;}\n"}, "vision/flow.cpp:1:", "--fix")


class Length(Tree):
    def test_a_long_file_is_warned_of_but_not_refused(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(self.faults("length", {"vision/flow.cpp": "// line\n" * 301}), [])
        self.assertIn("vision/flow.cpp:1: warning: 301 lines", said.getvalue())


class Folders(Tree):
    def test_a_folder_without_a_subject(self):
        self.assert_refused("folders", {"vision/utils/x.h": "#pragma once\n"}, "vision/utils:1:", "names no subject")


class Sources(Tree):
    def test_a_source_that_is_not_listed(self):
        self.assert_refused("sources", {"vision/stereo.cpp": "\n"}, "vision/stereo.cpp:1:", "no CMakeLists.txt lists it")

    def test_a_header_may_be_private(self):
        self.assertEqual(self.faults("sources", {"vision/stereo.h": "\n"}), [])

    def test_a_listed_source_that_is_missing(self):
        self.assert_refused("sources", {"avoidance/CMakeLists.txt": "hedgehop_library(avoidance HDRS steer.h SRCS gone.cpp)\n"},
                            "avoidance/CMakeLists.txt:1:", "avoidance/gone.cpp does not exist")

    def test_a_source_in_a_comment_is_not_listed(self):
        self.assert_refused("sources", {"vision/CMakeLists.txt": "# flow.cpp\n"}, "vision/flow.cpp:1:")


class CommandLine(Tree):
    def test_an_unknown_rule(self):
        with self.assertRaises(SystemExit) as stop, contextlib.redirect_stderr(io.StringIO()):
            style.main(["elegance"])
        self.assertEqual(stop.exception.code, 2)


if __name__ == "__main__":
    unittest.main()
