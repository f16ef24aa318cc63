"""The scores of a search with `score: sbft`, computed a second time from the files of its flights alone.

usage: competition_suite_test.py PROGRAM SOURCE
"""

import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SEED = 40
SCENARIO = f"""name: straight
seed: {SEED}
duration: 12
scene: {{type: park, extent: 60, trees: 0, bushes: 0, rocks: 0, vehicles: 0, texture_size: 64}}
vehicle: {{use: {SOURCE}/configs/vehicles/s900.yaml}}
velocimeter: {{enabled: false}}
wind: {{speed: 1, spread: 180, turbulence_w20: 3}}
start: {{north: 0, east: 0, altitude: 5}}
goal: {{north: 20, east: 0, altitude: 5, radius: 1}}
avoidance: {{module: go_to_goal, speed: 3}}
film: {{enabled: false}}
drawing: {{renderer: tiles}}
checks: [{{check: no_collision}}]
"""
SEARCH = """scenario: straight.yaml
score: sbft
design: {budget: 30, failures: 6}
boxes: {count: 2, north: [4, 16], east: [-10, 10], length: [1, 5], width: [1, 5], heading: [0, 90]}
constraints: [boxes_inside, boxes_apart, way_exists]
"""


def corners(box):
    c, s = math.cos(math.radians(box["heading"])), math.sin(math.radians(box["heading"]))
    return [(box["north"] + c * x - s * y, box["east"] + s * x + c * y)
            for x, y in ((0.5 * box["length"] * i, 0.5 * box["width"] * k) for i, k in ((1, 1), (1, -1), (-1, -1), (-1, 1)))]


def edges(polygon):
    return list(zip(polygon, polygon[1:] + polygon[:1]))


def span(polygon, x):
    """The interval of y in which the line at x crosses a convex polygon."""
    ys = [p[1] + (q[1] - p[1]) * (x - p[0]) / (q[0] - p[0]) for p, q in edges(polygon) if p[0] != q[0] and min(p[0], q[0]) <= x <= max(p[0], q[0])]
    return (min(ys), max(ys)) if ys else (0.0, 0.0)


def common_area(a, b):
    """Integral over x of the common interval of y, which is linear between corners and crossings of edges."""
    xs = [p[0] for p in a + b]
    for p, q in edges(a):
        for r, s in edges(b):
            cross = (q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0])
            if cross:
                xs.append(p[0] + (q[0] - p[0]) * ((r[0] - p[0]) * (s[1] - r[1]) - (r[1] - p[1]) * (s[0] - r[0])) / cross)
    low, high = max(min(p[0] for p in polygon) for polygon in (a, b)), min(max(p[0] for p in polygon) for polygon in (a, b))
    xs = sorted({x for x in xs if low < x < high} | {low, high}) if low < high else []

    def width(x):
        (a0, a1), (b0, b1) = span(a, x), span(b, x)
        return max(0.0, min(a1, b1) - max(a0, b0))

    return sum((right - left) * width(0.5 * (left + right)) for left, right in zip(xs, xs[1:]))


def similarity(a, b):
    common = sum(common_area(corners(one), corners(other)) for one in a for other in b)
    return common / (sum(box["length"] * box["width"] for box in a + b) - common)


def points(distance):
    return 5 if distance < 0.25 else 2 if distance < 1 else 1 if distance < 1.5 else 0


class Suite(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        (cls.folder / "straight.yaml").write_text(SCENARIO)
        (cls.folder / "scored.yaml").write_text(SEARCH)
        cls.done = cls.hedgehop("falsify", "scored.yaml", "--out", "out")
        cls.search = json.loads((cls.folder / "out/falsify.json").read_text())
        cls.suite = cls.search["suite"]

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def hedgehop(cls, *words):
        return subprocess.run([PROGRAM, *words], cwd=cls.folder, capture_output=True, text=True)

    def run_files(self, test):
        """(result, boxes) of each run, from the folder of its flight."""
        for run in test["runs"]:
            folder = self.folder / "out" / run["flight"]
            yield json.loads((folder / "result.json").read_text()), yaml.safe_load((folder / "scenario.yaml").read_text())["scene"]["boxes"]

    def test_scores_equal_those_of_the_flights_files(self):
        self.assertEqual(self.done.returncode, 1, self.done.stdout + self.done.stderr)
        scores, fields = [], []
        for test in self.suite["tests"]:
            runs = list(self.run_files(test))
            self.assertEqual([run["seed"] for run in test["runs"]], [SEED + k for k in range(1, 6)])
            distances = [run["min_obstacle_clearance_m"] if run["min_obstacle_clearance_m"] is not None else math.inf for run, _ in runs]
            minutes = sum(run["flight_time_s"] for run, _ in runs) / 5 / 60
            score = sum(map(points, distances)) / 5 * 10 / (2 ** 2 * minutes)
            self.assertAlmostEqual(test["score"], score, delta=1e-9 * max(1, score))
            self.assertEqual(test["confirmed"], max(distances) < 1.5)
            scores.append(score)
            fields.append(runs[0][1])
        confirmed = [i for i, test in enumerate(self.suite["tests"]) if test["confirmed"]]
        self.assertGreater(len(confirmed), 2)
        for key, chosen in (("of_confirmed", confirmed), ("of_all", range(len(scores)))):
            pairs = [similarity(fields[i], fields[k]) for i in chosen for k in chosen if k < i]
            self.assertGreater(max(pairs), 0)
            failure, diversity = sum(scores[i] for i in chosen), 1 - sum(pairs) / len(pairs)
            self.assertAlmostEqual(self.suite[key]["failure_score"], failure, delta=1e-9 * failure)
            self.assertAlmostEqual(self.suite[key]["diversity_score"], diversity, delta=1e-6)
            self.assertIn(f"failure score {failure:.2f}, diversity score {diversity:.2f}", self.done.stdout)

    def test_a_test_that_is_safe_in_one_run_does_not_count(self):
        confirmed = [test for test in self.suite["tests"] if test["confirmed"]]
        self.assertEqual(self.suite["confirmed"], len(confirmed))
        self.assertIn(f"confirmed: {len(confirmed)} of {len(self.suite['tests'])} tests", self.done.stdout)
        self.assertEqual(len(list((self.folder / "out/counterexamples").glob("*.yaml"))), len(confirmed))

    def test_stored_test_repeats_its_first_run(self):
        test = next(test for test in self.suite["tests"] if test["confirmed"])
        self.hedgehop("run", f"out/{test['file']}", "--out", "again")
        again = json.loads((self.folder / "again/result.json").read_text())
        first, _ = next(iter(self.run_files(test)))
        self.assertEqual(again["trajectory_hash"], first["trajectory_hash"])

    def test_page_lists_tests_and_scores(self):
        if not (shutil.which("chromium") and shutil.which("node")):
            self.skipTest("needs chromium and node")
        visit = {"page": str(self.folder / "out/report.html"), "steps": "return document.getElementById('search-card').textContent"}
        done = subprocess.run(["node", SOURCE / "tests/sim/pages/browser.mjs", "chromium"], input=json.dumps(visit) + "\n",
                              capture_output=True, text=True, check=True)
        seen = json.loads(done.stdout.splitlines()[0])
        self.assertEqual(seen["errors"], [])
        scores = self.suite["of_confirmed"]
        self.assertIn(f"failure score {scores['failure_score']:.2f}, diversity score {scores['diversity_score']:.2f}", seen["value"])
        for test in self.suite["tests"]:
            self.assertIn(f"{test['mean_points']:.1f}{test['score']:.2f}{'yes' if test['confirmed'] else 'no'}", seen["value"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
