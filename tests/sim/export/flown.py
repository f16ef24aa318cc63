"""Poses of a flight from the table of its run, with NumPy and OpenCV only."""

import cv2
import numpy as np


def rotation(w, x, y, z):
    """Returns the rotation matrix of a unit quaternion by its definition: v -> q v q*."""
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def flown_pose(row, p_BF, prefix=""):
    """Returns the position of a point of the body and its axes (forward, left, up) in east, north, up."""
    roll, pitch, heading = (float(row[prefix + key]) for key in ("roll_rad", "pitch_rad", "yaw_rad"))
    turns = [cv2.Rodrigues(np.array(v))[0] for v in ([roll, 0, 0], [0, pitch, 0], [0, 0, heading])]
    R_NB = turns[2] @ turns[1] @ turns[0]
    north, east, down = np.array([float(row[prefix + key]) for key in ("north_m", "east_m", "down_m")]) + R_NB @ p_BF
    flu = np.array([R_NB[:, 0], -R_NB[:, 1], -R_NB[:, 2]]).T
    return np.array([east, north, -down]), np.array([flu[1], flu[0], -flu[2]])
