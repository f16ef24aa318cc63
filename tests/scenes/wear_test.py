"""Compares places of a city with the eyes of a structure-from-motion tool: SIFT features and homographies of OpenCV.

    wear_test.py PROGRAM SOURCE_FOLDER
"""

import itertools
import pathlib
import subprocess
import sys
import tempfile
import unittest

import cv2

PROGRAM, SOURCE = sys.argv[1:3]
SCENARIO = f"""
name: places
duration: 1
scene: {{type: TYPE, texture_size: 512, wear: WEAR}}
vehicle: {{use: {SOURCE}/configs/vehicles/electric_helicopter_8kg.yaml}}
drawing: {{renderer: tiles}}
rig:
  cameras:
    - {{role: eye, width: 320, height: 240, fov: FOV, rate: 50, channel: grey, PITCH}}
velocimeter: {{enabled: false}}
start: {{north: 0, east: 0, altitude: 10}}
goal: {{north: 0, east: 0, altitude: 10}}
avoidance: {{module: go_to_goal}}
may_collide: true
"""


def common_features(first, second):
    """Returns the number of features of two images that one homography relates: those of one place, or of two alike."""
    sift, matcher = cv2.SIFT_create(), cv2.BFMatcher()
    (points_a, features_a), (points_b, features_b) = (sift.detectAndCompute(image, None) for image in (first, second))
    pairs = matcher.knnMatch(features_a, features_b, k=2)
    good = [a for a, b in pairs if a.distance < 0.8 * b.distance]
    if len(good) < 4:
        return 0
    corners = [cv2.KeyPoint_convert(points, [getattr(m, index) for m in good])
               for points, index in ((points_a, "queryIdx"), (points_b, "trainIdx"))]
    _, inliers = cv2.findHomography(corners[0], corners[1], cv2.RANSAC, 3.0, maxIters=2000, confidence=0.999)
    return 0 if inliers is None else int(inliers.sum())


class Places(unittest.TestCase):
    def most_alike(self, scene, wear, fov, pitch, places):
        """Returns the largest number of common features of two places."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            text = SCENARIO.replace("TYPE", scene).replace("WEAR", wear).replace("PITCH", pitch).replace("FOV", str(fov))
            (folder / "places.yaml").write_text(text)
            images = []
            for north, east, altitude, heading in places:
                image = folder / f"{len(images)}.png"
                where = [f"start.north={north}", f"start.east={east}", f"start.altitude={altitude}",
                         f"start.heading={heading}"]
                options = [word for key in where for word in ("--set", key)]
                done = subprocess.run([PROGRAM, "render", folder / "places.yaml", "--camera", "eye", "-o", image, *options],
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                images.append(cv2.imread(str(image), cv2.IMREAD_GRAYSCALE))
        return max(common_features(a, b) for a, b in itertools.combinations(images, 2))

    def compare(self, scene, *view):
        """Places of a scene with wear have far fewer features in common than places without."""
        plain, worn = (self.most_alike(scene, wear, *view) for wear in ("false", "true"))
        self.assertGreater(plain, 40)
        self.assertLess(worn, 0.6 * plain)

    def test_streets_from_above(self):
        self.compare("urban", 60, "pitch: -90", [(north, east, 9, 0) for north in (-45, -15, 15, 45) for east in (0, 30)])

    def test_facades_from_a_street(self):
        self.compare("urban", 100, "pitch: 0", [(north, 0, 12, heading) for north in (-45, -15, 15, 45) for heading in (90, -90)])

    def test_the_road_of_a_park(self):
        self.compare("park", 60, "pitch: -90", [(north, 0, 6, 0) for north in (-24, -16, -8, 0, 8, 16)])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
