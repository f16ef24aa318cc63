"""Reads exported data sets with NumPy and OpenCV only, and compares them with the flight.

    read_back_test.py PROGRAM
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np
import yaml

from euroc import START_NS, Euroc, pose
from flown import flown_pose, rotation
from patches import offset_of_patch
from tum import Tum

PROGRAM = sys.argv[1]
GRAVITY = 9.81
IMU_POSITION = np.array([0.10, 0.05, -0.02])  # forward, right, down of the mass center
SCENARIO = pathlib.Path(__file__).with_name("exported.yaml")


def hedgehop(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


class ReadBack(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.run_folder = cls.folder / "run"
        flown = hedgehop("run", SCENARIO, "--out", cls.run_folder, "--no-video", "--no-report")
        assert flown.returncode == 0, flown.stdout + flown.stderr
        for data_format, cameras in (("euroc", []), ("tum", ["left"]), ("kitti", ["left", "right"])):
            options = [word for camera in cameras for word in ("--camera", camera)]
            done = hedgehop("export", cls.run_folder, "--format", data_format, *options)
            assert done.returncode == 0, done.stderr
            assert "warning" not in done.stderr, done.stderr
        cls.euroc = Euroc(cls.run_folder / "euroc")
        cls.tum = Tum(cls.run_folder / "tum")
        with open(cls.run_folder / "trajectory.csv") as file:
            cls.trajectory = list(csv.DictReader(file))

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_calibrations_read_back_to_the_last_digit(self):
        def kalibr(*options):
            done = hedgehop("calibration", SCENARIO, "--format", "kalibr", *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout

        files = {"left": self.run_folder / "euroc/mav0/cam1/sensor.yaml", "right": self.run_folder / "euroc/mav0/cam2/sensor.yaml"}
        for role, file in files.items():
            camera = f"{{role: {role}, rate: 10, channel: grey, calibration: {file}}}"
            rig = f"rig={{cameras: [{{role: down, width: 160, height: 160, fov: 90, rate: 50, channel: grey}}, {camera}]}}"
            self.assertEqual(kalibr("--camera", role, "--set", rig), kalibr("--camera", role))
        tum = f"{{role: left, rate: 10, channel: grey, calibration: {self.run_folder}/tum/calibration.yaml}}"
        rig = f"rig={{cameras: [{{role: down, width: 160, height: 160, fov: 90, rate: 50, channel: grey}}, {tum}]}}"
        self.assertEqual(kalibr("--camera", "left", "--set", rig), kalibr("--camera", "left"))

    def test_all_numbers_of_the_sensors_are_numbers_for_other_readers(self):
        small = ["--set", "avionics.imu.gyro_noise=2.0e-5", "--set", "avionics.imu.gyro_bias_walk=1.0e-7", "--set", "duration=0.2",
                 "--set", "velocimeter.enabled=false", "--set", "rig.cameras.0.distortion=[2e-05, 0, 0, 0]"]
        flown = hedgehop("run", SCENARIO, "--out", self.folder / "small", "--no-video", "--no-report", *small)
        self.assertIn(flown.returncode, (0, 1), flown.stderr)
        done = hedgehop("export", self.folder / "small", "--format", "euroc")
        self.assertEqual(done.returncode, 0, done.stderr)
        sensor = yaml.safe_load((self.folder / "small/euroc/mav0/imu0/sensor.yaml").read_text())
        self.assertEqual((sensor["gyroscope_noise_density"], sensor["gyroscope_random_walk"]), (2.0e-5, 1.0e-7))
        done = hedgehop("export", self.folder / "small", "--format", "tum", "--camera", "down")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "small/tum/calibration.yaml").read_text().replace("!!opencv-matrix", "").partition("---\n")[2]
        self.assertEqual(yaml.safe_load(text)["distortion_coefficients"]["data"][0], 2.0e-5)

    def test_poses_are_those_of_the_run(self):
        compared = 0
        for row in self.trajectory:
            t_ns = round(float(row["t_s"]) * 1e9)
            at = np.searchsorted(self.euroc.truth[:, 0], t_ns)
            if at == len(self.euroc.truth) or self.euroc.truth[at, 0] != t_ns:
                continue
            p, R, _, _, _ = self.euroc.state(t_ns)
            p_flown, R_flown = flown_pose(row, IMU_POSITION)
            np.testing.assert_allclose(p, p_flown, atol=1e-9)
            np.testing.assert_allclose(R, R_flown, atol=1e-9)
            compared += 1
        self.assertGreater(compared, 200)

    def test_velocities_are_the_slope_of_the_positions(self):
        truth = self.euroc.truth
        t_s = truth[:, 0] * 1e-9
        slope = (truth[2:, 1:4] - truth[:-2, 1:4]) / (t_s[2:] - t_s[:-2])[:, None]
        self.assertLess(np.abs(slope - truth[1:-1, 8:11]).max(), 0.002)
        self.assertGreater(np.linalg.norm(truth[:, 8:11], axis=1).max(), 2.0)

    def test_integrated_imu_equals_the_truth(self):
        imu = self.euroc.imu
        span_ns = 1_000_000_000
        for begin_ns in (1_000_000_000, 2_000_000_000, 3_000_000_000):
            rows = imu[(imu[:, 0] >= begin_ns) & (imu[:, 0] <= begin_ns + span_ns)]
            p, R, v, b_w, b_a = self.euroc.state(begin_ns)
            for now, then in zip(rows[:-1], rows[1:]):
                dt = (then[0] - now[0]) * 1e-9
                w = 0.5 * (now[1:4] + then[1:4]) - b_w
                R_then = R @ cv2.Rodrigues(w * dt)[0]
                a = 0.5 * (R @ (now[4:7] - b_a) + R_then @ (then[4:7] - b_a)) - [0, 0, GRAVITY]
                p, v, R = p + v * dt + 0.5 * a * dt * dt, v + a * dt, R_then
            p_true, R_true, v_true, _, _ = self.euroc.state(int(rows[-1, 0]))
            # The remaining error: the low-pass filter of the sensor (cut-off 200 Hz) and the drift of the bias.
            self.assertLess(np.linalg.norm(p - p_true), 0.03)
            self.assertLess(np.linalg.norm(v - v_true), 0.05)
            self.assertLess(np.linalg.norm(cv2.Rodrigues(R.T @ R_true)[0]), 0.005)

    def test_images_have_the_times_of_their_cameras(self):
        for name, period_ns in (("cam0", 20_000_000), ("cam1", 100_000_000), ("cam2", 100_000_000)):
            images = self.euroc.images(name)
            self.assertGreater(len(images), 30)
            for t_ns, file in images.items():
                self.assertEqual(t_ns % period_ns, 0)
                self.assertEqual(file.stem, str(START_NS + t_ns))
                self.assertEqual(len(file.stem), 19)
                self.assertIsNotNone(cv2.imread(str(file)))
            self.assertLess(self.euroc.imu[0, 0], min(images))
            self.assertGreater(self.euroc.imu[-1, 0], max(images))
            self.assertEqual(sorted(file.name for file in (self.euroc.root / name / "data").iterdir()),
                             [images[t_ns].name for t_ns in sorted(images)])  # sorted as text
        self.assertEqual(len(self.euroc.images("cam0")), 249)  # of 251, without the first and the last
        self.assertLess(len(self.euroc.images("cam1")), 51)  # some are dropped

    def test_images_are_those_of_the_flight(self):
        t_ns = next(t for t in self.euroc.images("cam1") if t > 1_500_000_000)
        drawn = self.folder / "drawn.png"
        done = hedgehop("render", self.run_folder / "scenario.yaml", "--camera", "left", "--what", "grey", "--time",
                        t_ns * 1e-9, "-o", drawn)
        self.assertEqual(done.returncode, 0, done.stderr)
        exported = cv2.imread(str(self.euroc.images("cam1")[t_ns]), cv2.IMREAD_UNCHANGED)
        np.testing.assert_array_equal(exported, cv2.imread(str(drawn), cv2.IMREAD_UNCHANGED))

    def test_depth_and_pose_give_ground_at_height_zero(self):
        heights = []
        for t_text in list(self.tum.images)[5:45:10]:
            rows, _, points = self.tum.points(t_text, 13.0)
            x, y, z, qx, qy, qz, qw = self.tum.truth[t_text]
            heights.append(((rotation(qw, qx, qy, qz) @ points.T).T + [x, y, z])[rows > 200, 2])
        heights = np.concatenate(heights)
        self.assertGreater(len(heights), 1000)
        on_ground = heights[heights < 0.1]
        self.assertGreater(len(on_ground), 0.5 * len(heights))
        self.assertLess(np.abs(on_ground).max(), 0.001)  # resolution of depth: 0.2 mm

    def test_points_of_known_depth_are_at_their_projection(self):
        """Projects patches of the left image into the right one by depth and calibration, and compares their positions."""
        _, X_left = self.euroc.camera("cam1")
        K_right, X_right = self.euroc.camera("cam2")
        X_right_left = np.linalg.inv(X_right) @ X_left
        left, right = self.euroc.images("cam1"), self.euroc.images("cam2")
        random = np.random.default_rng(7)
        off = []
        for t_text in list(self.tum.images)[4:44:8]:
            t_ns = int(t_text.replace(".", "")) - START_NS
            if t_ns not in right:
                continue
            a, b = cv2.imread(str(left[t_ns]), 0), cv2.imread(str(right[t_ns]), 0)
            rows, cols, points = self.tum.points(t_text, 13.0)
            seen = (K_right @ (X_right_left[:3, :3] @ points.T + X_right_left[:3, 3:])).T
            seen = seen[:, :2] / seen[:, 2:]
            for k in random.permutation(len(rows))[:60]:
                off.extend(offset_of_patch(a, b, (rows[k], cols[k]), seen[k]))
        off = np.array(off)
        self.assertGreater(len(off), 60)
        self.assertLess(np.abs(np.median(off, axis=0)).max(), 0.05)
        self.assertGreater(np.mean(np.abs(off).max(axis=1) < 1.0), 0.8)

    def test_kitti_has_the_same_poses_from_its_first_frame(self):
        root = self.run_folder / "kitti"
        times = np.loadtxt(root / "sequences/00/times.txt")
        poses = np.loadtxt(root / "poses/00.txt").reshape(-1, 3, 4)
        self.assertEqual(len(times), len(poses))
        _, X_left = self.euroc.camera("cam1")

        def camera_at(t_s):
            p, R, _, _, _ = self.euroc.state(round(t_s * 1e9))
            return pose(R, p) @ X_left

        first = np.linalg.inv(camera_at(times[0]))
        for t_s, found in zip(times, poses):
            np.testing.assert_allclose(found, (first @ camera_at(t_s))[:3], atol=1e-9)
        both = set(self.euroc.images("cam1")) & set(self.euroc.images("cam2"))
        self.assertEqual([round(t * 1e9) for t in times], sorted(both))

    def test_kitti_images_and_projections_are_those_of_the_pair(self):
        root = self.run_folder / "kitti/sequences/00"
        calib = {line.split(":")[0]: np.array(line.split(":")[1].split(), float).reshape(3, 4)
                 for line in (root / "calib.txt").read_text().splitlines()}
        K, X_left = self.euroc.camera("cam1")
        np.testing.assert_allclose(calib["P0"], np.hstack([K, np.zeros((3, 1))]), atol=1e-9)
        self.assertAlmostEqual(-calib["P1"][0, 3] / K[0, 0], 0.4, places=9)  # the baseline
        np.testing.assert_allclose(calib["Tr_imu_to_cam0"], np.linalg.inv(X_left)[:3], atol=1e-9)
        # As pykitti reads the odometry layout: four projections, the baselines of both pairs, and the laser scanner.
        projections = [calib[f"P{camera}"] for camera in range(4)]
        offsets = [np.array([P[0, 3] / P[0, 0], 0, 0]) for P in projections]
        self.assertAlmostEqual(np.linalg.norm(offsets[1] - offsets[0]), 0.4, places=9)
        self.assertAlmostEqual(np.linalg.norm(offsets[3] - offsets[2]), 0.4, places=9)
        np.testing.assert_array_equal(calib["Tr"], calib["Tr_imu_to_cam0"])
        times = np.loadtxt(root / "times.txt")
        for number, t_s in list(enumerate(times))[::7]:
            for camera, name in ((0, "cam1"), (1, "cam2")):
                file = root / f"image_{camera}" / f"{number:06}.png"
                np.testing.assert_array_equal(cv2.imread(str(file), -1), cv2.imread(
                    str(self.euroc.images(name)[round(t_s * 1e9)]), -1))

    def test_readings_are_the_same_in_every_format(self):
        accelerometer = np.loadtxt(self.run_folder / "tum/accelerometer.txt")
        gyroscope = np.loadtxt(self.run_folder / "tum/gyroscope.txt")
        kitti = np.loadtxt(self.run_folder / "kitti/sequences/00/imu.txt")
        np.testing.assert_allclose(accelerometer[:, 0] - START_NS * 1e-9, self.euroc.imu[:, 0] * 1e-9, atol=1e-6)
        with open(self.run_folder / "tum/accelerometer.txt") as text:
            self.assertEqual(text.readlines()[3].split()[0], "1600000000.000000000")
        np.testing.assert_array_equal(accelerometer[:, 1:], self.euroc.imu[:, 4:7])
        np.testing.assert_array_equal(gyroscope[:, 1:], self.euroc.imu[:, 1:4])
        np.testing.assert_array_equal(kitti[:, 1:], self.euroc.imu[:, 1:7])

    def test_gravity_and_lever_arm_are_the_same_through_every_file(self):
        """The reading of the accelerometers at the start, in the hover, points up in the left camera's frame."""
        def turn(axis, degrees):
            return cv2.Rodrigues(np.radians(degrees) * np.eye(3)[axis])[0]

        row = self.trajectory[0]
        R_NB = turn(2, np.degrees(float(row["yaw_rad"]))) @ turn(1, np.degrees(float(row["pitch_rad"]))) \
            @ turn(0, np.degrees(float(row["roll_rad"])))
        R_BC = turn(1, -25) @ turn(0, 3) @ np.eye(3)[[2, 0, 1]]  # right, down, forward of a camera that looks forward
        up_C = R_BC.T @ R_NB.T @ [0, 0, -GRAVITY]
        p_CI_C = R_BC.T @ (IMU_POSITION - [0.3, 0, 0]) + [0.2, 0, 0]  # half of the baseline

        chain, opencv = self.folder / "chain.yaml", self.folder / "opencv.yaml"
        scenario = self.run_folder / "scenario.yaml"
        for words in (["--format", "kalibr", "--opencv-header", "-o", chain], ["-o", opencv]):
            done = hedgehop("calibration", scenario, "--camera", "left", "--camera", "right", *words)
            self.assertEqual(done.returncode, 0, done.stderr)
        kitti = dict(line.split(":") for line in (self.run_folder / "kitti/sequences/00/calib.txt").read_text().splitlines())

        open_files = []  # nodes refer to their files

        def node(file, *keys):
            open_files.append(cv2.FileStorage(str(file), cv2.FILE_STORAGE_READ))
            at = open_files[-1].root()
            for key in keys:
                at = at.getNode(key)
            return at

        rows = node(chain, "cam0", "T_cam_imu")
        X_CF = {"euroc": np.linalg.inv(self.euroc.camera("cam1")[1]),
                "kalibr": np.array([[rows.at(i).at(j).real() for j in range(4)] for i in range(4)]),
                "kitti": np.vstack([np.array(kitti["Tr"].split(), float).reshape(3, 4), [0, 0, 0, 1]]),
                "tum": np.linalg.inv(node(self.run_folder / "tum/calibration.yaml", "imu_from_camera").mat()),
                "opencv": np.linalg.inv(node(opencv, "left", "imu_from_camera").mat())}
        up_F = self.euroc.imu[0, 4:7] - self.euroc.state(0)[4]  # without the bias
        for name, X in X_CF.items():
            np.testing.assert_allclose(X[:3, :3] @ up_F, up_C, atol=0.3, err_msg=name)  # the trim accelerates a little
            np.testing.assert_allclose(X[:3, 3], p_CI_C, atol=1e-9, err_msg=name)

    def refused(self, *arguments):
        done = hedgehop("export", *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        return done.stderr

    def test_bad_input_is_rejected_with_valid_values(self):
        run_folder = self.run_folder
        self.assertIn("not the folder of a run", self.refused(self.folder, "--format", "euroc"))
        self.assertIn("not the folder of a run", self.refused(self.folder / "missing", "--format", "euroc"))
        self.assertIn("euroc", self.refused(run_folder, "--format", "bag"))
        self.assertIn("not an empty folder", self.refused(run_folder, "--format", "euroc"))
        other = ["--out", self.folder / "other"]
        self.assertIn("not in the rig; valid: down, left, right", self.refused(run_folder, "--format", "euroc", "--camera", "up", *other))
        self.assertIn("the TUM format supports one camera", self.refused(run_folder, "--format", "tum", *other))
        self.assertIn("select cameras with --camera", self.refused(run_folder, "--format", "kitti", *other))
        self.assertIn("given twice",
                      self.refused(run_folder, "--format", "kitti", "--camera", "left", "--camera", "left", *other))
        self.assertFalse((self.folder / "other").exists())

    def test_warns_of_a_different_trajectory_and_names_the_cause(self):
        result = json.loads((self.run_folder / "result.json").read_text())
        causes = {"another kind of processor": {"inputs": {"scenario.yaml": "0"}}, "another build": {"build": "0"}}
        for number, (cause, changes) in enumerate(causes.items()):
            other = self.folder / f"other_run_{number}"
            other.mkdir()
            (other / "result.json").write_text(json.dumps({**result, "trajectory_hash": "0", **changes}))
            (other / "scenario.yaml").write_bytes((self.run_folder / "scenario.yaml").read_bytes())
            done = hedgehop("export", other, "--format", "kitti", "--camera", "left")
            self.assertEqual(done.returncode, 0)
            self.assertIn("the re-simulated trajectory differs from the run's", done.stderr)
            self.assertIn(f": {cause}; the data agree", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
