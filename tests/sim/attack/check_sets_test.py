"""Random sets of checks at their bounds. The value of each check is computed here from the table of the flight; clearances, metrics
and the time of arrival come from result.json. Text, JSON, exit status, JUnit file, CSV file and pages must have its verdict."""

import json
import math
import operator
import random
import re
import unittest
import xml.etree.ElementTree

from attacked_flights import Flights, KNOWN_M, cases, scenario, table

HOLDS = {"<=": operator.le, ">=": operator.ge, ">": operator.gt}
BOX = {"name": "tower", "north": 12, "east": 1, "length": 4, "width": 4, "height": 20, "heading": 20}
BASES = {"reaches": {}, "times_out": {"goal": {"north": 20, "east": 1, "altitude": 5, "radius": 1}},
         "collides": {"duration": 8, "start": {"north": 6, "east": 1, "altitude": 5, "heading": 0},
                      "goal": {"north": 30, "east": 1, "altitude": 5, "radius": 1}}}


def base(kind):
    values = scenario(**BASES[kind])
    values["scene"]["boxes"] = [BOX]
    return values


def measured(flight):
    """Returns {check: (value, direction)} from the table and the result."""
    rows, result = flight.rows, flight.result

    def nearest(kind):
        return min(result[f"min_{kind}_clearance_m"] or KNOWN_M, KNOWN_M)

    speed_mps = max(math.hypot(r["v_north_mps"], r["v_east_mps"], r["v_down_mps"]) for r in rows)
    known = {"max_speed": (speed_mps, "<="), "speed_formula": (speed_mps, "<="),
             "max_tilt": (max(math.degrees(math.acos(math.cos(r["roll_rad"]) * math.cos(r["pitch_rad"]))) for r in rows), "<="),
             "highest": (max(-r["down_m"] for r in rows), "<="),
             "lowest": (min(-r["down_m"] for r in rows), ">="),
             "north": (max(r["north_m"] for r in rows), "<="),
             "west": (min(r["east_m"] for r in rows), ">="),
             "clear_of_ground": (nearest("ground"), ">="),
             "clear_of_obstacles": (nearest("obstacle"), ">="),
             "jerk_rms": (result["metrics"]["jerk_rms"], "<="),
             "mission_progress": (result["metrics"]["mission_progress"], ">=")}
    return {**known, "arrives": (result["flight_time_s"], "<=")} if result["outcome"] == "reached" else known


def make_check(kind, limit, number):
    """Returns a check of one measured quantity, its name and its further conditions."""
    wide = 1000.0
    box = {"check": "inside_box", "north_min": -wide, "north_max": wide, "east_min": -wide, "east_max": wide}
    return {"max_speed": {"check": "max_speed", "at_most": limit},
            "max_tilt": {"check": "max_tilt", "at_most": limit},
            "highest": {"check": "altitude_band", "min": -wide, "max": limit},
            "lowest": {"check": "altitude_band", "min": limit, "max": wide},
            "north": {**box, "north_max": limit},
            "west": {**box, "east_min": limit},
            "clear_of_ground": {"check": "min_clearance", "at_least": limit, "to": "ground"},
            "clear_of_obstacles": {"check": "min_clearance", "at_least": limit, "to": "obstacles"},
            "jerk_rms": {"check": "metric", "name": "jerk_rms", "at_most": limit},
            "mission_progress": {"check": "metric", "name": "mission_progress", "at_least": limit},
            "speed_formula": {"check": "formula", "name": f"formula {number}", "formula": f"always (speed <= {limit:.17f})"},
            "arrives": {"check": "reached_goal", "before": limit}}[kind]


def limit_at(value, direction, kind, draw):
    """Returns a limit at, next to, or far from the value; and whether the value satisfies it."""
    step = 1e-9 * max(1.0, abs(value))  # above the rounding of a norm and of degrees
    rounded = kind in ("max_speed", "speed_formula", "max_tilt")
    exact = [value, math.nextafter(value, math.inf), math.nextafter(value, -math.inf)]
    limit = draw.choice([value + step, value - step, value + draw.uniform(0, 1), value - draw.uniform(0, 1)] +
                        ([] if rounded else exact))
    if kind not in ("lowest", "highest", "north", "west", "mission_progress"):
        limit = max(limit, 1e-6)
    if kind == "arrives":
        limit = min(limit, 3.0)  # the duration
    return limit, HOLDS[direction](value, limit)


class CheckSets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.flights = Flights()
        cls.base = {kind: cls.flights.fly(kind, base(kind)) for kind in BASES}

    @classmethod
    def tearDownClass(cls):
        cls.flights.scratch.cleanup()

    def draw_set(self, draw):
        """Returns a scenario with random checks and their expected verdicts."""
        kind = draw.choice(sorted(BASES))
        values, known = base(kind), measured(self.base[kind])
        checks, expected = [], []
        for number in range(draw.randint(1, 6)):
            name = draw.choice(sorted(known))
            limit, holds = limit_at(*known[name], name, draw)
            check = make_check(name, limit, number)
            checks.append(check)
            expected.append((check.get("name", check["check"]), holds))
        values["may_collide"] = draw.random() < 0.5
        if not values["may_collide"]:
            expected.append(("no_collision", self.base[kind].result["outcome"] != "collided"))
        values["checks"] = checks
        return values, expected

    def test_text_json_exit_status_junit_csv_and_pages_agree(self):
        draw = random.Random(1)
        sets = {f"set{number}": self.draw_set(draw) for number in range(cases(8))}
        for name, (values, _) in sets.items():
            self.flights.write(name, values)
        done = self.flights.hedgehop("batch", *(f"{name}.yaml" for name in sets), "--out", "batch", "--junit", "j.xml")
        self.assertEqual(done.returncode, 0 if all(holds for _, expected in sets.values() for _, holds in expected) else 1, done.stderr)
        suites = {suite.get("name"): suite for suite in xml.etree.ElementTree.parse(self.flights.folder / "j.xml").getroot()}
        rows = {row["group"]: row for row in table(self.flights.folder / "batch/batch.csv")}
        columns = {column["name"]: column["values"] for column in self.page("batch")["columns"]}
        shown = dict(zip(columns["group"], columns["passed"]))
        for name, (values, expected) in sets.items():
            with self.subTest(name=name, checks=values["checks"]):
                passes = all(holds for _, holds in expected)
                result = self.agrees_alone(name, values, expected)
                cases_of_suite = list(suites[f"{name}/seed1"])[2:]  # after the properties and the flight
                self.assertEqual([case.find("failure") is None for case in cases_of_suite], [holds for _, holds in expected])
                self.assertEqual([re.sub(r" \(\d+\)$", "", case.get("name")) for case in cases_of_suite], [check for check, _ in expected])
                self.assertEqual(rows[name]["passed"], str(int(passes)))
                self.assertEqual(self.values_of_csv(rows[name], expected), [check["value"] for check in result["checks"]])
                self.assertEqual(shown[name], int(passes))

    def agrees_alone(self, name, values, expected):
        """Flies it with `run`; returns the result."""
        flight = self.flights.fly(name, values, "--renderer", "tiles")
        self.assertEqual(flight.status, 0 if all(holds for _, holds in expected) else 1)
        checks = flight.result["checks"]
        self.assertEqual([(check["name"], check["passed"]) for check in checks], expected)
        for check in checks:
            self.assertEqual(HOLDS[check["must"]](check["value"], check["limit"]), check["passed"], check)
        printed = re.findall(r"^  (pass|FAIL)  (.{16,}?) (-?[0-9.e+-]+)", flight.out, re.MULTILINE)
        self.assertEqual([(word == "pass", check.strip()) for word, check, _ in printed], [(holds, check) for check, holds in expected])
        for (_, _, number), check in zip(printed, checks):
            self.assertAlmostEqual(float(number), check["value"], delta=1e-3 * max(1.0, abs(check["value"])))
        self.assertEqual(self.page(f"runs/{name}")["result"]["checks"], checks)
        return flight.result

    def page(self, folder):
        text = (self.flights.folder / folder / "report.html").read_text()
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)[1])

    @staticmethod
    def values_of_csv(row, expected):
        """Returns the values of the checks; the second of a name has a number."""
        seen, values = {}, []
        for check, _ in expected:
            seen[check] = seen.get(check, 0) + 1
            values.append(float(row[f"check.{check}" + (f".{seen[check]}" if seen[check] > 1 else "")]))
        return values


if __name__ == "__main__":
    unittest.main()
