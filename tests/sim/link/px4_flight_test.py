"""Flights of the program with a scripted PX4 on real sockets: px4_flight_test.py HEDGEHOP SOURCE_FOLDER."""

import json
import os
import pathlib
import random
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

import px4_peer

HEDGEHOP, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCENARIO = """
use: {source}/configs/links/px4_wall.yaml
name: offboard
duration: 30
scene: {{type: wall, north: 9, width: 120, height: 40}}
rig: {{cameras: [{{role: depth, width: 64, height: 48, fov: 90, rate: 10, channel: depth}}]}}
start: {{north: 0, east: 0, altitude: 3, heading: 30}}
goal: {{north: 4, east: 2, altitude: 3.5, radius: 0.8}}
avoidance: {{module: go_to_goal, speed: 1.5}}
checks: [{{check: altitude_band, min: 2, max: 5}}, {{check: reached_goal}}]
drawing: {{renderer: tiles}}
link:
  type: px4
  port: {port}
  offboard_port: {port}
  autopilot_port: {peer_port}
  frame_class: 1
  frame_type: 1
  stand_altitude: 0.3
  command: []
"""


def free_ports():
    """Two ports that no process uses, for TCP and for UDP. Processes begin at different ports, because another one may
    take a port after the probe."""
    for port in range(20000 + 7 * (os.getpid() % 2000), 60000, 7):
        try:
            for used in (port, port + 1):
                for kind in (socket.SOCK_STREAM, socket.SOCK_DGRAM):
                    with socket.socket(socket.AF_INET, kind) as probe:
                        probe.bind(("127.0.0.1", used))
            return port, port + 1
        except OSError:
            continue
    raise RuntimeError("no free port")


class Px4Flight(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.port, self.peer_port = free_ports()
        self.scenario = self.folder / "offboard.yaml"
        self.scenario.write_text(SCENARIO.format(source=SOURCE, port=self.port, peer_port=self.peer_port))

    def command(self, *arguments, out="run"):
        return [HEDGEHOP, "run", self.scenario, "--no-report", "--no-video", "--out", self.folder / out, *arguments]

    def run_hedgehop(self, *arguments, out="run"):
        return subprocess.run(self.command(*arguments, out=out), capture_output=True, text=True, check=False, timeout=200)

    def fly(self, script, *arguments, out="run"):
        """Runs the program while `script(autopilot)` plays PX4. Returns the ended program and the autopilot."""
        flight = subprocess.Popen(self.command(*arguments, out=out), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        peers, faults = [], []

        def play():
            try:
                peers.append(px4_peer.Px4(self.port, self.port, self.peer_port))
                script(peers[0])
            except (OSError, AssertionError) as error:
                faults.append(error)

        thread = threading.Thread(target=play, daemon=True)
        thread.start()
        text, errors = flight.communicate(timeout=200)
        thread.join(timeout=60)
        for peer in peers:
            peer.close()
        self.assertEqual(faults, [])
        return subprocess.CompletedProcess(flight.args, flight.returncode, text, errors), peers[0]

    def result(self, out="run"):
        return json.loads((self.folder / out / "result.json").read_text())

    def test_an_offboard_flight_reaches_its_goal_and_its_recording_flies_it_again(self):
        # A busy machine may leave the peer without processor time for longer than the default of 2 s.
        patient = ("--set", "link.unanswered_after=60")
        done, px4 = self.fly(lambda autopilot: autopilot.fly(), *patient)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = self.result()
        self.assertEqual(result["outcome"], "reached")
        link = result["link"]
        self.assertEqual(link["kind"], "px4")
        self.assertEqual(link["unanswered"] + link["repeated"] + link["malformed"] + link["strangers"], 0)
        self.assertEqual(px4.commands.count(400), 1)
        self.assertEqual(px4.times_us, list(range(4000, 4000 * (len(px4.times_us) + 1), 4000)))
        # One answer per state, except for those of the boot. At the pace of the wall, the first answers may come after the next state.
        self.assertEqual(link["frames"] + link["old"], px4.states - px4_peer.BOOT_STATES)
        seconds = px4.states / 250
        self.assertEqual(px4.updated[0x3F], px4.states)
        self.assertAlmostEqual(px4.updated[0x1C0] / seconds, 100, delta=1)
        self.assertAlmostEqual(px4.updated[0x1A00] / seconds, 50, delta=1)
        self.assertAlmostEqual(len(px4.gps) / seconds, 5, delta=0.5)
        # Setpoints: the start as a position, then the module's velocities with its heading.
        masks = [setpoint[12] for setpoint in px4.setpoints]
        first = masks.index(px4_peer.VELOCITY)
        self.assertEqual(set(masks[:first]), {px4_peer.POSITION})
        self.assertLessEqual(set(masks[first:]), {px4_peer.VELOCITY, px4_peer.HOVER})
        gaps = [b - a for a, b in zip(px4.setpoint_us, px4.setpoint_us[1:])]
        self.assertLess(max(gaps), 500_000)

        again = self.run_hedgehop("--replay-link", self.folder / "run" / "link.bin", *patient, out="again")
        self.assertEqual(again.returncode, 0, again.stderr)
        replayed = self.result("again")
        self.assertEqual(replayed["trajectory_hash"], result["trajectory_hash"])
        self.assertEqual(replayed["link"]["start_tick"], link["start_tick"])

    def test_the_autopilot_receives_the_wall_in_its_sectors(self):
        done, px4 = self.fly(lambda autopilot: autopilot.fly(), "--set", "duration=2", "--set", "start.heading=0", "--set",
                             "avoidance={module: section_grid, depth: camera}")
        self.assertIn(done.returncode, (0, 1), done.stdout + done.stderr)
        seen = [message[1:73] for message in px4.obstacles if message[1] < 2000]
        self.assertGreater(len(seen), 5)
        ahead, right = seen[0][0], seen[0][6]
        self.assertAlmostEqual(ahead, 900, delta=40)  # cm
        self.assertAlmostEqual(right, 900 / 0.866, delta=80)  # 30 deg to the right
        self.assertEqual(seen[0][36], 65535)

    def test_an_attitude_module_is_refused_before_the_flight(self):
        done = self.run_hedgehop("--set", "avoidance={module: corridor_centering, law: published}", "--set",
                                 "rig.cameras.0={role: fisheye, model: fisheye, width: 100, height: 100, fov: 190, pitch: -90, rate: 10}")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("the module commands attitudes, which autopilots do not accept", done.stderr)
        self.assertFalse((self.folder / "run" / "result.json").exists())

    def test_an_autopilot_that_stops_loses_the_link_and_all_is_written(self):
        done, px4 = self.fly(lambda autopilot: (autopilot.fly(1500), autopilot.close()))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.result()["outcome"], "link_lost")
        self.assertEqual(self.result()["cause"], f"link: the autopilot closed its connection at tick {4 * px4.states + 4}")

    def test_malformed_bytes_are_counted_and_warned_of_once(self):
        def script(autopilot):
            noise = random.Random(1)
            while autopilot.states < 400:
                autopilot.fly(autopilot.states + 1)
                autopilot.stream.sendall(noise.randbytes(noise.randrange(200)).replace(b"\xfd", b"\xfc"))
            autopilot.fly()

        done, _ = self.fly(script)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreater(self.result()["link"]["malformed"], 100)
        self.assertEqual(done.stderr.count("warning: link"), 1)

    def test_a_second_autopilot_is_not_accepted(self):
        refused = []

        def script(autopilot):
            autopilot.fly(10)
            try:
                socket.create_connection(("127.0.0.1", self.port), timeout=10)
            except ConnectionRefusedError as error:
                refused.append(error)
            autopilot.fly()

        done, _ = self.fly(script, "--set", "duration=1")
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertEqual(len(refused), 1)

    def test_silence_and_a_port_in_use_are_refused_before_the_flight(self):
        done = self.run_hedgehop("--set", "link.wait=0.1")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "link: no autopilot within 0.1 s; start: make px4_sitl none_iris\n")
        with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as other:
            other.bind(("127.0.0.1", self.port))
            other.listen()
            done = self.run_hedgehop()
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"link.port: {self.port} is in use (instance N uses {self.port} + N)\n")

    def test_vehicles_and_rates_that_do_not_fit_are_refused(self):
        done = self.run_hedgehop("--set", "link.frame_type=0")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'vehicle.arms'", done.stderr)
        done = self.run_hedgehop("--set", f"vehicle={{use: {SOURCE}/configs/vehicles/xcell_60.yaml}}")
        self.assertEqual(done.returncode, 2)
        self.assertIn("px4 flies multicopters; the vehicle is a helicopter", done.stderr)
        done = self.run_hedgehop("--set", "physics_rate=1200")
        self.assertEqual(done.returncode, 2)
        self.assertIn("1200 Hz is no multiple of PX4's IMU rate, 250 Hz", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
