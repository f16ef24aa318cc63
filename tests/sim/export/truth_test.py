"""Compares the exported ground truth with the exported poses: depth projected into the next image gives the flow.

    truth_test.py PROGRAM
"""

import json
import pathlib
import sys
import tempfile
import unittest

import cv2
import numpy as np

from euroc import START_NS
from read_back_test import SCENARIO, Euroc, hedgehop, pose

CHANGES = ("duration=0.6", "scene.texture_size=64", "scene.movers=[{name: ball, shape: balloon, radius: 1, height: 3, "
           "motion: {type: orbit, north: 0, east: 0, radius: 2, speed: 1}}]")


class Truth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.temporary.name)
        changes = [word for change in CHANGES for word in ("--set", change)]
        flown = hedgehop("run", SCENARIO, *changes, "--out", folder / "run", "--no-video", "--no-report")
        assert flown.returncode in (0, 1), flown.stdout + flown.stderr
        done = hedgehop("export", folder / "run", "--format", "euroc", "--camera", "down", "--truth")
        assert done.returncode == 0, done.stderr
        done = hedgehop("export", folder / "run", "--format", "euroc", "--camera", "left", "--truth", "--float-depth",
                        "--out", folder / "far")
        assert done.returncode == 0, done.stderr
        cls.folder = folder
        cls.far = Euroc(folder / "far")
        cls.table = json.loads((folder / "far/truth/labels.json").read_text())
        cls.data = Euroc(folder / "run/euroc")
        cls.root = folder / "run/euroc/truth/cam0"
        cls.times = sorted(cls.data.images("cam0"))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def read(self, what, t_ns):
        return cv2.imread(str(self.root / what / f"{START_NS + t_ns}.png"), cv2.IMREAD_UNCHANGED)

    def test_every_image_has_its_truth(self):
        for what in ("depth", "labels", "semantic", "moving", "flow"):
            names = sorted(int(file.stem) - START_NS for file in (self.root / what).iterdir())
            self.assertEqual(names, self.times[:-1] if what == "flow" else self.times)
        self.assertEqual(self.read("depth", self.times[0]).dtype, np.uint16)
        self.assertEqual(self.read("moving", self.times[0]).dtype, np.uint8)

    def test_moving_mask_shows_the_ball_below(self):
        moving = self.read("moving", self.times[5]) == 255
        labels = self.read("labels", self.times[5])
        self.assertGreater(moving.sum(), 100)
        self.assertEqual(len(np.unique(labels[moving])), 1)
        self.assertFalse(np.isin(labels[~moving], labels[moving]).any())
        # Its top is about 2 m below the camera, the ground about 6 m.
        depth = self.read("depth", self.times[5])
        self.assertLess(np.median(depth[moving]), 3500)
        self.assertGreater(np.median(depth[~moving]), 4500)

    def test_classes_are_those_of_the_labels(self):
        self.assertEqual(self.table, json.loads((self.root.parent / "labels.json").read_text()))
        self.assertEqual([row["id"] for row in self.table["instances"]], list(range(1, 1 + len(self.table["instances"]))))
        rows = [{"name": "sky", "class": "sky"}, *self.table["instances"]]
        classes = np.array([self.table["classes"][row["class"]] for row in rows])
        seen = set()
        for t_ns in self.times:
            labels = self.read("labels", t_ns)
            np.testing.assert_array_equal(classes[labels], self.read("semantic", t_ns))
            seen.update(rows[label]["name"] for label in np.unique(labels))
        self.assertLessEqual({"ground", "ball"}, seen)

    def read_far(self, what, t_ns, ending):
        return cv2.imread(str(self.folder / "far/truth/cam0" / what / f"{START_NS + t_ns}.{ending}"), cv2.IMREAD_UNCHANGED)

    def test_float_depth_of_the_ground_is_that_of_a_plane(self):
        K, X_FC = self.far.camera("cam0")
        farthest = 0.0
        for t_ns in self.far.images("cam0"):
            p, R, *_ = self.far.state(t_ns)
            X_EC = pose(R, p) @ X_FC
            z = self.read_far("depth", t_ns, "tiff")
            self.assertEqual(z.dtype, np.float32)
            classes = self.read_far("semantic", t_ns, "png")
            np.testing.assert_array_equal(np.isinf(z), classes == 0)
            rows, cols = np.nonzero(classes == self.table["classes"]["ground"])
            rays = X_EC[:3, :3] @ np.linalg.inv(K) @ np.array([cols, rows, np.ones_like(rows)])
            expected = -X_EC[2, 3] / rays[2]
            compared = expected < 1000  # a rounded pose moves points near the horizon
            np.testing.assert_allclose(z[rows, cols][compared], expected[compared], rtol=1e-3)
            farthest = max(farthest, expected[compared].max())
        self.assertGreater(farthest, 100.0)  # beyond 16 bits of millimeters

    def test_rendered_truth_equals_the_exported_one(self):
        t_ns = sorted(self.far.images("cam0"))[-1]
        for what, folder, ending in (("depth_m", "depth", "tiff"), ("labels", "labels", "png"), ("semantic", "semantic", "png")):
            file = self.folder / f"{what}.{ending}"
            done = hedgehop("render", self.folder / "run/scenario.yaml", "--camera", "left", "--what", what, "--time",
                            1e-9 * t_ns, "-o", file)
            self.assertEqual(done.returncode, 0, done.stderr)
            np.testing.assert_array_equal(cv2.imread(str(file), cv2.IMREAD_UNCHANGED), self.read_far(folder, t_ns, ending))
        self.assertEqual(self.table, json.loads((self.folder / "labels.json").read_text()))

    def test_flow_equals_that_from_depth_and_poses(self):
        K, X_FC = self.data.camera("cam0")
        off = []
        for now, then in list(zip(self.times, self.times[1:]))[3:]:
            X_EC = [pose(R, p) @ X_FC for p, R, *_ in (self.data.state(now), self.data.state(then))]
            z = self.read("depth", now) / 1000.0
            flow = self.read("flow", now)[:, :, ::-1].astype(float)  # OpenCV's order is blue, green, red
            known = (flow[:, :, 2] == 1) & (z > 0) & (self.read("moving", now) == 0)
            rows, cols = np.nonzero(known)
            rays = np.linalg.inv(K) @ np.array([cols, rows, np.ones_like(rows)])
            points = np.vstack([rays * z[rows, cols], np.ones(len(rows))])
            u, v, w = K @ (np.linalg.inv(X_EC[1]) @ X_EC[0] @ points)[:3]
            wanted = np.array([u / w - cols, v / w - rows])
            measured = (flow[rows, cols, :2].T - 32768) / 64
            off.append(np.abs(wanted - measured).max(axis=0))
        off = np.concatenate(off)
        self.assertLess(np.median(off), 0.02)  # half a unit of flow is 0.008 px
        self.assertLess(np.quantile(off, 0.99), 0.05)

    def test_flow_of_kitti_leads_to_the_next_image_over_omitted_instants(self):
        changes = ("duration=1.5", "scene.texture_size=64", "rig.stereo.0.imperfections.drop=0.3")
        flown = hedgehop("run", SCENARIO, *[word for change in changes for word in ("--set", change)], "--out",
                         self.folder / "lossy", "--no-video", "--no-report")
        self.assertIn(flown.returncode, (0, 1), flown.stderr)
        done = hedgehop("export", self.folder / "lossy", "--format", "kitti", "--truth", "--camera", "left", "--camera", "right")
        self.assertEqual(done.returncode, 0, done.stderr)
        root = self.folder / "lossy/kitti"
        times = np.loadtxt(root / "sequences/00/times.txt")
        self.assertGreater(np.diff(times).max(), 0.15)  # the period is 0.1 s
        P = [np.array(line.split()[1:], float).reshape(3, 4) for line in (root / "sequences/00/calib.txt").read_text().splitlines()[:2]]
        poses = [np.vstack([row.reshape(3, 4), [0, 0, 0, 1]]) for row in np.loadtxt(root / "poses/00.txt")]
        for camera, right in ((0, 0.0), (1, 0.4)):
            X_C0C = np.eye(4)
            X_C0C[0, 3] = right
            np.testing.assert_allclose(P[camera], P[0] @ np.linalg.inv(X_C0C), atol=1e-6)
            for number, (now, then) in enumerate(zip(poses, poses[1:])):
                z, flow = (cv2.imread(str(root / f"truth/cam{camera}/{what}/{number:06}.png"), cv2.IMREAD_UNCHANGED)
                           for what in ("depth", "flow"))
                rows, cols = np.nonzero((flow[:, :, 0] == 1) & (z > 0))  # OpenCV's order is blue, green, red
                points = np.linalg.inv(P[0][:, :3]) @ np.array([cols, rows, np.ones_like(rows)]) * (z[rows, cols] / 1000.0)
                X = np.linalg.inv(then @ X_C0C) @ now @ X_C0C
                u, v, w = P[0] @ X @ np.vstack([points, np.ones(len(rows))])
                measured = (flow[rows, cols, :0:-1].T.astype(float) - 32768) / 64
                off = np.abs(np.array([u / w - cols, v / w - rows]) - measured).max(axis=0)
                self.assertLess(np.median(off), 0.02, (camera, number, times))

    def test_options_without_effect_on_a_log_print_a_line(self):
        cases = (("ulog", ["--truth"], ["--truth"]), ("ulog", ["--truth", "--float-depth"], ["--truth", "--float-depth"]),
                 ("mcap", ["--truth", "--float-depth"], ["--float-depth"]), ("mcap", ["--truth"], []))
        for number, (name, options, ignored) in enumerate(cases):
            done = hedgehop("export", self.folder / "run", "--format", name, "--camera", "down", *options,
                            "--out", self.folder / f"log{number}")
            self.assertEqual(done.returncode, 0, done.stderr)
            words = [line.split()[1] for line in done.stderr.splitlines() if line.startswith("warning: --")]
            self.assertEqual(words, ignored, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
