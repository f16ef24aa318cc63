"""Clearances along flights, computed here from the logged path, the boxes of the scene and the parts of the vehicle: each
distance lies between that of two points of the bodies and the width of a slab that separates them."""

import math
import random
import unittest

from attacked_flights import Flights, KNOWN_M, cases, scenario

EXACT_M = 1e-6
BETWEEN_ROWS_M = 0.1  # maximum change between two rows: 0.06 m at 3 m/s and 50 Hz, and turns
# configs/vehicles/s900.yaml: six rotor discs, the disc of the frame, and a body. (shape, center in B, half extents), m
S900 = [("disc", (0.45 * math.cos(math.radians(a)), 0.45 * math.sin(math.radians(a)), -0.115), (0.1905, 0.015))
        for a in (30, 90, 150, -150, -90, -30)]
S900 += [("disc", (0.0, 0.0, -0.115 + 0.015 + 0.025), (0.45, 0.025)), ("box", (0.0, 0.0, 0.0), (0.18, 0.18, 0.15))]


def add(a, b, scale=1.0):
    return (a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


class Body:
    """A box or an upright disc with its axes in W: `axes` are the columns of the rotation."""

    def __init__(self, shape, center, axes, size):
        self.shape, self.center, self.axes, self.size = shape, center, axes, size
        self.radius = math.hypot(*size)

    def to_world(self, local):
        point = self.center
        for value, axis in zip(local, self.axes):
            point = add(point, axis, value)
        return point

    def nearest(self, point):
        offset = add(point, self.center, -1.0)
        local = [dot(offset, axis) for axis in self.axes]
        if self.shape == "box":
            return self.to_world([max(-s, min(s, value)) for value, s in zip(local, self.size)])
        radius, half_height = self.size
        out = math.hypot(local[0], local[1])
        scale = radius / out if out > radius else 1.0
        return self.to_world([scale * local[0], scale * local[1], max(-half_height, min(half_height, local[2]))])

    def extent(self, direction):
        """Returns the maximum of the body along a unit vector."""
        along = [dot(direction, axis) for axis in self.axes]
        if self.shape == "box":
            return dot(self.center, direction) + sum(s * abs(a) for s, a in zip(self.size, along))
        return dot(self.center, direction) + self.size[0] * math.hypot(along[0], along[1]) + self.size[1] * abs(along[2])


def distance_bounds(first, second):
    """Returns bounds of the distance by alternating projections; (0, 0) if the bodies touch."""
    a = first.center
    low, high = 0.0, math.inf
    for _ in range(20_000):
        b = second.nearest(a)
        a = first.nearest(b)
        gap = add(b, a, -1.0)
        high = math.sqrt(dot(gap, gap))
        if high < 1e-9:
            return 0.0, 0.0
        normal = tuple(value / high for value in gap)
        low = max(low, -second.extent(tuple(-value for value in normal)) - first.extent(normal))
        if high - low < 0.5 * EXACT_M:
            break
    return low, high


def box_body(box):
    heading = math.radians(box["heading"])
    axes = [(math.cos(heading), math.sin(heading), 0.0), (-math.sin(heading), math.cos(heading), 0.0), (0.0, 0.0, 1.0)]
    return Body("box", (box["north"], box["east"], -box["height"] / 2), axes, (box["length"] / 2, box["width"] / 2, box["height"] / 2))


def hull_at(row):
    """Returns the vehicle's parts at a row of trajectory.csv. Source: rotation by yaw, pitch, roll, in this order."""
    cr, sr, cp, sp, cy, sy = (f(row[f"{angle}_rad"]) for angle in ("roll", "pitch", "yaw") for f in (math.cos, math.sin))
    axes = [(cy * cp, sy * cp, -sp), (cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr),
            (cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr)]
    position = (row["north_m"], row["east_m"], row["down_m"])
    parts = []
    for shape, center, size in S900:
        at = position
        for value, axis in zip(center, axes):
            at = add(at, axis, value)
        parts.append(Body(shape, at, axes, size))
    return parts


def nearest_bounds(parts, boxes):
    low = high = math.inf
    for box in boxes:
        for part in parts:
            if math.dist(part.center, box.center) - part.radius - box.radius > high:
                continue
            bounds = distance_bounds(part, box)
            low, high = min(low, bounds[0]), min(high, bounds[1])
    return low, high


class Clearance(unittest.TestCase):
    def test_equals_that_of_the_logged_path(self):
        draw = random.Random(3)
        flights = Flights()
        self.addCleanup(flights.scratch.cleanup)
        rows = 0
        for number in range(cases(3)):
            boxes = [{"name": f"box{i}", "north": draw.uniform(2, 14), "east": draw.choice([-1, 1]) * draw.uniform(2.5, 6),
                      "length": draw.uniform(0.5, 3), "width": draw.uniform(0.5, 3), "height": draw.uniform(3, 9),
                      "heading": draw.uniform(-180, 180)} for i in range(4)]
            values = scenario(may_collide=True, duration=6, start={"north": 0, "east": 0, "altitude": 5, "heading": draw.uniform(-180, 180)},
                              goal={"north": 12, "east": draw.uniform(-3, 3), "altitude": draw.uniform(3, 7), "radius": 1})
            values["scene"]["boxes"] = boxes
            flight = flights.fly(f"flight{number}", values)
            bodies = [box_body(box) for box in boxes]
            for row in flight.rows[::5]:
                with self.subTest(number=number, t_s=row["t_s"]):
                    parts = hull_at(row)
                    ground = -max(part.extent((0.0, 0.0, 1.0)) for part in parts)
                    self.assertAlmostEqual(row["ground_clearance_m"], ground, delta=EXACT_M)
                    low, high = nearest_bounds(parts, bodies)
                    self.assertLess(high, KNOWN_M)
                    if row["clearance_m"] > 0:
                        self.assertTrue(low - EXACT_M <= row["clearance_m"] <= high + EXACT_M, (low, row["clearance_m"], high))
                        self.assertLess(high - low, EXACT_M)
                    else:
                        self.assertEqual((low, high), (0.0, 0.0))
                    rows += 1
            minimum_m = min(row["clearance_m"] for row in flight.rows)
            self.assertLessEqual(flight.result["min_obstacle_clearance_m"], minimum_m + EXACT_M)
            self.assertGreaterEqual(flight.result["min_obstacle_clearance_m"], minimum_m - BETWEEN_ROWS_M)
        self.assertGreater(rows, 5)
        print(f"{rows} rows")


if __name__ == "__main__":
    unittest.main()
