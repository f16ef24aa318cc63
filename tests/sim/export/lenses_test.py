"""Exports a flight with wide lenses to EuRoC, and reads the calibration of the export back.

    lenses_test.py PROGRAM SOURCE_FOLDER
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PROGRAM, SOURCE = sys.argv[1:3]
WORLD = f"{SOURCE}/configs/worlds/wall.yaml"
CHAIN = f"{SOURCE}/configs/calibrations/kalibr_wide.yaml"


def hedgehop(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def numbers(text, key):
    """The numbers of a list, or of a list of rows below the key."""
    listed = re.search(rf"{key}:((?:[^\n]*\n\s+-)*[^\n]*)", text)[1]
    return [float(word) for word in re.findall(r"-?\d[\d.e+-]*", listed)]


class Lenses(unittest.TestCase):
    def test_the_lens_and_pose_of_an_export_are_those_of_the_chain(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for entry, model in (("cam0", "omni"), ("cam1", "ds")):
                def camera(file):
                    return f"rig.cameras.0={{role: front, rate: 10, channel: grey, calibration: {file}}}"

                hedgehop("run", WORLD, "--set", camera(f"{CHAIN}, calibration_camera: {entry}"), "--set", "duration=0.3",
                         "--renderer", "tiles", "--no-video", "--no-report", "--out", folder / model)
                hedgehop("export", folder / model, "--format", "euroc", "--camera", "front", "--out", folder / f"{model}-euroc")
                sensor = folder / f"{model}-euroc/mav0/cam0/sensor.yaml"
                self.assertIn(f"camera_model: {model}\n", sensor.read_text())
                chains = [hedgehop("calibration", WORLD, "--set", camera(file), "--camera", "front", "--format", "kalibr")
                          for file in (f"{CHAIN}, calibration_camera: {entry}", sensor)]
                for key in ("intrinsics", "distortion_coeffs"):
                    self.assertGreaterEqual(len(numbers(chains[0], "intrinsics")), 5)
                    self.assertEqual(numbers(chains[0], key), numbers(chains[1], key))
                np.testing.assert_allclose(numbers(chains[0], "T_cam_imu"), numbers(chains[1], "T_cam_imu"), atol=1e-12)
                self.assertEqual(len(numbers(chains[0], "T_cam_imu")), 16)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
