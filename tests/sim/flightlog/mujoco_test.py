"""Flights of one rigid body by MuJoCo, replayed by `hedgehop compare-log` over 10 s.

usage: mujoco_test.py PROGRAM SOURCE NODE FLY.mjs
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE, NODE, FLY = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], sys.argv[4]
NO_DRAG = [0.0, 0.0, 0.0]
MAX_M, MAX_RAD = 1e-6, 1e-6


class MuJoCo(unittest.TestCase):
    def check(self, case, drag):
        """Flies the case by both programs and compares the ends of two windows of 10 s."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "map.yaml").write_text("axes: flu\nwarm_up: 0\n")
            (folder / "body.yaml").write_text(f"use: {SOURCE}/configs/vehicles/hummingbird.yaml\n"
                                              f"mass: {{mass: 0.7, inertia: [0.007, 0.009, 0.012]}}\nbody_drag: {drag}\n")
            subprocess.run([NODE, FLY, case, folder / "log.csv"], check=True)
            done = subprocess.run([PROGRAM, "compare-log", folder / "body.yaml", folder / "log.csv", "--columns",
                                   folder / "map.yaml", "--horizon", "10", "--every", "60", "--json"],
                                  check=True, capture_output=True, text=True)
        row = json.loads(done.stdout)["horizons"][0]
        position_m = row["rmse"]["position"]["model"]
        attitude_rad = math.radians(row["rmse"]["attitude"]["model"])
        print(f"{case}: {row['windows']} windows, position {position_m:.2g} m, attitude {attitude_rad:.2g} rad")
        self.assertEqual(row["windows"], 2)
        self.assertLess(position_m, MAX_M)
        self.assertLess(attitude_rad, MAX_RAD)
        self.assertGreater(row["rmse"]["position"]["unchanged"], 10.0)

    def test_a_thrown_body_tumbles_alike(self):
        self.check("free", NO_DRAG)

    def test_a_spinning_body_nutates_alike(self):
        self.check("spin", NO_DRAG)

    def test_a_body_about_its_middle_axis_flips_alike(self):
        self.check("flip", NO_DRAG)

    def test_drag_by_a_force_of_the_user_slows_alike(self):
        self.check("drag", [0.02, 0.03, 0.05])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
