"""Flights of the program with a scripted autopilot on real sockets: linked_flight_test.py HEDGEHOP SOURCE_FOLDER."""

import json
import os
import pathlib
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import scripted_peer

HEDGEHOP, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
PEER = pathlib.Path(__file__).with_name("scripted_peer.py")
SCENARIO = """
name: linked
duration: 2
scene: {{type: tree}}
vehicle: {{use: {source}/configs/vehicles/hummingbird.yaml}}
rig: {{cameras: [{{role: front, width: 64, height: 48, fov: 75, rate: 10, channel: grey}}]}}
velocimeter: {{enabled: false}}
start: {{north: -20, east: 0, altitude: 6, heading: 30}}
avoidance: {{module: go_to_goal, speed: 1}}
goal: {{north: 40, east: 0, altitude: 6}}
checks: [{{check: altitude_band, min: 5, max: 7}}]
film: {{enabled: false}}
link: {{type: ardupilot_json, port: {port}, serial_port: 0, multicopter: {{frame_class: 1, frame_type: 0}}}}
"""


def free_port():
    """A UDP port that no process uses, and for parallel flights the port of the next instance, too. Processes begin at
    different ports, because another one may take a port after the probe."""
    for port in range(20000 + 7 * (os.getpid() % 2000), 60000, 7):
        try:
            for used in (port, port + 10):
                with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
                    probe.bind(("127.0.0.1", used))
            return port
        except OSError:
            continue
    raise RuntimeError("no free port")


class LinkedFlight(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.port = free_port()
        self.scenario = self.folder / "linked.yaml"
        self.scenario.write_text(SCENARIO.format(source=SOURCE, port=self.port))

    def run_hedgehop(self, *arguments, out="run"):
        return subprocess.run([HEDGEHOP, "run", self.scenario, "--no-report", "--renderer", "tiles", "--out", self.folder / out,
                               *arguments], capture_output=True, text=True, check=False, timeout=200)

    def fly(self, script, *arguments, out="run"):
        """Runs the program while `script(peer)` plays the autopilot."""
        peer = scripted_peer.Peer(self.port)
        self.addCleanup(peer.close)
        faults = []

        def play():
            try:
                script(peer)
            except (OSError, AssertionError) as error:
                faults.append(error)

        # The peer begins when the port is open: a packet to a closed port is lost.
        flight = subprocess.Popen([HEDGEHOP, "run", self.scenario, "--no-report", "--renderer", "tiles", "--out", self.folder / out,
                                   *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.wait_for_port(flight)
        thread = threading.Thread(target=play, daemon=True)
        thread.start()
        text, errors = flight.communicate(timeout=200)
        self.assertEqual(faults, [])  # without a join: the peer may wait for an answer that the ended program does not send
        return subprocess.CompletedProcess(flight.args, flight.returncode, text, errors)

    def wait_for_port(self, flight):
        """Waits until the program listens; its port is then in this list. Fails if the program ends before."""
        wanted = f"0100007F:{self.port:04X} "
        while wanted not in pathlib.Path("/proc/net/udp").read_text():
            if flight.poll() is not None:
                self.fail(f"hedgehop ended with status {flight.returncode} before its flight: {''.join(flight.communicate())}")
            time.sleep(0.01)

    def result(self, out="run"):
        return json.loads((self.folder / out / "result.json").read_text())

    @staticmethod
    def hover(peer):
        scripted_peer.fly(peer, scripted_peer.HoverLaw("hummingbird"), 10**9)

    def test_a_hover_flies_and_its_recording_flies_the_same_flight_again(self):
        done = self.fly(self.hover)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = self.result()
        self.assertEqual(result["outcome"], "timeout")
        link = result["link"]
        self.assertEqual(link["kind"], "ardupilot_json")
        self.assertEqual(link["peer"], "127.0.0.1")
        self.assertEqual(link["missed"] + link["malformed"] + link["strangers"], 0)
        # On the stand, the thrust exceeds the weight soon after the pulses do.
        self.assertGreaterEqual(link["start_tick"], 2 * scripted_peer.BOOT_STEPS)
        self.assertLess(link["start_tick"], 2 * scripted_peer.BOOT_STEPS + 200)
        self.assertEqual(link["frames"], link["start_tick"] + 2000)
        self.assertEqual(result["physics_rate_hz"], 1000)
        rows = (self.folder / "run" / "trajectory.csv").read_text().splitlines()
        self.assertEqual(len(rows) - 1, 201)
        recording = self.folder / "run" / "link.bin"
        # Each packet has a header of 12 bytes and 40 bytes.
        self.assertGreaterEqual(recording.stat().st_size, 52 * link["frames"])

        again = self.run_hedgehop("--replay-link", recording, out="again")
        self.assertEqual(again.returncode, 0, again.stderr)
        replayed = self.result("again")
        self.assertEqual(replayed["trajectory_hash"], result["trajectory_hash"])
        self.assertEqual(replayed["link"]["frames"], link["frames"])
        self.assertEqual(replayed["link"]["start_tick"], link["start_tick"])
        self.assertEqual((self.folder / "again" / "trajectory.csv").read_bytes(), (self.folder / "run" / "trajectory.csv").read_bytes())

        exported = subprocess.run([HEDGEHOP, "export", self.folder / "run", "--format", "euroc"], capture_output=True, text=True, check=False)
        self.assertEqual(exported.returncode, 0, exported.stderr)
        self.assertNotIn("warning", exported.stderr)

    def test_the_vehicle_takes_off_from_a_stand_and_the_clock_begins_at_the_start(self):
        law = scripted_peer.HoverLaw("hummingbird", climb_m=4.0)
        states = []

        class Watched:
            def pulses(self, state):
                states.append(state)
                return law.pulses(state)

        done = self.fly(lambda peer: scripted_peer.fly(peer, Watched(), 10**9), "--set", "link.stand_altitude=2", "--set",
                        "link.start_radius=0.3", "--set", "link.start_speed=0.5")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        first = states[0]
        self.assertEqual(first["position"], [-20, 0, -2])
        self.assertEqual(first["velocity"], [0, 0, 0])
        self.assertEqual(first["imu"]["gyro"], [0, 0, 0])
        self.assertAlmostEqual(first["imu"]["accel_body"][2], -9.81)
        # It is one step later than its packet.
        self.assertAlmostEqual(first["timestamp"], 0.001 * 2 * scripted_peer.BOOT_STEPS, places=6)
        result = self.result()
        start = result["link"]["start_tick"]
        self.assertAlmostEqual(states[start - 2 * scripted_peer.BOOT_STEPS]["position"][2], -6, delta=0.3)
        self.assertEqual(result["flight_time_s"], 2.0)

    def test_a_restart_ends_the_flight_and_leaves_all_until_then(self):
        def script(peer):
            scripted_peer.fly(peer, scripted_peer.HoverLaw("hummingbird"), 1500)
            peer.count = 0
            peer.send(peer.packet([0] * 16))

        done = self.fly(script)
        self.assertEqual(done.returncode, 1, done.stderr)
        result = self.result()
        self.assertEqual(result["outcome"], "link_lost")
        self.assertEqual(result["cause"], "link: the autopilot restarted at tick 1500")
        rows = (self.folder / "run" / "trajectory.csv").read_text().splitlines()
        self.assertEqual(len(rows) - 1, 1 + (1500 - result["link"]["start_tick"]) // 10)
        again = self.run_hedgehop("--replay-link", self.folder / "run" / "link.bin", out="again")
        self.assertEqual(again.returncode, 1)
        self.assertEqual(self.result("again")["cause"], result["cause"])
        self.assertEqual(self.result("again")["trajectory_hash"], result["trajectory_hash"])

    def test_an_autopilot_that_stops_loses_the_link(self):
        done = self.fly(lambda peer: scripted_peer.fly(peer, scripted_peer.HoverLaw("hummingbird"), 1000), "--set", "link.silence=5")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.result()["outcome"], "link_lost")
        self.assertEqual(self.result()["cause"], "link: no new packet for 5 s at tick 1000")

    def test_malformed_packets_are_counted_and_warned_of_once(self):
        def script(peer):
            law = scripted_peer.HoverLaw("hummingbird")
            state = peer.step([0] * 16)
            for _ in range(5):
                peer.send(b"\x1aH" + bytes(30))
                peer.send(b"")
                state = peer.step(law.pulses(state))
            scripted_peer.fly(peer, law, 10**9)

        done = self.fly(script)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.result()["link"]["malformed"], 10)
        self.assertEqual(done.stderr.count("link:"), 1)
        self.assertIn("warning: link: 10 packets of another format were dropped\n", done.stderr)

    def test_silence_and_a_port_in_use_are_refused_before_the_flight(self):
        done = self.run_hedgehop("--set", "link.wait=0.1")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "link: no autopilot within 0.1 s; start: arducopter --model JSON:127.0.0.1\n")
        self.assertFalse((self.folder / "run" / "result.json").exists())
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.bind(("127.0.0.1", self.port))
            done = self.run_hedgehop()
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"link.port: {self.port} is in use (instance N uses {self.port} + 10 N)\n")
        done = self.run_hedgehop("--replay-link", self.folder / "absent.bin")
        self.assertEqual(done.returncode, 2)
        done = self.run_hedgehop("--bind", "localhost")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--bind: 'localhost' is no numeric IPv4 address", done.stderr)

    def test_a_wrong_packet_before_the_flight_is_refused(self):
        done = self.fly(lambda peer: peer.send(struct.pack("<H26x", 1234)))
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "link: 28 bytes with magic 1234; expected 40 with 18458 or 72 with 29569: is the "
                                      "autopilot's model JSON?\n")

    def test_motors_and_rates_that_do_not_fit_are_refused(self):
        done = self.run_hedgehop("--set", "link.multicopter.frame_type=1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'vehicle.arms': arm 1 (0, clockwise) is no motor of FRAME_CLASS 1, TYPE 1", done.stderr)
        done = self.run_hedgehop("--set", "physics_rate=300", "--set", "avionics.imu.rate=300")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'physics_rate': 300 Hz is below the loop rate of 400 Hz", done.stderr)

    def test_a_campaign_starts_and_ends_one_autopilot_per_flight(self):
        command = f"link.command=[{sys.executable}, {PEER}, -I, '{{instance}}', --port, '{{port}}', --climb, '0']"
        done = subprocess.run([HEDGEHOP, "batch", self.scenario, "--seeds", "1:4", "-j", "2", "--renderer", "tiles", "--no-report",
                               "--set", command, "--out", self.folder / "batch"], capture_output=True, text=True, check=False, timeout=200)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        hashes = set()
        for seed in range(1, 5):
            result = json.loads(next(self.folder.glob(f"batch/*/seed{seed}/result.json")).read_text())
            self.assertEqual(result["outcome"], "timeout")
            hashes.add(result["trajectory_hash"])
        running = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True).stdout
        self.assertNotIn(f"--port {self.port}", running)
        self.assertNotIn(f"--port {self.port + 10}", running)

    def test_the_shipped_scenarios_fly(self):
        programs = self.folder / "bin"
        programs.mkdir()
        for name in ("arducopter", "arducopter-heli"):
            (programs / name).write_text(f'#!/bin/sh\nexec "{sys.executable}" "{PEER}" --port {self.port} "$@"\n')
            (programs / name).chmod(0o755)
        for scenario, pulses in (("hover_quad", 4), ("wall_hexa", 6), ("hover_helicopter", 8)):
            done = subprocess.run([HEDGEHOP, "run", SOURCE / f"configs/links/{scenario}.yaml", "--no-report", "--no-video", "--renderer",
                                   "tiles", "--set", "duration=1", "--set", f"link.port={self.port}", "--set", "link.serial_port=0",
                                   "--set", "film.enabled=false", "--out", self.folder / scenario], capture_output=True, text=True,
                                  check=False, timeout=200, env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"})
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            result = self.result(scenario)
            self.assertEqual(result["outcome"], "timeout")
            self.assertGreater(result["link"]["start_tick"], 500)
            packet = (self.folder / scenario / "link.bin").read_bytes()[-40:]
            self.assertTrue(all(800 <= pulse <= 2200 for pulse in struct.unpack("<8x16H", packet)[:pulses]), scenario)

    def test_an_autopilot_that_ends_at_once_is_reported(self):
        done = self.run_hedgehop("--set", f"link.command=[{sys.executable}, -c, 'raise SystemExit(3)']")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "link: the autopilot ended before its first packet: exit status 3; its output: "
                                      f"{self.folder}/run/autopilot.log\n")
        done = self.run_hedgehop("--set", "link.command=[no_such_autopilot]")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "link.command: 'no_such_autopilot' cannot be started: No such file or directory\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
