"""Reads a folder in the TUM layout with NumPy and OpenCV only."""

import cv2
import numpy as np


def lines(file):
    return [line.split() for line in file.read_text().splitlines() if line[0] != "#"]


class Tum:
    """Times are the texts of the files."""

    def __init__(self, root):
        self.root = root
        self.images = dict(lines(root / "rgb.txt"))
        self.depths = dict(lines(root / "depth.txt"))
        self.truth = {words[0]: np.array(words[1:], float) for words in lines(root / "groundtruth.txt")}
        calibration = cv2.FileStorage(str(root / "calibration.yaml"), cv2.FILE_STORAGE_READ)
        self.depth_per_meter = calibration.getNode("depth_per_meter").real()
        self.K = calibration.getNode("camera_matrix").mat()

    def points(self, t_text, most_m):
        """Returns pixels without an edge, and their positions in the camera's frame."""
        units = cv2.imread(str(self.root / self.depths[t_text]), cv2.IMREAD_UNCHANGED)
        assert units.dtype == np.uint16
        z = units / self.depth_per_meter
        z_far = np.where(z > 0, z, 1e3)
        rough = cv2.dilate(z_far, np.ones((9, 9))) - cv2.erode(z_far, np.ones((9, 9)))
        rows, cols = np.nonzero((z > 0) & (z < most_m) & (rough < 0.15 * z_far))
        rays = np.linalg.inv(self.K) @ np.array([cols, rows, np.ones_like(rows)])
        return rows, cols, (rays * z[rows, cols]).T
