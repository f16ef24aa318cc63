"""Whether a level flight through boxes and cylinders can keep a distance, by brute force on a grid."""

import collections
import math

CELL_M = 0.25
BESIDE_M = 30.0  # searched space around the points of a mission


def local(row, north, east, down):
    """A position in the axes of an obstacle, m."""
    w, x, y, z = (float(row[key]) for key in ("qw", "qx", "qy", "qz"))
    p = (north - float(row["north_m"]), east - float(row["east_m"]), down - float(row["down_m"]))
    axes = ((1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),  # columns of the rotation matrix
            (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
            (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))
    return [sum(a * b for a, b in zip(axis, p)) for axis in axes]


def distance_m(row, north, east, down):
    """From a position to the surface of a box or of a cylinder along its z axis; 0 inside."""
    x, y, z = local(row, north, east, down)
    half = [0.5 * float(row[f"size_{axis}_m"]) for axis in "xyz"]
    if row["shape"] == "cylinder":
        return math.hypot(max(0.0, math.hypot(x, y) - half[0]), max(0.0, abs(z) - half[2]))
    return math.hypot(*(max(0.0, abs(value) - size) for value, size in zip((x, y, z), half)))


def blocked_cells(rows, low, size, altitude, distance):
    """Cells that have a point closer than the distance to an obstacle."""
    reach = distance + CELL_M * math.sqrt(0.5)
    blocked = set()
    for row in rows:
        wide = 0.5 * math.hypot(*(float(row[f"size_{axis}_m"]) for axis in "xyz")) + reach
        spans = []
        for axis, key in enumerate(("north_m", "east_m")):
            first, last = (math.floor((float(row[key]) + side * wide - low[axis]) / CELL_M) for side in (-1, 1))
            spans.append(range(max(0, first), min(size[axis], last + 1)))
        for i in spans[0]:
            for j in spans[1]:
                if distance_m(row, low[0] + (i + 0.5) * CELL_M, low[1] + (j + 0.5) * CELL_M, -altitude) < reach:
                    blocked.add((i, j))
    return blocked


def has_way(rows, points, altitude, radius, distance):
    """Whether a way through points, in their order, keeps the distance from all obstacles.

    rows  obstacles as `hedgehop import --solids` writes them. points  (north, east), m. altitude  of the flight, m.
    radius  within which a point after the first one counts as reached, m. distance  from the vehicle's center, m.
    True is certain. False may be an error if the way is less than a cell wider than the distance.
    """
    low = [min(point[axis] for point in points) - BESIDE_M for axis in range(2)]
    size = [math.ceil((max(point[axis] for point in points) + BESIDE_M - low[axis]) / CELL_M) for axis in range(2)]
    blocked = blocked_cells(rows, low, size, altitude, distance)
    cells = [tuple(math.floor((point[axis] - low[axis]) / CELL_M) for axis in range(2)) for point in points]
    found = {cells[0]} - blocked
    for point in points[1:]:
        open_cells = collections.deque(found)
        while open_cells:
            i, j = open_cells.popleft()
            for cell in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if cell not in found and cell not in blocked and 0 <= cell[0] < size[0] and 0 <= cell[1] < size[1]:
                    found.add(cell)
                    open_cells.append(cell)
        found = {(i, j) for i, j in found
                 if math.hypot(low[0] + (i + 0.5) * CELL_M - point[0], low[1] + (j + 0.5) * CELL_M - point[1]) <= radius}
    return bool(found)
