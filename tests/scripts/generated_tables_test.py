"""The tables that scripts write into pages: generated_tables_test.py SOURCE."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(sys.argv[1]) / "scripts"))
from generated_tables import wilson, with_table  # noqa: E402

PAGE = "# A page\n<!-- figures: one -->\nold\n<!-- end -->\ntext\n<!-- fields: two -->\n<!-- end -->\n"


class GeneratedTables(unittest.TestCase):
    def test_only_the_named_table_changes(self):
        once = with_table(PAGE, "docs/page.md", "figures", "one", "new")
        self.assertEqual(once, PAGE.replace("old", "new"))
        self.assertEqual(with_table(once, "docs/page.md", "figures", "one", "new"), once)
        self.assertEqual(with_table(PAGE, "docs/page.md", "fields", "two", "new"), PAGE.replace("two -->\n", "two -->\nnew\n"))

    def test_a_page_without_both_markers_is_an_error(self):
        for page in ("", PAGE + PAGE, "<!-- figures: one -->\nold\n", "<!-- end -->\n<!-- figures: one -->\nold\n",
                     "<!-- figures: one -->\nold\n<!-- fields: two -->\n<!-- end -->\n"):
            with self.subTest(page), self.assertRaisesRegex(SystemExit, "docs/page.md must contain '<!-- figures: one -->' exactly once, followed by '<!-- end -->'"):
                with_table(page, "docs/page.md", "figures", "one", "new")

    def test_intervals_are_those_of_a_table(self):
        for count, total, low, high in ((0, 10, 0.0, 27.8), (9, 10, 59.6, 98.2), (5, 10, 23.7, 76.3)):
            for bound, expected in zip(wilson(count, total), (low, high)):
                self.assertAlmostEqual(bound, expected, 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
