"""A scripted PX4 for tests: speaks the simulator protocol over TCP in lockstep, and OFFBOARD commands over UDP.

It is written from the definitions of MAVLink 2 and from PX4's documentation, independently of sim/mavlink. As a program, it
replaces `px4` in the tests: px4_peer.py -i INSTANCE [--port PORT] [--states N]. It flies the iris of
configs/links/px4_wall.yaml with the PD law of scripted_peer.py.
"""

import argparse
import math
import socket
import struct
import sys
import time

import scripted_peer

BOOT_STATES = 25  # states before the first controls
READY_STATES = 100  # states before the estimator is ready to arm
# id: (CRC_EXTRA, struct format)
MESSAGES = {
    0: (50, "<IBBBBB"),                       # HEARTBEAT
    76: (152, "<7fHBBB"),                     # COMMAND_LONG
    77: (143, "<HBBiBB"),                     # COMMAND_ACK
    84: (143, "<I11fHBBB"),                   # SET_POSITION_TARGET_LOCAL_NED
    93: (47, "<QQ16fB"),                      # HIL_ACTUATOR_CONTROLS
    107: (108, "<Q13fIB"),                    # HIL_SENSOR
    113: (124, "<QiiiHHHhhhHBBBH"),           # HIL_GPS
    115: (4, "<Q4f3fiiihhhHHhhh"),            # HIL_STATE_QUATERNION
    253: (83, "<B50sHB"),                     # STATUSTEXT
    330: (23, "<Q72HHHBBffB"),                # OBSTACLE_DISTANCE
}
HEARTBEAT, COMMAND, ACK, SETPOINT, CONTROLS, SENSOR, GPS, STATE, OBSTACLES = 0, 76, 77, 84, 93, 107, 113, 115, 330
OFFBOARD = 6 << 16
POSITION, VELOCITY, HOVER = 0x09F8, 0x09C7, 0x05C7

scripted_peer.FRAMES["quad_x"] = [(45, -1), (-135, -1), (-45, 1), (135, 1)]
scripted_peer.VEHICLES["iris"] = ("quad_x", 1.52, (0.029, 0.029, 0.055), 0.255, 5.84e-6, 0.06, 1100.0, 1.0)


def crc(data, extra):
    value = 0xFFFF
    for byte in data + bytes([extra]):
        value ^= byte
        for _ in range(8):
            value = (value >> 1) ^ (0x8408 if value & 1 else 0)
    return value


class Codec:
    """Frames of one component, both ways. Every frame that it reads must be valid."""

    def __init__(self):
        self.sequence = 0
        self.rest = b""

    def frame(self, message_id, *values):
        extra, layout = MESSAGES[message_id]
        payload = struct.pack(layout, *values).rstrip(b"\0") or b"\0"
        head = struct.pack("<BBBBBB", len(payload), 0, 0, self.sequence, 1, 1) + message_id.to_bytes(3, "little")
        self.sequence = (self.sequence + 1) % 256
        return b"\xfd" + head + payload + struct.pack("<H", crc(head + payload, extra))

    def read(self, data):
        """The messages that the bytes complete, as (id, values)."""
        self.rest += data
        while len(self.rest) >= 12 and len(self.rest) >= self.rest[1] + 12:
            size = self.rest[1] + 12
            frame, self.rest = self.rest[:size], self.rest[size:]
            assert frame[0] == 0xFD and frame[2] == 0, frame.hex()
            message_id = int.from_bytes(frame[7:10], "little")
            if message_id not in MESSAGES:
                continue
            extra, layout = MESSAGES[message_id]
            assert crc(frame[1:-2], extra) == int.from_bytes(frame[-2:], "little"), frame.hex()
            yield message_id, struct.unpack(layout, frame[10:-2].ljust(struct.calcsize(layout), b"\0"))


class Px4:
    """One autopilot. `states` counts the HIL_SENSOR messages."""

    def __init__(self, port=4560, offboard_port=14540, autopilot_port=14580, vehicle="iris"):
        self.stream = self.connect(port)
        self.datagrams = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.datagrams.bind(("127.0.0.1", autopilot_port))
        self.datagrams.setblocking(False)
        self.companion = ("127.0.0.1", offboard_port)
        self.codec, self.messages = Codec(), Codec()
        self.law = scripted_peer.HoverLaw(vehicle)
        self.motors = len(self.law.motors)
        self.states = 0
        self.times_us, self.gps, self.obstacles, self.commands, self.setpoints = [], [], [], [], []
        self.updated = {}  # bits of fields_updated: count
        self.origin = None
        self.state = None
        self.mode, self.armed = 0, False
        self.setpoint, self.setpoint_us = None, []
        self.answers = True
        self.stream.sendall(self.codec.frame(COMMAND, 115.0, 5000.0, 0, 0, 0, 0, 0, 511, 0, 0, 0) + self.heartbeat(self.codec))

    @staticmethod
    def connect(port):
        for _ in range(100000):
            try:
                stream = socket.create_connection(("127.0.0.1", port), timeout=60)
                stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                return stream
            except ConnectionRefusedError:
                time.sleep(0.0005)
        raise TimeoutError("the simulator does not listen")

    def close(self):
        self.stream.close()
        self.datagrams.close()

    def heartbeat(self, codec):
        return codec.frame(HEARTBEAT, self.mode, 2, 12, 129 if self.armed else 1, 4, 3)

    def fly(self, states=10**9):
        """Flies until the simulator ends the flight or the states are over."""
        try:
            while self.states < states:
                data = self.stream.recv(65536)
                if not data:
                    return
                for message in self.codec.read(data):
                    self.take(*message)
        except (ConnectionError, socket.timeout):
            pass  # the flight is over

    def take(self, message_id, values):
        if message_id == SENSOR:
            assert not self.times_us or values[0] > self.times_us[-1], "time must rise"
            self.times_us.append(values[0])
            for bits in (0x3F, 0x1C0, 0x1A00):
                self.updated[bits] = self.updated.get(bits, 0) + (values[14] & bits == bits)
        elif message_id == GPS:
            self.gps.append(values)
        elif message_id == STATE:
            assert values[0] == self.times_us[-1], "with the sensors of its time"
            self.state = self.decoded(values)
            self.states += 1
            if self.states > BOOT_STATES:
                self.answer()

    def decoded(self, values):
        """The true state as the law of scripted_peer reads it; positions are from the first one."""
        w, x, y, z = values[1:5]
        latitude, longitude, altitude = values[8:11]
        self.origin = self.origin or (latitude, longitude, altitude)
        meters = math.radians(1e-7) * 6371000
        north = (latitude - self.origin[0]) * meters
        east = (longitude - self.origin[1]) * meters * math.cos(math.radians(1e-7 * self.origin[0]))
        return {"position": [north, east, -0.001 * (altitude - self.origin[2])],
                "velocity": [0.01 * v for v in values[11:14]],
                "attitude": [math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), math.asin(2 * (w * y - z * x)),
                             math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))],
                "imu": {"gyro": list(values[5:8])}}

    def answer(self):
        self.exchange_messages()
        controls = [0.0] * 16
        if self.armed:
            self.follow()
            pulses = self.law.pulses(self.state)
            controls[: self.motors] = [(pulse - 1000) / 1000 for pulse in pulses[: self.motors]]
        if self.answers:
            self.stream.sendall(self.codec.frame(CONTROLS, self.times_us[-1], 1, *controls, 129 if self.armed else 1))

    def follow(self):
        """Moves the law's hold point so that it follows the last setpoint."""
        if self.setpoint is None:
            return
        north, east, down, vn, ve, vd = self.setpoint[1:7]
        yaw, mask = self.setpoint[10], self.setpoint[12]
        n, e, d = self.state["position"]
        if mask == POSITION:
            self.law.hold = (n + scripted_peer.clamp(north - n, -2, 2), e + scripted_peer.clamp(east - e, -2, 2), down, yaw)
        else:
            keep = self.law.hold[3] if self.law.hold else self.state["attitude"][2]
            self.law.hold = (n + 1.8 * vn, e + 1.8 * ve, d + 1.25 * vd, yaw if mask == VELOCITY else keep)

    def exchange_messages(self):
        if self.states % 250 == BOOT_STATES + 1:
            self.datagrams.sendto(self.heartbeat(self.messages), self.companion)
        while True:
            try:
                data = self.datagrams.recv(65536)
            except BlockingIOError:
                return
            for message_id, values in self.messages.read(data):
                if message_id == SETPOINT:
                    self.setpoint = values
                    self.setpoints.append(values)
                    self.setpoint_us.append(self.times_us[-1])
                elif message_id == OBSTACLES:
                    self.obstacles.append(values)
                elif message_id == COMMAND:
                    self.obey(values)

    def obey(self, values):
        command = values[7]
        self.commands.append(command)
        accepted = False
        if command == 176:  # OFFBOARD needs setpoints at more than 2 Hz
            accepted = values[:2] == (1, 6) and len(self.setpoint_us) > 2 and self.setpoint_us[-1] - self.setpoint_us[-3] < 1e6
            self.mode = OFFBOARD if accepted else self.mode
        elif command == 400:
            accepted = values[0] == 1 and self.mode == OFFBOARD and self.states > READY_STATES
            self.armed = self.armed or accepted
        self.datagrams.sendto(self.messages.frame(ACK, command, 0 if accepted else 1, 0, 0, 0, 0) + self.heartbeat(self.messages),
                              self.companion)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("-i", dest="instance", type=int, default=0)
    parser.add_argument("--port", type=int)
    parser.add_argument("--states", type=int, default=10**9)
    options, _ = parser.parse_known_args()
    autopilot = Px4(options.port or 4560 + options.instance, 14540 + options.instance, 14580 + options.instance)
    autopilot.fly(options.states)
    return 0


if __name__ == "__main__":
    sys.exit(main())
