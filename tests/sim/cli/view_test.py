"""Runs `hedgehop run --view` and acts as a browser: view_test.py HEDGEHOP SCENARIO.

The flight must be equal with and without a viewer that pauses and steps it, and other sites must not control it.
"""

import http.client
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HEDGEHOP, SCENARIO = sys.argv[1:3]
OPTIONS = ["run", SCENARIO, "--renderer", "tiles", "--seed", "77", "--set", "duration=1.5", "--set", "checks=[]", "--no-video", "--no-report"]


def events(response):
    """The events of a stream as (name, data)."""
    name = ""
    for line in response:
        text = line.decode().rstrip("\n")
        if text.startswith("event: "):
            name = text[7:]
        elif text.startswith("data: "):
            yield name, json.loads(text[6:])


class View(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def hash_of(self, name):
        return json.loads((pathlib.Path(self.folder.name) / name / "result.json").read_text())["trajectory_hash"]

    def request(self, method, path, headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        self.addCleanup(connection.close)
        connection.request(method, path, headers=headers or {})
        return connection.getresponse()

    def test_a_viewer_pauses_and_steps_the_flight_and_does_not_change_it(self):
        subprocess.run([HEDGEHOP, *OPTIONS, "--out", f"{self.folder.name}/alone"], check=True, capture_output=True)
        flight = subprocess.Popen([HEDGEHOP, *OPTIONS, "--view", "--out", f"{self.folder.name}/viewed"], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True)
        for end in (flight.stderr.close, flight.wait, flight.kill):  # in reverse order: a failure may leave it paused
            self.addCleanup(end)
        self.port = int(re.search(r"http://127\.0\.0\.1:(\d+)/", flight.stderr.readline()).group(1))
        page = self.request("GET", "/").read().decode()
        self.assertIn('<canvas id="view"', page)
        self.assertEqual(self.request("POST", "/pause", {"Host": "example.org"}).status, 403)
        self.assertEqual(self.request("POST", "/pause", {"Origin": "http://example.org"}).status, 403)
        self.assertEqual(self.request("GET", "/other").status, 404)
        self.assertEqual(self.request("POST", "/pause").status, 204)
        times, seen = [], set()
        for name, data in events(self.request("GET", "/events")):
            seen.add(name)
            if name == "states":
                times += [state[0] for state in data]
                if len(times) < 4:
                    self.assertEqual(self.request("POST", "/step").status, 204)
                else:
                    self.request("POST", "/play")
            if name == "end":
                self.assertEqual(data["trajectory_hash"], self.hash_of("alone"))
                break
        self.assertEqual(flight.wait(60), 0)
        flight.stderr.read()
        self.assertEqual(self.hash_of("viewed"), self.hash_of("alone"))
        self.assertEqual(times, sorted(set(times)))
        self.assertEqual(times[0], 0.0)
        self.assertGreaterEqual(seen, {"paused", "states", "images", "end"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
