"""Feeds scripts/style small trees that break one rule each, and one that breaks none."""

import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import re
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]


def load_style():
    loader = importlib.machinery.SourceFileLoader("style", str(ROOT / "scripts" / "style"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("style", loader))
    loader.exec_module(module)
    return module


style = load_style()

GOOD_TREE = {
    "CMakeLists.txt": 'set(HEDGEHOP_LAYERS\n    "vision:"\n    "avoidance: vision"\n    "sim/loop:")\n',
    "vision/CMakeLists.txt": "hedgehop_library(vision\n  HDRS flow.h\n  SRCS flow.cpp ${CMAKE_CURRENT_BINARY_DIR}/made.cpp)\n",
    "vision/flow.h": "#pragma once\n\n/// Mean flow: [Garratt2009] eq. (2).\nint flow();\n",
    "vision/flow.cpp": '#include "vision/flow.h"\n\n#include <opencv2/core.hpp>\n\n// [Garratt2009]\n// sec. 3\nint flow() { return 1; }\n',
    "avoidance/CMakeLists.txt": "hedgehop_library(avoidance HDRS steer.h)\n",
    "avoidance/steer.h": '#pragma once\n\n#include "vision/flow.h"\n',
    "REFERENCES.md": "- **[Garratt2009]** A. Author: A title, 2009.\n- **[Shah2009]** B. Author: A thesis, 2009.\n\n"
                     "| paper | equations | figures | tables |\n|---|---|---|---|\n"
                     "| Garratt2009 | 4 | 7 | |\n| Shah2009 | 4.24 | 4.6, 5.1 | 4.1 |\n",
    "CONTRIBUTING.md": "# Rules\n\n## Frames\n\n| letter | kind | meaning | only in |\n|---|---|---|---|\n"
                       "| `W` | frame | world | |\n| `C` | frame | camera | |\n| `Cr` | frame | right camera | |\n"
                       "| `L` | frame | light | `sim/render` |\n| `NE` | frame | plan | |\n| `P` | point | any | |\n\n## Next\n",
    "sim/render/sun.h": "#pragma once\n",
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

    def test_an_include_of_a_header_that_cmake_writes(self):
        changes = {"avoidance/steer.h": '#include "vision/identity.h"\n', "cmake/Identity.cmake": "set(x ${B}/generated/vision/identity.h)\n"}
        self.assertEqual(self.faults("layers", changes), [])

    def test_a_row_that_looks_down(self):
        table = 'set(HEDGEHOP_LAYERS\n    "vision: avoidance"\n    "avoidance: vision")\n'
        self.assert_refused("layers", {"CMakeLists.txt": table, "vision/flow.h": '#include "avoidance/steer.h"\n'},
                            "is not above it")

    def test_a_row_that_permits_what_no_file_includes(self):
        table = 'set(HEDGEHOP_LAYERS\n    "vision:"\n    "avoidance: vision"\n    "sim/loop: vision")\n'
        self.assert_refused("layers", {"CMakeLists.txt": table}, "sim/loop may use vision, but does not include it")

    def test_yaml_outside_the_scenario_room(self):
        self.assert_refused("layers", {"sim/loop/x.h": "#include <yaml-cpp/yaml.h>\n"}, "belongs into sim/config")

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
        twice = GOOD_TREE["REFERENCES.md"] + "- **[Garratt2009]** again\n"
        self.assert_refused("citations", {"REFERENCES.md": twice}, "listed twice")

    def test_a_figure_that_the_paper_does_not_have(self):
        self.assert_refused("citations", {"vision/flow.cpp": "\n// [Garratt2009] fig. 8\n"},
                            "vision/flow.cpp:2:", "[Garratt2009] has no fig. 8; its highest of figures: 7")

    def test_an_equation_that_the_paper_does_not_have_behind_one_that_it_has(self):
        for place in ("eq. (3) to (5)", "eq. (4) and eq. (5)", "fig. 7, eq. (5)", "eqs. (4)\n/// and (5)", "eq. (0)"):
            self.assert_refused("citations", {"vision/flow.cpp": f"/// [Garratt2009] {place}\n"}, "[Garratt2009] has no eq")

    def test_a_table_of_a_paper_without_tables(self):
        self.assert_refused("citations", {"vision/flow.cpp": "// [Garratt2009] table 1\n"}, "has no table 1", "none")

    def test_numbers_by_chapter(self):
        self.assert_refused("citations", {"vision/flow.cpp": "// [Shah2009] fig. 4.6 and fig. 5.2\n"}, "has no fig. 5.2")
        self.assert_refused("citations", {"vision/flow.cpp": "// [Shah2009] eq. (3.1)\n"}, "has no eq. 3.1")
        self.assertEqual(self.faults("citations", {"vision/flow.cpp": "// [Shah2009] eq. (4.24), fig. 4.2 and table 4.1\n"}), [])

    def test_documents_are_read_too(self):
        self.assert_refused("citations", {"docs/a.md": "See [Garratt2009] fig. 9.\n"}, "docs/a.md:1:", "has no fig. 9")

    def test_configs_are_read_too(self):
        self.assert_refused("citations", {"configs/a.yaml": "gain: 4.0  # [Nobody1999] table 1\n"}, "configs/a.yaml:1:")

    def test_array_subscripts_are_no_citations(self):
        self.assertEqual(self.faults("citations", {"vision/flow.cpp": "int a = b[kCount2] + c[2009];\n"}), [])


class Includes(Tree):
    def test_a_name_without_its_header(self):
        self.assert_refused("includes", {"vision/flow.h": "#include <vector>\nstd::vector<std::string> names();\n"},
                            "vision/flow.h:2: std::string needs #include <string>")

    def test_a_header_of_the_project_may_include_it(self):
        self.assertEqual(self.faults("includes", {"vision/names.h": "#include <string>\n",
                                                  "vision/flow.h": '#include "vision/names.h"\nstd::string name();\n'}), [])


class Constants(Tree):
    def test_a_unit_behind_an_underscore(self):
        for name in ("kGravity_mps2", "kRange_m", "kMax_Range"):
            self.assert_refused("constants", {"vision/flow.cpp": f"constexpr double {name} = 1.0;\n"},
                                "vision/flow.cpp:1:", name, "kGravityMps2")

    def test_names_of_the_form_kNameUnit(self):
        self.assertEqual(self.faults("constants", {"vision/flow.cpp": "constexpr double kGravityMps2 = 9.8, k = 1.0;\n"}), [])


class Frames(Tree):
    def test_a_letter_that_is_not_declared(self):
        for name, letter in (("p_WQ", "Q"), ("v_QC_C", "Q"), ("X_WC_Q", "Q"), ("draw_q_QW", "Q"), ("w_WC_Q", "Q"),
                             ("R_CxW", "Cx")):
            self.assert_refused("frames", {"vision/flow.cpp": f"\nint {name};\n"},
                                "vision/flow.cpp:2:", name, f"frame {letter} is not declared")

    def test_a_letter_outside_its_folders(self):
        self.assert_refused("frames", {"vision/flow.cpp": "int R_LW;\n"}, "R_LW: L has its meaning only in sim/render")
        self.assertEqual(self.faults("frames", {"sim/render/sun.h": "int R_LW;\n"}), [])

    def test_a_point_that_is_used_as_a_frame(self):
        self.assert_refused("frames", {"vision/flow.cpp": "int X_WP;\n"}, "X_WP: P is a point and has no axes")

    def test_declared_frames_points_and_pairs(self):
        for name in ("p_WC", "v_WC_C", "X_CCr", "p_CrP_W", "p_NE", "X_WC_est", "p_CP_m", "sp_pool", "x_T", "e_p_W"):
            self.assertEqual(self.faults("frames", {"vision/flow.cpp": f"int {name};\n"}), [], name)

    def test_texts_are_no_names(self):
        self.assertEqual(self.faults("frames", {"vision/flow.cpp": 'auto a = "p_RS_R";\n'}), [])


class Paths(Tree):
    def test_a_file_that_is_gone(self):
        self.assert_refused("paths", {"docs/a.md": "\nSee `vision/gone.h`.\n"}, "docs/a.md:2:", "`vision/gone.h` does not exist")

    def test_one_of_two_files(self):
        self.assert_refused("paths", {"docs/a.md": "See `avoidance/steer.{h,cpp}`.\n"}, "`avoidance/steer.cpp` does not exist")

    def test_files_folders_and_patterns_that_are_there(self):
        text = "`vision/flow.{h,cpp}`, `vision/`, `avoidance/steer.h`, `vision/*.h`, `sim/loop/NAME: no path`\n"
        self.assertEqual(self.faults("paths", {"docs/a.md": text}), [])


class Hashes(Tree):
    def test_a_build_hash_in_a_page(self):
        self.assert_refused("hashes", {"docs/a.md": "# A\n\nFlown by build `0123456789abcdef`.\n"},
                            "docs/a.md:3:", "build hash 0123456789abcdef", "an earlier build")

    def test_a_build_hash_after_a_generated_table(self):
        text = "<!-- figures: local_map -->\nbuild `0123456789abcdef`\n<!-- end -->\nbuild `fedcba9876543210`\n"
        self.assert_refused("hashes", {"docs/a.md": text}, "docs/a.md:4:", "fedcba9876543210")

    def test_generated_tables_may_have_them(self):
        table = "<!-- figures: local_map -->\nbuild `0123456789abcdef`\n<!-- end -->\n"
        self.assertEqual(self.faults("hashes", {"docs/a.md": table, "docs/results.md": "| 0123456789abcdef |\n"}), [])

    def test_other_numbers_are_no_build_hashes(self):
        text = "0123456789012345, SHA-256 " + "0123456789abcdef" * 4 + ", commit 1be1724, face1234\n"
        self.assertEqual(self.faults("hashes", {"docs/a.md": text}), [])


class Words(Tree):
    def test_each_word_in_text_and_in_names(self):
        for text in ("the picture of a camera", "draws it anew", "int nearness_m;", "two are astray", "it hangs on z", "Of no use.",
                     "what it believes", "int spoiled;"):
            self.assert_refused("words", {"docs/a.md": f"\n{text}\n"}, "docs/a.md:2:", ": write ")

    def test_the_message_names_the_word_of_the_field(self):
        self.assert_refused("words", {"configs/a.yaml": "# One picture.\n"}, '"picture": write image')

    def test_parts_of_other_words(self):
        self.assertEqual(self.faults("words", {"docs/a.md": "manewood, pictured, unbelieved\n"}), [])


class Pending(Tree):
    def test_faults_in_pending_files_are_warnings(self):
        said = io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(said):
            root = pathlib.Path(folder)
            for name in ("vision/a.h", "visions/a.h"):
                (root / name).parent.mkdir()
                (root / name).write_text("// drawn anew\n")
            with unittest.mock.patch.dict(style.PENDING, {"words": ["vision"]}):
                faults = style.faults_of("words", root)
        self.assertEqual([str(fault.path) for fault in faults], ["visions/a.h"])
        self.assertIn("vision/a.h:1: warning:", said.getvalue())


class Format(Tree):
    def test_a_line_that_clang_format_would_change(self):
        if not style.formatter():
            self.skipTest(f"clang-format {style.CLANG_FORMAT_VERSION} is not installed")
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
    def test_ctest_runs_every_rule(self):
        text = (ROOT / "tests/style/CMakeLists.txt").read_text()
        listed = re.search(r"foreach\(rule ([^)]*)\)", text)[1].split()
        self.assertEqual(sorted(listed), sorted(style.RULES))

    def test_an_unknown_rule(self):
        with self.assertRaises(SystemExit) as stop, contextlib.redirect_stderr(io.StringIO()):
            style.main(["elegance"])
        self.assertEqual(stop.exception.code, 2)


if __name__ == "__main__":
    unittest.main()
