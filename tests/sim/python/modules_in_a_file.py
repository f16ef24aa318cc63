"""Modules that module_test.py flies from a file."""

import math
import os
import time

import hedgehop


class GoToGoal:
    def __init__(self, speed=2.0, slow_radius=4.0):
        self.speed, self.slow_radius = speed, slow_radius

    def update(self, observation):
        north, east, _ = observation.goal.p_WG_m - observation.navigation.p_WB_est_m
        distance = math.sqrt(north * north + east * east)
        speed = self.speed * (distance / self.slow_radius if distance < self.slow_radius else 1.0) / distance
        return hedgehop.VelocityCommand([north * speed, east * speed], -observation.goal.p_WG_m[2],
                                        observation.goal.heading_rad)


class Fails:
    needs = ["front"]

    def update(self, observation):
        if observation.t_ns > 500_000_000:
            raise ValueError("no\nway")
        return hedgehop.HoverCommand()


class Prints:
    def update(self, observation):
        print("seen", observation.t_ns)
        return hedgehop.HoverCommand()


class ReturnsNone:
    def update(self, observation):
        pass


class TakesNoSetup(Prints):
    def reset(self):
        pass


class Sleeps(Prints):
    def update(self, observation):
        with open(os.environ["AWAKE"], "w") as awake:
            awake.write("awake")
        time.sleep(0.2)
        return hedgehop.HoverCommand()


class NeedsAText(Prints):
    needs = "front"


class NeedsANumber(Prints):
    needs = 5


class NeedsWhatIsNotThere(Prints):
    needs = ["forward", hedgehop.CameraNeed("front", "depth")]


class CommandsOfNoType(Prints):
    commands = ["velocity", "thrust"]


class SignalsInAList(Prints):
    signals = ["nearest"]


class MetricsInAText(Prints):
    def metrics(self):
        return "3 turns"


class AnnotatesANumber(Prints):
    def annotate(self):
        return 5


class Looks:
    needs = [hedgehop.CameraNeed("front")]
    signals = {"mean_grey": "", "first_comes_last": ""}

    def reset(self, setup):
        self.setup, self.images = setup, 0
        self.band = setup.altitude_band_m or (math.inf, math.inf)

    def update(self, observation):
        self.images += 1
        image = observation.images.get("front")
        mean = math.nan if image is None else float(image.mean())
        return hedgehop.Decision(hedgehop.HoverCommand(), "look", [mean, -1.0])

    def metrics(self):
        return {"images": self.images, "lowest_m": min(self.band[0], 999.0), "highest_m": min(self.band[1], 999.0)}

    def annotate(self):
        import numpy
        return numpy.full((48, 64, 3), 200, numpy.uint8)
