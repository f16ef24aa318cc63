"""Reads a folder in the EuRoC layout with NumPy only."""

import csv

import numpy as np

from flown import rotation


def pose(R, p):
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = R, p
    return X


def yaml_numbers(text, key):
    """Returns the bracketed list after a key."""
    begin = text.index("[", text.index(key)) + 1
    return np.array([float(n) for n in text[begin:text.index("]", begin)].split(",")])


START_NS = 1_600_000_000_000_000_000  # time stamp of the start of a flight


def table(file):
    """Returns the rows of a table with times of the flight, ns. As numbers of NumPy, time stamps would lose 256 ns."""
    with open(file) as text:
        rows = [row for row in csv.reader(text) if not row[0].startswith("#")]
    return np.array([[int(row[0]) - START_NS, *map(float, row[1:])] for row in rows])


class Euroc:
    """Times are those of the flight, ns."""

    def __init__(self, folder):
        self.root = folder / "mav0"
        self.truth = table(self.root / "state_groundtruth_estimate0/data.csv")
        self.imu = table(self.root / "imu0/data.csv")

    def camera(self, name):
        text = (self.root / name / "sensor.yaml").read_text()
        fu, fv, cu, cv = yaml_numbers(text, "intrinsics")
        return np.array([[fu, 0, cu], [0, fv, cv], [0, 0, 1]]), yaml_numbers(text, "data").reshape(4, 4)

    def images(self, name):
        with open(self.root / name / "data.csv") as file:
            rows = list(csv.reader(file))
        return {int(t) - START_NS: self.root / name / "data" / image for t, image in rows[1:]}

    def state(self, t_ns):
        row = self.truth[np.searchsorted(self.truth[:, 0], t_ns)]
        assert row[0] == t_ns
        return row[1:4], rotation(*row[4:8]), row[8:11], row[11:14], row[14:17]
