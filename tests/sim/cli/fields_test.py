"""scripts/fields: the sample of a synthetic list, flights that `hedgehop validate` accepts, and tables of made-up results.
scripts/validation: the table of made-up failure searches.

usage: fields_test.py PROGRAM SOURCE
"""

import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
BOXES = "simulation:\n  obstacles:\n  - size: {{l: 4, w: 4, h: 10}}\n    position: {{x: {x}, y: {y}, z: 0, r: 30}}\n"


class Fields(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)
        (self.folder / "tests").mkdir()
        for name, x, y in (("m1_test_0", 2, 20), ("m1_test_1", 5, 25), ("m2_test_0", -3, 30)):
            (self.folder / "tests" / f"{name}.yaml").write_text(BOXES.format(x=x, y=y))
        # The script writes into its own source tree.
        for part in ("scripts/fields", "scripts/free_way.py", "scripts/generated_tables.py", "scripts/validation", "configs", "docs/validation.md"):
            copy, whole = self.folder / "source" / part, SOURCE / part
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copytree(whole, copy) if whole.is_dir() else shutil.copy(whole, copy)

    def fields(self, *words, status=0):
        return self.script("fields", *words, status=status)

    def script(self, name, *words, status=0):
        done = subprocess.run([sys.executable, self.folder / "source/scripts" / name, *words], cwd=self.folder, capture_output=True,
                              text=True, env={**os.environ, "HEDGEHOP": str(PROGRAM)})
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_every_module_flies_the_listed_fields_at_every_speed(self):
        (self.folder / "list.yaml").write_text("fields: [{name: m1_test_1}, {name: m2_test_0}]\n")
        self.fields("prepare", "out", "--aerialist", "tests", "--sample", "list.yaml", "--modules", "all", "--speeds", "3,10", "--seeds", "24001:24005")
        board = yaml.safe_load((self.folder / "out/campaign.yaml").read_text())["leaderboard"]
        self.assertEqual([world["name"] for world in board["worlds"]], ["m1_test_1", "m2_test_0"])
        names = [module["name"] for module in board["modules"]]
        with_speed = ["go_to_goal", "stereo_corridor", "flow_balance", "landmark_map", "local_map"]
        self.assertEqual(sorted(names), sorted([f"{name} {speed}" for name in with_speed for speed in (3, 10)] + ["section_grid own", "cloned_policy own"]))
        fast = next(module["set"] for module in board["modules"] if module["name"] == "local_map 10")
        self.assertIn("avoidance.speed=10", fast)
        self.assertEqual([item for item in fast if "speed_limit" in item], ["avionics.autopilot.speed_limit=10"])
        done = subprocess.run([PROGRAM, "validate", "out/campaign.yaml"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("120 flights of 24 scenarios", done.stdout)

    def test_a_missing_field_or_an_unknown_module_is_an_error(self):
        (self.folder / "list.yaml").write_text("fields: [{name: barn_world_3}]\n")
        self.assertIn("the folders lack barn_world_3", self.fields("prepare", "out", "--aerialist", "tests", "--sample", "list.yaml", status=1))
        self.assertIn("'zig_zag' is no module that flies to a goal; valid: all, go_to_goal, ",
                      self.fields("prepare", "out", "--aerialist", "tests", "--modules", "zig_zag", status=1))

    def test_a_folder_without_fields_is_an_error(self):
        (self.folder / "other").mkdir()
        for option, file in (("barn", "world_*.world"), ("agile", "easy|medium|hard/environment_*.csv"), ("competition", "static_obstacles.csv")):
            self.assertIn(f"--{option} other has no file {file}", self.fields("prepare", "out", "--aerialist", "tests", f"--{option}", "other", status=1))
        (self.folder / "other/static_obstacles.csv").touch()
        self.assertIn("--competition other has no file dynamic_obstacles.yaml\n", self.fields("prepare", "out", "--competition", "other", status=1))
        self.assertIn("no folder is given; valid: --aerialist, --barn, --agile, --competition", self.fields("prepare", "out", status=1))

    def test_files_that_cannot_be_read_are_no_traceback(self):
        (self.folder / "tests/m1_test_0.yaml").write_text("a: 1\n")
        text = self.fields("prepare", "out", "--aerialist", "tests", status=1)
        self.assertRegex(text, r"\A.*m1_test_0\.yaml:1:1: missing key 'simulation'\nscripts/fields: 'hedgehop import aerialist tests/m1_test_0.yaml' ended with exit status 2\n\Z")
        self.assertEqual(self.fields("prepare", "out", "--aerialist", "tests", "--sample", "absent.yaml", status=1), "scripts/fields: absent.yaml: No such file or directory\n")

    def test_sample_takes_the_median_of_each_stratum(self):
        (self.folder / "out").mkdir()
        with (self.folder / "out/fields.csv").open("w", newline="") as file:
            rows = csv.writer(file)
            rows.writerow(["field", "source", "density"])
            rows.writerows([f"barn_{k}", "barn", f"{(7 * k) % 27}.5"] for k in range(27))  # each density once
            rows.writerows([f"m{k}", "aerialist", f"0.{k}"] for k in range(4))
            for level in ("easy", "medium", "hard"):
                rows.writerows([f"{level}_{k}", f"flightmare {level}", k] for k in range(6))
            rows.writerow(["moving_field", "moving field", 28.9])
        self.fields("sample", "out")
        chosen = yaml.safe_load((self.folder / "source/configs/fields/sample.yaml").read_text())["fields"]
        self.assertEqual(len(chosen), 20)
        self.assertEqual([field["density"] for field in chosen if field["source"] == "barn"], [3 * k + 1.5 for k in range(9)])
        self.assertEqual([field["name"] for field in chosen if field["source"] == "flightmare hard"], ["hard_1", "hard_4"])
        self.assertEqual({field["of"] for field in chosen if field["source"] == "barn"}, {27})

    def test_a_way_exists_if_every_gap_is_wider_than_the_vehicle(self):
        sys.path.insert(0, str(SOURCE / "scripts"))
        from free_way import has_way

        def solid(shape, north, east, down, size, turn=(1, 0, 0, 0)):
            return dict(zip(("shape", "north_m", "east_m", "down_m", "qw", "qx", "qy", "qz", "size_x_m", "size_y_m", "size_z_m"),
                            (shape, north, east, down, *turn, *size)))

        def wall(gap, turn=(1, 0, 0, 0), size=(1, 100, 10)):  # across the way at 10 m north, with a gap in the middle
            return [solid("box", 10, side * (50 + gap / 2), -5, size, turn) for side in (-1, 1)]

        def way(rows, altitude=5):
            return has_way(rows, [(0, 0), (20, 0), (20, 10)], altitude, 3, 1.0)

        half = 0.5**0.5
        self.assertTrue(way([]))
        self.assertTrue(way(wall(2.8)))
        self.assertFalse(way(wall(1.9)))
        self.assertFalse(way(wall(1.9, (half, half, 0, 0), (1, 10, 100)), 4))  # the same walls, turned about north
        self.assertFalse(way(wall(0), 10.9))  # 0.9 m above the walls
        self.assertTrue(way(wall(0), 11.4))
        # A row of upright cylinders of 1.2 m, then of lying ones.
        self.assertTrue(way([solid("cylinder", 10, 4 * k, -4, (1.2, 1.2, 8)) for k in range(-20, 21)]))
        self.assertFalse(way([solid("cylinder", 10, 3.1 * k, -4, (1.2, 1.2, 8)) for k in range(-20, 21)]))
        self.assertFalse(way([solid("cylinder", 10, 4 * k, -4, (1.2, 1.2, 8), (half, half, 0, 0)) for k in range(-20, 21)]))
        self.assertFalse(way([solid("box", 0, 0, -5, (1, 1, 10))]))  # at the start

    def test_table_counts_success_by_density_source_and_speed(self):
        out = self.folder / "out"
        (out / "flights").mkdir(parents=True)
        (out / "fields.csv").write_text("field,source,density,way\nthin,barn,0.5,True\ndense,barn,4,False\nthick,barn,12,False\n")
        cells, rows = [], []
        for field, module, ends in (("thin", "local_map 3", ["reached"] * 9 + ["timeout"]), ("dense", "local_map 3", ["reached", "collided"]),
                                    ("dense", "section_grid own", ["timeout"]), ("thick", "section_grid own", ["timeout"])):
            cells.append({"group": f"{field}/{module}", "world": field, "module": module, "reason": ""})
            rows += [f"{field}/{module},flown,{end}" for end in ends]
        rows.append("dense/local_map 3,failed,failed")  # was not flown
        (out / "flights/leaderboard.json").write_text(json.dumps({"cells": cells}))
        (out / "flights/batch.csv").write_text("\n".join(["group,status,outcome", *rows]) + "\n")
        text = self.fields("table", "out")
        # Intervals of Wilson from a table: 9 of 10, 1 of 2, 10 of 12, 0 of 2.
        self.assertIn("| obstacles in 100 m² | module | 3 m/s | own speed |", text)
        self.assertIn("| 0 to 1 | local_map | 90 % (60 to 98) of 10 | - |", text)
        self.assertIn("| 3 to 10 | local_map | 50 % (9 to 91) of 2; 1 collided | - |", text)
        self.assertIn("| all | local_map | 83 % (55 to 95) of 12; 1 collided | - |", text)
        self.assertIn("| barn | section_grid | - | 0 % (0 to 66) of 2 |", text)
        self.assertIn("| static, with a way of 0.94 m | local_map | 90 % (60 to 98) of 10 | - |", text)
        self.assertEqual(re.findall(r"^\| (\d.*?|all) \| section_grid", text, re.M), ["3 to 10", "10 or more", "all"])
        self.assertIn("14 flights.", text)
        page, before = self.folder / "source/docs/validation.md", (SOURCE / "docs/validation.md").read_text()
        for _ in range(2):  # also over its own text
            self.fields("table", "out", "--write", "sample")
            parts = [re.fullmatch(r"(.*<!-- fields: sample -->\n)(.*?)(<!-- end -->.*)", whole, re.S) for whole in (before, page.read_text())]
            self.assertEqual(parts[0].group(1, 3), parts[1].group(1, 3))
            self.assertEqual(parts[1][2], text)

    def test_the_scores_of_a_module_are_added_over_its_missions(self):
        def score(failure, diversity):
            return {"failure_score": failure, "diversity_score": diversity}
        suites = [{"confirmed": 1, "tests": [{}] * 3, "of_confirmed": score(20.5, None), "of_all": score(31.25, 0.8)},
                  {"confirmed": 2, "tests": [{}] * 2, "of_confirmed": score(4.25, 0.5), "of_all": score(4.25, 0.5)}]
        for mission, suite in enumerate(suites, 1):
            folder = self.folder / f"searches/mission_{mission}_section_grid"
            folder.mkdir(parents=True)
            (folder / "falsify.json").write_text(json.dumps({"flights": 100, "failing_flights": 7, "suite": suite}))
        self.script("validation", "scores", "searches")
        text = (self.folder / "source/docs/validation.md").read_text()
        self.assertIn("| `section_grid` | 1 | 100 | 7 | 3 | 1 | 20.50 | - | 31.25 | 0.80 |\n", text)
        self.assertIn("| `section_grid` | sum | 200 | 14 | 5 | 3 | 24.75 | 0.50 | 35.50 | 1.30 |\n", text)
        (folder / "falsify.json").write_text(json.dumps({"flights": 40, "failing_flights": 7, "suite": None}))
        self.assertIn("mission_2_section_grid/falsify.json: the tests of this search are not flown", self.script("validation", "scores", "searches", status=1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
