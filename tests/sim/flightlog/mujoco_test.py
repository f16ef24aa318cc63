"""Flights of one rigid body by MuJoCo, replayed by `hedgehop compare-log` over 10 s.

usage: mujoco_test.py PROGRAM SOURCE

The environment variable HEDGEHOP_MUJOCO names the folder in which `npm install @mujoco/mujoco` was called; without it, the
test is skipped.
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
FOLDER = os.environ.get("HEDGEHOP_MUJOCO", "")
NODE = shutil.which("node")
PRESENT = bool(NODE and FOLDER and (pathlib.Path(FOLDER) / "node_modules/@mujoco/mujoco").is_dir())
DRAG = {"free": [0.0, 0.0, 0.0], "spin": [0.0, 0.0, 0.0], "flip": [0.0, 0.0, 0.0], "drag": [0.02, 0.03, 0.05]}
MAX_M, MAX_RAD = 1e-6, 1e-6


@unittest.skipUnless(PRESENT, "HEDGEHOP_MUJOCO names no folder with the npm package @mujoco/mujoco")
class MuJoCo(unittest.TestCase):
    def test_positions_and_attitudes_agree_after_ten_seconds(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "map.yaml").write_text("axes: flu\nwarm_up: 0\n")
            for case, drag in DRAG.items():
                (folder / "body.yaml").write_text(f"use: {SOURCE}/configs/vehicles/hummingbird.yaml\n"
                                                  f"mass: {{mass: 0.7, inertia: [0.007, 0.009, 0.012]}}\nbody_drag: {drag}\n")
                subprocess.run([NODE, SOURCE / "tests/sim/flightlog/mujoco_flight.mjs", FOLDER, case, folder / "log.csv"],
                               check=True)
                done = subprocess.run([PROGRAM, "compare-log", folder / "body.yaml", folder / "log.csv", "--columns",
                                       folder / "map.yaml", "--horizon", "10", "--every", "60", "--json"],
                                      check=True, capture_output=True, text=True)
                row = json.loads(done.stdout)["horizons"][0]
                position_m = row["rmse"]["position"]["model"]
                attitude_rad = math.radians(row["rmse"]["attitude"]["model"])
                print(f"{case}: {row['windows']} windows, position {position_m:.2g} m, attitude {attitude_rad:.2g} rad")
                self.assertEqual(row["windows"], 2)
                self.assertLess(position_m, MAX_M, case)
                self.assertLess(attitude_rad, MAX_RAD, case)
                self.assertGreater(row["rmse"]["position"]["unchanged"], 10.0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
