"""A scripted autopilot for tests: speaks ArduPilot's JSON physics protocol over UDP, in lockstep.

It is written from the protocol and from the table of ArduPilot's frames, independently of sim/link. As a program, it replaces
`arducopter` in the tests: scripted_peer.py --model JSON:127.0.0.1 -I INSTANCE [--port PORT] [--climb M] [--steps N]
[--defaults FILE.parm]. It lets the multicopter of the parameter file climb, and holds it with a PD law of its own.
"""

import argparse
import json
import math
import pathlib
import socket
import struct
import sys

GRAVITY = 9.81
BOOT_STEPS = 200  # steps without pulses, then as many at rest

# Azimuth from the nose, clockwise from above, deg; +1 for a propeller that turns clockwise from above.
FRAMES = {
    "quad_plus": [(90, -1), (-90, -1), (0, 1), (180, 1)],
    "hexa_x": [(90, 1), (-90, -1), (-30, 1), (150, -1), (30, -1), (-150, 1)],
}
# mass kg, inertia kg m2, arm m, thrust N s2, torque per thrust m, maximum speed rad/s, cosine of the rotors' tilt
VEHICLES = {
    "hummingbird": ("quad_plus", 0.716, (0.007, 0.007, 0.012), 0.17, 8.54858e-6, 0.016, 838.0, 1.0),
    "s900_mirrored": ("hexa_x", 4.606, (0.25665, 0.25024, 0.36309), 0.45, 6.54e-5, 0.024, 612.0, math.cos(math.radians(8))),
}


def clamp(value, low, high):
    return max(low, min(high, value))


class Hold:
    """The position and heading of the first state, `climb_m` higher."""

    def __init__(self, climb_m=0.0):
        self.climb_m = climb_m
        self.hold = None

    def offsets(self, state):
        """Returns the offset from it (north, east, down, m) and the turn back to the heading (rad)."""
        n, e, d = state["position"]
        yaw = state["attitude"][2]
        if self.hold is None:
            self.hold = (n, e, d - self.climb_m, yaw)
        n0, e0, d0, yaw0 = self.hold
        return n - n0, e - e0, d - d0, math.remainder(yaw0 - yaw, 2 * math.pi)


class HoverLaw(Hold):
    """Pulses that hold a multicopter at a position and heading, from the state of the reply."""

    def __init__(self, vehicle, climb_m=0.0):
        frame, self.mass, self.inertia, self.arm, self.thrust, self.torque, self.highest, self.upright = VEHICLES[vehicle]
        self.motors = FRAMES[frame]
        super().__init__(climb_m)

    def pulses(self, state):
        off_n, off_e, off_d, turn = self.offsets(state)
        vn, ve, vd = state["velocity"]
        roll, pitch, yaw = state["attitude"]
        p, q, r = state["imu"]["gyro"]
        forward = clamp(-1.0 * off_n - 1.8 * vn, -2, 2)
        east = clamp(-1.0 * off_e - 1.8 * ve, -2, 2)
        ahead = forward * math.cos(yaw) + east * math.sin(yaw)
        right = -forward * math.sin(yaw) + east * math.cos(yaw)
        down = clamp(-2.0 * clamp(off_d, -1, 1) - 2.5 * vd, -3, 3)
        if state["velocity"] == [0, 0, 0]:
            down -= 1.0  # on the stand, the thrust must exceed the weight
        total = self.mass * (GRAVITY - down) / max(0.5, math.cos(roll) * math.cos(pitch)) / self.upright
        roll_torque = self.inertia[0] * (60 * (right / GRAVITY - roll) - 14 * p)
        pitch_torque = self.inertia[1] * (60 * (-ahead / GRAVITY - pitch) - 14 * q)
        yaw_torque = self.inertia[2] * (4 * clamp(turn, -0.5, 0.5) - 3 * r)
        count = len(self.motors)
        pulses = []
        for azimuth, clockwise in self.motors:
            a = math.radians(azimuth)
            lift = (total + 2 / self.arm * (pitch_torque * math.cos(a) - roll_torque * math.sin(a))
                    - clockwise * yaw_torque / self.torque) / count
            share = math.sqrt(max(0.0, lift) / self.thrust) / self.highest
            pulses.append(round(1000 + 1000 * clamp(share, 0, 1)))
        return pulses + [0] * (16 - count)


class HelicopterLaw(Hold):
    """Pulses that hold the X-Cell .60 of configs/links/hover_helicopter.yaml, for a swashplate H3-120."""

    HOVER_DEG, TAIL_DEG, ROLL_RAD = 5.48, 11.2, 0.0784  # collective, tail and bank of the hover
    LOW_DEG, HIGH_DEG, CYCLIC_DEG, TAIL_STOP_DEG = -2.0, 12.0, 8.0, 20.0
    CYCLIC_LIMIT = 2500 / 4500  # roll or pitch at the cyclic stop
    FACTORS = [(0.866025, 0.5), (-0.866025, 0.5), (0, -1)]  # of roll and pitch, per servo

    def pulses(self, state):
        off_n, off_e, off_d, turn = self.offsets(state)
        vn, ve, vd = state["velocity"]
        roll, pitch, yaw = state["attitude"]
        p, q, r = state["imu"]["gyro"]
        north = clamp(-0.2 * off_n - 0.6 * vn, -1, 1)
        east = clamp(-0.2 * off_e - 0.6 * ve, -1, 1)
        ahead = north * math.cos(yaw) + east * math.sin(yaw)
        right = -north * math.sin(yaw) + east * math.cos(yaw)
        lateral = clamp(math.degrees(0.1 * (self.ROLL_RAD + right / GRAVITY - roll) - 0.005 * p), -6, 6)
        longitudinal = clamp(math.degrees(0.1 * (-ahead / GRAVITY - pitch) - 0.005 * q), -6, 6)
        collective = self.HOVER_DEG + clamp(1.0 * clamp(off_d, -1, 1) + 1.2 * vd, -2, 2)
        tail = clamp(self.TAIL_DEG + 10 * turn - 6 * r, -15, 18)
        col = 0.25 + 0.5 * (collective - self.LOW_DEG) / (self.HIGH_DEG - self.LOW_DEG)
        rudder = (tail - self.TAIL_DEG) / (self.TAIL_STOP_DEG + (-self.TAIL_DEG if tail >= self.TAIL_DEG else self.TAIL_DEG))
        pulses = [1000] * 8
        for servo, (of_roll, of_pitch) in enumerate(self.FACTORS):
            share = 0.45 * self.CYCLIC_LIMIT / self.CYCLIC_DEG * (of_roll * lateral + of_pitch * longitudinal) + col
            pulses[servo] = round(1000 * (share + 1))
        pulses[3] = round(1500 + 400 * rudder)
        pulses[7] = 1700
        return pulses + [0] * 8


class Peer:
    """One socket of an autopilot. `count` is the number of the next packet."""

    def __init__(self, port, rate=1200):
        self.address = ("127.0.0.1", port)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.settimeout(60)
        self.rate = rate
        self.count = 0
        self.texts = []

    def close(self):
        self.socket.close()

    def packet(self, pulses, count=None, magic=18458):
        return struct.pack(f"<HHI{len(pulses)}H", magic, self.rate, self.count if count is None else count, *pulses)

    def send(self, data):
        self.socket.sendto(data, self.address)

    def receive(self):
        """The state of the next reply; the text lies between its last two newlines."""
        text = self.socket.recv(65536).decode("ascii")
        self.texts = [text]
        assert text[0] == "\n" and text[-1] == "\n" and text.count("\n") == 2, text
        return json.loads(text[1:-1])

    def step(self, pulses):
        """One step in lockstep: servos, then the state after them."""
        self.send(self.packet(pulses))
        state = self.receive()
        self.count += 1
        return state


def fly(peer, law, steps):
    """Boots, then flies until the simulator ends the flight or the steps are over. Returns the last state."""
    state = None
    try:
        for k in range(steps):
            pulses = [0] * 16 if k < BOOT_STEPS else [1000] * 16 if k < 2 * BOOT_STEPS else law.pulses(state)
            state = peer.step(pulses)
    except (ConnectionError, socket.timeout):
        pass  # the flight is over
    return state


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--model")
    parser.add_argument("-I", dest="instance", type=int, default=0)
    parser.add_argument("--port", type=int)
    parser.add_argument("--defaults", default="quad_plus.parm")
    parser.add_argument("--climb", type=float, help="m; default: to the start of the scenario of the parameter file")
    parser.add_argument("--steps", type=int, default=10**9)
    options, _ = parser.parse_known_args()
    peer = Peer(options.port or 9002 + 10 * options.instance)
    name = pathlib.Path(options.defaults).stem
    climb_m = {"quad_plus": 2.7, "hexa_x": 4.5, "helicopter": 3.5}[name] if options.climb is None else options.climb
    law = HelicopterLaw(climb_m) if name == "helicopter" else HoverLaw({"quad_plus": "hummingbird", "hexa_x": "s900_mirrored"}[name], climb_m)
    fly(peer, law, options.steps)
    return 0


if __name__ == "__main__":
    sys.exit(main())
