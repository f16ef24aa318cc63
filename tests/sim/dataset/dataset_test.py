"""Data sets of `hedgehop dataset`, read with NumPy and OpenCV only.

    dataset_test.py PROGRAM SOURCE_FOLDER
"""

import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "export"))
from flown import rotation  # noqa: E402

PROGRAM, SOURCE = sys.argv[1:3]
CAMERA = ["--set", "rig.cameras.0.width=160", "--set", "rig.cameras.0.height=120"]
WORLD = f"{SOURCE}/configs/worlds/park.yaml"


def hedgehop(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def dataset(out, *options):
    return hedgehop("dataset", WORLD, *CAMERA, "--renderer", "tiles", "--out", out, *options)


def files(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*")) if file.is_file()}


def pose(row, prefix=""):
    X = np.eye(4)
    X[:3, :3] = rotation(*(float(row[prefix + k]) for k in ("qw", "qx", "qy", "qz")))
    X[:3, 3] = [float(row[prefix + k]) for k in ("north_m", "east_m", "down_m")]
    return X


class Dataset(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.out = cls.folder / "one"
        done = dataset(cls.out, "--seeds", "1:3", "--images", 7, "-j", 1)
        assert done.returncode == 0, done.stderr
        with open(cls.out / "manifest.csv") as text:
            cls.rows = list(csv.DictReader(text))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def read(self, row, channel, suffix="png"):
        file = self.out / row["split"] / channel / f"{row['image']}.{suffix}"
        image = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
        self.assertIsNotNone(image, file)
        return image

    def test_images_are_spread_over_worlds_and_worlds_over_splits(self):
        self.assertEqual([row["image"] for row in self.rows], [f"{i:06}" for i in range(7)])
        self.assertEqual([row["seed"] for row in self.rows], ["1", "1", "1", "2", "2", "3", "3"])
        split_of = {row["seed"]: row["split"] for row in self.rows}
        self.assertEqual(sorted(split_of.values()), ["test", "train", "val"])
        self.assertTrue(all(split_of[row["seed"]] == row["split"] for row in self.rows))

    def test_the_manifest_names_labels_and_calibration(self):
        self.assertEqual(list(self.rows[0])[-1], "file")
        self.assertEqual({row["scenario"] for row in self.rows}, {"world_park"})
        for row in self.rows:
            self.assertTrue((self.out / "labels" / f"{row['file']}-seed{row['seed']}.json").is_file(), row)
            self.assertTrue((self.out / "calibration" / f"{row['file']}.yaml").is_file(), row)

    def test_any_number_of_workers_and_any_interruption_give_the_same_bits(self):
        other = self.folder / "two"
        self.assertEqual(dataset(other, "--seeds", "1:3", "--images", 7, "-j", 2).returncode, 0)
        whole = files(self.out)
        self.assertEqual(files(other), whole)
        # As after a kill: one world is missing, another is half written.
        missing, half = (next(row for row in self.rows if row["split"] == split) for split in ("val", "train"))
        for row in (missing, half):
            (other / f"worlds/{int(row['seed']) - 1:06}.csv").unlink()
        shutil.rmtree(other / "val")
        (other / "train/color" / f"{half['image']}.png").write_bytes(b"half")
        for file in [*other.glob("manifest.csv"), *other.glob("coco_*.json")]:
            file.unlink()
        self.assertEqual(dataset(other, "--seeds", "1:3", "--images", 7).returncode, 2)
        done = dataset(other, "--seeds", "1:3", "--images", 7, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(files(other), whole)

    def test_a_changed_file_does_not_continue_a_data_set(self):
        scenario, out = self.folder / "changing.yaml", self.folder / "changed"
        scenario.write_text(f"use: {WORLD}\nname: changing\n")
        options = ["--seeds", "1:2", "--images", 2, "--channels", "depth", "--renderer", "tiles", "--out", out]
        self.assertEqual(hedgehop("dataset", scenario, *options).returncode, 0)
        self.assertEqual(hedgehop("dataset", scenario, *options, "--resume").returncode, 0)
        scenario.write_text(f"use: {WORLD}\nname: changing\nduration: 20\n")
        done = hedgehop("dataset", scenario, *options, "--resume")
        self.assertEqual(done.returncode, 2)
        self.assertIn("of other files", done.stderr)

    def test_the_calibration_is_that_of_any_lens(self):
        def camera(calibration):
            return ["--set", "rig.cameras.0={role: front, rate: 10, channel: color, calibration: " + f"{calibration}}}"]

        ocam = f"{SOURCE}/configs/calibrations/ocam_fisheye.txt"
        chain = f"{SOURCE}/configs/calibrations/kalibr_wide.yaml, calibration_camera: cam1"
        for number, (given, written) in enumerate(((ocam, "park.txt"), (chain, "park.yaml"))):
            out = self.folder / f"lens{number}"
            done = hedgehop("dataset", WORLD, *camera(given), "--images", 1, "--channels", "depth", "--renderer", "tiles", "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            if given == ocam:
                self.assertEqual((out / "calibration" / written).read_bytes(), pathlib.Path(ocam).read_bytes())
                continue
            chains = [hedgehop("calibration", WORLD, *camera(file), "--camera", "front", "--format", "kalibr").stdout
                      for file in (given, out / "calibration" / written)]
            self.assertIn("camera_model: ds", chains[0])
            self.assertEqual(chains[0], chains[1])

    def test_poses_are_within_their_bounds(self):
        for row in self.rows:
            self.assertGreaterEqual(float(row["clearance_m"]), 0.0)
            self.assertTrue(1.0 <= -float(row["down_m"]) <= 20.0)

    def test_flow_is_that_of_depth_and_poses(self):
        calibration = cv2.FileStorage(str(self.out / "calibration/park.yaml"), cv2.FILE_STORAGE_READ)
        camera = calibration.getNode("front")
        K, X_BC = camera.getNode("camera_matrix").mat(), camera.getNode("body_from_camera").mat()
        compared = 0
        for row in self.rows:
            z = self.read(row, "depth", "tiff")
            self.assertEqual(z.dtype, np.float32)
            flow = self.read(row, "flow")[:, :, ::-1].astype(float)
            X = np.linalg.inv(pose(row, "next_") @ X_BC) @ pose(row) @ X_BC
            rows, cols = np.nonzero((flow[:, :, 2] == 1) & np.isfinite(z))
            rays = np.linalg.inv(K) @ np.array([cols, rows, np.ones_like(rows)])
            points = X @ np.vstack([rays * z[rows, cols], np.ones(len(rows))])
            seen = K @ points[:3]
            wanted = (seen[:2] / seen[2] - [cols, rows]).T
            measured = (flow[rows, cols, :2] - 32768) / 64
            error = np.abs(wanted - measured).max(axis=1)
            self.assertLess(np.median(error), 0.02)
            compared += len(error)
        self.assertGreater(compared, 50_000)

    def test_coco_masks_are_the_instances(self):
        annotations = 0
        for split in ("train", "val", "test"):
            coco = json.loads((self.out / f"coco_{split}.json").read_text())
            names = {category["id"]: category["name"] for category in coco["categories"]}
            images = {image["id"]: image for image in coco["images"]}
            self.assertEqual([a["id"] for a in coco["annotations"]], list(range(1, len(coco["annotations"]) + 1)))
            for annotation in coco["annotations"]:
                row = self.rows[annotation["image_id"]]
                self.assertEqual((row["split"], images[annotation["image_id"]]["file_name"]), (split, f"{row['image']}.png"))
                height, width = annotation["segmentation"]["size"]
                runs = [np.full(n, i % 2, np.uint8) for i, n in enumerate(annotation["segmentation"]["counts"])]
                mask = np.concatenate(runs).reshape(width, height).T
                np.testing.assert_array_equal(mask == 1, self.read(row, "instance") == annotation["instance_id"])
                self.assertEqual(annotation["area"], mask.sum())
                v, u = np.nonzero(mask)
                self.assertEqual(annotation["bbox"], [u.min(), v.min(), np.ptp(u) + 1, np.ptp(v) + 1])
                classes = np.unique(self.read(row, "semantic")[mask == 1])
                self.assertEqual(list(classes), [annotation["category_id"]])
                self.assertIn(annotation["category_id"], names)
                annotations += 1
        self.assertGreater(annotations, 20)

    def test_a_trajectory_of_a_flight_gives_its_images(self):
        run = self.folder / "run"
        flown = hedgehop("run", WORLD, *CAMERA, "--set", "duration=1", "--set", "avionics.imu.rate=100", "--renderer", "tiles",
                         "--no-video", "--no-report", "--out", run)
        self.assertEqual(flown.returncode, 0, flown.stderr)
        self.assertEqual(hedgehop("export", run, "--format", "tum", "--camera", "front").returncode, 0)
        out = self.folder / "along"
        done = dataset(out, "--poses", run / "tum/groundtruth.txt", "--pose-of", "front", "--channels", "color")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out / "manifest.csv") as text:
            by_time = {round(float(row["t_s"]), 6): row for row in csv.DictReader(text)}
        compared = 0
        for line in (run / "tum/rgb.txt").read_text().splitlines():
            if line.startswith("#"):
                continue
            stamp, name = line.split()
            row = by_time[round(float(stamp) - 1_600_000_000, 6)]
            image = cv2.imread(str(out / row["split"] / "color" / f"{row['image']}.png"))
            exported = cv2.imread(str(run / "tum" / name))
            # The poses of the file have finite digits, so that a pixel at an edge may differ.
            self.assertLess(np.mean(np.abs(image.astype(int) - exported) > 8), 0.002)
            compared += 1
        self.assertGreaterEqual(compared, 9)

    def test_bad_input_is_rejected_with_valid_values(self):
        def refused(*options):
            done = dataset(self.folder / "bad", *options)
            self.assertEqual(done.returncode, 2, done.stderr)
            return done.stderr

        self.assertIn("valid: grey, color, depth", refused("--images", 2, "--channels", "collor"))
        self.assertIn("need a number of images", refused())
        twice = hedgehop("dataset", WORLD, WORLD, "--images", 2, "--out", self.folder / "bad")
        self.assertEqual(twice.returncode, 2)
        self.assertIn("another scenario has this file name", twice.stderr)
        other = hedgehop("dataset", WORLD, "--renderer", "foo", "--images", 2, "--out", self.folder / "bad")
        self.assertEqual(other.returncode, 2)
        self.assertIn("--renderer: foo not in {osmesa,egl,tiles}", other.stderr)
        no_camera = refused("--images", 1, "--camera", "up")
        self.assertIn("not in the rig; valid: front, down", no_camera)
        self.assertNotIn("exit status", no_camera)
        self.assertIn("random poses in a row", refused("--images", 1, "--height", "900,901"))
        self.assertIn("the scene has no obstacle, so no pose is 1 to 30 m from one",
                      refused("--images", 1, "--set", "scene={type: open}"))
        (self.folder / "poses.txt").write_text("1 2 3\n")
        self.assertIn("poses.txt:1: 3 numbers; valid", refused("--poses", self.folder / "poses.txt"))
        (self.folder / "two.txt").write_text("0 0 0 10 0 0 0 1\n1 0 0 10 0 0 0 1\n")
        self.assertIn("--images 7: " + str(self.folder / "two.txt") + " has 2 poses; valid: up to 6 images in 3 worlds",
                      refused("--poses", self.folder / "two.txt", "--images", 7, "--seeds", "1:3"))
        (self.folder / "one.txt").write_text("0 0 0 10 0 0 0 1\n")
        self.assertIn("one.txt has 1 pose; valid: up to 1 image\n", refused("--poses", self.folder / "one.txt", "--images", 2))
        missing = dataset(self.folder / "none", "--poses", self.folder / "nosuch.csv")
        self.assertEqual(missing.returncode, 2, missing.stderr)
        self.assertIn("nosuch.csv: there is no such file", missing.stderr)
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
