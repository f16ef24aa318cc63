"""Actions of environments: arrays of numbers in [-1, 1] that become commands."""

import math

import numpy as np

from ._native import ActionPilot, BodyRateCommand, MotorCommand

#: Body rates (roll, pitch, yaw) of an action of 1, rad/s.
RATES_RADPS = (math.pi, math.pi, 0.5 * math.pi)


def _between(action, hover, highest):
    """Returns 0 for an action of -1, the value of the hover for 0, the highest value for 1; linear between them."""
    return np.interp(action, (-1.0, 0.0, 1.0), (0.0, hover, highest))


class Velocity:
    """Forward, right, climb, turn: shares of the speed limit (twice), of 1 m/s and of 1 rad/s."""

    size, rates = 4, False

    def __init__(self, simulation):
        self._speed_limit_mps, _ = simulation.limits

    def start(self, seen):
        self._pilot = ActionPilot(seen.navigation)

    def command(self, action, seen, step_s):
        return self._pilot.fly(action, seen.navigation, self._speed_limit_mps, step_s)


class Rates:
    """Roll, pitch and yaw rate, and thrust: shares of RATES_RADPS; thrust is none at -1, that of the hover at 0, the maximum
    at 1. They replace the autopilot."""

    size, rates = 4, True

    def __init__(self, simulation):
        self._hover_thrust = simulation.direct_hover[0]

    def start(self, seen):
        pass

    def command(self, action, seen, step_s):
        return BodyRateCommand(action[:3] * RATES_RADPS, _between(action[3], self._hover_thrust, 1.0))


class Motors:
    """The speed of each rotor of a multicopter, in the order of its arms: 0 at -1, that of the hover at 0, the maximum at 1.
    They replace the autopilot."""

    rates = True

    def __init__(self, simulation):
        _, self._hover_radps, self._highest_radps = simulation.direct_hover
        self.size = len(self._hover_radps)
        if self.size == 0:
            raise ValueError("actions 'motors': the vehicle is a helicopter, which has no speed per rotor; valid: velocity, rates")

    def start(self, seen):
        pass

    def command(self, action, seen, step_s):
        return MotorCommand([_between(a, hover, self._highest_radps) for a, hover in zip(action, self._hover_radps)])


KINDS = {"velocity": Velocity, "rates": Rates, "motors": Motors}
