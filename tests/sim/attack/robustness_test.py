"""The robustness of random formulas, computed here by its definition from the tables of the flight."""

import math
import random
import unittest

from attacked_flights import Flights, KNOWN_M, cases, scenario

FORMULAS = 20  # per flight
BOX = {"name": "tower", "north": 8, "east": 2.5, "length": 2, "width": 2, "height": 20, "heading": 30}


def signals_of(flight, goal, rate_hz):
    """Returns {signal: values at the control ticks}, as docs/falsify.md defines them."""
    def column(name):
        return [row[name] for row in flight.rows]

    def distances(kind, column_name):
        values = [min(KNOWN_M if d is None else d, KNOWN_M) for d in column(column_name)]
        closest = flight.result[f"closest_{kind}"]
        if closest:  # counts at the tick before it
            tick = min(int(closest["t_s"] * rate_hz + 1e-9), len(values) - 1)
            values[tick] = min(values[tick], closest["distance_m"])
        return values

    rows = flight.rows
    north, east = column("north_m"), column("east_m")
    obstacle, ground = distances("obstacle", "clearance_m"), distances("ground", "ground_clearance_m")
    status, decisions = [], [(float(d["t_s"]), d["status"]) for d in flight.decisions]
    for row in rows:
        status.append(([word for t_s, word in decisions if t_s <= row["t_s"]] or [""])[-1])
    return {
        "north": north, "east": east, "altitude": [-d for d in column("down_m")],
        "speed": [math.sqrt(r["v_north_mps"] ** 2 + r["v_east_mps"] ** 2 + r["v_down_mps"] ** 2) for r in rows],
        "climb": [-v for v in column("v_down_mps")],
        "roll": [math.degrees(a) for a in column("roll_rad")], "pitch": [math.degrees(a) for a in column("pitch_rad")],
        "tilt": [math.degrees(math.acos(max(-1.0, min(1.0, math.cos(r["roll_rad"]) * math.cos(r["pitch_rad"]))))) for r in rows],
        "tracking_error": [math.nan if r["cmd_v_north_mps"] is None else
                           math.hypot(r["cmd_v_north_mps"] - r["v_north_mps"], r["cmd_v_east_mps"] - r["v_east_mps"]) for r in rows],
        "estimation_error": [math.dist([r[f"est_{axis}_m"] for axis in ("north", "east", "down")],
                                       [r[f"{axis}_m"] for axis in ("north", "east", "down")]) for r in rows],
        "goal_distance": [math.hypot(n - goal["north"], e - goal["east"]) for n, e in zip(north, east)],
        "obstacle_clearance": obstacle, "ground_clearance": ground, "clearance": [min(a, b) for a, b in zip(obstacle, ground)],
        "status": status}


def draw_formula(depth, signals, draw):
    """Returns a random formula as a tree; about half of its limits are values of the flight."""
    if depth == 0 or draw.random() < 0.15:
        if draw.random() < 0.1:
            return ("status", draw.choice(["cruise", "avoid"]))
        name = draw.choice(sorted(set(signals) - {"status"}))
        value = draw.choice([value for value in signals[name] if not math.isnan(value)] or [0.0])
        return ("compare", name, draw.choice(["<", "<=", ">", ">="]), round(value + draw.choice([0, draw.uniform(-1, 1)]), 6))
    kind = draw.choice(["not", "and", "or", "->", "always", "eventually", "until"])
    parts = [draw_formula(depth - 1, signals, draw) for _ in range(1 if kind in ("not", "always", "eventually") else 2)]
    first = draw.choice([0, draw.randint(0, 40)])
    last = draw.choice([None, first + draw.randint(0, 40)])
    return (kind, parts, first, last) if kind in ("always", "eventually", "until") else (kind, parts)


def text_of(formula, rate_hz):
    kind = formula[0]
    if kind == "status":
        return f"(status == {formula[1]})"
    if kind == "compare":
        return f"({formula[1]} {formula[2]} {formula[3]:.6f})"
    parts = [text_of(part, rate_hz) for part in formula[1]]
    if kind == "not":
        return f"(not {parts[0]})"
    if kind in ("and", "or", "->"):
        return f"({parts[0]} {kind} {parts[1]})"
    first, last = formula[2] / rate_hz, "end" if formula[3] is None else formula[3] / rate_hz
    if kind == "until":
        return f"({parts[0]} until[{first},{last}] {parts[1]})"
    return f"({kind}[{first},{last}] {parts[0]})"


def ticks_ahead(formula):
    """Returns how far a formula looks ahead, in ticks, without its open intervals."""
    if formula[0] in ("status", "compare"):
        return 0
    inside = max(ticks_ahead(part) for part in formula[1])
    return inside + (formula[2] if len(formula) > 2 and formula[3] is None else formula[3] if len(formula) > 2 else 0)


def robustness(formula, signals, unknown=-math.inf):
    """Returns the robustness at every tick, by the definition; `unknown` is that of a comparison with NaN."""
    kind, count = formula[0], len(signals["north"])
    if kind == "status":
        return [math.inf if word == formula[1] else -math.inf for word in signals["status"]]
    if kind == "compare":
        margins = [value - formula[3] if formula[2] in (">", ">=") else formula[3] - value for value in signals[formula[1]]]
        return [unknown if math.isnan(margin) else margin for margin in margins]
    parts = [robustness(part, signals, -unknown if i == 0 and kind in ("not", "->") else unknown) for i, part in enumerate(formula[1])]
    if kind == "not":
        return [-value for value in parts[0]]
    if kind in ("and", "or", "->"):
        left = [-value for value in parts[0]] if kind == "->" else parts[0]
        return [(min if kind == "and" else max)(a, b) for a, b in zip(left, parts[1])]
    first, last = formula[2], count if formula[3] is None else formula[3]
    result = []
    for now in range(count):
        window = range(now + first, min(now + last, count - 1) + 1)
        if kind == "until":
            best, so_far = -math.inf, min(parts[0][now:now + first], default=math.inf)
            for tick in window:
                best = max(best, min(parts[1][tick], so_far))
                so_far = min(so_far, parts[0][tick])
            result.append(best)
        else:
            best = min if kind == "always" else max
            result.append(best((parts[0][tick] for tick in window), default=math.inf if kind == "always" else -math.inf))
    return result


class RobustnessOfFormulas(unittest.TestCase):
    def test_equals_its_definition_on_the_tables_of_the_flight(self):
        draw = random.Random(2)
        flights = Flights()
        self.addCleanup(flights.scratch.cleanup)
        rate_hz = 50
        for number in range(cases(3)):
            values = scenario(control_rate=rate_hz, may_collide=True)
            values["goal"]["north"], values["goal"]["east"] = draw.uniform(3, 12), draw.uniform(-2, 4)
            values["scene"]["boxes"] = [BOX]
            signals = signals_of(flights.fly(f"base{number}", values), values["goal"], rate_hz)
            formulas = []
            while len(formulas) < FORMULAS:
                formula = draw_formula(draw.randint(1, 3), signals, draw)
                if ticks_ahead(formula) <= rate_hz * values["duration"]:
                    formulas.append(formula)
            values["checks"] = [{"check": "formula", "name": f"f{i}", "formula": text_of(formula, rate_hz)} for i, formula in enumerate(formulas)]
            checks = flights.fly(f"judged{number}", values).result["checks"]
            for formula, check in zip(formulas, checks, strict=True):
                expected = robustness(formula, signals)[0]
                with self.subTest(formula=text_of(formula, rate_hz)):
                    self.assertEqual(check["passed"], expected >= 0 if abs(expected) > 1e-9 else check["passed"])
                    if math.isinf(expected):
                        self.assertIsNone(check["value"])
                    else:
                        self.assertAlmostEqual(check["value"], expected, delta=1e-9 * max(1.0, abs(expected)))


if __name__ == "__main__":
    unittest.main()
