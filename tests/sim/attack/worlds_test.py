"""Worlds that are shifted, rotated and mirrored: with exact sensors, the flight is shifted, rotated and mirrored as well, with
the same outcome, times and clearances."""

import math
import random
import unittest

from attacked_flights import Flights, cases, scenario

SAME_M = 1e-6


def exact_sensors():
    imu = {key: 0 for key in ("gyro_noise", "gyro_bias_walk", "gyro_offset", "accelerometer_noise", "accelerometer_bias_walk",
                              "accelerometer_offset", "misalignment")}
    return {"imu": imu, "magnetometer": {"noise": 0, "offset": 0},
            "gps": {"noise": 0, "velocity_noise": 0, "wander_horizontal": 0, "wander_vertical": 0},
            "height_sensor": {"noise": 0, "noise_per_range": 0, "offset": 0},
            "navigation": {"position_sigma": 1e-9}}  # drawn along north, east and down


class Motion:
    """A motion of the plan: mirrored east to west if requested, then rotated from north to east, then shifted."""

    def __init__(self, north=0.0, east=0.0, turn_deg=0.0, mirrors=False):
        self.north, self.east, self.turn, self.sign = north, east, math.radians(turn_deg), -1.0 if mirrors else 1.0

    def point(self, north, east):
        c, s, east = math.cos(self.turn), math.sin(self.turn), self.sign * east
        return c * north - s * east + self.north, s * north + c * east + self.east

    def place(self, values):
        north, east = self.point(values["north"], values["east"])
        moved = {**values, "north": north, "east": east}
        if "heading" in values:
            turned = self.sign * values["heading"] + math.degrees(self.turn)
            moved["heading"] = (turned + 180.0) % 360.0 - 180.0
        return moved


def motions(draw):
    return {"shifted": Motion(draw.uniform(-8, 8), draw.uniform(-8, 8)), "rotated": Motion(turn_deg=draw.uniform(-180, 180)),
            "mirrored": Motion(mirrors=True), "all": Motion(draw.uniform(-8, 8), draw.uniform(-8, 8), draw.uniform(-180, 180), True)}


def draw_world(draw):
    """Returns a start, a goal and boxes next to the way; in some worlds one box is on the way."""
    boxes = [{"name": f"box{i}", "north": draw.uniform(1, 14), "east": draw.choice([-1, 1]) * draw.uniform(2.5, 6),
              "length": draw.uniform(0.5, 3), "width": draw.uniform(0.5, 3), "height": draw.uniform(3, 9),
              "heading": draw.uniform(-180, 180)} for i in range(4)]
    if draw.random() < 0.3:
        boxes.append({"name": "in the way", "north": 9, "east": 0, "length": 1, "width": 3, "height": 9, "heading": 20})
    return {"start": {"north": 0, "east": 0, "altitude": 4, "heading": draw.uniform(-180, 180)},
            "goal": {"north": 12, "east": draw.uniform(-2, 2), "altitude": draw.uniform(3, 6), "radius": 1, "heading": 0}, "boxes": boxes}


class Worlds(unittest.TestCase):
    def fly(self, name, world, motion):
        values = scenario(duration=8, may_collide=True, avionics=exact_sensors(), start=motion.place(world["start"]),
                          goal=motion.place(world["goal"]))
        values["scene"] = {**values["scene"], "extent": 120, "boxes": [motion.place(box) for box in world["boxes"]]}
        return self.flights.fly(name, values)

    def test_shifted_rotated_and_mirrored_worlds_give_the_same_flight(self):
        draw = random.Random(4)
        self.flights = Flights()
        self.addCleanup(self.flights.scratch.cleanup)
        largest = {}
        for number in range(cases(3)):
            world = draw_world(draw)
            base = self.fly(f"base{number}", world, Motion())
            for kind, motion in motions(draw).items():
                with self.subTest(number=number, kind=kind):
                    moved = self.fly(f"{kind}{number}", world, motion)
                    self.assertEqual(moved.result["outcome"], base.result["outcome"])
                    off_m = self.off(base, moved, motion)
                    largest[kind] = max(largest.get(kind, 0.0), off_m)
                    self.assertLess(off_m, SAME_M)
                    self.assertLess(abs(moved.result["flight_time_s"] - base.result["flight_time_s"]), 0.02)
                    for figure in ("min_obstacle_clearance_m", "min_ground_clearance_m"):
                        self.assertAlmostEqual(moved.result[figure], base.result[figure], delta=SAME_M)
        print("largest differences, m:", {kind: f"{off_m:.2g}" for kind, off_m in largest.items()})

    @staticmethod
    def off(base, moved, motion):
        """Returns the largest distance of the moved path from the motion of the path."""
        off_m = 0.0
        for a, b in zip(base.rows, moved.rows):
            north, east = motion.point(a["north_m"], a["east_m"])
            off_m = max(off_m, math.dist((north, east, a["down_m"]), (b["north_m"], b["east_m"], b["down_m"])))
        return off_m


if __name__ == "__main__":
    unittest.main()
