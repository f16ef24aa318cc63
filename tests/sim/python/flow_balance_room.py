"""Optic flow in Python: a module after [Garratt2009] sec. 2 in thirty lines, with OpenCV's flow."""

import cv2
import numpy as np

import hedgehop

#: Direction of each camera: forward, right.
DIRECTIONS = {"front": (1.0, 0.0), "right": (0.0, 1.0), "rear": (-1.0, 0.0), "left": (0.0, -1.0)}


class FlowBalance:
    """Keeps its direction, and moves away from the sides with fast optic flow."""

    needs = list(DIRECTIONS)
    signals = {f"flow_{role}_radps": "rad/s" for role in DIRECTIONS}

    def __init__(self, gain=1.0, speed=0.5):
        self.gain, self.speed = gain, speed

    def reset(self, setup):
        self.focal_px = {c.role: c.pinhole["focal_x_px"] / 2 for c in setup.cameras if c.role in DIRECTIONS}
        self.last, self.way = {}, np.array([1.0, 0.3])

    def update(self, observation):
        push, flows = np.zeros(2), []
        for role, direction in DIRECTIONS.items():
            flow_radps = self.flow_radps(role, observation)
            flows.append(flow_radps)
            push -= np.nan_to_num(flow_radps) ** 2 * np.array(direction)
        self.way += self.gain * push
        self.way /= np.linalg.norm(self.way)
        heading_rad = observation.goal.heading_rad
        cos, sin = np.cos(heading_rad), np.sin(heading_rad)
        forward, right = self.speed * self.way
        command = hedgehop.VelocityCommand([cos * forward - sin * right, sin * forward + cos * right],
                                           -observation.goal.p_WG_m[2], heading_rad)
        return hedgehop.Decision(command, "balance", flows)

    def flow_radps(self, role, observation):
        """Returns the mean angular speed of the image of a camera; NaN without two images."""
        if role not in observation.images:
            return np.nan
        image = cv2.resize(observation.images[role], None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
        before = self.last.get(role)
        self.last[role] = (observation.t_ns, image)
        if before is None:
            return np.nan
        flow_px = cv2.calcOpticalFlowFarneback(before[1], image, None, 0.5, 2, 15, 2, 5, 1.1, 0)
        seconds = 1e-9 * (observation.t_ns - before[0])
        return float(np.linalg.norm(flow_px, axis=2).mean()) / self.focal_px[role] / seconds
