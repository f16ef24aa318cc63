"""The tables that scripts write into pages: generated_tables_test.py SOURCE."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(sys.argv[1]) / "scripts"))
import city_sweep  # noqa: E402
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


COLUMNS = "start.heading,scene.pitch,scene.street_min_width,seed,build,renderer,status,outcome,metric.center_collision,metric.hull_collision\n"


class CitySweep(unittest.TestCase):
    def test_every_flight_is_counted_in_its_cell_and_a_missing_flight_leaves_the_table_unchanged(self):
        rows = [f"{heading},50,8,{seed},b1,tiles,flown,{outcome},{center},1" for heading in (0, 22.5, 45)
                for seed, outcome, center in ((1, "reached", 0), (2, "collided", 1), (3, "timeout", 0))]
        with tempfile.TemporaryDirectory() as name:
            out = pathlib.Path(name)
            for law in city_sweep.SWEEPS:
                (out / f"city_{law}").mkdir()
                (out / f"city_{law}/sweep.csv").write_text(COLUMNS + "\n".join(rows))
            sweeps = city_sweep.all_sweeps(out)
            self.assertIn("| 50 | 8 |" + " 1 (1, 3) |" * 7, city_sweep.table(sweeps))
            self.assertIn("| all | all |" + " 1 of 3 (1, 3) |" * 7, city_sweep.table(sweeps))
            self.assertEqual(city_sweep.figure(sweeps).count(">1 of 3<"), 6)
            for lost in ("missing,,", "flown,fault,"):
                (out / "city_control/sweep.csv").write_text(COLUMNS + "\n".join(rows + [f"0,50,8,4,b1,tiles,{lost},"]))
                self.assertEqual(city_sweep.all_sweeps(out), {})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
