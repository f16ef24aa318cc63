"""Reads exported logs with the readers of their formats (npm), and compares them with the flight.

    logs_test.py PROGRAM SOURCE_FOLDER NODE FOLDER_WITH_READERS
"""

import base64
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np
import yaml

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from flown import flown_pose, rotation  # noqa: E402

PROGRAM, SOURCE, NODE, READERS = sys.argv[1:5]
START_NS = 1_600_000_000_000_000_000  # of ROS times
IMU_POSITION = np.array([0.10, 0.05, -0.02])  # forward, right, down of the mass center
SCENARIO = pathlib.Path(__file__).with_name("logged.yaml")


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True)


def hedgehop(*words):
    return run(PROGRAM, *words)


def read(script, file):
    done = run(NODE, pathlib.Path(READERS) / script, file)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


class Logs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.run_folder = cls.folder / "run"
        flown = hedgehop("run", SCENARIO, "--out", cls.run_folder, "--no-video", "--no-report")
        assert flown.returncode in (0, 1), flown.stdout + flown.stderr
        for name, options in (("mcap", ["--truth"]), ("rosbag2", []), ("ulog", [])):
            done = hedgehop("export", cls.run_folder, "--format", name, *options)
            assert done.returncode == 0, done.stderr
            assert "warning" not in done.stderr, done.stderr
        cls.mcap = read("read_mcap.mjs", cls.run_folder / "mcap/flight.mcap")
        cls.bag = read("read_mcap.mjs", cls.run_folder / "rosbag2/flight_0.mcap")
        cls.ulog = read("read_ulog.mjs", cls.run_folder / "ulog/flight.ulg")
        with open(cls.run_folder / "trajectory.csv") as file:
            cls.trajectory = list(csv.DictReader(file))
        with open(cls.run_folder / "decisions.csv") as file:
            cls.decisions = list(csv.DictReader(file))
        cls.result = json.loads((cls.run_folder / "result.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def messages(self, log, topic):
        self.assertIn(topic, log["topics"])
        return log["topics"][topic]["messages"]

    def assert_poses(self, poses, prefix):
        """poses: (t_ns, position, quaternion w x y z)"""
        self.assertEqual(len(poses), len(self.trajectory))
        for (t_ns, p, q), row in zip(poses, self.trajectory):
            self.assertEqual(t_ns, round(float(row["t_s"]) * 1e9))
            p_flown, R_flown = flown_pose(row, IMU_POSITION, prefix)
            np.testing.assert_allclose(p, p_flown, atol=1e-9)
            np.testing.assert_allclose(rotation(*q), R_flown, atol=1e-9)

    @staticmethod
    def pose_of(t_ns, position, orientation):
        return t_ns, [position[k] for k in "xyz"], [orientation[k] for k in "wxyz"]

    def image(self, message):
        return cv2.imdecode(np.frombuffer(base64.b64decode(message["data"]["base64"]), np.uint8), cv2.IMREAD_UNCHANGED)

    def rendered(self, camera, t_s):
        file = self.folder / "rendered.png"
        what = "color" if camera == "belly" else "grey"
        done = hedgehop("render", SCENARIO, "--camera", camera, "--time", t_s, "--what", what, "-o", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        return cv2.imread(str(file), cv2.IMREAD_UNCHANGED)

    def test_mcap_poses_are_those_of_the_run(self):
        poses = [self.pose_of(t, m["pose"]["position"], m["pose"]["orientation"]) for t, m in self.messages(self.mcap, "/pose")]
        self.assert_poses(poses, "")
        transforms = [(t, m["transforms"][0]) for t, m in self.messages(self.mcap, "/tf")]
        self.assertEqual({(m["parent_frame_id"], m["child_frame_id"]) for _, m in transforms}, {("world", "body")})
        self.assert_poses([self.pose_of(t, m["translation"], m["rotation"]) for t, m in transforms], "")
        estimates = [self.pose_of(t, m["pose"]["position"], m["pose"]["orientation"])
                     for t, m in self.messages(self.mcap, "/estimate")]
        self.assert_poses(estimates, "est_")

    def test_mcap_state_and_decisions_are_the_tables_of_the_run(self):
        for topic, table in (("/state", self.trajectory), ("/decision", self.decisions)):
            messages = self.messages(self.mcap, topic)
            self.assertEqual(len(messages), len(table))
            for (t_ns, message), row in zip(messages, table):
                self.assertEqual(list(message), ["timestamp", *[name for name in row if name != "t_s"]])
                for name, value in row.items():
                    if name == "t_s":
                        self.assertEqual(t_ns, round(float(value) * 1e9))
                    elif name == "status":
                        self.assertEqual(message[name], value)
                    else:
                        logged = float(message[name])
                        self.assertTrue(math.isnan(logged) if value == "" else logged == float(value), name)

    def test_mcap_images_are_those_of_the_renderer(self):
        for camera, t_s in (("belly", 1.0), ("dome", 1.5), ("left", 2.0)):
            images = dict((t, m) for t, m in self.messages(self.mcap, f"/camera/{camera}/image"))
            message = images[round(t_s * 1e9)]
            self.assertEqual(message["format"], "png")
            np.testing.assert_array_equal(self.image(message), self.rendered(camera, t_s))

    def test_mcap_calibration_has_the_time_and_the_frame_of_its_image(self):
        images, calibrations = (self.messages(self.mcap, f"/camera/left/{kind}") for kind in ("image", "calibration"))
        self.assertEqual([t for t, _ in images], [t for t, _ in calibrations])
        focal = 80 / math.tan(math.radians(35))
        for _, message in calibrations:
            self.assertEqual(message["frame_id"], "camera/left")
            np.testing.assert_allclose(message["K"], [focal, 0, 79.5, 0, focal, 59.5, 0, 0, 1])
        right = self.messages(self.mcap, "/camera/right/calibration")[0][1]
        self.assertAlmostEqual(right["P"][3], -focal * 0.3)
        self.assertEqual(self.messages(self.mcap, "/camera/dome/calibration")[0][1]["distortion_model"], "kannala_brandt")

    def test_matched_depth_is_near_the_true_depth(self):
        def depths(topic):
            return {t: np.frombuffer(base64.b64decode(m["data"]["base64"]), np.uint16).reshape(m["height"], m["width"])
                    for t, m in self.messages(self.mcap, topic)}
        matched, true = depths("/camera/left/depth"), depths("/camera/left/true_depth")
        self.assertEqual(list(matched), list(true))
        errors = []
        for t in matched:
            known = (matched[t] > 0) & (true[t] > 0)
            errors.append(1e3 / matched[t][known] - 1e3 / true[t][known])
        errors = np.concatenate(errors)
        self.assertGreater(errors.size, 0.2 * 160 * 120 * len(matched))
        focal_baseline = 80 / math.tan(math.radians(35)) * 0.3
        self.assertLess(np.median(np.abs(errors)) * focal_baseline, 0.5)  # px of disparity

    def test_events_tell_the_failure_and_the_outcome(self):
        events = [(t, m["level"], m["name"], m["message"]) for t, m in self.messages(self.mcap, "/events")]
        failures = [(t, level) for t, level, name, _ in events if name == "failure"]
        self.assertEqual(failures, [(1_000_000_000, 3), (1_500_000_000, 2)])
        self.assertIn(self.result["outcome"], [text.split(":")[0] for _, _, name, text in events if name == "flight"])
        gps = [t for t, _ in self.messages(self.mcap, "/gps")]
        self.assertFalse([t for t in gps if 1.0e9 <= t < 1.5e9])
        self.assertTrue([t for t in gps if t >= 1.5e9])

    def test_mcap_scene_has_the_objects_of_the_scene(self):
        entities = self.messages(self.mcap, "/scene")[0][1]["entities"]
        names = [entity["id"] for entity in entities]
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("ground", names)
        trees = [e for e in entities if e["metadata"] == [{"key": "class", "value": "tree"}]]
        self.assertEqual(len(trees), 30)
        for entity in entities:
            triangles = entity["triangles"][0]
            self.assertEqual(len(triangles["points"]), len(triangles["colors"]))
            self.assertEqual(len(triangles["indices"]) % 3, 0)
            self.assertLess(max(triangles["indices"]), len(triangles["points"]))
            if entity["id"] != "ground":
                self.assertGreaterEqual(min(p["z"] for p in triangles["points"]), -0.5)
        movers = self.messages(self.mcap, "/movers")[0][1]["entities"]
        self.assertEqual([(m["id"], m["frame_id"], m["frame_locked"]) for m in movers], [("balloon", "mover/0", True)])
        moved = [m["transforms"][-1] for _, m in self.messages(self.mcap, "/tf")]
        self.assertEqual({m["child_frame_id"] for m in moved}, {"mover/0"})
        np.testing.assert_allclose([moved[100]["translation"][k] for k in "xyz"], [12, 13, 4], atol=1e-6)  # after 1 s

    def test_mcap_has_the_run_in_attachments_and_metadata(self):
        self.assertEqual(self.mcap["attachments"]["scenario.yaml"], (self.run_folder / "scenario.yaml").read_text())
        attached = json.loads(self.mcap["attachments"]["result.json"])
        self.assertEqual(attached["trajectory_hash"], self.result["trajectory_hash"])
        self.assertEqual(self.mcap["metadata"]["hedgehop"]["trajectory_hash"], self.result["trajectory_hash"])
        self.assertTrue(self.mcap["sorted"])

    def test_compressions_have_equal_messages_and_repeat(self):
        for name in ("none", "lz4"):
            out = self.folder / name
            done = hedgehop("export", self.run_folder, "--format", "mcap", "--truth", "--compression", name, "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            other = read("read_mcap.mjs", out / "flight.mcap")
            self.assertEqual(other["topics"], self.mcap["topics"])
            self.assertEqual(other["compression"], "" if name == "none" else name)
        again = self.folder / "again"
        done = hedgehop("export", self.run_folder / "scenario.yaml", "--format", "mcap", "--truth", "--out", again)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((again / "flight.mcap").read_bytes(), (self.run_folder / "mcap/flight.mcap").read_bytes())

    def test_bag_poses_are_those_of_the_run(self):
        self.assertEqual(self.bag["profile"], "ros2")
        for topic, prefix, frame in (("/ground_truth/odom", "", "map"), ("/odom", "est_", "odom")):
            poses = []
            for t, m in self.messages(self.bag, topic):
                self.assertEqual((m["header"]["frame_id"], m["child_frame_id"]), (frame, "base_link"))
                self.assertEqual(m["header"]["stamp"]["sec"] * 10**9 + m["header"]["stamp"]["nanosec"], round(t, -3))
                poses.append(self.pose_of(round(t - START_NS, -6), m["pose"]["pose"]["position"], m["pose"]["pose"]["orientation"]))
            self.assert_poses(poses, prefix)
        truth = self.messages(self.bag, "/ground_truth/odom")
        p = np.array([[m["pose"]["pose"]["position"][k] for k in "xyz"] for _, m in truth])
        v = np.array([rotation(*[m["pose"]["pose"]["orientation"][k] for k in "wxyz"]) @
                      [m["twist"]["twist"]["linear"][k] for k in "xyz"] for _, m in truth])
        self.assertLess(np.abs((p[2:] - p[:-2]) / 0.02 - v[1:-1]).max(), 0.02)

    def test_bag_images_equal_those_of_the_mcap(self):
        for camera, encoding in (("belly", "rgb8"), ("left", "mono8")):
            raw, png = self.messages(self.bag, f"/camera/{camera}/image_raw"), self.messages(self.mcap, f"/camera/{camera}/image")
            self.assertEqual(len(raw), len(png))
            for (_, m), (_, compressed) in zip(raw, png):
                self.assertEqual(m["encoding"], encoding)
                pixels = np.frombuffer(base64.b64decode(m["data"]["base64"]), np.uint8).reshape(m["height"], m["width"], -1)
                other = self.image(compressed)
                other = other[:, :, ::-1] if other.ndim == 3 else other[:, :, None]
                np.testing.assert_array_equal(pixels, other)

    def test_bag_scan_is_the_level_slice_of_the_depth_image(self):
        scans = self.messages(self.bag, "/camera/range/scan")
        images = self.messages(self.bag, "/camera/range/depth/image_raw")
        self.assertEqual(len(scans), len(images))
        finite = 0
        for (_, scan), (_, image) in zip(scans, images):
            self.assertEqual(len(scan["ranges"]), image["width"])
            self.assertAlmostEqual(scan["angle_max"], scan["angle_min"] + 63 * scan["angle_increment"], places=5)
            depth = np.frombuffer(base64.b64decode(image["data"]["base64"]), np.uint16).reshape(48, 64)
            for i, distance in enumerate(scan["ranges"]):
                if not isinstance(distance, float) or distance > 60:
                    continue
                finite += 1
                angle = scan["angle_min"] + i * scan["angle_increment"]
                columns = depth[:, max(0, 62 - i):66 - i]  # within two columns; a small roll moves the slice
                self.assertLess(np.abs(columns - 1000 * distance * math.cos(angle)).min(), 0.05 * 1000 * distance + 1)
        self.assertGreater(finite, 100)

    def test_bag_fixes_are_near_the_truth(self):
        fixes = self.messages(self.bag, "/gps/fix")
        self.assertGreater(len(fixes), 5)
        for _, fix in fixes:
            stamp_s = fix["header"]["stamp"]["sec"] - 1_600_000_000 + fix["header"]["stamp"]["nanosec"] * 1e-9
            row = self.trajectory[min(round(max(0.0, stamp_s) * 100), len(self.trajectory) - 1)]
            north = math.radians(fix["latitude"] - 47.397742) * 6.3686e6  # radius of the meridian at 47.4 deg
            east = math.radians(fix["longitude"] - 8.545594) * 6.3897e6 * math.cos(math.radians(47.397742))
            for measured, key, limit in ((north, "north_m", 6), (east, "east_m", 6), (488 - fix["altitude"], "down_m", 10)):
                self.assertLess(abs(measured - float(row[key])), limit)

    def test_bag_metadata_counts_the_messages(self):
        info = yaml.safe_load((self.run_folder / "rosbag2/metadata.yaml").read_text())["rosbag2_bagfile_information"]
        topics = {t["topic_metadata"]["name"]: t for t in info["topics_with_message_count"]}
        self.assertEqual(set(topics), set(self.bag["topics"]))
        for name, topic in topics.items():
            self.assertEqual(topic["message_count"], len(self.messages(self.bag, name)))
            self.assertEqual(topic["topic_metadata"]["type"], self.bag["topics"][name]["schema"])
            profile = topic["topic_metadata"]["offered_qos_profiles"]
            self.assertEqual(profile, self.bag["topics"][name]["metadata"]["offered_qos_profiles"])
            latched = name in ("/tf_static", "/scene", "/movers")
            self.assertEqual(yaml.safe_load(profile)[0]["durability"], 1 if latched else 2)
        self.assertEqual(info["message_count"], sum(t["message_count"] for t in topics.values()))
        self.assertEqual(info["relative_file_paths"], ["flight_0.mcap"])
        self.assertEqual(info["starting_time"]["nanoseconds_since_epoch"], START_NS)

    def test_ulog_is_the_table_of_the_run(self):
        state = self.ulog["topics"]["hedgehop_state"]
        self.assertEqual(len(state), len(self.trajectory))
        for message, row in zip(state, self.trajectory):
            self.assertEqual(message["timestamp"], round(float(row["t_s"]) * 1e6))
            for name, value in row.items():
                if name != "t_s" and value not in ("", "inf"):
                    self.assertEqual(message[name], float(value), name)
        position = self.ulog["topics"]["vehicle_local_position_groundtruth"]
        np.testing.assert_allclose([m["z"] for m in position], [float(row["down_m"]) for row in self.trajectory], rtol=1e-6)
        self.assertEqual(len(self.ulog["topics"]["hedgehop_decision"]), len(self.decisions))
        self.assertEqual(self.ulog["information"]["sys_name"], "Hedgehop")
        self.assertIn(f"trajectory_hash: {self.result['trajectory_hash']}", [text for _, _, text in self.ulog["texts"]])

    def test_bad_requests_leave_no_folder(self):
        text = SCENARIO.read_text().replace("../../../../configs", f"{SOURCE}/configs")
        cases = (("down looking", "down looking", "has letters, digits"), ("2nd", "2nd", "starts with no digit"), ("belly", "up", "not in the rig"))
        for role, requested, words in cases:
            (bad := self.folder / "bad.yaml").write_text(text.replace("role: belly", f'role: "{role}"'))
            out = self.folder / "refused"
            done = hedgehop("export", bad, "--format", "rosbag2", "--out", out, "--camera", requested)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
